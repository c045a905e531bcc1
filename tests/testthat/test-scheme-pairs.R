expect_pair_mistake <- function(change, words) {
  expect_s3_class(expect_crestline_error(leaf_scheme(change), c("table pairs", words)),
                  "crestline_scheme_error")
}
mirror_broken <- function(table, row, column, value, words) {
  expect_pair_mistake(set_cell(table, row, column, value), words)
}

test_that("names that mean nothing, and partners of two", {
  mirror_broken("pairs", 2, "right", "edge",
                c("row 2 (edge left), column right", "no curve \"edge\""))
  mirror_broken("pairs", 1, "left", "wide", c("row 1 (wide), column left", "no landmark \"wide\""))
  mirror_broken("pairs", 3, "left", "blade", c("row 3 (blade), column left", "no patch \"blade\""))
  mirror_broken("pairs", 1, "right", "wideL", "has a partner already")
  again <- function(x) {
    x$pairs <- rbind(x$pairs, data.frame(level = "landmarks", left = "wideR", right = "tip"))
    x
  }
  expect_pair_mistake(again, c("row 4 (wideR), column left", "has a partner already"))
})

test_that("partners that are no mirror images", {
  mirror_broken("curves", 3, "kind", "valley",
                c("row 2 (edge left)", "kind is valley, the partner's ridge"))
  mirror_broken("curves", 3, "radius", 3, "radius is 3, the partner's 2")
  mirror_broken("curves", 3, "side", "left", "side is left, the partner's right")
  mirror_broken("curves", 3, "to", "wideR", "to is wideR, the partner's tip")
  mirror_broken("curves", 2, c("keep_away_from", "keep_away_to"), list("base", "wideL"),
                "keep_away is NA NA, the partner's base wideR")
  mirror_broken("curves", 2:3, c("keep_side_from", "keep_side_to", "keep_side_towards"),
                list("base", "tip", "wideL"), "keep_side_towards is wideL, the partner's wideR")
  mirror_broken("patches", 2, "outward", "rows",
                c("row 3 (blade left)", "outward is rows, the partner's columns"))
  mirror_broken("patches", 2, c("columns", "n"), list("2:4", 9), "n is 9, the partner's 12")
  mirror_broken("patches", 2, "curve_a", "edge left[1:6]",
                "curve_a is edge left[1:6], the partner's edge right[1:6]")
})

test_that("partners with different n are no pair", {
  fewer <- function(x) {
    x$curves$n[3] <- 5
    x$patches <- x$strips <- NULL
    x$pairs <- x$pairs[1:2, ]
    x
  }
  expect_pair_mistake(fewer, c("row 2 (edge left), column right", "n is 5, the partner's 6"))
})

test_that("what has no partner must be its own mirror image", {
  unpaired <- function(row) function(x) {
    x$pairs <- x$pairs[-row, ]
    x
  }
  expect_pair_mistake(unpaired(2), "is no mirror image: curve_a is edge right[1:6]")
  sided <- function(x) {
    x$curves <- rbind(x$curves[1, ], transform(x$curves[1, ], curve = "rim", to = "wideL"))
    list(landmarks = x$landmarks, curves = x$curves, pairs = x$pairs[1, ])
  }
  expect_pair_mistake(sided, "the curve \"rim\" has no partner, but its ends have")
  expect_pair_mistake(unpaired(3), "the patch \"blade left\" has no partner, but its curves have")
})

test_that("a curve across from left to right is its own", {
  across <- function(x) {
    x$curves <- rbind(x$curves,
                      transform(x$curves[1, ], curve = "waist", from = "wideL", to = "wideR"))
    x
  }
  expect_equal(nrow(leaf_scheme(across)$curves), 4)
})

test_that("partners go both ways and others are their own", {
  pairs <- leaf_scheme()$pairs
  expect_equal(partner_of(c("wideL", "wideR", "tip"), pairs, "landmarks"),
               c("wideR", "wideL", "tip"))
  expect_equal(partner_of("wideL", pairs, "curves"), "wideL")
})
