shape <- quad_shape()

test_that("co-ordinates of single parts are rows of the whole, an unknown part is refused", {
  all <- coords(shape)
  part <- shape$scheme$curves$curve[2:1]
  expect_identical(coords(shape, part = part),
                   all[shape$points$part[shape$points$level == "curves"] %in% part, ])
  mark <- shape$scheme$landmarks$landmark[3]
  expect_identical(coords(shape, "landmarks", mark), coords(shape, "landmarks")[3, , drop = FALSE])
  expect_crestline_error(coords(shape, part = "lip"), c("part", "lip"))
})

test_that("one shape is an array of one specimen", {
  array <- as.array(shape, "curves")
  expect_identical(dim(array), c(dim(coords(shape)), 1L))
  expect_identical(array[, , shape$id], coords(shape))
  expect_identical(as.array(shape), as.array(shape, "landmarks"))
})

test_that("a shape says how to add the landmarks that its specimen has not", {
  lacking <- quad_shape(landmarks = quad_corners()[-1, ])
  name <- rownames(quad_corners())[1]
  expect_output(print(lacking), paste0("the specimen has no ", name), fixed = TRUE)
  expect_false(any(grepl("the specimen has no", capture.output(print(shape)))))
})

test_that("a setting that is a column of the scheme is told where it belongs", {
  expect_crestline_error(ridge_settings(radius = 7), c("belongs to the curves of a scheme"))
})

test_that("values of a shape's surface have their scale beside it", {
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  own <- sum(shape$points$level == "surface")
  with <- plot(shape, surface = seq_len(own), engine = "picture", resolution = 10)
  without <- plot(shape, surface = seq_len(own), engine = "picture", resolution = 10,
                  legend = FALSE)
  expect_gt(without$plt[2] - without$plt[1], with$plt[2] - with$plt[1])
})
