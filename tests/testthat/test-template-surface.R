# A free point alone: its place nearest to where the bond with a held point draws it.
drawn_to <- function(specimen, start, aim) {
  surface <- walkable(specimen)
  at <- as.matrix(surface_points(specimen$mesh, matrix(start, 1)))
  cpp_slide_on_mesh(surface$vb, surface$it, surface$twin, matrix(1), at[, 1:3, drop = FALSE],
                    -matrix(aim, 1), at[, 4:7, drop = FALSE], 1e-12, 100)
}

test_that("a point alone goes to the exactly closest place of the mesh", {
  mesh <- bent_ridge()
  for (i in 1:20) {
    aim <- with_seed(i, c(stats::runif(2, -12, 12), 8))
    start <- with_seed(i + 100, c(stats::runif(2, -12, 12), 0))
    found <- drawn_to(mesh, start, aim)
    closest <- surface_points(mesh$mesh, matrix(aim, 1))
    distance <- function(p) sqrt(sum((unlist(p)[1:3] - aim)^2))
    expect_equal(distance(found$points), distance(closest), tolerance = 1e-9)
    expect_true(found$trace$converged)
    expect_lte(max(diff(found$trace$energy)), 1e-10)
  }
})

test_that("it cannot jump to a sheet that it is not joined to", {
  sheet <- grid_mesh(9)
  other <- sheet
  other$vb[3, ] <- 0.5
  both <- structure(list(vb = cbind(sheet$vb, other$vb),
                         it = cbind(sheet$it, sheet$it + ncol(sheet$vb))), class = "mesh3d")
  two <- specimen(both, rbind(a = c(1, 1, 0)), id = "two", outward = "keep", debris = 0)
  found <- drawn_to(two, c(4.2, 4.1, 0), c(6.3, 6.1, 0.5))
  expect_equal(found$points[1, 1:3], c(6.3, 6.1, 0), tolerance = 1e-9)
})

test_that("a border stops it, and a face without area does not", {
  sheet <- grid_mesh(9)
  sheet$vb[1:2, 41] <- sheet$vb[1:2, 40]
  one <- specimen(sheet, rbind(a = c(1, 1, 0)), id = "one", outward = "keep")
  expect_equal(drawn_to(one, c(4.2, 4.1, 0), c(12, 3.3, 2))$points[1, 1:3], c(8, 3.3, 0),
               tolerance = 1e-9)
  expect_equal(drawn_to(one, c(1.2, 4.1, 0), c(7.2, 4.3, 1))$points[1, 1:3], c(7.2, 4.3, 0),
               tolerance = 1e-9)
})

test_that("points on bounding curves are held, those inside are free", {
  scheme <- paired_scheme()
  bound <- bound_places(scheme)
  free <- setdiff(unique(scheme$points$place), bound)
  expect_setequal(free,
                  as.vector(outer(1:6, 2:5,
                                  function(c, r) sprintf("surface|cheek left|%d %d", c, r))) |>
                    (\(left) c(left, sub("left", "right", left)))())
  expect_true("surface|belt|2" %in% bound)
})

test_that("held points of patches go along with the points of their curve", {
  shape <- paired_shape(c(1.2, 1, 1.1))
  slid <- slide(shape, symmetrise(paired_shape()), slide_settings(curves = "held"))
  track <- slid$tracks[["across"]]
  middle <- points_along(track$path, track$s[3])
  expect_equal(unname(coords(slid, "surface")["belt 2", ]), unname(as.vector(middle)),
               tolerance = 1e-9)
})

test_that("the energy of a shape's free points is least: moving any on the mesh raises it", {
  shape <- paired_shape(c(1.2, 1, 1.1))
  template <- symmetrise(paired_shape())
  settings <- slide_settings(curves = "held", surface_tolerance = 1e-9, surface_sweeps = 2000)
  slid <- slide(shape, template, settings)
  plan <- slide_plan(template, settings)
  set <- surface_sets(slide_state(slid, settings)$store, plan)[[1]]
  x <- places_of(slid)[set$places, ]
  least <- quadratic_form(set$b, x)
  expect_equal(least, slid$sliding$energy_after[slid$sliding$part == "surface"])
  for (i in seq_along(set$free)) {
    place <- set$free[i]
    nudged <- x
    aside <- x[place, , drop = FALSE] + with_seed(i, stats::rnorm(3, 0, 0.2))
    nudged[place, ] <- unlist(surface_points(shape$specimen$mesh, aside)[1:3])
    expect_gte(quadratic_form(set$b, nudged), least * (1 - 1e-9))
  }
})
