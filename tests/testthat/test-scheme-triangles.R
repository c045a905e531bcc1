test_that("quads are split from (c, r) to (c + 1, r + 1), in both orders", {
  grid <- t(matrix(1:4, 2))  # column 1: vertices 1, 2; column 2: 3, 4
  expect_equal(quad_triangles(grid, "columns", "model", "g")[3:5],
               data.frame(v1 = c(1L, 1L), v2 = c(3L, 4L), v3 = c(4L, 2L)))
  expect_equal(quad_triangles(grid, "rows", "model", "g")[3:5],
               data.frame(v1 = c(1L, 1L), v2 = c(4L, 2L), v3 = c(3L, 4L)))
})

test_that("a repeated corner leaves one triangle, two leave none", {
  expect_equal(nrow(quad_triangles(rbind(c(1, 1), 2:3), "rows", "model", "g")), 1)
  expect_equal(nrow(quad_triangles(rbind(c(1, 1), c(2, 2)), "rows", "model", "g")), 0)
  expect_equal(nrow(quad_triangles(rbind(1:3), "rows", "model", "g")), 0)
})

# Edges in both directions: 1 each way inside, 1 at a border.
half_edges <- function(triangles) {
  v <- as.matrix(triangles[c("v1", "v2", "v3")])
  paste(c(v), c(v[, c(2, 3, 1)]))
}

test_that("the leaf's triangles are one sheet, all in one sense", {
  triangles <- leaf_scheme()$triangles
  expect_equal(nrow(triangles), 2 * (2 * 3 * 2) + 2 * 4)
  expect_equal(anyDuplicated(half_edges(triangles)), 0)
  expect_setequal(triangles$group,
                  c("blade left", "blade right", "strip rib left", "strip rib right"))
})
