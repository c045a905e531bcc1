# One face in the space of a norm: laid, standardised, its missing points and its errors known.

#' A face as the norm sees it
#'
#' @return List: `xyz` (k x 3, laid), `scale`, `turn`, `missing` (k), `y` (1 x 3k, missing points
#'   made up by the surface around them), `expected`, `u` (3k), `excess` (3k: variance of u that a
#'   worse scan adds), `se` (k), `errors` ("given", "estimated"), `rough` (factor).
#' @noRd
patient_surface <- function(shape, norms, age, sex) {
  points <- shape$points[shape$points$level == "surface", ]
  row <- match(norms$points$point, paste(points$part, points$point))
  xyz <- as.matrix(points[row, c("x", "y", "z")])
  if (sum(!is.na(xyz[, 1])) < 0.5 * nrow(xyz)) {
    crestline_abort("more than half of its surface points are missing.",
                    "Measure it again, with the landmarks that it lacks.", stage = "norms",
                    id = shape$id)
  }
  laid <- lay_face(xyz, as.matrix(norms$points[c("x", "y", "z")]))
  check_size_ratio(1 / laid$scale, "the norm's mean face", shape$id, "norms")
  check_not_mirrored(xyz, as.matrix(norms$points[c("x", "y", "z")]), "the norm's mean face",
                     shape$id, "norms")
  field <- prepared_field(norms, "surface", scan = FALSE)
  found <- standardised_face(field, as.vector(laid$laid), age, sex)
  se <- points$se[row] * laid$scale
  c(list(xyz = matrix(found$y, ncol = 3), scale = laid$scale, turn = laid$turn,
         missing = unname(is.na(xyz[, 1])), se = se),
    found, excess_variance(field, found, rep(se, 3), rep(norms$points$se_norm, 3)))
}

#' The same of its asymmetry on one side
#' @noRd
patient_asymmetry <- function(patient, norms, age, sex) {
  if (is.null(norms$asymmetry)) return(NULL)
  partner <- norms$points$partner
  side <- which(norms$points$side)
  laid <- patient$xyz
  laid[patient$missing, ] <- NA
  off <- asymmetric_part(laid, partner)[side, ]
  field <- prepared_field(norms, "asymmetry")
  found <- standardised_face(field, as.vector(off), age, sex)
  both <- function(se) sqrt(se[side]^2 + se[partner[side]]^2) / 2
  c(list(missing = is.na(off[, 1])), found,
    excess_variance(field, found, rep(both(patient$se), 3),
                    rep(both(norms$points$se_norm), 3)))
}

#' A field with its inverse and, if asked for, the scan's weights, made once a session
#' @noRd
prepared_field <- function(norms, name, scan = TRUE) {
  field <- norms$cache[[name]]
  if (is.null(field)) {
    field <- norms[[name]]
    field$inverse <- invert_field(field)
    field$own_variance <- 1 / inverse_diagonal(field$inverse)
  }
  if (scan && is.null(field$weights)) {
    field$weights <- scan_weights(field, unique(field$scan$radii), field$inverse)
  }
  assign(name, field, norms$cache)
  field
}

#' Standardised deviations of one face; of missing points what the others make expected
#' @param y 3k, NA where missing.
#' @noRd
standardised_face <- function(field, y, age, sex) {
  expected <- expected_columns(field$columns, age, sex)
  spread <- as.vector(expected$sd * sqrt(1 + expected$h))
  u <- (y - as.vector(expected$mean)) / spread
  out <- is.na(u)
  if (any(out)) u <- given_the_rest(field, replace(u, out, 0), out)$fit
  list(u = u, y = as.vector(expected$mean) + u * spread, expected = expected, spread = spread)
}

#' Variance of u that this scan has beyond the norm's own
#'
#' By the standard errors of its points where at least half have one; else by how rough it is: the
#' median squared residual from what the neighbours make expected, over that of held-out faces.
#' @noRd
excess_variance <- function(field, found, se, se_norm) {
  spread <- as.vector(found$expected$sd)
  if (mean(!is.na(se)) >= 0.5) {
    base <- ifelse(is.na(se_norm), 0, se_norm^2)
    excess <- pmax(0, se^2 - base) / spread^2
    excess[is.na(excess)] <- 0
    return(list(excess = excess, errors = "given", rough = NA_real_))
  }
  rough <- roughness(field$inverse, as.matrix(found$u))$median / field$rough
  list(excess = (max(1, rough) - 1) * field$own_variance, errors = "estimated", rough = rough)
}

#' The scan of one face: every centre, radius, and one or both sides
#'
#' @return List: `z` (k x bumps), `largest`, `p`, `at` (row), `radius`, `both` (FALSE at a point
#'   without another as its partner: there both bumps are the same), `z_at` (with its sign).
#' @noRd
scanned_face <- function(field, found, age, sex, but = rep(FALSE, nrow(field$points))) {
  t <- lapply(field$weights, function(w) crossprod(found$u, w))
  extra <- lapply(field$weights, function(w) crossprod(found$excess, w^2))
  maps <- scan_maps(t, field$scan, age, factor(sex, names(field$scan$by_age)), extra)
  z <- vapply(maps$z, as.vector, numeric(nrow(field$points)))
  z <- matrix(z, nrow(field$points))
  free <- z
  free[but, ] <- 0
  best <- arrayInd(which.max(abs(free)), dim(z))
  list(z = z, largest = abs(free[best]), at = best[1], radius = field$scan$radii[best[2]],
       both = field$scan$both[best[2]] && isTRUE(field$partner[best[1]] != best[1]),
       z_at = free[best],
       p = tail_p(abs(free[best]), field$scan$quantiles))
}
