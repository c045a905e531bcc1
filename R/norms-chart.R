# Centiles of size and measurements by age: the curves of a growth chart.

#' Values at levels of a normal variable: the inverse of z by [predicted_z()] and [straightened()]
#'
#' @param table Of the norm: rows of the columns that are wanted.
#' @param rows Which columns these are.
#' @param level Probabilities.
#' @return Array: ages x columns x levels, in the unit of the measurements.
#' @noRd
centile_values <- function(norms, rows, age, sex, level, fewest = 3) {
  expected <- expected_columns(norms$values, age, rep(sex, length(age)))
  table <- norms$table[rows, ]
  found <- array(NA_real_, c(length(age), length(rows), length(level)))
  for (q in seq_along(level)) {
    for (j in seq_along(rows)) {
      at <- rows[j]
      z <- bent_back(stats::qnorm(level[q]), table[j, ])
      t <- stats::qt(stats::pnorm(z), pmax(fewest, 1 / expected$h_spread[, at]))
      y <- expected$mean[, at] + expected$sd[, at] * sqrt(1 + expected$h[, at]) * t
      found[, j, q] <- if (table$transform[j] == "log") exp(y) else y
    }
  }
  found
}

#' The inverse of [straightened()] for one column
#' @noRd
bent_back <- function(z, skew) {
  if (is.na(skew$skew_1)) return(z)
  skew$skew_1 + skew$skew_2 * sinh((asinh(z) + skew$skew_3) / skew$skew_4)
}

#' Centile curves of size and measurements for one sex
#'
#' @param level Probabilities; those of the WHO's charts.
#' @param steps Number of ages.
#' @return Data frame: `name`, `age`, `centile` (0 to 100), `value`.
#' @noRd
growth_chart <- function(norms, sex, level = c(0.03, 0.15, 0.5, 0.85, 0.97), steps = 60) {
  range <- unlist(norms$ages[norms$ages$sex == sex, c("from", "to")])
  age <- seq(range[[1]], range[[2]], length.out = steps)
  rows <- which(!startsWith(norms$table$name, "component "))
  value <- centile_values(norms, rows, age, sex, level)
  known <- rep(effective_faces(norms, age, rep(sex, steps)) >= norms$settings$least,
               length(rows) * length(level))
  data.frame(name = rep(rep(norms$table$name[rows], each = steps), length(level)),
             age = rep(age, length(rows) * length(level)),
             centile = rep(100 * level, each = steps * length(rows)),
             value = ifelse(known, as.vector(value), NA_real_))
}

#' Unit of size, measurements and components, in words: "mm" for the face, whose scheme is in mm
#' @noRd
value_units <- function(norms) {
  kind <- norms$measurements$kind[match(norms$table$name, norms$measurements$measurement)]
  unit <- measurement_kinds()$unit[match(kind, measurement_kinds()$kind)]
  unit[norms$table$name == "size"] <- "unit"
  unit[is.na(unit)] <- "1"
  sub("unit", length_unit(norms$scheme$hash), unit, fixed = TRUE)
}

length_unit <- function(hash) if (identical(hash, scheme_hash(face_scheme()))) "mm" else "unit"
