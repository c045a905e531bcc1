json_file <- function(...) landmark_file("mrk.json", ...)
json_point <- function(label, position = "[10, 20, 30]", ...) {
  paste0('{"label": "', label, '", "position": ', position, ..., "}")
}
json_list <- function(..., type = "Fiducial", more = "") {
  sprintf('{"type": "%s"%s, "controlPoints": [%s]}', type, more, paste(c(...), collapse = ","))
}
json_markups <- function(...) {
  json_file(sprintf('{"@schema": "markups-schema-v1.0.3.json#", "markups": [%s]}',
                    paste(c(...), collapse = ",")))
}
undefined <- ', "positionStatus": "undefined"'

test_that("what is written is read back, to the last bit, with curves, in either frame", {
  expect_round_trip(hard_landmarks(), "mrk.json")
  x <- structure(hard_landmarks(), curves = hard_curves())
  file <- expect_round_trip(x, "mrk.json")
  expect_round_trip(structure(hard_landmarks()[0, ], curves = hard_curves()), "mrk.json")
  write_landmarks(x, file, frame = "RAS")
  expect_identical(read_landmarks(file, frame = "RAS"), x)
  expect_equal(unname(read_landmarks(file)[1, ]), unname(x[1, ] * c(-1, -1, 1)))
  expect_equal(attr(read_landmarks(file), "curves")[[2]][1, ], c(x = -1, y = -2, z = 3))
})

test_that("what is written follows the schema: types, system, empty position of a missing point", {
  file <- tempfile(fileext = ".mrk.json")
  write_landmarks(xyz(1, 2, 3, NA, NA, NA, name = c("a", "b")), file, curves = hard_curves()[1:2])
  markup <- jsonlite::read_json(file)$markups
  expect_equal(vapply(markup, `[[`, "", "type"), c("Fiducial", "Curve", "ClosedCurve"))
  expect_equal(vapply(markup, `[[`, "", "coordinateSystem"), rep("LPS", 3))
  missing <- markup[[1]]$controlPoints[[2]]
  expect_equal(missing[c("position", "positionStatus")],
               list(position = "", positionStatus = "undefined"))
  expect_equal(unlist(markup[[1]]$controlPoints[[1]]$orientation), c(-1, 0, 0, 0, -1, 0, 0, 0, 1))
})

test_that("several lists are one specimen's: landmarks together, curves by name", {
  x <- read_landmarks(json_markups(
    json_list(json_point("a"), json_point("b", "[1, 2, 3]")), json_list(json_point("c")),
    json_list(json_point("C-1"), json_point("C-2"), type = "Curve", more = ', "name": "lip"'),
    json_list(json_point("C-1"), type = "ClosedCurve", more = ', "name": "eye"'),
    json_list(json_point("L-1"), json_point("L-2", "[0, 0, 1]"), type = "Line")
  ))
  expect_equal(rownames(x), c("a", "b", "c"))
  curves <- attr(x, "curves")
  expect_equal(names(curves)[1:2], c("lip", "eye"))
  expect_match(names(curves)[3], " 5$")
  expect_equal(unname(vapply(curves, attr, TRUE, "closed")), c(FALSE, TRUE, FALSE))
  expect_equal(unname(vapply(curves, nrow, 0L)), c(2, 1, 2))
})

test_that("Angle lists are curves, missing control points stay, ROI lists are left out", {
  angle <- json_list(json_point("A-1"), json_point("A-2", '""', undefined), json_point("A-3"),
                     type = "Angle", more = ', "name": "jaw"')
  file <- json_markups(angle, json_list(json_point("R"), type = "ROI"))
  expect_warning(x <- read_landmarks(file), "ROI", class = "crestline_format_warning")
  expect_equal(attr(x, "curves"),
               list(jaw = structure(xyz(10, 20, 30, NA, NA, NA, 10, 20, 30), closed = FALSE)))
})

test_that("lists that share labels are told apart by their names", {
  x <- read_landmarks(json_markups(json_list(json_point("F-1"), more = ', "name": "left"'),
                                   json_list(json_point("F-1"), more = ', "name": "right"')))
  expect_equal(rownames(x), c("left F-1", "right F-1"))
})

test_that("an only list without a name has the file's", {
  file <- json_markups(json_list(json_point("C-1"), type = "Curve"))
  expect_equal(names(attr(read_landmarks(file), "curves")),
               sub(".mrk.json", "", basename(file), fixed = TRUE))
})

test_that("points that are not defined are missing, and numbers stay numbers", {
  x <- read_landmarks(json_markups(json_list(json_point("a", '""', undefined), json_point("b"),
                                             json_point("c", '""', ', "positionStatus": "missing"'),
                                             json_point("d", "[0, 0, 0]",
                                                        ', "positionStatus": "preview"'),
                                             json_point("e", "null", undefined))))
  expect_equal(x, xyz(NA, NA, NA, 10, 20, 30, rep(NA, 9), name = c("a", "b", "c", "d", "e")))
  expect_type(x, "double")
})

test_that("the orientation of a point does not turn the others", {
  turned <- ', "orientation": [0, -1, 0, 1, 0, 0, 0, 0, 1]'
  file <- json_markups(json_list(json_point("a", "[10, 20, 30]", turned),
                                 more = ', "coordinateSystem": "LPS"'))
  expect_equal(unname(read_landmarks(file, frame = "RAS")[1, ]), c(-10, -20, 30))
  expect_equal(unname(read_landmarks(file)[1, ]), c(10, 20, 30))
})

test_that("each list's frame counts; without one it is LPS", {
  x <- read_landmarks(json_markups(json_list(json_point("a"), more = ', "coordinateSystem": "RAS"'),
                                   json_list(json_point("b"))))
  expect_equal(x, xyz(-10, -20, 30, 10, 20, 30, name = c("a", "b")))
  expect_refused(json_markups(json_list(json_point("a"), more = ', "coordinateSystem": "IJK"')),
                 '"IJK"')
})

test_that("units may be a word or DICOM's triple; different ones are refused", {
  triple <- json_list(json_point("a"), more = ', "coordinateUnits": ["mm", "UCUM", "millimeter"]')
  expect_equal(nrow(read_landmarks(json_markups(triple, json_list(json_point("b"))))), 2)
  micron <- json_list(json_point("b"), more = ', "coordinateUnits": "um"')
  expect_refused(json_markups(triple, micron), "different units: mm, um")
  expect_equal(read_landmarks(json_markups(micron)), xyz(10, 20, 30, name = "b"))
})

test_that("names: label, else id, else number; other types are left out with a warning", {
  plane <- json_list(json_point("P"), type = "Plane")
  file <- json_markups(json_list('{"id": "7", "position": [1, 2, 3]}', '{"position": [1, 2, 3]}'),
                       plane)
  expect_warning(x <- read_landmarks(file), "Plane", class = "crestline_format_warning")
  expect_equal(rownames(x), c("7", "2"))
})

test_that("what cannot be read is refused with file and place", {
  expect_refused(json_file("{"), "not JSON")
  expect_refused(json_file("[1, 2]"), "no markups")
  expect_refused(json_file('{"markups": []}'), "no markups")
  expect_refused(json_file('{"markups": [3]}'), "no markups")
  expect_refused(json_markups(json_list(json_point("a"), json_point("b", "[1, 2]"))),
                 c("list 1, point 2", "three numbers"))
  expect_refused(json_markups(json_list(json_point("a", '""'))), "three numbers")
  expect_refused(json_markups(json_list(json_point("a", '[1, "b", 3]'))), "three numbers")
  expect_refused(json_markups('{"type": "Fiducial", "controlPoints": "none"}'),
                 "not a control point")
})

test_that("a co-ordinate system by its number is taken as such", {
  list <- json_list(json_point("a", "[1, 2, 3]"))
  markup <- if (grepl("coordinateSystem", list)) list else
    sub("{", '{"coordinateSystem": "LPS", ', list, fixed = TRUE)
  numbered <- sub('"coordinateSystem": *"[A-Z]+"', '"coordinateSystem": 0', markup)
  expect_equal(unname(read_landmarks(json_markups(numbered))[1, ]), c(-1, -2, 3))
  expect_refused(json_markups(sub('"coordinateSystem": *"[A-Z]+"', '"coordinateSystem": 7',
                                  markup)), "7")
})

test_that("labels that are numbers are names; co-ordinates by name are refused", {
  numbered <- json_list('{"label": 5, "position": [1, 2, 3]}', '{"id": 12, "position": [1, 2, 4]}')
  expect_identical(rownames(read_landmarks(json_markups(numbered))), c("5", "12"))
  expect_refused(json_markups(json_list(json_point("a", '{"z": 3, "y": 2, "x": 1}'))),
                 "three numbers")
})
