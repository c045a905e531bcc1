# Every mistake is named by table, row and column.
expect_mistake <- function(change, table, row, column, words = character()) {
  where <- if (is.na(row)) sprintf("- column %s:", column) else
    c(sprintf("- row %d (", row), sprintf("), column %s:", column))
  error <- expect_crestline_error(leaf_scheme(change), c(paste("table", table), where, words))
  expect_s3_class(error, "crestline_scheme_error")
}
expect_wrong <- function(table, row, column, value, words) {
  expect_mistake(set_cell(table, row, column, value), table, row, column, words)
}
without <- function(table, column) {
  function(tables) {
    tables[[table]][[column]] <- NULL
    tables
  }
}

test_that("a missing column is named with those that are there", {
  for (column in c("curve", "from", "to", "kind", "n")) {
    expect_mistake(without("curves", column), "curves", NA, column, c("missing", "radius, width"))
  }
  expect_mistake(without("landmarks", "landmark"), "landmarks", NA, "landmark", "missing")
  expect_mistake(without("patches", "rows_kept"), "patches", NA, "rows_kept", "missing")
  expect_mistake(without("pairs", "level"), "pairs", NA, "level", "missing")
  expect_mistake(without("strips", "outward"), "strips", NA, "outward", "missing")
})

test_that("mistakes in landmarks", {
  expect_wrong("landmarks", 2, "landmark", "base", c("(base)", "twice", "row 1"))
  expect_wrong("landmarks", 2, "landmark", NA, "empty")
})

test_that("mistakes in the cells of curves", {
  expect_wrong("curves", 2, "n", 1, c("(edge left)", "1 is not", "at least 2"))
  expect_wrong("curves", 2, "n", 2.5, "whole number")
  expect_wrong("curves", 2, "n", NA, "empty")
  expect_wrong("curves", 2, "n", "six", c("six", "number"))
  expect_wrong("curves", 3, "kind", "crest", c("crest", "ridge, valley, plane"))
  expect_wrong("curves", 3, "radius", -5, c("-5", "above 0"))
  expect_wrong("curves", 3, "radius", Inf, "Inf")
  expect_wrong("curves", 3, "radius", NA, "needs it")
  expect_wrong("curves", 3, "width", NA, "needs it")
  expect_wrong("curves", 3, "width", 0, "above 0")
  expect_wrong("curves", 1, "trust_from", 1.5, c("1.5", "at most 1"))
  expect_wrong("curves", 1, "angle_limit", 3, "at most 1.57")
  expect_wrong("curves", 3, "side", "up", "left, right")
})

test_that("a plane curve needs neither radius nor width", {
  plane <- set_cell("curves", 1, c("kind", "radius", "width"), list("plane", NA, NA))
  expect_equal(leaf_scheme(plane)$curves$radius[1], NA_real_)
})

test_that("names in curves that mean nothing", {
  expect_wrong("curves", 2, "from", "bas", c("no landmark \"bas\"", "nearest: base"))
  expect_wrong("curves", 2, "to", "base", "same landmark as from")
  expect_wrong("curves", 3, "curve", "edge left", c("twice", "row 2"))
  expect_wrong("curves", 3, "curve", "edge[1]", "may not hold")
  expect_wrong("curves", 3, "side_of", "mid rib", c("no curve \"mid rib\"", "midrib"))
  expect_wrong("curves", 2, "side_of", "edge left", "leads back")
  expect_mistake(set_cell("curves", 1, c("side_of", "side"), list("edge left", "left")), "curves",
                 1, "side_of", c("leads back", "row 2 (edge left)"))
})

test_that("columns that go together", {
  expect_mistake(set_cell("curves", 1, "cut_share", 2), "curves", 1, "cut_from",
                 c("go together", "column cut_to"))
  expect_mistake(set_cell("curves", 1, c("cut_share", "cut_from", "cut_to"),
                          list(2, "base", "base")),
                 "curves", 1, "cut_to", "same")
  expect_mistake(set_cell("curves", 1, "keep_away_from", "wideL"), "curves", 1, "keep_away_to",
                 "go together")
  expect_mistake(set_cell("curves", 1, "keep_away_radius", 1), "curves", 1, "keep_away_radius",
                 "keep_away_from is not")
  expect_mistake(set_cell("curves", 2, "side", NA), "curves", 2, "side", "go together")
  beside <- c("keep_side_from", "keep_side_to", "keep_side_towards")
  expect_mistake(set_cell("curves", 1, beside[1:2], list("wideL", "tip")), "curves", 1,
                 "keep_side_towards", "go together")
  expect_mistake(set_cell("curves", 1, beside, list("wideL", "tip", "tip")), "curves", 1,
                 "keep_side_towards", "same landmark")
  expect_mistake(set_cell("curves", 1, beside, list("wideL", "tip", "wide")), "curves", 1,
                 "keep_side_towards", "no landmark \"wide\"")
  expect_mistake(set_cell("curves", 1, c("trust_from", "trust_to"), list(0.5, 0.5)), "curves", 1,
                 "trust_to", "not above")
})

test_that("mistakes in patches", {
  expect_wrong("patches", 1, "curve_a", "edge left[1:7]", c("points 1 to 6", "1:7", "(blade left)"))
  expect_wrong("patches", 1, "curve_a", "edge left[0:5]", "0:5")
  expect_wrong("patches", 1, "curve_b", "midrip[1:6]", c("no curve \"midrip\"", "midrib"))
  expect_wrong("patches", 1, "curve_a", "edge left 1:6", "cannot be read")
  expect_wrong("patches", 1, "curve_b", "midrib[1:5]", c("gives 5 columns", "gives 6"))
  expect_wrong("patches", 1, "columns", "2:7", "1 to 6")
  expect_wrong("patches", 1, "columns", "2,2,3,4", "each once")
  expect_wrong("patches", 1, "columns", "all", "1,3:8")
  expect_wrong("patches", 1, "rows_kept", "1:5", "1 to 4")
  expect_wrong("patches", 1, "rows_kept", "most", "2:6")
  expect_wrong("patches", 1, "n", 13, c("is 13", "4 columns times 3 rows"))
  expect_wrong("patches", 1, "rows", 1, "there is a curve_b")
  expect_wrong("patches", 3, "rows", 2, "no curve_b")
  expect_wrong("patches", 1, "first_column", "midrib[1:9]", "points 1 to 6")
  expect_wrong("patches", 3, "first_column", "midrib[1:4]", "curve_b is not")
  expect_wrong("patches", 3, "resample_b", 4, "curve_b is not")
  expect_wrong("patches", 2, "patch", "blade left", "twice")
  expect_mistake(set_cell("patches", 1:2, c("patch", "block"), list("blade", c(NA, 1))), "patches",
                 2, "block", "not in another")
  expect_wrong("patches", 1, "outward", "up", "columns, rows")
})

test_that("mistakes in strips", {
  expect_wrong("strips", 2, "a", "blade left|9 3", c("no surface point", "(rib left rung 2)"))
  expect_wrong("strips", 2, "rung", 3, "in order")
  expect_wrong("strips", 2, "outward", "rows", "first row")
  expect_wrong("strips", 2, "part", "extra", "first row")
})

test_that("mistakes in definitions", {
  with_definitions <- function(...) {
    function(tables) {
      rows <- data.frame(landmark = c("wideL", "tip", "wideR"),
                         kind = c("cap", "profile", "crossing"), radius = 2, reach = 3,
                         bend = c(NA, "out", NA), mirror = c(NA, "wideL", NA),
                         from = c(NA, NA, "base"), to = c(NA, NA, "tip"), type = c(NA, NA, "ridge"),
                         width = c(NA, NA, 4), across_from = c(NA, NA, "wideL"),
                         across_to = c(NA, NA, "base"), across_type = c(NA, NA, "plane"))
      change <- list(...)
      if (length(change)) rows[change[[1]], change[[2]]] <- change[[3]]
      tables$definitions <- rows
      tables
    }
  }
  fine <- leaf_scheme(with_definitions())
  expect_equal(fine$definitions$kind, c("cap", "profile", "crossing"))
  expect_output(print(fine), "landmarks with a definition: wideL, tip, wideR")
  wrong <- function(row, column, value, words, named = column) {
    error <- expect_crestline_error(leaf_scheme(with_definitions(row, column, value)),
                                    c("definitions", sprintf("row %d", row),
                                      sprintf("column %s", named), words))
    expect_s3_class(error, "crestline_scheme_error")
  }
  wrong(1, "landmark", "top", "no landmark \"top\"")
  wrong(2, "landmark", "wideL", "named twice")
  wrong(1, "kind", "knob", "cap, cup")
  wrong(1, "radius", NA, "is empty")
  wrong(2, "bend", "left", "out or in")
  wrong(2, "mirror", NA, "either mirror or")
  wrong(3, "mirror", "wideL", "either mirror or")
  wrong(2, "mirror", "wideL edge", "no left landmark")
  wrong(3, "from", NA, "taken on a curve")
  wrong(3, "to", NA, "taken on a curve")
  wrong(3, "across_to", NA, "go together")
  wrong(3, "across_type", NA, "has a type")
  wrong(3, "from", "wideR", "own curve", named = "landmark")
  wrong(3, "kind", "turn", "left or right", named = "bend")
})

test_that("all problems of a table are told at once, in order of rows, and cut short", {
  many <- function(x) {
    x$curves$n <- 0
    x$curves$radius <- -1
    x$curves$kind <- "crest"
    x
  }
  error <- expect_crestline_error(leaf_scheme(many),
                                  c("has 9 problems", "row 1 (midrib)", "row 3 (edge right)",
                                    "and 1 more"))
  expect_equal(lengths(regmatches(conditionMessage(error),
                                  gregexpr("\n- ", conditionMessage(error)))), 9)
})

test_that("a table that is none, or empty, is refused", {
  x <- leaf_tables()
  expect_crestline_error(curve_scheme("landmarks.csv", x$curves),
                         "table landmarks is landmarks.csv")
  expect_crestline_error(curve_scheme(x$landmarks, x$curves[0, ]), "table curves is empty")
  expect_crestline_error(curve_scheme(x$landmarks, NULL), "table curves is NULL")
})
