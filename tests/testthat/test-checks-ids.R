stop_with <- function(problem, remedy) stop(problem, " ", remedy, call. = FALSE)
rows <- function(data, ids) {
  suppressMessages(as.integer(rows_of_specimens(data, ids, "data", stop_with)))
}
values <- function(x, ids) suppressMessages(by_specimen(x, ids, "group", stop_with))
ids <- c("s1", "s2", "s3", "s4")
turned <- c("s4", "s2", "s3", "s1")

test_that("a column of any usual name is the key", {
  for (name in c("id", "ID", "Ids", "specimen", "Specimen ID", "subject", "Name", "FILE",
                 "file_name", "filename", "sample", "scan",
                 "Case", "mesh", "participant.id", "\ufeffid", "X.U.FEFF.ID", "\u00ef..id")) {
    expect_true(is_key_column(name))
    expect_equal(rows(stats::setNames(data.frame(turned, 1:4), c(name, "age")), ids), c(4, 2, 3, 1))
  }
  for (name in c("sex", "age", "size", "identity", "scanner",
                 "caseload")) expect_false(is_key_column(name))
  expect_equal(rows(data.frame(age = 1:4, row.names = turned), ids), c(4, 2, 3, 1))
})

test_that("blanks, case, folder and extension do not matter, letters do", {
  for (other in list(toupper(turned), paste0(" ", turned, "\t"), paste0(turned, "\u00a0"),
                     paste0("scans/", turned, ".PLY"),
                     paste0("C:\\scans\\", turned, ".mrk.json"))) {
    expect_equal(rows(data.frame(id = other), ids), c(4, 2, 3, 1))
  }
  expect_error(rows(data.frame(id = c("s4", "s2", "s3", "s01")), ids),
               "`data` has no row for s1. The specimens are s1, .*; it has s4, s2, s3, s01")
  expect_error(rows(data.frame(id = 1:4), c("001", "002", "003", "004")), "no row for 001")
  expect_equal(rows(data.frame(id = c(2e5, 1e5)), c("100000", "200000")), 2:1)
})

test_that("ids that differ in case or folder only are matched exactly", {
  expect_equal(rows(data.frame(id = c("b", "A", "a")), c("a", "A", "b")), c(3, 2, 1))
  expect_equal(rows(data.frame(id = c("y/face", "x/face")), c("x/face", "y/face")), 2:1)
  expect_error(rows(data.frame(id = c("face", "x/face")), c("x/face", "y/face")),
               "no row for y/face")
  expect_error(rows(data.frame(id = c("z/face", "nose")), c("x/face", "nose")), "no row for x/face")
})

test_that("a specimen twice is refused where its rows differ", {
  expect_equal(rows(data.frame(id = c(ids, "s1"), sex = c("F", "M", "M", "M", "F")), ids), 1:4)
  expect_error(rows(data.frame(id = c(ids, "S1 "), sex = c("F", "M", "M", "M", "M")), ids),
               "2 different rows for s1")
  expect_error(values(c(s1 = "F", s1 = "M", s2 = "F", s3 = "M", s4 = "M"), ids),
               "2 different values for s1")
})

test_that("of several keys that with the specimens is taken; two that disagree are refused", {
  expect_equal(rows(data.frame(case = c("yes", "no", "yes", "no"), id = turned), ids),
               c(4, 2, 3, 1))
  expect_equal(rows(data.frame(id = 1:4, row.names = turned), ids), c(4, 2, 3, 1))
  expect_error(rows(data.frame(id = turned, file = ids), ids), "columns `id` and `file`")
})

test_that("position is used only where neither side has names, and that is said", {
  bare <- as.character(1:4)
  expect_message(place <- rows_of_specimens(data.frame(sex = c("F", "M", "F", "M")), bare, "data",
                                            stop_with), "in the order of the specimens")
  expect_equal(as.integer(place), 1:4)
  expect_error(rows(data.frame(sex = 1:4), ids),
               "no column of the specimens' names \\(s1, s2, s3, s4\\).*columns are sex")
  expect_error(rows(data.frame(id = turned), bare), "no row for 1, 2, 3, 4")
  expect_message(values <- by_specimen(4:1, ids, "group", stop_with),
                 "in the order of the specimens")
  expect_equal(values, 4:1)
})

test_that("values come by name, from a vector or a table of one column", {
  expect_equal(values(c(s4 = 4, s2 = 2, s3 = 3, s1 = 1), ids), as.numeric(1:4))
  expect_equal(values(data.frame(Specimen = turned, sex = c("d", "b", "c", "a")), ids),
               letters[1:4])
  expect_equal(values(matrix(4:1, 4, 1, dimnames = list(rev(ids), NULL)), ids), 1:4)
  expect_error(values(c(s4 = 4, s2 = 2, s3 = 3, t1 = 1), ids), "`group` has no value for s1")
  expect_error(values(c("a", "b"), ids), "2 values for 4 specimens")
  expect_error(values(data.frame(id = ids, a = 1, b = 2), ids), "has the columns id, a, b")
  expect_error(values(list(1, 2, 3, 4), ids), "of class list")
})

test_that("levels that differ by blanks or case only are found", {
  expect_equal(alike_levels(c("F", "f ", "M")), c("F", "f "))
  expect_length(alike_levels(c("F", "FF", "M")), 0)
  expect_length(alike_levels(character()), 0)
})

test_that("names may have more folders than the ids", {
  expect_equal(id_places(c("m/a", "n/a", "b"),
                         c("C:\\data\\n\\a.ply", "C:\\data\\b.ply", "C:\\data\\m\\a.ply")),
               list(3L, 1L, 2L))
  expect_equal(lengths(id_places("m/a", c("x/m/a", "y/m/a", "xm/a"))), 2)
})

test_that("bytes that are no text are taken for Latin 1", {
  bytes <- rawToChar(as.raw(c(0x47, 0x72, 0xfc, 0x6e)))
  expect_equal(id_places("gr\u00fcn", bytes), list(1L))
})

test_that("rows of one specimen are compared in all columns, matrices and tables too", {
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "groups", call = NULL)
  data <- data.frame(id = c("a", "b", "b"), v = c(1, 2, 2))
  rows <- function(column) {
    data$more <- column
    as.integer(rows_of_specimens(data, c("b", "a"), "data", fail))
  }
  expect_equal(rows(cbind(1:3, c(4, 5, 5), c(1, 1, 1))[, 3, drop = FALSE]), c(2, 1))
  expect_crestline_error(rows(cbind(c(1, 2, 2), c(4, 5, 6))), "2 different rows for b")
  expect_crestline_error(rows(I(data.frame(p = c(1, 2, 2), q = c(4, 5, 6)))),
                         "2 different rows for b")
  expect_equal(rows(I(list(1, "x", "x"))), c(2, 1))
  expect_equal(rows(as.POSIXlt("2026-01-01", tz = "UTC") + c(0, 1, 1)), c(2, 1))
})

test_that("two key columns of one name are refused", {
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "groups", call = NULL)
  data <- cbind(data.frame(id = c("a", "b"), v = 1:2), id = c("b", "a"))
  expect_crestline_error(rows_of_specimens(data, c("a", "b"), "data", fail), "two columns `id`")
})
