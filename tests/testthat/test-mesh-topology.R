topology_of <- function(...) cpp_mesh_topology(matrix(as.integer(c(...)), 3), max(...))

test_that("two triangles share one edge and have four of the border", {
  pair <- topology_of(1, 2, 3, 2, 1, 4)
  # Half edges: 1: 1-2, 2: 2-3, 3: 3-1; 4: 2-1, 5: 1-4, 6: 4-2.
  expect_identical(pair$twin, matrix(c(4L, 0L, 0L, 1L, 0L, 0L), 3))
  expect_identical(pair$border_edges, 4L)
  expect_identical(pair$nonmanifold_edges, 0L)
  expect_identical(pair$pieces, 1L)
  expect_identical(pair$piece, c(1L, 1L))
})

test_that("twins are mutual, run the other way, and a closed mesh has no border", {
  mesh <- ball()
  topology <- mesh_topology(mesh)
  twin <- as.vector(topology$twin)
  expect_identical(twin[twin], seq_along(twin))
  start <- as.vector(mesh$it)
  end <- as.vector(mesh$it[c(2, 3, 1), ])
  expect_equal(start[twin], end)
  expect_equal(end[twin], start)
  expect_identical(topology$border_edges, 0L)
  expect_identical(topology$pieces, 1L)
})

test_that("a grid's border is its outline", {
  topology <- mesh_topology(grid_mesh(6))
  expect_identical(topology$border_edges, 4L * 5L)
  expect_identical(sum(topology$twin == 0), 20L)
})

test_that("an edge of three triangles belongs to none of them", {
  book <- topology_of(1, 2, 3, 2, 1, 4, 1, 2, 5)
  expect_identical(book$nonmanifold_edges, 1L)
  expect_true(all(book$twin == 0))
  expect_identical(book$border_edges, 6L)
  expect_identical(book$pieces, 3L)
})

test_that("two triangles that run through their edge the same way are not joined", {
  turned <- topology_of(1, 2, 3, 1, 2, 4)
  expect_identical(turned$nonmanifold_edges, 1L)
  expect_identical(turned$pieces, 2L)
})

test_that("pieces joined in a corner only are two pieces", {
  corner <- topology_of(1, 2, 3, 3, 4, 5)
  expect_identical(corner$piece, 1:2)
  expect_identical(corner$pieces, 2L)
})
