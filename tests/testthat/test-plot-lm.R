# Maps and scores of linear models.

grown_balls <- local({
  made <- NULL
  function() {
    if (!is.null(made)) return(made)
    ball <- Rvcg::vcgSphere(2)
    xyz <- t(ball$vb[1:3, ])
    bump <- exp(-20 * rowSums(sweep(xyz, 2, c(0, 0, 1))^2))
    people <- data.frame(id = paste0("s", 1:16), age = 1:16)
    balls <- with_seed(1, lapply(1:16, function(i) {
      xyz * (1 + 0.03 * stats::rnorm(1) * xyz[, 1]^2 + i / 200 * bump) +
        stats::rnorm(length(xyz), sd = 0.01)
    }))
    names(balls) <- people$id
    aligned <- align(simplify2array(balls), "ball", triangles = ball$it)
    made <<- shape_lm(aligned, ~ age, people, n_perm = 499, seed = 1,
                      settings = model_settings(tests = c("shape", "points")))
    made
  }
})

test_that("the map of a term holds the error that is asked", {
  model <- grown_balls()
  said <- function(adjust) {
    plot(model, "map", "age", adjust = adjust, engine = "widget")$drawn$title
  }
  counted <- function(p) sprintf("(%d of %d points)", sum(p <= 0.05), length(p))
  p <- model$points$p_value
  expect_match(said("none"), paste("p of each point < 0.05", counted(p)), fixed = TRUE)
  expect_match(said("fdr"),
               paste("false discovery rate < 0.05", counted(p.adjust(p, "BH"))), fixed = TRUE)
  expect_match(said("fwe"),
               paste("family-wise p < 0.05", counted(model$points$p_adjusted)), fixed = TRUE)
  expect_false(counted(p) == counted(model$points$p_adjusted))
})

test_that("what maps and base graphics cannot draw is refused by the package", {
  model <- grown_balls()
  wrong <- list(limits = "a", limits = 1, palette = "no colour", legend = NA, adjust = "bonferroni")
  for (i in seq_along(wrong)) {
    call <- c(list(model, "map", engine = "picture"), wrong[i])
    expect_crestline_error(draw_quietly(do.call(plot, call)), names(wrong)[i])
  }
  aligned <- model$aligned[[1]]
  group <- stats::setNames(rep(1:2, each = 8), names(aligned))
  compared <- compare_groups(aligned, group, n_perm = 19, progress = FALSE,
                             settings = comparison_settings(components = 2, tests = "size"))
  objects <- list(model, shape_pca(aligned), compared,
                  shape_lda(aligned, group, components = 2, progress = FALSE))
  for (object in objects) {
    more <- if (inherits(object, "shape_lm")) list("scores")
    expect_crestline_error(draw_quietly(do.call(plot, c(list(object), more, xlim = "a"))),
                           c("cannot be drawn", "further arguments"))
  }
})
