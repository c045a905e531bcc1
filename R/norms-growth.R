# Growth that a norm makes expected between two ages.

#' The growth of a face between two ages, if it keeps its z
#'
#' @param known Of [visits_with_errors()]; the first visit grows.
#' @param ages Two ages; `sex` as checked.
#' @return List: `move` (matrix by row of the points, in the frame of the shape: points that are no
#'   surface points move as the nearest one), `se` (of the move along the normals, by the norm),
#'   `values` (data frame `name`, `factor`, `plus`, `se`: a measurement becomes factor x + plus),
#'   `words`.
#' @noRd
expected_growth <- function(known, norms, ages, sex) {
  shape <- known$before
  first <- patient_surface(shape, norms, ages[1], sex)
  later <- expected_columns(norms$surface$columns, ages[2], sex)
  y <- later$mean + (first$y - first$expected$mean) * later$sd / first$expected$sd
  values <- own_errors(shape, norms, known$error, together = known$together)$value
  grown <- grown_values(norms, values, ages, sex)
  before <- first$xyz
  after <- matrix(y, ncol = 3)
  centre <- colMeans(before)
  spread <- function(x) sqrt(sum(sweep(x, 2, colMeans(x))^2))
  ratio <- exp(grown$later[1] - values[1]) * spread(before) / spread(after)
  scaled <- ratio * sweep(after, 2, colMeans(after))
  move <- (sweep(scaled, 2, centre, `+`) - before) %*% t(first$turn) / first$scale
  normal <- as.matrix(norms$points[c("nx", "ny", "nz")])
  own <- growth_error(norms$surface$along, ages, sex)
  by_size <- row_products(sweep(before, 2, centre), normal) * grown$se[1]
  se <- sqrt(own^2 + by_size^2) / first$scale
  points <- shape$points
  row <- match(paste(points$part, points$point), norms$points$point)
  row[points$level != "surface"] <- NA
  open <- which(is.na(row) & !is.na(points$x))
  known <- which(!is.na(row) & !is.na(points$x))
  xyz <- point_columns(shape)
  nearest <- vapply(open, function(i) {
    known[which.min(rowSums(sweep(xyz[known, , drop = FALSE], 2, xyz[i, ])^2))]
  }, 0L)
  row[open] <- row[nearest]
  list(move = move[row, , drop = FALSE], se = se[row], values = grown,
       words = sprintf("from %.4g to %.4g years, expected by %s%s, subtracted", ages[1], ages[2],
                       if (length(norms$about$name)) paste0(norms$about$name, ", ") else "",
                       amount(norms$n, "face")))
}

#' Size and measurements at the second age, on the norm's scales, if z stays
#' @return Data frame: `name`, `transform`, `now`, `later`, `se` (of the growth).
#' @noRd
grown_values <- function(norms, values, ages, sex) {
  table <- norms$table[seq_along(values), ]
  expected <- expected_columns(norms$values, ages, rep(sex, 2))
  own <- seq_along(values)
  z <- (values - expected$mean[1, own]) / expected$sd[1, own]
  data.frame(name = table$name, transform = table$transform, now = values,
             later = expected$mean[2, own] + z * expected$sd[2, own],
             se = growth_error(norms$values, ages, sex)[own])
}

#' Standard error of the difference of two means of a norm
#' @param factor As in [norm_error()].
#' @noRd
growth_error <- function(fit, ages, sex, factor = 1.25) {
  one <- fit$groups[[sex]]
  x <- age_splines(ages, fit$size$k, fit$size$range)
  apart <- leverage_of(x[2, , drop = FALSE] - x[1, , drop = FALSE], one$basis, one$lambda)
  as.vector(factor * sqrt(apart) * expected_columns(fit, ages[2], sex)$sd)
}

#' Expected growth of measurements and its standard error, NA where the norm has none
#' @param names Of measurements.
#' @noRd
measured_growth <- function(names, growth) {
  own <- growth$values[match(names, growth$values$name), ]
  logs <- own$transform == "log"
  back <- function(x) ifelse(logs, exp(x), x)
  later <- back(own$later)
  data.frame(growth = later - back(own$now), se = own$se * ifelse(logs, later, 1))
}

#' What growth is subtracted, by the arguments of [compare_visits()]; NULL for none
#' @noRd
checked_growth <- function(known, norms, ages, sex) {
  if (is.null(norms)) {
    if (!is.null(ages) || !is.null(sex)) {
      crestline_abort("`ages` and `sex` are of the growth that `norms` expect.",
                      "Give `norms`, or leave them out.", stage = "visits")
    }
    return(NULL)
  }
  check_class(norms, "shape_norms", "norms", "fit_norms() or read_norms()")
  ages <- check_numbers(ages, "ages", 2, lower = 0)
  if (ages[1] > ages[2]) {
    refuse_argument("ages", ages, "Give the first visit as `before`, its age first.",
                    "falling: the visits look exchanged")
  }
  sex <- check_norm_sex(sex, norms)
  check_norm_scheme(known$before, norms)
  for (age in ages) check_norm_age(age, sex, norms, known$before$id)
  expected_growth(known, norms, ages, sex)
}
