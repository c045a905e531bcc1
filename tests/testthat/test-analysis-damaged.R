# Alignments, components, comparisons and samples with a part that is not what it was.

tetrahedra <- function(n = 10) {
  shapes <- with_seed(5,
                      array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), n) +
                            stats::rnorm(12 * n, sd = 0.05), c(4, 3, n)))
  dimnames(shapes) <- list(letters[1:4], c("x", "y", "z"), paste0("s", seq_len(n)))
  shapes
}

with_attribute <- function(x, name, value) {
  class <- oldClass(x)
  x <- unclass(x)
  attr(x, name) <- value
  structure(x, class = class)
}

test_that("an alignment with a field of another kind is refused by all its methods", {
  aligned <- align(tetrahedra())
  calls <- list(as.data.frame, function(x) x[1:5], function(x) c(x[1:5], x[6:10]), shape_pca,
                as_geomorph, as_rrpp, as_morpho, function(x) `names<-`(x, letters[1:10]), print)
  wrong <- list(mean = "x", size = 1:3, weights = "x", tangent = NA, missing = "x",
                missing = list(), reference = sum, provenance = "x",
                provenance = list(settings = sum), settings = list(tolerance = "x"))
  for (i in seq_along(wrong)) {
    damaged <- with_attribute(aligned, names(wrong)[i], wrong[[i]])
    for (call in calls) {
      expect_error(utils::capture.output(call(damaged)), class = "crestline_error")
    }
  }
  lost <- structure(within(unclass(aligned), s1 <- "x"), class = "aligned")
  expect_error(as.data.frame(lost), "do not fit together", class = "crestline_error")
  expect_s3_class(aligned[1:5], "aligned")
})

test_that("components and a comparison with parts that do not fit are refused", {
  aligned <- align(tetrahedra())
  pca <- shape_pca(aligned)
  for (part in c("sdev", "share", "x", "direction", "mean")) {
    damaged <- tampered(pca, function(x) x[names(x) != part])
    for (call in list(summary, as.data.frame, plot, generics::tidy, generics::glance,
                      function(x) shape_at(x, 1, 2))) {
      expect_error(draw_quietly(call(damaged)), class = "crestline_error")
    }
  }
  compared <- compare_groups(aligned, stats::setNames(gl(2, 5), names(aligned)), n_perm = 49,
                             settings = comparison_settings(components = 2))
  for (part in c("tests", "points", "aligned", "group")) {
    damaged <- tampered(compared, function(x) replace(x, part, "x"))
    for (call in list(summary, as.data.frame, plot, generics::tidy, generics::glance)) {
      expect_error(draw_quietly(call(damaged)), "the comparison is damaged",
                   class = "crestline_error")
    }
  }
  for (call in list(summary, as.data.frame, generics::tidy, generics::glance)) {
    expect_no_error(call(compared))
  }
})

test_that("a sample with a damaged shape is refused", {
  sample <- own_mesh_case()$sample
  damaged_at <- function(change) {
    class <- oldClass(sample)
    parts <- unclass(sample)
    parts$ball <- change(parts$ball)
    structure(parts, class = class)
  }
  changes <- list(function(x) "x",
                  function(x) tampered(x, function(f) within_list(f, points = "x")),
                  function(x)
                    tampered(x, function(f)
                      within_list(f, points = replace(unclass(f$points), "level", list(sum)))),
                  function(x) tampered(x, function(f) within_list(f, id = NA)))
  for (change in changes) {
    for (call in list(align, summary, as.data.frame, quality, function(x) x[1])) {
      expect_error(call(damaged_at(change)), class = "crestline_error")
    }
  }
})
