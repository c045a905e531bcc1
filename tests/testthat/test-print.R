# The first line of what is printed names the class, in one form for all.

printable_objects <- function(made = argument_objects()) {
  one <- made$specimens[[1]]
  shape <- made$shapes[[1]]
  curve <- suppressWarnings(ridge_curve(one, "aL", "aR", "ridge", radius = 20, width = 20, n = 7))
  sample <- suppressWarnings(homologise(made$shapes[1:4], rounds = 1, progress = FALSE))
  aligned <- align(sample, "landmarks")
  list(one, shape, curve, curve$path, curve$surface, curve$line, made$scheme, sample, aligned,
       shape_pca(aligned),
       suppressWarnings(compare_groups(sample, c(1, 1, 2, 2), "landmarks", n_perm = 19,
                                       progress = FALSE,
                                       settings = comparison_settings(components = 1))),
       curve_distance(shape, made$shapes[[2]]), sample_limits(), quality_limits(),
       quality(made$shapes[1:2]),
       repeatability(made$shapes[1:4], c("a", "a", "b", "b")), keep_away("aL", "aR"),
       keep_side("aL", "aR", "n"),
       curvature(one, 20), ridge_settings(), find_settings(), slide_settings(),
       path_settings(), cohort_settings(), norm_settings(), visit_settings(), repeat_settings(),
       small_norms(),
       suppressWarnings(compare_visits(small_patient(), small_patient(seed = 6))),
       visit_errors(list(small_patient(), small_patient(seed = 6))),
       suppressWarnings(assess(small_patient(), small_norms(), 10, "female")),
       simulate_cohort(2, template = symmetrise(shape), seed = 1),
       bending_energy(shape), suggest_landmarks(one, 20),
       suppressWarnings(check_scheme(made$scheme, one)),
       landmark_template(one), simulate_faces(2, scan = NULL, seed = 1, progress = FALSE),
       structure(list(ids = 1:2), class = "rgl_scene"),
       draw_quietly(draw_surface(made$ball, resolution = 5, samples = 1)),
       suppressWarnings(fit_shapes(made$specimens[1], made$scheme, progress = FALSE)))
}

test_that("every class prints a header that names it", {
  objects <- suppressWarnings(printable_objects())
  headers <- vapply(objects, function(x) utils::capture.output(print(x))[1], "")
  expect_match(headers, "^<[a-z_]+> .")
  named <- sub("^<([a-z_]+)>.*", "\\1", headers)
  expect_true(all(mapply(inherits, objects, named)), label = paste(headers, collapse = "; "))
  methods <- sub("^S3method[(]print,(.*)[)]$", "\\1",
                 grep("^S3method[(]print,",
                      readLines(system.file("NAMESPACE", package = "crestline")), value = TRUE))
  # Summaries print their object's header; a kept shape prints as the shape that it is read as.
  methods <- setdiff(methods,
                     c("comparison_summary", "crestline_summary", "summary_shape_pca",
                       "kept_shape", "norms_summary"))
  says <- function(class) {
    body <- deparse(body(utils::getS3method("print", class, envir = asNamespace("crestline"))))
    any(grepl(paste0("<", class, ">"), body, fixed = TRUE))
  }
  expect_identical(Filter(Negate(says), methods), character())
})
