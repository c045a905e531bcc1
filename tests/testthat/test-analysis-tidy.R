test_that("tidy tables have broom's names and the results' values", {
  skip_if_not_installed("generics")
  data <- grouped_sample(c(5, 6))
  compared <- compare_groups(data$x, data$group, n_perm = 49, seed = 1, progress = FALSE,
                             settings = comparison_settings(components = 2))
  tidied <- generics::tidy(compared)
  expect_named(tidied,
               c("level", "term", "statistic", "p.value", "adj.p.value", "p.value.parametric"))
  expect_equal(tidied$p.value, compared$tests$p_value)
  points <- generics::tidy(compared, "points")
  expect_equal(points$estimate, compared$points$displacement)
  glanced <- generics::glance(compared)
  expect_equal(glanced[c("nobs", "groups", "permutations", "exact")],
               data.frame(nobs = 11L, groups = 2L, permutations = 49L, exact = FALSE))
  expect_equal(glanced$p.value, compared$tests$p_value[2])
  pca <- compared$pca[[1]]
  expect_equal(generics::tidy(pca)$percent, pca$share)
  expect_equal(generics::glance(pca)$variance, sum(pca$sdev^2))
  aligned <- compared$aligned[[1]]
  expect_equal(generics::tidy(aligned), as.data.frame(aligned))
  expect_equal(generics::glance(aligned)$size, mean(aligned$size))
  without <- compare_groups(data$x, data$group, n_perm = 19, progress = FALSE,
                            settings = comparison_settings(tests = "points"))
  expect_crestline_error(generics::tidy(without), "no tests")
})
