shapes <- paired_sample()

test_that("a shape knows scheme, mesh, landmarks and settings", {
  shape <- shapes[[2]]
  known <- shape$provenance
  expect_identical(known$scheme,
                   list(name = "paired", hash = scheme_hash(paired_scheme()), unit = 1))
  expect_identical(known$mesh$key, shape$key)
  expect_setequal(known$landmarks$landmark, rownames(paired_corners()))
  expect_identical(unique(known$landmarks$how), "given")
  expect_false(known$settings$ridge$error)
  expect_identical(known$settings$fit$cut_scale, 1)
  text <- capture.output(summary(shape))
  expect_match(text, "settings: ridge error = FALSE; fit as by default", fixed = TRUE, all = FALSE)
  expect_lte(length(text), 24)
})

test_that("measuring twice gives the same provenance, other settings another", {
  expect_identical(paired_shape(id = "ball1")$provenance, shapes[[1]]$provenance)
  coarse <- fit_shape(stretched_ball(id = "ball1"), paired_scheme(), ridge_settings(error = FALSE),
                      unit = 1, progress = FALSE, measuring = shape_settings(cut_scale = 0.9))
  expect_identical(coarse$provenance$settings$fit$cut_scale, 0.9)
  expect_match(provenance_lines(coarse$provenance), "cut_scale = 0.9", all = FALSE)
})

test_that("the unit of the scheme's lengths is told, with the hash of the scheme as it was given", {
  metres <- stretched_ball(id = "small")
  mesh <- metres$mesh
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] / 1000
  small <- specimen(mesh, metres$landmarks / 1000, id = "small")
  shape <- fit_shape(small, paired_scheme(), ridge_settings(error = FALSE), unit = 1000,
                     progress = FALSE)
  expect_identical(shape$provenance$scheme$hash, shapes[[1]]$provenance$scheme$hash)
  expect_match(provenance_lines(shape$provenance), "lengths divided by 1000", all = FALSE)
})

test_that("a slid shape and its sample name the template that they were slid against", {
  sample <- homologise(shapes, progress = FALSE)
  hash <- template_provenance("mean", places_of(sample$template))
  expect_identical(sample$provenance$template, hash)
  expect_identical(sample[["ball2"]]$provenance$template, hash)
  expect_identical(slide(shapes[[2]], sample$template)$provenance, sample[["ball2"]]$provenance)
  text <- capture.output(summary(sample[-1]))
  expect_lte(length(text), 24)
  expect_match(text, "3 meshes", all = FALSE)
  expect_match(text, "6 given of ball2, ball3, ball4", all = FALSE, fixed = TRUE)
  expect_match(text, hash$hash, all = FALSE)
  expect_no_match(text, "ball1")
})

test_that("results carry what their sample carries, and their own settings", {
  sample <- homologise(shapes, progress = FALSE)
  aligned <- align(sample, "curves", scale = FALSE)
  results <- list(aligned, aligned[-1],
                  c(align(sample[1:2], "curves", scale = FALSE),
                    align(sample[3:4], "curves", scale = FALSE)),
                  shape_pca(aligned), compare_groups(sample, c("a", "a", "b", "b"), "curves",
                                                     n_perm = 5, progress = FALSE,
                                                     settings = comparison_settings(
                                                       components = 1)),
                  repeatability(sample, c("a", "a", "b", "b")))
  for (result in results) {
    known <- result$provenance
    expect_identical(known$scheme$hash, scheme_hash(paired_scheme()))
    expect_identical(known$template, sample$provenance$template)
    expect_s3_class(known$specimens, "data.frame")
    text <- capture.output(print(summary(result)))
    expect_match(text, "made with: crestline", all = FALSE)
    expect_lte(length(text), 32)
  }
  expect_identical(results[[1]]$provenance$specimens$id, names(sample))
  expect_identical(results[[2]]$provenance$specimens$id, names(sample)[-1])
  expect_identical(results[[3]]$provenance$specimens$id, names(sample))
  expect_match(capture.output(summary(aligned)), "align scale = FALSE", all = FALSE)
  expect_s3_class(summary(results[[4]]), "summary.prcomp")
  expect_identical(names(summary(results[[5]])), c("test", "curves"))
})

test_that("of an array only what it was made with is known, and of an old shape nothing", {
  known <- align(posed_sample())$provenance
  expect_setequal(names(known), c("package", "r", "settings"))
  old <- shapes[[1]]
  old$provenance <- NULL
  expect_output(print(summary(old)), "not recorded")
  expect_identical(specimens_provenance(list(old))$landmarks, "not recorded")
})

test_that("settings that differ between specimens are told of", {
  other <- fit_shape(stretched_ball(id = "other"), paired_scheme(), ridge_settings(error = FALSE),
                     progress = FALSE, measuring = shape_settings(bridge = 0.1))
  said <- settings_lines(shapes_provenance(list(shapes[[1]], other))$settings)
  expect_match(said, "fit differs = between specimens", fixed = TRUE)
  expect_match(said, "ridge error = FALSE", fixed = TRUE)
})
