# 23 simulated faces in dense correspondence: what an independent implementation found.

simpop_dense <- function() {
  folder <- shared_data("simpop")
  meta <- read.csv(file.path(folder, "metadata.csv"))
  dense <- lapply(meta$id, function(id) {
    t(Rvcg::vcgImport(file.path(folder, paste0(id, ".ply")), silent = TRUE,
                      clean = FALSE)$vb[1:3, ])
  })
  marks <- read.csv(file.path(folder, "landmarks.csv"))
  marks <- lapply(meta$id, function(id) as.matrix(marks[marks$id == id, c("x", "y", "z")]))
  each <- lapply(list(dense = dense, landmarks = marks), simplify2array)
  each <- lapply(each, function(x) array(x, dim(x), list(NULL, c("x", "y", "z"), meta$id)))
  c(each, list(sex = stats::setNames(meta$sex, meta$id)))
}

test_that("sex differs in the faces of simpop as it was found before", {
  faces <- simpop_dense()
  compared <- compare_groups(faces[c("landmarks", "dense")], faces$sex, equal_spread = TRUE,
                             n_perm = 1999, seed = 1, progress = FALSE,
                             settings = comparison_settings(
                               tests = c("size", "shape", "T2", "components")))
  of <- function(level) compared$tests[compared$tests$level == level, ]
  p <- data.frame(test = of("dense")$test, landmarks = of("landmarks")$p_value,
                  dense = of("dense")$p_value)
  before <- data.frame(test = c("size t", "mean shape", "T2", "PC2"),
                       landmarks = c(0.001, 0.015, 0.001, 0.002),
                       dense = c(0.009, 0.002, 0.001, 0.015))
  ours <- p[match(before$test, p$test), c("landmarks", "dense")]
  # Both are shares of 1,999 random permutations.
  error <- sqrt(2 * as.matrix(before[-1]) / 1999) + 5e-4
  expect_true(all(abs(ours - before[-1]) < 4 * error))
  # Ten components carry all that the population varies in.
  expect_gt(sum(compared$pca$dense$share[1:10]), 0.999)
  distances <- lapply(compared$aligned,
                      function(one) as.vector(dist(t(matrix(one$coords, length(one$mean))))))
  expect_equal(cor(distances$landmarks, distances$dense), 0.95, tolerance = 0.01)
})
