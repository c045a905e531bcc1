# One face against a norm.

looked <- function(shape, ..., norms = small_norms()) {
  suppressWarnings(assess(shape, norms, age = 10, sex = "female", ...))
}

test_that("z does not depend on the pose, and size only on size", {
  shape <- small_patient()
  moved <- larger <- shape
  xyz <- as.matrix(shape$points[c("x", "y", "z")])
  turn <- rotation_about(c(0.4, 1, -2))
  moved$points[c("x", "y", "z")] <- as.data.frame(sweep(xyz %*% turn, 2, c(30, -5, 9), `+`))
  larger$points[c("x", "y", "z")] <- as.data.frame(1.1 * xyz)
  larger$points$se <- 1.1 * shape$points$se
  a <- looked(shape)
  b <- looked(moved)
  # Errors come from draws, which are turned with the face.
  same <- c("name", "value", "z", "centile", "se_scan")
  expect_equal(a$values[same], b$values[same], tolerance = 1e-6)
  expect_equal(a$points[-(2:4)], b$points[-(2:4)], tolerance = 1e-6)
  c <- looked(larger)
  expect_equal(c$values$value[1], 1.1 * a$values$value[1])
  expect_equal(c$points$z_map, a$points$z_map, tolerance = 1e-6)
  ratio <- a$values$name == "index"
  expect_equal(c$values$z[ratio], a$values$z[ratio], tolerance = 1e-8)
})

test_that("what errors add is taken off a worse scan, and off one whose errors are not known", {
  norms <- small_norms()
  long <- norms$table$name == "arc"
  expect_gt(norms$table$bias_norm[long], 0)
  people <- data.frame(age = rep(10, 60), sex = "female")
  value <- function(noise) {
    shapes <- simulate_cohort(60, data = people, template = small_template(), seed = 3,
                              settings = cohort_settings(noise = noise))$sample$shapes
    each <- lapply(shapes, own_errors, norms, draws = 20)
    list(with = vapply(each, function(one) one$value[long], 0),
         bias = mean(vapply(each, function(one) one$bias[long], 0)), shapes = shapes)
  }
  truth <- value(0)
  worse <- value(2)
  off <- worse$with - truth$with
  # Errors of 2 lengthen the arc by many standard errors of a mean
  expect_gt(worse$bias, 5 * stats::sd(off) / sqrt(60))
  expect_lt(abs(mean(off)), 3 * stats::sd(off) / sqrt(60))
  bare <- worse$shapes[[1]]
  bare$points$se <- NA_real_
  found <- own_errors(bare, norms)
  plain <- measurements(bare, norms$measurements, draws = 0)$value[which(long) - 1]
  expect_equal(found$value[long], log(plain) - norms$table$bias_norm[long])
  former <- norms
  former$table$bias_norm <- NULL
  expect_equal(own_errors(worse$shapes[[1]], former)$value[long], log(plain))
})

test_that("a measurement that is not larger than what its errors add is not assessed", {
  shape <- small_patient()
  shape$points$se <- 60
  found <- looked(shape)$values
  expect_true(is.na(found$z[1]))
  expect_match(found$reason[1], "not larger than what its errors add")
  # The print says so, also where no value is left
  x <- suppressWarnings(assess(shape, small_norms(), age = 10, sex = "female"))
  x$values <- x$values[c(1, grep("component", x$values$name)), ]
  x$values$reason[3] <- "a point that it needs is missing"
  text <- paste(utils::capture.output(print(x)), collapse = " ")
  expect_match(text, paste("2 values (it is not larger than what its errors add, a point that it",
                           "needs is missing)"), fixed = TRUE)
})

test_that("z, centile and expectation fit each other", {
  found <- looked(small_patient())$values
  expect_equal(found$centile, 100 * stats::pnorm(found$z))
  expect_true(all((found$z > 0) == (found$value > found$expected)))
  expect_true(all(found$se_norm > 0))
  norms <- small_norms()
  expected <- expected_columns(norms$values, 10, "female")
  expect_equal(found$expected[1], exp(expected$mean[1]))
})

test_that("a lesion is found where it is, and healed; a plain face is left as it is", {
  template <- small_template()
  point <- rownames(coords(template, "surface"))[18]
  plain <- looked(small_patient())
  expect_equal(plain$verdicts$verdict[5], "not distinguishable")
  expect_equal(nrow(plain$findings), 0)
  expect_equal(plain$healed, as.matrix(plain$points[c("x", "y", "z")]), ignore_attr = TRUE)
  with <- looked(small_patient(lesions = data.frame(height = 8, radius = 18, point = point)))
  expect_equal(with$verdicts$verdict[5], "real")
  expect_lt(with$verdicts$p[5], 0.001)
  at <- match(with$findings$point[1], rownames(coords(template, "surface")))
  apart <- as.matrix(stats::dist(coords(template, "surface")))
  expect_lt(apart[18, at], 20)
  expect_equal(with$points$healed[18], 8, tolerance = 0.35)
  out <- with$points$healed_sd > 0
  expect_equal(with$healed[!out, ], as.matrix(with$points[!out, c("x", "y", "z")]),
               ignore_attr = TRUE, tolerance = 1e-6)
  expect_match(paste(utils::capture.output(print(with)), collapse = "\n"), "found at .*height")
  expect_match(finding_words(with$findings[1, ], "mm"),
               "radius [0-9.]+ mm, volume [0-9.e+]+ mm\\^3")
})

test_that("a lesion on both sides is found on both, and healed there", {
  norms <- small_norms()
  side <- which(norms$points$side)[10]
  pair <- norms$points$point[c(side, norms$points$partner[side])]
  plain <- small_patient()
  both <- plain
  xyz <- c("x", "y", "z")
  for (point in pair) {
    one <- small_patient(lesions = data.frame(height = 8, radius = 18, point = point))
    both$points[xyz] <- both$points[xyz] + one$points[xyz] - plain$points[xyz]
  }
  found <- looked(both)
  expect_equal(found$verdicts$verdict[5], "real")
  expect_match(found$verdicts$where[5], " and ")
  first <- found$findings[1:2, ]
  expect_true(all(first$both))
  row <- match(first$point, norms$points$point)
  expect_equal(norms$points$partner[row], rev(row))
  expect_true(all(found$points$healed[match(pair, norms$points$point)] > 4))
  expect_match(paste(utils::capture.output(print(found)), collapse = "\n"), "both sides")
  # Of one side only one disc is healed.
  expect_false(any(looked(one)$findings$both))
})

test_that("points that are left out are what the whole correlation makes expected", {
  field <- small_norms()$surface
  u <- with_seed(3, stats::rnorm(105))
  out <- rep(seq_len(35) %in% c(4, 5, 12), 3)
  found <- given_the_rest(field, u, out)
  pose <- pose_directions(field)
  whole <- field$vectors %*% (field$values * t(field$vectors)) + block_kernel(field) +
    1e6 * tcrossprod(pose)
  weight <- whole[out, !out] %*% solve(whole[!out, !out])
  expect_equal(found$fit[out], as.vector(weight %*% u[!out]), tolerance = 1e-3)
  expect_equal(found$fit[!out], u[!out])
  expect_equal(found$variance[out], diag(whole[out, out] - weight %*% whole[!out, out]),
               tolerance = 1e-2)
})

test_that("a worse scan is judged on a wider scale", {
  rough <- small_patient(settings = cohort_settings(noise = 1))
  told <- rough
  unknown <- rough
  unknown$points$se <- NA_real_
  blind <- rough
  blind$points$se <- 0.1
  largest <- function(shape) looked(shape)$verdicts$statistic[5]
  expect_lt(largest(told), largest(blind))
  expect_lt(largest(unknown), largest(blind))
  expect_identical(looked(told)$errors, "given")
  found <- looked(unknown)
  expect_identical(found$errors, "estimated")
  expect_gt(found$rough, 2)
  values <- looked(told)$values
  expect_true(all(abs(values$z_widened) <= abs(values$z) + 1e-9, na.rm = TRUE))
})

test_that("missing points are left out, and said", {
  shape <- small_patient()
  lost <- shape$points$level == "surface" & shape$points$point %in% c("3 3", "3 4")
  holed <- shape
  holed$points[lost, c("x", "y", "z", "se")] <- NA
  found <- looked(holed)
  expect_equal(sum(!found$points$assessed), 2)
  expect_true(all(is.na(found$points$z_map[!found$points$assessed])))
  whole <- looked(shape)
  far <- found$points$assessed
  expect_gt(stats::cor(found$points$z_map[far], whole$points$z_map[far]), 0.95)
  expect_match(paste(utils::capture.output(print(found)), collapse = " "), "2 surface points")
})

test_that("ages beyond the norm, other schemes and unknown sexes are refused", {
  shape <- small_patient()
  norms <- small_norms()
  expect_crestline_error(assess(shape, norms, 40, "female"), c("`age`", "range"))
  expect_crestline_error(assess(shape, norms, 10, "boy"), "`sex`")
  expect_crestline_error(assess(shape, norms, 10), "`sex`")
  expect_crestline_error(assess(quad_shape(), norms, 10, "female"), "another scheme")
  few <- norms
  few$settings$least <- 1e6
  expect_crestline_error(assess(shape, few, 10, "female"), "effective")
  few <- norms
  few$settings$few <- 1e6
  expect_warning(assess(shape, few, 10, "female"), class = "crestline_norm_doubt")
  damaged <- norms
  damaged$points <- damaged$points[-1, ]
  expect_crestline_error(assess(shape, damaged, 10, "female"), "damaged")
  former <- norms
  former$surface$healing <- NULL
  expect_crestline_error(assess(shape, former, 10, "female"), "former version")
})

test_that("a mirror image is refused by name", {
  mirrored <- small_patient()
  mirrored$points$x <- -mirrored$points$x
  expect_error(looked(mirrored), "mirror image", class = "crestline_mirrored")
  expect_error(compare_visits(small_patient(), mirrored), "mirror image",
               class = "crestline_mirrored")
})

test_that("another template than the norm's is said; the same one is not", {
  norms <- small_norms()
  norms$scheme$template <- "one"
  shape <- small_patient()
  shape$provenance$template <- list(id = "x", hash = "other")
  expect_warning(suppressWarnings(assess(shape, norms, 10, "female"), "crestline_norm_doubt"),
                 "another template", class = "crestline_other_template")
  shape$provenance$template$hash <- "one"
  heard <- character()
  withCallingHandlers(assess(shape, norms, 10, "female"), warning = function(w) {
    heard <<- c(heard, class(w))
    rlang::cnd_muffle(w)
  })
  expect_false("crestline_other_template" %in% heard)
  # The file keeps it.
  dir <- tempfile()
  write_norms(norms, dir)
  expect_identical(read_norms(dir)$scheme$template, "one")
  unlink(dir, recursive = TRUE)
})

test_that("below a number of faces the map's limit is Bonferroni's", {
  norms <- small_norms()
  expect_equal(looked(small_patient())$limits[["map"]], stats::qnorm(1 - 0.05 / 70))
  norms$settings$bonferroni_below <- 0
  at <- limit_levels() == 0.95
  expect_equal(looked(small_patient(), norms = norms)$limits[["map"]], norms$limits$map[at])
})

test_that("another unit is refused; red parts and a shape that was not slid are said", {
  shape <- small_patient()
  metres <- shape
  metres$points[c("x", "y", "z")] <- metres$points[c("x", "y", "z")] / 1000
  error <- expect_error(looked(metres), class = "crestline_unit_error")
  expect_match(conditionMessage(error), "0[.]001[0-9]* times .* another unit")
  # As if it had been measured on a scan
  measured <- shape
  measured$key <- "a mesh"
  expect_warning(assess(measured, small_norms(), age = 10, sex = "female"), "not slid",
                 class = "crestline_not_slid") |> suppressWarnings()
  heard <- character()
  withCallingHandlers(assess(shape, small_norms(), age = 10, sex = "female"),
                      warning = function(w) {
                        heard <<- c(heard, class(w))
                        rlang::cnd_muffle(w)
                      })
  expect_false("crestline_not_slid" %in% heard)
})
