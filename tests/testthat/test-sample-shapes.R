# A batch behaves as a list does, in memory and in files.

small_batch <- function(dir = NULL, specimens = batch_specimens(), ...) {
  fit_shapes(specimens, edge_scheme(...), dir)
}

test_that("elements are had by id and number; one that is not there is an error", {
  skip_without_futures()
  for (dir in list(NULL, tempfile("out-"))) {
    batch <- small_batch(dir)
    expect_length(batch, 3)
    expect_identical(batch$`ball 3`, batch[[3]])
    expect_crestline_error(batch[["bal 2"]], c("bal 2", "Near ids: ball 2"))
    for (i in list(4, 0, -1, NA, 1.5, 1:2, "", NULL)) {
      expect_crestline_error(batch[[i]], "no specimen")
    }
    expect_crestline_error(batch$anna, "anna")
    expect_named(batch[-2], c("ball 1", "ball 3"))
    expect_named(batch[c(TRUE, FALSE, FALSE)], "ball 1")
    expect_named(rev(batch), paste("ball", 3:1))
    expect_named(utils::head(batch, 2), paste("ball", 1:2))
    expect_length(batch[0], 0)
    for (i in list(5, "anna", NA, list(1), c(1, NA))) {
      expect_crestline_error(batch[i], "no specimen")
    }
    expect_crestline_error(batch[c(1, 1)], "twice")
    unlink(dir, recursive = TRUE)
  }
})

test_that("for and lapply give shapes, from files too, and NULL for what failed", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  three <- batch_specimens()
  three[[2]]$landmarks[] <- NA
  rownames(three[[2]]$landmarks) <- paste0("not ", letters[1:4])
  memory <- small_batch(NULL, three)
  files <- small_batch(out, three)
  curves <- function(shape) if (!is.null(shape)) coords(shape, "curves")
  right <- lapply(memory, curves)
  expect_identical(lapply(files, curves), right)
  i <- 0
  for (shape in files) {
    i <- i + 1
    expect_identical(curves(shape), right[[i]])
    if (i == 2) expect_null(shape) else expect_s3_class(shape, "shape")
  }
  expect_identical(i, 3)
  kept <- unclass(files)[[1]]
  expect_identical(names(kept), names(files[[1]]))
  expect_identical(kept[["status"]], files[[1]]$status)
  expect_identical(as.data.frame(kept), as.data.frame(files[[1]]))
  expect_output(print(kept), "<shape> ball 1")
  kept$specimen <- NULL
  expect_null(kept$specimen)
  expect_identical(class(kept), "shape")
  # A field is not taken from a file that has gone.
  unlink(file.path(out, "ball 3.shape"))
  expect_crestline_error(unclass(files)[[3]]$points, "not there", id = "ball 3")
  expect_identical(failures(files)$id, c("ball 2", "ball 3"))
})

test_that("two batches of one scheme are joined, in memory or in files", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  three <- batch_specimens()
  three[[3]]$landmarks <- three[[3]]$landmarks[0, ]
  joined <- c(small_batch(out, three[1]), small_batch(NULL, three[2:3]))
  expect_s3_class(joined, "shape_batch")
  expect_named(joined, paste("ball", 1:3))
  expect_identical(failures(joined)$id, "ball 3")
  expect_s3_class(joined[[1]], "shape")
  expect_identical(names(c(joined[3], joined[1])), c("ball 3", "ball 1"))
  expect_identical(summary(joined)$measured, c(TRUE, TRUE, FALSE))
  expect_crestline_error(c(joined, joined[1]), c("ball 1", "twice"))
  expect_crestline_error(c(joined, small_batch(NULL, batch_specimens(1), n = 9)),
                         "different schemes")
  expect_crestline_error(c(joined, list(1)), "shape_batch")
})

test_that("a batch that is none is refused", {
  skip_without_futures()
  batch <- small_batch(NULL, batch_specimens(2))
  shape <- batch[[1]]
  expect_crestline_error(validate_shape_batch(new_shape_batch(list(shape))), "no id")
  expect_crestline_error(validate_shape_batch(new_shape_batch(list(a = shape, a = shape))), "twice")
  expect_crestline_error(validate_shape_batch(new_shape_batch(list(a = 1))), "no shape")
  expect_crestline_error(validate_shape_batch(new_shape_batch(list(a = NULL))), "nothing tells why")
  expect_identical(validate_shape_batch(batch), batch)
})

test_that("a batch that a former version made is told, not an error", {
  file <- tempfile(fileext = ".shape")
  on.exit(unlink(file))
  to <- gzfile(file, "wb")
  serialize("key", to)
  serialize(quad_shape(edge_scheme()), to)
  close(to)
  failed <- structure(list(stage = "reading", message = "no mesh", remedy = "none"),
                      class = "shape_failure")
  old <- structure(list(a = NULL, b = failed, c = quad_shape(edge_scheme())),
                   files = list(file, NULL, NULL), class = "shape_batch")
  expect_identical(failures(old)[c("id", "stage")],
                   data.frame(id = c("a", "b"), stage = c("keeping", "reading")))
  expect_match(failures(old)$message[1], "former version")
  expect_s3_class(old$c, "shape")
  expect_warning(expect_null(old$a), "former version")
  expect_output(print(old), "1 measured, 2 failed")
})

test_that("missing landmarks are told", {
  skip_without_futures()
  three <- batch_specimens()
  three[[2]]$landmarks["c", ] <- NA
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  for (dir in list(NULL, out)) {
    batch <- small_batch(dir, three)
    expect_output(print(batch), "1 specimen: landmarks of the scheme are missing: ball 2 (1 of 4)",
                  fixed = TRUE)
    expect_identical(summary(batch)$lacking, c(0L, 1L, 0L))
  }
})
