test_that("a scheme keeps its tables, typed, with every column and the defaults", {
  away <- function(x) {
    x$curves[2:3, c("keep_away_from", "keep_away_to")] <- data.frame("base", c("wideL", "wideR"))
    x
  }
  leaf <- leaf_scheme(away)
  expect_s3_class(leaf, "curve_scheme")
  expect_named(leaf,
               c("name", "landmarks", "curves", "patches", "pairs", "strips", "definitions",
                 "tracks", "points", "triangles"))
  expect_equal(leaf$curves$keep_away_radius, c(NA, 0.7, 0.7))
  expect_equal(leaf$curves$keep_away_extension, c(NA, 0.2, 0.2))
  expect_equal(c(leaf$curves$trust_from[1], leaf$curves$trust_to[1]), c(0, 1))
  expect_type(leaf$curves$n, "integer")
  expect_type(leaf$curves$note, "character")
})

test_that("text cells are read as numbers, further columns are kept, spaces are not", {
  text <- function(x) {
    x$curves[] <- lapply(x$curves, as.character)
    x$curves$kind <- paste0(" ", x$curves$kind, " ")
    x$curves$colour <- c("red", "green", "blue")
    x
  }
  leaf <- leaf_scheme(text)
  expect_identical(leaf$curves[names(leaf_scheme()$curves)], leaf_scheme()$curves)
  expect_equal(leaf$curves$colour, c("red", "green", "blue"))
})

test_that("patches, pairs and strips may be absent", {
  x <- leaf_tables()
  bare <- curve_scheme(x$landmarks, x$curves)
  for (table in c("patches", "pairs", "strips", "definitions", "tracks", "triangles")) {
    expect_equal(nrow(bare[[table]]), 0)
  }
  expect_equal(nrow(bare$points), 4 + 18)
  expect_output(print(bare), "3 curves with 18 points")
})

test_that("as.data.frame gives any table", {
  leaf <- leaf_scheme()
  for (table in c("landmarks", "curves", "patches", "pairs", "strips", "definitions", "tracks",
                  "points", "triangles")) {
    expect_identical(as.data.frame(leaf, table), leaf[[table]])
    expect_identical(as.data.frame(leaf, table = table), leaf[[table]])
  }
  expect_identical(as.data.frame(leaf), leaf$curves)
  expect_crestline_error(as.data.frame(leaf, "curbs"), c("curbs", "curves"))
})

test_that("print fits a screen and counts what there is", {
  text <- capture.output(print(leaf_scheme()))
  expect_lte(length(text), 12)
  expect_true(all(nchar(text) <= 80))
  expect_match(text, "3 patches in 3 blocks, 28 points at 28 places", all = FALSE)
  expect_match(text, "2 ridge, 1 valley, 0 plane", all = FALSE)
  expect_match(text, "2 held to a side", all = FALSE)
})

test_that("a number of points that no memory holds is refused by row and column", {
  curve <- data.frame(curve = "p", from = "a", to = "b", kind = "plane", n = 1e9)
  error <- expect_crestline_error(curve_scheme(data.frame(landmark = c("a", "b")), curve),
                                  c("row 1 (p), column n", "at most 1e+05"))
  expect_s3_class(error, "crestline_scheme_error")
})

test_that("the hash of a scheme is that of its tables' content", {
  tables <- paired_tables()
  hash <- function(change = identity,
                   name = "paired") scheme_hash(do.call(curve_scheme,
                                                        c(change(tables), name = name)))
  expect_match(hash(), "^[0-9a-f]{32}$")
  expect_identical(hash(name = "other"), hash())
  expect_identical(hash(function(t) {
    rownames(t$curves) <- letters[seq_len(nrow(t$curves))]
    t$curves <- t$curves[rev(names(t$curves))]
    t$curves$n <- as.double(t$curves$n)
    t$curves$kind <- factor(t$curves$kind)
    t
  }), hash())
  expect_false(identical(hash(function(t) {
    t$curves$n[1] <- 8
    t$curves$n[2] <- 8
    t$patches <- t$pairs <- NULL
    t
  }), hash()))
  expect_false(identical(hash(function(t) {
    t$patches <- NULL
    t$pairs <- t$pairs[-6, ]
    t
  }), hash()))
})

test_that("a scheme that is changed is checked anew, and its points follow", {
  scheme <- quad_scheme()
  before <- scheme
  scheme$curves$n[3] <- 9
  expect_identical(sum(scheme$points$part == "left"), 9L)
  tables <- Filter(NROW, unclass(scheme)[names(scheme_columns)])
  expect_identical(scheme, do.call(curve_scheme, c(tables, list(name = scheme$name))))
  expect_crestline_error(scheme$curves$n[3] <- -1, c("curves", "n"))
  expect_crestline_error(scheme$curves$from[1] <- "nobody", "nobody")
  expect_crestline_error(scheme[["curves"]] <- 3, "curves")
  expect_crestline_error(scheme$points <- NULL, c("points", "worked out"))
  expect_crestline_error(scheme$colour <- "red", "no table colour")
  expect_crestline_error(scheme[[99]] <- 1, "no such table")
  before[["name"]] <- "other"
  expect_identical(before$name, "other")
})
