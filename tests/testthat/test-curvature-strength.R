# A hand-made curvature: k1, k2 and directions along the axes.
by_hand <- function(k1, k2) {
  n <- length(k1)
  axis <- function(i) matrix(diag(3)[i, ], n, 3, byrow = TRUE)
  structure(list(k1 = k1, k2 = k2, direction1 = axis(1), direction2 = axis(2), normal = axis(3)),
            class = "curvature")
}

test_that("strength has the sought sign, and is 0 where the shape index has the other", {
  #            cup valley saddle-ish          ridge cap plane
  curved <- by_hand(k1 = c(2, 1, 1, 0.5, 0, -1, 0), k2 = c(1, 0, -0.5, -1, -1, -2, 0))
  expect_equal(strength_at(curved, "valley"), c(2, 1, 1, 0, 0, 0, 0))
  expect_equal(strength_at(curved, "ridge"), c(0, 0, 0, 1, 1, 2, 0))
  expect_equal(strength_at(curved, "ridge", at = c(6, 1)), c(2, 0))
})

test_that("however weak, it counts", {
  expect_identical(strength_at(by_hand(1e-9, -2e-9), "ridge"), 2e-9)
})

test_that("a symmetric saddle is neither ridge nor valley, NA stays NA", {
  expect_equal(strength_at(by_hand(1, -1), "ridge"), 0)
  expect_equal(strength_at(by_hand(1, -1), "valley"), 0)
  expect_true(is.na(strength_at(by_hand(NA_real_, NA_real_), "valley")))
})

test_that("across a direction it is Euler's formula, whatever the direction's length", {
  curved <- by_hand(k1 = c(3, 3, 3), k2 = c(1, 1, -5))
  angle <- pi / 6
  direction <- matrix(c(cos(angle), sin(angle), 0), 3, 3, byrow = TRUE)
  expect_equal(normal_curvature(curved, 1:3, direction),
               3 * cos(angle)^2 + c(1, 1, -5) * sin(angle)^2)
  expect_equal(normal_curvature(curved, 1:3, 7 * direction),
               normal_curvature(curved, 1:3, direction))
  expect_equal(strength_at(curved, "valley", 1:2, direction[1:2, ]), rep(3 * 0.75 + 0.25, 2))
  # positive along this direction
  expect_equal(strength_at(by_hand(0.1, -1), "ridge", 1, matrix(c(1, 0, 0), 1)), 0)
})

test_that("keep_away() is a cylinder about the axis with its extension, in shares of its length", {
  mesh <- grid_mesh(11)
  region <- keep_away(c(2, 5, 0), c(6, 5, 0), radius = 0.5, extension = 0.25)
  points <- rbind(c(4, 5, 0), c(4, 7, 0), c(4, 7.01, 0), c(1, 5, 0), c(0.99, 5, 0), c(7, 5, 0),
                  c(7.01, 5, 0), c(4, 5, 2))
  expect_identical(is_kept_away(in_context(located_regions(region, region_locator(mesh), mesh$id)),
                                points), c(TRUE, TRUE, FALSE, TRUE, FALSE, TRUE, FALSE, TRUE))
  expect_identical(is_kept_away(in_context(located_regions(NULL, region_locator(mesh), mesh$id)),
                                points), logical(8))
  both <- list(region, keep_away(c(0, 1, 0), c(1, 1, 0)))
  expect_identical(is_kept_away(in_context(located_regions(both, region_locator(mesh), mesh$id)),
                                rbind(points[1, ], c(0.5, 1.6, 0), c(9, 9, 0))),
                   c(TRUE, TRUE, FALSE))
  expect_crestline_error(check_regions(list("eye")), "keep_away()")
  expect_crestline_error(keep_away("a", "b", radius = -1), "`radius`")
  expect_crestline_error(keep_away("a", "b", extension = NA), "`extension`")
  expect_output(print(region), "\\(2, 5, 0\\) - \\(6, 5, 0\\): radius 0.5, extension 0.25")
})

test_that("keep_away() takes landmarks by name, and says which is missing", {
  face <- graph_specimen(quote(0 * u), two_ends())
  expect_identical(
    is_kept_away(in_context(located_regions(keep_away("a", "b", radius = 0.1), region_locator(face),
                                            face$id)), rbind(c(0, 1, 0), c(0, 9, 0))),
    c(TRUE, FALSE))
  expect_crestline_error(
    is_kept_away(in_context(located_regions(keep_away("a", "eye"), region_locator(face), face$id)),
                 diag(3)), "eye", id = "graph")
})

test_that("keep_side() keeps what lies beyond the line away, at any height above the plane", {
  mesh <- grid_mesh(11)
  region <- keep_side(c(2, 5, 0), c(6, 5, 0), towards = c(9, 8, 0))
  points <- rbind(c(4, 5.01, 0), c(4, 4.99, 0), c(-50, 5.01, 0), c(50, 4.99, 0), c(4, 5.01, 30),
                  c(4, 4.99, -30))
  expect_identical(is_kept_away(in_context(located_regions(region, region_locator(mesh), mesh$id)),
                                points), rep(c(FALSE, TRUE), 3))
  turned <- keep_side(c(6, 5, 0), c(2, 5, 0), towards = c(0, 8, 0))
  expect_identical(is_kept_away(in_context(located_regions(turned, region_locator(mesh), mesh$id)),
                                points), rep(c(FALSE, TRUE), 3))
  other <- keep_side(c(2, 5, 0), c(6, 5, 0), towards = c(9, 2, 0))
  expect_identical(is_kept_away(in_context(located_regions(other, region_locator(mesh), mesh$id)),
                                points), rep(c(TRUE, FALSE), 3))
  both <- list(region, keep_away(c(4, 6, 0), c(5, 6, 0), radius = 0.5))
  expect_identical(is_kept_away(in_context(located_regions(both, region_locator(mesh), mesh$id)),
                                rbind(c(4.5, 6, 0), c(4, 8, 0), c(4, 2, 0))), c(TRUE, FALSE, TRUE))
  expect_output(print(region), "side of \\(2, 5, 0\\) - \\(6, 5, 0\\) where \\(9, 8, 0\\) lies")
})

test_that("keep_side() takes landmarks by name, and refuses three on one line", {
  face <- graph_specimen(quote(0 * u), two_ends())
  expect_identical(
    is_kept_away(in_context(located_regions(keep_side("a", "b", c(0, 3, 0)), region_locator(face),
                                            face$id)), rbind(c(0, 1, 0), c(0, -1, 0))),
    c(FALSE, TRUE))
  expect_crestline_error(
    is_kept_away(in_context(located_regions(keep_side("a", "b", "eye"), region_locator(face),
                                            face$id)), diag(3)), "eye", id = "graph")
  expect_crestline_error(
    is_kept_away(in_context(located_regions(keep_side(c(-1, 0, 0), c(1, 0, 0), c(3, 0, 0)),
                                            region_locator(face), face$id)), diag(3)),
    "lies on the line", id = "graph")
})
