test_that("a landmark beside its crest and a width that is cut are named, with a remedy", {
  mesh <- structure(local({
    side <- seq(-15, 15)
    at <- with_seed(2, expand.grid(x = side, y = side) + stats::runif(2 * 31^2, -0.2, 0.2))
    list(vb = rbind(at$x, at$y, 4 * exp(-at$y^2 / 8), 1),
         it = grid_triangles(31, 31, rep(TRUE, 900)))
  }), class = "mesh3d")
  marks <- as.matrix(locate(mesh, rbind(a = c(-10, 0, 4), b = c(10, 0, 4),
                                        beside = c(10, 2, 3)))[c("x", "y", "z")])
  object <- specimen(mesh, marks, id = "ridge")
  curves <- data.frame(curve = c("on it", "hooked", "wide", "flat"), from = "a",
                       to = c("b", "beside", "b", "beside"),
                       kind = c("ridge", "ridge", "ridge", "plane"), radius = c(3, 3, 3, NA),
                       width = c(4, 4, 9, NA), n = 9)
  scheme <- curve_scheme(data.frame(landmark = rownames(marks)), curves, name = "humps")
  checked <- suppressWarnings(check_scheme(scheme, object))
  expect_equal(checked$part, curves$curve)
  expect_no_match(paste(checked$reason[c(1, 3, 4)]), "stands")
  expect_match(checked$reason[2], "landmark beside stands 2[.0-9]* beside the ridge")
  expect_match(checked$remedy[2], "snap()", fixed = TRUE)
  expect_true(checked$grade[2] >= "amber")
  expect_match(checked$reason[3], "only 4.5 of its width is used")
  status <- fit_shape(object, scheme)$status
  expect_equal(checked$length[1], status$length[4])
  remark <- stats::setNames(status$remark, status$part)
  expect_identical(unname(remark[c("on it", "flat", "a")]), rep(NA_character_, 3))
  expect_match(remark[["hooked"]], "^landmark beside stands [12][.0-9]* beside the ridge, which")
  expect_identical(remark[["wide"]], "only 4.5 of its width is used, 1.5 radii")
  curve <- ridge_curve(object, "a", "beside", "ridge", radius = 3, width = 4, n = 9)
  expect_lt(max(abs(curve$beside - c(0, 2))), 0.4)
  expect_output(print(curve), "landmark beside stands")
  # An end where curvature is not trusted need not stand on a crest; nor one within the limit.
  trusted <- ridge_curve(object, "a", "beside", "ridge", radius = 3, width = 4, n = 9,
                         trust = c(0, 0.8))
  expect_identical(trusted$beside[2], NA_real_)
  lenient <- fit_shape(object, scheme, ridge_settings(beside = 1))$status
  expect_identical(lenient$remark[lenient$part == "hooked"], NA_character_)
  said <- utils::capture.output(print(checked))
  expect_match(said[1], "<scheme_check> humps on ridge: ")
  expect_lte(max(nchar(said)), 80)
  expect_match(said[length(said) - 0:4], "of its width|snap|landmark", all = FALSE)
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  expect_identical(plot(checked, resolution = 20, samples = 1), checked)
  expect_crestline_error(plot(checked, "none"), "parts")
})

test_that("patches are rows too, and every reason has a remedy", {
  checked <- check_scheme(quad_scheme(), quad_specimen())
  scene <- plot(checked, engine = "widget")
  expect_setequal(drawn_layers(scene$drawn), c("surface", "landmarks", unique(checked$part)))
  expect_setequal(names(scene$drawn$key), as.character(checked$grade))
  expect_setequal(checked$level, c("curves", "surface"))
  expect_identical(is.na(checked$remedy), is.na(checked$reason))
  expect_match(remedy_of("it runs along the edge of the window"), "larger width")
  expect_match(remedy_of("something new"), "picture")
  expect_equal(remedy_of(NA_character_), NA_character_)
  lost <- quad_specimen()
  lost$landmarks["a", ] <- NA
  expect_match(check_scheme(quad_scheme(), lost)$remedy, "Place the landmark", all = FALSE)
})
