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
