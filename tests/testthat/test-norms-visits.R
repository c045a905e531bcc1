# Two visits: what has changed, and what has not.

two_visits <- function(height = 0, n = 1, ..., seed = 1) {
  people <- data.frame(age = rep(20, n), sex = rep("female", n))
  simulate_cohort(n, data = people, template = small_template(), visits = 2, seed = seed,
                  lesions = data.frame(height = height, radius = 18, point = "mid 4 3", visit = 2),
                  settings = cohort_settings(noise = 0.1, ...))
}

test_that("a change is found where it is, and its size is right", {
  made <- two_visits(4)
  found <- compare_visits(made$sample[[1]], made$second[[1]])
  own <- found$points[found$points$level == "surface", ]
  at <- which(paste(own$part, own$point) == "mid 4 3")
  expect_equal(own$change[at], 4, tolerance = 0.1)
  expect_true(own$called[at])
  expect_equal(own$se[at], sqrt(2) * 0.1, tolerance = 0.1)
  expect_equal(own$detectable, stats::qnorm(0.975) * own$se)
  far <- as.matrix(stats::dist(own[c("x", "y", "z")]))[at, ] > 22
  expect_lt(max(abs(own$change[far])), 0.6)
  expect_true(found$converged)
  expect_match(utils::capture.output(print(found))[1], "<visit_comparison>")
})

test_that("the pose of the second visit does not count, its size does", {
  made <- two_visits(4)
  moved <- made$second[[1]]
  xyz <- as.matrix(moved$points[c("x", "y", "z")])
  moved$points[c("x", "y", "z")] <- as.data.frame(
    sweep(xyz %*% rotation_about(c(1, -1, 0.5)), 2, c(20, 30, -4), `+`)
  )
  a <- compare_visits(made$sample[[1]], made$second[[1]], table = ball_measurements())
  b <- compare_visits(made$sample[[1]], moved, table = ball_measurements())
  expect_equal(a$points, b$points, tolerance = 1e-5)
  expect_equal(a$measurements$change, b$measurements$change, tolerance = 1e-6)
  same <- compare_visits(made$sample[[1]], made$sample[[1]])
  expect_lt(max(abs(same$points$change)), 1e-9)
})

test_that("a second scan that is worse changes no length", {
  people <- data.frame(age = rep(20, 20), sex = "female")
  visit <- function(noise) {
    simulate_cohort(20, data = people, template = small_template(), seed = 6,
                    settings = cohort_settings(noise = noise))$sample
  }
  first <- visit(0.1)
  second <- visit(2)
  table <- ball_measurements()
  long <- which(table$measurement == "arc")
  found <- lapply(seq_along(first), function(i) {
    compare_visits(first[[i]], second[[i]], table = table)$measurements[long, ]
  })
  found <- do.call(rbind, found)
  raw <- measurements(second[[1]], table[long, ])$value -
    measurements(first[[1]], table[long, ])$value
  score <- found$change / found$se
  expect_lt(abs(mean(score)), 3 / sqrt(20))
  # As measured, arcs become longer
  expect_gt(raw, found$change[1])
})

test_that("another person is said, errors of 0 are none, and errors of landmarks are refused", {
  made <- two_visits(0, 2)
  expect_warning(compare_visits(made$sample[[1]], made$second[[2]]), "of one person.*give `norms`",
                 class = "crestline_visit_doubt")
  expect_no_warning(compare_visits(made$sample[[1]], made$second[[1]]))
  exact <- lapply(list(made$sample[[1]], made$second[[1]]), function(shape) {
    shape$points$se <- 0
    shape
  })
  found <- compare_visits(exact[[1]], exact[[2]], table = ball_measurements())
  expect_true(all(is.na(found$points$score)) && !any(found$points$called))
  expect_true(all(is.na(found$measurements$p)))
  expect_crestline_error(compare_visits(exact[[1]], exact[[2]], error = c(aL = 1)),
                         c("`error`", "landmarks"))
})

test_that("least squares by patches that did not change, and wrong names", {
  made <- two_visits(0)
  a <- compare_visits(made$sample[[1]], made$second[[1]], unchanged = "mid")
  b <- as.array(made$sample[[1]], "surface")[, , 1]
  after <- as.array(made$second[[1]], "surface")[, , 1]
  laid <- laid_onto(after, b, FALSE)
  normal <- place_normals(places_of(made$sample[[1]]), made$sample[[1]]$scheme)
  scheme <- made$sample[[1]]$scheme
  row <- match(scheme$points$place[scheme$points$level == "surface"], unique(scheme$points$place))
  expect_equal(a$points$change[a$points$level == "surface"],
               unname(rowSums((laid - b) * normal[row, ])), tolerance = 1e-8)
  expect_crestline_error(compare_visits(made$sample[[1]], made$second[[1]], unchanged = "nose"),
                         "`unchanged`")
  expect_crestline_error(compare_visits(made$sample[[1]], quad_shape()), "scheme")
})

test_that("without a change points are called as often as the level says", {
  made <- two_visits(0, 80)
  called <- sapply(seq_along(made$sample), function(i) {
    found <- compare_visits(made$sample[[i]], made$second[[i]])
    own <- found$points[found$points$level == "surface", ]
    c(any = any(own$called), points = mean(abs(own$score) > 1.96))
  })
  expect_lt(mean(called["any", ]), 0.13)
  expect_equal(mean(called["points", ]), 0.05, tolerance = 0.6)
})

test_that("the limit is that of the largest of many errors", {
  points <- cbind(1:40 * 100, 0, 0)
  limit <- function(settings) visit_limit(0.04 * together_at(points, settings), settings)
  free <- limit(visit_settings())
  expect_equal(free, stats::qnorm((1 + 0.95^(1 / 40)) / 2))
  # Far apart, drawn errors are independent; close together, they are one.
  expect_equal(limit(visit_settings(range = 1, draws = 4000)), free, tolerance = 0.04)
  expect_equal(limit(visit_settings(range = 1e6, draws = 4000)), 1.96, tolerance = 0.05)
  # A mean of errors that go together has their error.
  own <- data.frame(level = "surface", part = "a", point = 1:4, change = 1, se_growth = 0,
                    score = 2, df = Inf)
  part <- function(covariance) changed_parts(own, covariance, visit_settings())$se
  expect_equal(part(diag(0.25, 4)), 0.25)
  expect_equal(part(matrix(0.25, 4, 4)), 0.5)
})

test_that("errors of change are those of drawn errors after the registration", {
  made <- two_visits(0)
  settings <- visit_settings(range = 12, share = 0.6)
  shape <- made$sample[[1]]
  known <- list(before = shape, after = shape, grown = shape, error = NULL, settings = settings)
  surface <- shape$points$level == "surface"
  weight <- ifelse(surface, seq(0.5, 1, length.out = length(surface)), NA)
  found <- change_covariance(known, weight)
  own <- shape$points$level != "landmarks"
  xyz <- point_columns(shape)[own, ]
  normal <- row_normals(shape)[own, ]
  at <- which(surface[own])
  errors <- t(chol(together_at(xyz, settings) + diag(1e-9, nrow(xyz)))) * sqrt(2) * 0.1
  change <- with_seed(1, vapply(1:3000, function(i) {
    moved <- xyz + errors %*% matrix(stats::rnorm(length(xyz)), ncol = 3)
    laid <- weighted_move(moved[at, ], xyz[at, ], weight[surface])(moved)
    rowSums((laid - xyz) * normal)
  }, numeric(nrow(xyz))))
  expect_equal(sqrt(diag(found)), apply(change, 1, stats::sd), tolerance = 0.03)
  expect_equal(sqrt(mean(found[at, at])), stats::sd(colMeans(change[at, ])), tolerance = 0.05)
  # In any unit of the mesh
  own_weight <- ifelse(surface, weight, 0)[own]
  taken <- function(unit) taken_up(unit * xyz, normal, together_at(xyz, settings), own_weight)
  for (unit in c(1e-9, 1e9)) expect_equal(taken(unit), taken(1))
})

test_that("without points in common there is no covariance", {
  bare <- small_patient()
  bare$points$se <- NA_real_
  known <- list(before = bare, after = bare, error = NULL, settings = visit_settings(),
                df = rep(Inf, nrow(bare$points)))
  expect_true(all(is.na(change_covariance(known, rep(NA, nrow(bare$points))))))
})

test_that("an error of growth is that of all points of a part alike", {
  own <- data.frame(level = "surface", part = "a", point = 1:4, change = 1, se_growth = 0.3,
                    score = 2, df = Inf)
  expect_equal(changed_parts(own, diag(0.25, 4), visit_settings())$se, sqrt(0.25^2 + 0.3^2))
})

test_that("points without an error are not assessed, and said", {
  made <- two_visits(0)
  bare <- made$second[[1]]
  bare$points$se <- NA_real_
  found <- compare_visits(made$sample[[1]], bare)
  expect_true(all(is.na(found$points$score)))
  expect_false(any(found$points$called))
  expect_match(paste(utils::capture.output(print(found)), collapse = " "), "not assessed")
  expect_false(anyNA(compare_visits(made$sample[[1]], bare, error = 0.2)$points$score))
})

test_that("a second visit in another unit is refused", {
  made <- two_visits()
  metres <- made$second[[1]]
  metres$points[c("x", "y", "z")] <- metres$points[c("x", "y", "z")] / 1000
  expect_error(compare_visits(made$sample[[1]], metres), "0[.]00[0-9]* times",
               class = "crestline_unit_error")
})

test_that("points that are missing are left out of picture and page, which say so", {
  made <- two_visits(4)
  lost <- function(shape, rows) {
    shape$points[which(shape$points$level == "surface")[rows], c("x", "y", "z")] <- NA
    shape
  }
  found <- compare_visits(lost(made$sample[[1]], 1:5), lost(made$second[[1]], 4:8))
  own <- found$points[found$points$level == "surface", ]
  expect_equal(which(is.na(own$change)), 1:8)
  # Places, as points of two patches may share one
  mesh <- points_mesh(as.matrix(own[c("x", "y", "z")]), found$triangles)
  row <- attr(mesh, "row")
  expect_false(any(1:5 %in% row))
  expect_true(all(is.finite(mesh$vb)))
  gone <- colSums(matrix(found$triangles %in% 1:5, 3)) > 0
  expect_equal(ncol(mesh$it), sum(!gone))
  expect_equal(matrix(row[mesh$it], 3), unname(found$triangles[, !gone]))
  skip_if_not_installed("htmltools")
  file <- tempfile(fileext = ".html")
  on.exit(unlink(file))
  write_page(found, file)
  expect_match(paste(readLines(file, encoding = "UTF-8"), collapse = " "),
               sprintf("8 missing at one of the visits of %d points", nrow(own)))
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off(), add = TRUE)
  expect_identical(plot(found, engine = "picture"), found)
  expect_identical(plot(found, "score", engine = "picture"), found)
  expect_output(print(found), "[(]called from")
  found$points[c("score", "se", "detectable")] <- NA
  said <- utils::capture.output(print(found))
  expect_match(said, "largest change [-0-9.e]+( mm)? at [^(]+$", all = FALSE)
  expect_crestline_error(plot(found, "score", engine = "picture"), "error")
  found$points[c("x", "y", "z")] <- NA
  expect_error(points_mesh(as.matrix(found$points[c("x", "y", "z")]), found$triangles),
               class = "crestline_error")
})

test_that("the change from which on a point is called has the score of the limit", {
  points <- data.frame(se = c(0.5, 2, 1), df = c(4, 30, Inf))
  change <- called_from(4, points)
  expect_equal(normal_score(change / points$se, points$df), rep(4, 3))
  expect_gt(change[1] / 0.5, 8)
  expect_equal(change[3], 4)
})
