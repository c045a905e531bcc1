shapes <- paired_sample()
names(shapes) <- vapply(shapes, `[[`, "", "id")
at <- which(shapes[[2]]$status$level == "curves")[1]
curve <- shapes[[2]]$status$part[at]
bad <- shapes
bad$ball2$checks$roughness[at] <- 90
red_of <- function(shapes) {
  table <- quality(shapes)
  table[table$grade == "red", c("specimen", "part")]
}

test_that("parts that are red are told of with their specimens, once, unless they are kept", {
  own <- red_parts(bad, quality_limits())
  expect_true(any(own$specimen == "ball2" & own$part == curve))
  expect_warning(with_red(bad, "warn", quality_limits()),
                 paste0(curve, " (ball2"), fixed = TRUE, class = "crestline_red_parts")
  expect_identical(with_red(bad, "keep", quality_limits()), bad)
  expect_match(landmark_lines(bad), "1 specimen with red parts, see quality(): ball2 (1)",
               fixed = TRUE, all = FALSE)
  template <- symmetrise(shapes[[1]])
  expect_warning(slide(bad$ball2, template, slide_settings(curves = "held")), curve, fixed = TRUE,
                 class = "crestline_red_parts")
  bare <- with_fields(shapes[[1]], checks = NULL)
  expect_null(red_parts(list(a = bare), quality_limits()))
})

test_that("a part that is red only as points are missing is used with the points that it has", {
  half <- shapes
  half$ball2$checks$missing[at] <- 0.5
  expect_identical(as.character(quality(half)$grade[quality(half)$specimen == "ball2"][at]), "red")
  expect_identical(nrow(red_parts(half, quality_limits())), 0L)
})

test_that("a red curve is left out with the points that lie on it, its landmarks stay", {
  row <- bad$ball2$scheme$curves[bad$ball2$scheme$curves$curve == curve, ]
  parts <- as.data.frame(quality(bad$ball2))
  without <- without_parts(bad$ball2, parts[parts$part == curve, ])
  points <- without$points
  own <- points$level == "curves" & points$part == curve
  expect_true(all(is.na(points$x[own][-c(1, sum(own))])))
  ends <- points$level == "landmarks" & points$part %in% c(row$from, row$to)
  expect_identical(points[ends, ], bad$ball2$points[ends, ])
  place <- bad$ball2$scheme$points$place
  expect_true(all(is.na(points$x[place %in% setdiff(place[own], place[ends])])))
  expect_false(curve %in% names(without$tracks))
  expect_null(without$paths[[curve]])
  expect_match(status_of(without, curve)$reason, "left out, as it is red: .*rough")
})

test_that("a sample is made without the red parts: they are missing in it, the rest is there", {
  own <- suppressWarnings(homologise(shapes, progress = FALSE))
  sample <- homologise(bad, red = "leave out", progress = FALSE)
  gone <- sample$missing[sample$missing$id == "ball2" & sample$missing$level == "curves", ]
  expect_true(curve %in% gone$part)
  lost <- is.na(coords(sample[["ball2"]], "curves")[, 1])
  expect_true(all(startsWith(names(lost)[lost], curve) | sub(" [0-9]+$", "", names(lost)[lost]) %in%
                    red_of(bad)$part))
  near <- row_lengths(coords(sample[["ball2"]], "curves") - coords(own[["ball2"]], "curves"))
  expect_lte(max(near, na.rm = TRUE), 0.5)
  expect_identical(sample$provenance$settings$homologise$red, "leave out")
})

test_that("of a red patch only what lies inside it goes, in all that is slid", {
  patchy <- shapes
  patch <- which(patchy[[3]]$status$level == "surface")[1]
  name <- patchy[[3]]$status$part[patch]
  patchy[[3]]$checks$roughness[patch] <- 90
  sample <- homologise(patchy, red = "leave out", progress = FALSE)
  points <- sample[[3]]$points
  inside <- setdiff(points$part[points$level == "surface" & is.na(points$x)], NA)
  expect_identical(unique(inside), name)
  place <- sample[[3]]$scheme$points$place
  expect_setequal(place[is.na(points$x)],
                  setdiff(place[points$level == "surface" & points$part == name],
                          bound_places(sample[[3]]$scheme)))
})
