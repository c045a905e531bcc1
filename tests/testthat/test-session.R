test_that("a value of the session is worked out once", {
  times <- 0
  make <- function() {
    times <<- times + 1
    times
  }
  name <- paste("test", Sys.getpid(), proc.time()[[3]])
  expect_identical(c(once(name, make), once(name, make)), c(1, 1))
})

test_that("what a caller does to the face's scheme stays with the caller", {
  scheme <- face_scheme()
  scheme$curves$radius <- 1
  expect_false(identical(face_scheme()$curves$radius, scheme$curves$radius))
})
