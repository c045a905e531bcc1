test_that("a loop is walked once round at any offset, whichever face it begins in", {
  ring <- ring_specimen()
  scan <- walkable(ring)
  path <- reference_path(ring, "a", "a", "ridge", radius = ring_radius, via = "b")
  window <- near_path(scan, path, 4, 3)
  s <- seq(0, attr(path, "length"), length.out = 41)
  for (start in c(0, 0.5)) {
    wave <- cos(2 * pi * s / attr(path, "length"))
    walked <- walked_loop(scan, window, s, wave, tries = start)
    expect_path_on_mesh(walked, ring$mesh)
    expect_true(is_closed(walked))
    found <- cpp_path_coordinates(t(xyz_of(walked)), t(xyz_of(path)), path_normals(scan, path),
                                  TRUE)
    expect_equal(found$d, cos(2 * pi * found$s / attr(path, "length")), tolerance = 0.1)
  }
})

test_that("a line that leaves its window is not walked", {
  ring <- ring_specimen()
  scan <- walkable(ring)
  path <- reference_path(ring, "a", "a", "ridge", radius = ring_radius, via = "b")
  window <- near_path(scan, path, 2, 1)
  s <- c(0, attr(path, "length"))
  expect_true(failed(walked_loop(scan, window, s, c(50, 50))))
  half <- window[window$s < 30, ]
  attributes(half)[c("length", "closed")] <- attributes(window)[c("length", "closed")]
  expect_true(failed(walked_loop(scan, half, s, c(0, 0))))
})
