# A sample in files has the numbers of the same sample in memory.

# An array in memory, and in files of seven specimens.
stored_sample <- function(n = c(12, 11), k = 12, effect = 0.05, block = 7, ...) {
  data <- grouped_sample(n, effect, k = k)
  x <- named_array(posed_sample(k, sum(n), sd = 0))
  with_seed(5, x[] <- x + stats::rnorm(length(x), sd = 0.05))
  x <- x + data$x / 5
  dimnames(x)[[3]] <- sprintf("s%02d", seq_len(sum(n)))
  list(x = x, group = stats::setNames(data$group, dimnames(x)[[3]]),
       files = write_blocks(x, tempfile("blocks-"), block, ...))
}

test_that("an alignment of files is that of the array", {
  skip_if_not_installed("nanoparquet")
  stored <- stored_sample()
  for (scale in list(TRUE, "full", FALSE)) {
    aligned <- suppressWarnings(align(stored$x, "points", scale))
    files <- suppressWarnings(align(stored$files, "points", scale))
    unit <- if (isFALSE(scale)) mean(aligned$size) else 1
    expect_equal(files$mean, aligned$mean, tolerance = 1e-10)
    expect_equal(files$size, aligned$size, tolerance = 1e-12)
    own <- unlist(lapply(1:4, function(i) read_block(attr(files, "files"), i)))
    expect_lt(max(abs(own - as.vector(aligned$coords))) / unit, 1e-10)
    expect_equal(as.data.frame(files), as.data.frame(aligned), tolerance = 1e-9)
  }
  expect_identical(names(files), dimnames(stored$x)[[3]])
  expect_match(printed_lines(files), "<aligned> 23 specimens, 12 points", all = FALSE)
  expect_crestline_error(files$coords, "in files")
  expect_crestline_error(files[1:3], "in files")
})

test_that("pairs, repeats and sites in files are those of the array", {
  skip_if_not_installed("nanoparquet")
  for (case in list(list(k = 12, triangles = NULL), list(k = 5, triangles = four_triangles()))) {
    stored <- stored_sample(c(12, 12), k = case$k, triangles = case$triangles)
    aligned <- align(stored$x, triangles = case$triangles)
    files <- align(stored$files)
    folders <- list.files(tempdir(), "^units-")
    # Pairs of both groups; three repeats of each of eight.
    for (block in list(rep(1:12, 2), rep(c(3, 1, 2, 4:8), each = 3))) {
      compare <- function(x) {
        suppressWarnings(compare_groups(
          x, stored$group, n_perm = 40, block = block, seed = 1,
          settings = comparison_settings(components = 2, n_boot = 20)
        ))
      }
      expect_alike(compare(files), compare(aligned), c("tests", "points", "components"))
    }
    draw_quietly(plot(suppressWarnings(compare_groups(files, stored$group, n_perm = 40,
                                                      block = rep(1:12, 2), seed = 1)), "boxes"))
    expect_identical(list.files(tempdir(), "^units-"), folders)
  }
})

test_that("a model of blocks is saved with its units, and a failure leaves no folder", {
  skip_if_not_installed("nanoparquet")
  stored <- stored_sample(c(12, 12), k = 5, triangles = four_triangles())
  kept <- tempfile("kept-")
  on.exit(unlink(kept, recursive = TRUE))
  files <- align(stored$files, settings = align_settings(dir = kept))
  data <- data.frame(id = names(files), age = rep(c(3, 9, 1, 4, 8, 2, 7, 5), each = 3))
  fit <- function(x) {
    shape_lm(x, ~ age, data, n_perm = 20, block = rep(1:8, each = 3), seed = 1,
             settings = model_settings(components = 2))
  }
  model <- fit(files)
  expect_identical(model$exchange, "whole")
  expect_alike(model, fit(align(stored$x, triangles = four_triangles())), c("tests", "points"))
  # Another session has other temporary files, and the folder that the user named.
  saved <- tempfile(fileext = ".rds")
  saveRDS(model, saved)
  unlink(list.files(tempdir(), "^units-", full.names = TRUE), recursive = TRUE)
  read <- readRDS(saved)
  expect_equal(predict(read, data.frame(age = 6)), predict(model, data.frame(age = 6)))
  expect_s3_class(draw_quietly(plot(read, "scores")), "data.frame")
  design <- list(kind = "within", block = factor(rep(1:12, 2)))
  where <- asNamespace("crestline")
  suppressMessages(trace("write_block", quote(stop("the disk is full")), print = FALSE,
                         where = where))
  on.exit(suppressMessages(untrace("write_block", where = where)), add = TRUE)
  expect_error(units_in_files(files, design), "the disk is full")
  expect_length(list.files(tempdir(), "^units-"), 0)
})

test_that("missing points of files are put in as those of the array", {
  skip_if_not_installed("nanoparquet")
  stored <- stored_sample()
  x <- stored$x
  x[3, , c(2, 14)] <- NA
  x[5:9, , 20] <- NA
  stored <- write_blocks(x, tempfile("blocks-"), 7)
  expect_warning(expect_warning(files <- align(stored), class = "crestline_estimated"),
                 class = "crestline_beyond")
  aligned <- suppressWarnings(align(x))
  expect_identical(files$missing, aligned$missing)
  # In any pose: each goes back to the mean from which it was put in.
  shape <- function(coords) apply(coords, 3, stats::dist)
  own <- unlist(lapply(1:4, function(i) shape(read_block(attr(files, "files"), i))))
  expect_equal(own, as.vector(shape(aligned$coords)), tolerance = 1e-5)
  expect_equal(files$size, aligned$size, tolerance = 1e-5)
  x[4, , ] <- NA
  expect_message(without <- suppressWarnings(align(write_blocks(x, tempfile("blocks-"), 7))),
                 "left out: 4")
  expect_identical(rownames(without$mean), setdiff(rownames(files$mean), "4"))
  x[-(1:4), , 7] <- NA
  expect_crestline_error(align(write_blocks(x, tempfile("blocks-"), 7)), "3 points only")
})

test_that("components, comparisons and models of files are those of the array", {
  skip_if_not_installed("nanoparquet")
  data <- data.frame(id = sprintf("s%02d", 1:23), age = 1:23, sex = rep(c("f", "m"), 12)[-24])
  # More variables than specimens, and fewer; along the normals, and all co-ordinates.
  for (case in list(list(k = 12, triangles = NULL), list(k = 5, triangles = four_triangles()))) {
    stored <- stored_sample(k = case$k, triangles = case$triangles)
    aligned <- align(stored$x, triangles = case$triangles)
    files <- align(stored$files)
    for (components in list(NULL, 3)) {
      expect_alike(shape_pca(files, components = components),
                   shape_pca(aligned, components = components),
                   c("x", "sdev", "rotation", "center", "share", "direction", "size"))
    }
    compare <- function(x) {
      compare_groups(x, stored$group, n_perm = 40, seed = 1,
                     settings = comparison_settings(components = 2, n_boot = 20))
    }
    expect_alike(compare(files), compare(aligned), c("tests", "points", "components"))
    fit <- function(x) {
      shape_lm(x, ~ age + sex, data, n_perm = 20, seed = 1,
               settings = model_settings(components = 2))
    }
    expect_alike(fit(files), fit(aligned), c("tests", "points"))
    expect_equal(predict(fit(files), data[2, ]), predict(fit(aligned), data[2, ]),
                 tolerance = 1e-9)
    new <- 3 * stored$x[, , 4]
    expect_equal(predict(shape_pca(files), new), predict(shape_pca(aligned), new),
                 tolerance = 1e-8)
  }
})

test_that("three groups, pooled variances and areas are those of the array too", {
  skip_if_not_installed("nanoparquet")
  stored <- stored_sample(k = 5, triangles = four_triangles())
  group <- rep(c("a", "b", "c"), c(8, 8, 7))
  names(group) <- names(stored$files)
  compare <- function(x, equal, ...) {
    suppressWarnings(compare_groups(x, group, n_perm = 30, seed = 1, equal_spread = equal,
                                    settings = comparison_settings(components = 2, ...)))
  }
  aligned <- align(stored$x, weights = "area", triangles = four_triangles())
  for (equal in c(TRUE, FALSE)) {
    expect_alike(compare(stored$files, equal, weights = "area"), compare(aligned, equal),
                 c("tests", "points"))
  }
})

test_that("missing points are dropped, or refused, and doubts are told", {
  skip_if_not_installed("nanoparquet")
  x <- named_array(posed_sample(10, 15))
  x[3, , c(2, 14)] <- NA
  x[, , 9] <- x[, , 5]
  files <- write_blocks(x, tempfile("blocks-"), 7)
  expect_crestline_error(align(files, missing = "stop"), "missing")
  expect_warning(dropped <- align(files, missing = "drop"), class = "crestline_twin")
  own <- suppressWarnings(align(x, missing = "drop"))
  expect_equal(dropped$mean, own$mean, tolerance = 1e-10)
  expect_equal(dropped$missing, own$missing, ignore_attr = TRUE)
  unlink(attr(dropped, "files")$dir, recursive = TRUE)
  expect_crestline_error(shape_pca(dropped), "not there any more")
})
