key <- function(mesh) crestline:::mesh_key(mesh)
ball <- Rvcg::vcgSphere(2)

test_that("a mesh has one key, whatever it is dressed in", {
  expect_match(key(ball), "^[0-9a-f]{32}$")
  dressed <- ball
  dressed$vb <- rbind(ball$vb[1:3, ], 1)
  dressed$normals <- -ball$normals
  dressed$material <- list(color = rep("#FF0000", ncol(ball$vb)))
  dimnames(dressed$vb) <- list(c("x", "y", "z", "w"), NULL)
  expect_identical(key(dressed), key(ball))
  dressed$vb <- ball$vb[1:3, ]
  storage.mode(dressed$it) <- "double"
  expect_identical(key(dressed), key(ball))
  zero <- ball
  zero$vb[ball$vb == 0] <- -0
  expect_identical(key(zero), key(ball))
})

test_that("the key does not depend on how R keeps the numbers", {
  plain <- list(vb = rbind(c(0, 1, 0), c(0, 0, 1), 0), it = matrix(c(1L, 2L, 3L), 3))
  compact <- plain
  compact$it <- matrix(1:3, 3)
  expect_identical(key(compact), key(plain))
  expect_identical(key(unserialize(serialize(ball, NULL))), key(ball))
})

test_that("other vertices, triangles or orders have other keys", {
  n <- ncol(ball$it)
  others <- list(
    moved = within(unclass(ball), vb[1, ] <- vb[1, ] + 1),
    nudged = within(unclass(ball), vb[2, 5] <- vb[2, 5] * (1 + 1e-15) + 1e-300),
    reordered = within(unclass(ball), it <- it[, n:1]),
    turned = within(unclass(ball), it[, 1] <- it[c(2, 3, 1), 1]),
    cut = within(unclass(ball), it <- it[, -1]),
    swapped = within(unclass(ball), it[, 1:2] <- it[, 2:1]),
    exchanged = within(unclass(ball), vb[, 1:2] <- vb[, 2:1]),
    axes = within(unclass(ball), vb[1:3, ] <- vb[c(2, 1, 3), ])
  )
  keys <- vapply(c(list(ball), others), key, "")
  expect_identical(anyDuplicated(keys), 0L)
})

test_that("keys of many small changes differ", {
  set.seed(1)
  keys <- replicate(2000, {
    one <- ball
    at <- sample(length(one$it), 1)
    one$it[at] <- sample(setdiff(seq_len(ncol(one$vb)), one$it[at]), 1)
    paste(key(one), rlang::hash(one$it))
  })
  expect_identical(length(unique(substr(keys, 1, 32))), length(unique(substr(keys, 34, 65))))
})
