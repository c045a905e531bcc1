# Discriminants: those of MASS, an error that has not seen the specimen.

lda_of <- function(...) suppressMessages(shape_lda(...), "crestline_message")

test_that("discriminants of all specimens are those of MASS::lda on the scores", {
  made <- grouped_sample(c(12, 14), effect = 0.1)
  fit <- lda_of(made$x, made$group, components = 4)
  pca <- shape_pca(align(made$x))
  theirs <- MASS::lda(pca$x[, 1:4] / 1e-3, made$group)
  ours <- predict(fit)
  expect_equal(ours$posterior, predict(theirs)$posterior, tolerance = 1e-8, ignore_attr = TRUE)
  expect_equal(nrow(as.data.frame(fit)), 26)
})

test_that("each specimen is assigned as by a sample that never had it", {
  made <- grouped_sample(c(8, 9), effect = 0.12)
  fit <- lda_of(made$x, made$group, components = 3)
  for (i in c(1, 17)) {
    without <- align(made$x[, , -i])
    scores <- shape_pca(without)
    one <- predict(scores, made$x[, , i])[, 1:3, drop = FALSE]
    theirs <- MASS::lda(scores$x[, 1:3] / 1e-3, made$group[-i], prior = c(8, 9) / 17)
    expect_equal(unname(fit$posterior[i, ]), unname(predict(theirs, one / 1e-3)$posterior[1, ]),
                 tolerance = 1e-6)
  }
  expect_equal(sum(fit$confusion), 17)
  expect_equal(fit$error, mean(!fit$specimens$correct))
})

test_that("labels without meaning are guessed as by chance, an effect is not", {
  right <- vapply(1:20, function(seed) {
    made <- grouped_sample(c(8, 8), seed = seed)
    1 - lda_of(made$x, made$group, components = 1:4)$error
  }, 0)
  expect_lt(abs(mean(right) - 0.5), 3.5 * 0.5 / sqrt(320) + 0.03)
  made <- grouped_sample(c(8, 8), effect = 0.3)
  expect_gt(1 - lda_of(made$x, made$group, components = 1:4)$error, 0.9)
})

test_that("answers do not depend on pose, unit or order", {
  made <- grouped_sample(c(7, 8), effect = 0.1)
  dimnames(made$x) <- list(NULL, NULL, paste0("s", 1:15))
  group <- stats::setNames(made$group, paste0("s", 1:15))
  fit <- lda_of(made$x, group, components = 1:3)
  mixed <- with_seed(1, sample.int(15))
  again <- lda_of(100 * made$x[, , mixed] + 3, group, components = 1:3)
  expect_equal(again$posterior[names(group), ], fit$posterior, tolerance = 1e-6)
  expect_output(print(fit), "left out and assigned")
})

test_that("what cannot be is refused", {
  made <- grouped_sample(c(2, 9))
  expect_error(lda_of(made$x, made$group), "two specimens", class = "crestline_error")
  made <- grouped_sample(c(4, 4))
  expect_error(lda_of(made$x, made$group, components = 7), "`components`",
               class = "crestline_error")
})

test_that("discriminants that another session reads assign new shapes", {
  skip_on_cran()
  made <- grouped_sample(c(7, 8), effect = 0.1)
  fit <- lda_of(made$x, made$group, components = 3)
  files <- c(tempfile(fileext = ".rds"), tempfile(fileext = ".rds"), tempfile(fileext = ".R"))
  on.exit(unlink(files))
  saveRDS(list(fit = fit, new = made$x[, , 2]), files[1])
  writeLines(sprintf(".libPaths(%s); given <- readRDS('%s'); library(crestline, quietly = TRUE)
    saveRDS(predict(given$fit, given$new), '%s')", paste(deparse(.libPaths()), collapse = ""),
    files[1], files[2]), files[3])
  system2(file.path(R.home("bin"), "Rscript"), c("--vanilla", files[3]), stdout = FALSE,
          stderr = FALSE)
  expect_equal(readRDS(files[2])$posterior, predict(fit, made$x[, , 2])$posterior)
})
