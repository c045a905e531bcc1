# A leaf: two edges and a midrib between base and tip, a blade on each side. Everything facial is
# absent.
leaf_tables <- function() {
  list(
    landmarks = data.frame(landmark = c("base", "tip", "wideL", "wideR")),
    curves = data.frame(
      curve = c("midrib", "edge left", "edge right"), from = "base", to = "tip",
      kind = c("valley", "ridge", "ridge"), radius = 2, width = 4, n = 6,
      side_of = c(NA, "midrib", "midrib"), side = c(NA, "left", "right")
    ),
    patches = data.frame(
      patch = c("blade left", "blade right", "rib"), n = c(12, 12, 4),
      columns = c("2:5", "2:5", "1:4"), rows = c(4, 4, 1), rows_kept = c("1:3", "1:3", "1"),
      curve_a = c("edge left[1:6]", "edge right[1:6]", "midrib[1:6]"),
      resample_a = c(NA, NA, 4), curve_b = c("midrib[1:6]", "midrib[1:6]", NA),
      outward = c("rows", "columns", NA)
    ),
    pairs = data.frame(level = c("landmarks", "curves", "surface"),
                       left = c("wideL", "edge left", "blade left"),
                       right = c("wideR", "edge right", "blade right")),
    strips = data.frame(
      part = "model", strip = rep(c("rib left", "rib right"), each = 3), rung = rep(1:3, 2),
      a = c(paste0("blade left|", 2:4, " 3"), paste0("blade right|", 2:4, " 3")),
      b = paste0("rib|", 2:4), outward = rep(c("columns", "rows"), each = 3)
    )
  )
}

# The leaf's scheme after `change` (a function of the tables), or the tables' own.
leaf_scheme <- function(change = identity) {
  do.call(curve_scheme, c(change(leaf_tables()), name = "leaf"))
}

# A change of one cell, for leaf_scheme().
set_cell <- function(table, row, column, value) {
  function(tables) {
    tables[[table]][row, column] <- value
    tables
  }
}
