# A scheme of a few plane curves on the landmarks of the face: quick to measure.
face_lines <- function(landmarks = face_scheme()$landmarks) {
  curves <- data.frame(curve = c("eye left", "eye right", "nose", "lip", "base"),
                       from = c("exL", "exR", "n", "chL", "acL"),
                       to = c("enL", "enR", "pn", "chR", "acR"), kind = "plane", n = 5)
  pairs <- face_scheme()$pairs
  pairs <- rbind(pairs[pairs$level == "landmarks", ],
                 data.frame(level = "curves", left = "eye left", right = "eye right"))
  curve_scheme(landmarks, curves, pairs = pairs, name = "lines")
}

in_unit <- function(factor) {
  mesh <- humface_scan()
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] / factor
  specimen(mesh, humface_landmarks() / factor, id = "other unit")
}

# Grades by what is known of landmarks alone.
of_landmarks <- function(...) {
  other <- c("missing", "asymmetry", "roughness", "coarse", "bridged", "border", "spike")
  do.call(quality_limits,
          c(stats::setNames(lapply(other, function(name) if (name %in% small_is_bad)
            c(-Inf, -Inf) else c(Inf, Inf)), other),
            list(...)))
}

grades_of <- function(shape, parts, ...) {
  graded <- quality(shape, of_landmarks(...))
  as.character(graded$grade[match(parts, graded$part)])
}

test_that("a face in another unit is refused with the factor to give, and measured by it", {
  for (factor in c(10, 1000, 25.4)) {
    face <- in_unit(factor)
    error <- expect_crestline_error(fit_shape(face, face_lines(), progress = FALSE),
                                    c(sprintf("unit = %g", factor), "lines"), id = "other unit")
    expect_s3_class(error, "crestline_unit_error")
    shape <- fit_shape(face, face_lines(), unit = factor, progress = FALSE)
    expect_true(all(shape$status$ok[shape$status$level == "curves"]))
  }
  expect_crestline_error(fit_shape(in_unit(1), face_lines(), unit = 10, progress = FALSE),
                         "unit = 1`")
  expect_crestline_error(refine_landmarks(in_unit(10), face_scheme()), "unit = 10")
})

test_that("half and twice the size are no other unit; a scheme without places asks nothing", {
  for (factor in c(0.5, 2)) {
    expect_no_error(check_scale(in_unit(factor), face_scheme()))
  }
  bare <- face_scheme()$landmarks[c("landmark", "name")]
  expect_null(nrow(typical_landmarks(list(landmarks = bare))))
  shape <- fit_shape(in_unit(10), face_lines(bare), progress = FALSE)
  expect_true(all(shape$status$ok[shape$status$level == "curves"]))
})

test_that("exchanged landmarks are warned of once, red with the curves there, and said why", {
  at <- humface_landmarks()
  for (two in list(c("acL", "acR"), c("n", "pn"))) {
    names <- rownames(at)
    names[match(two, names)] <- rev(two)
    expect_warning(face <- specimen(humface_scan(),
                                    structure(at, dimnames = list(names, colnames(at)))),
                   class = "crestline_exchanged")
    shape <- expect_no_warning(fit_shape(face, face_lines(), progress = FALSE))
    own <- if ("acL" %in% two) "base" else "nose"
    expect_equal(grades_of(shape, c(two, own)), rep("red", 3))
    expect_equal(grades_of(shape, c("exL", "eye left", "lip")), rep("green", 3))
    graded <- quality(shape)
    expect_match(graded$why[match(own, graded$part)],
                 paste(paste(sort(two), collapse = " and "), "look exchanged"), fixed = TRUE)
    expect_equal(grades_of(shape, own, exchanged = "amber"), "amber")
    expect_output(print(shape), "look exchanged", fixed = TRUE)
  }
})

test_that("pairs that have other names are told by the scheme, by fit_shape() itself", {
  at <- humface_landmarks()
  rownames(at) <- sub("([a-z]+)L$", "left \\1", rownames(at))
  names <- face_scheme()$landmarks
  names$landmark <- sub("([a-z]+)L$", "left \\1", names$landmark)
  scheme <- curve_scheme(names,
                         data.frame(curve = "base", from = "left ac", to = "acR", kind = "plane",
                                    n = 5), name = "other names")
  names <- rownames(at)
  names[match(c("left ac", "acR"), names)] <- c("acR", "left ac")
  face <- expect_no_warning(specimen(humface_scan(),
                                     structure(at, dimnames = list(names, colnames(at)))))
  expect_warning(shape <- fit_shape(face, scheme, progress = FALSE), "acR and left ac",
                 class = "crestline_exchanged")
  expect_equal(grades_of(shape, "base"), "red")
})

test_that("mirrored faces are red at their sides, not in the middle", {
  at <- humface_landmarks()
  rownames(at) <- ifelse(endsWith(rownames(at), "L"), sub("L$", "R", rownames(at)),
                         sub("R$", "L", rownames(at)))
  expect_warning(face <- specimen(humface_scan(), at), class = "crestline_mirrored")
  shape <- expect_no_warning(fit_shape(face, face_lines(), progress = FALSE))
  expect_equal(grades_of(shape, c("exL", "eye left", "lip", "pn", "nose")),
               c("red", "red", "red", "green", "green"))
})

test_that("found with little confidence or predicted is amber; if most is, all is", {
  face <- found_lines()
  shape <- fit_shape(face, face_lines(), progress = FALSE)
  expect_equal(grades_of(shape, c("exL", "eye left", "nose")), rep("green", 3))
  low <- face
  low$placing$confidence[low$placing$landmark == "exL"] <- 0.3
  shape <- fit_shape(low, face_lines(), progress = FALSE)
  expect_equal(grades_of(shape, c("exL", "eye left", "lip", "nose")),
               c("amber", "amber", "green", "green"))
  graded <- quality(shape)
  expect_match(graded$why[match("eye left", graded$part)],
               "it ends on exL: it was found with a confidence of 0.30 only", fixed = TRUE)
  expect_output(print(shape), "little confidence: exL (0.3)", fixed = TRUE)
  expect_output(print(low), "little confidence: exL (0.3)", fixed = TRUE)
  low$placing$confidence[1:13] <- 0.3
  wrong <- quality(fit_shape(low, face_lines(), progress = FALSE))
  expect_true(all(wrong$grade > "green"))
  expect_match(wrong$why[match("lip", wrong$part)],
               "13 of 19 found landmarks have little confidence", fixed = TRUE)
  expect_true(any(quality(fit_shape(low, face_lines(), progress = FALSE),
                          of_landmarks(doubtful = c(Inf, Inf)))$grade == "green"))
})

test_that("a landmark that was moved since is doubted no more; one left out says why", {
  face <- found_lines()
  face$placing$confidence[face$placing$landmark %in% c("exL", "n")] <- 0.3
  face$landmarks["exL", ] <- face$landmarks["exL", ] + 0.5
  face$landmarks["n", ] <- NA
  shape <- fit_shape(face, face_lines(), progress = FALSE)
  expect_equal(grades_of(shape, c("exL", "eye left")), c("green", "green"))
  expect_match(status_of(shape, "n")$reason, "found with a confidence of 0.30 only: left out",
               fixed = TRUE)
})

test_that("the ears are predicted where a scan has them too, and what ends there is amber", {
  data(dummyhead, package = "Rvcg", envir = environment())
  head <- find_landmarks(dummyhead.mesh, id = "head", settings = quick_settings())
  state <- stats::setNames(head$placing$state, head$placing$landmark)
  expect_equal(unname(state[ear_names]), rep("predicted", 4))
  curves <- as.data.frame(face_scheme(), "curves")[c("curve", "from", "to")]
  curves <- curves[curves$from %in% ear_names | curves$to %in% ear_names, ]
  expect_gte(nrow(curves), 10)
  scheme <- curve_scheme(data.frame(landmark = unique(c(curves$from, curves$to))),
                         cbind(curves, kind = "plane", n = 3))
  parts <- quality(suppressWarnings(fit_shape(head, scheme, progress = FALSE)))
  there <- parts$part %in% c(ear_names, curves$curve)
  expect_true(all(parts$grade[there] >= "amber"))
  expect_match(parts$why[match("tL", parts$part)], "predicted by the other landmarks")
})
