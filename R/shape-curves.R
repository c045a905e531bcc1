# Every curve of a scheme on one specimen: found, cut off where the scheme says so, spaced.

#' Fit the curves of a scheme
#'
#' @param specimen,scheme,settings,passes,threads,cut_scale As in [fit_shape()].
#' @param tick Called after every curve.
#' @return List by name of curve; each a list of `points` (data frame of n rows: x, y, z, face, w1, w2, w3, s, se),
#'   `path`, `length`, `strength`, `se`, `competing`, `reason` (NA where there is nothing to say) or, where it failed,
#'   of `reason` alone.
#' @noRd
fit_scheme_curves <- function(specimen, scheme, settings, passes, threads, cut_scale, tick) {
  curves <- scheme$curves
  sources <- scheme_curvatures(specimen, curves, settings, threads)
  fits <- stats::setNames(vector("list", nrow(curves)), curves$curve)
  fit <- function(row) {
    suppressWarnings(fit_scheme_curve(row, specimen, sources, fits, settings, passes),
                     classes = "crestline_warning")
  }
  for (i in fitting_order(curves)) {
    fits[[i]] <- tryCatch(fit(curves[i, ]), crestline_error = function(e) cut_instead(curves[i, ], e$problem, fit))
    tick()
  }
  cut_curves(specimen, curves, fits, cut_scale)
}

#' The shortest cut in place of a ridge or valley that could not be estimated, or the reason alone
#' @noRd
cut_instead <- function(row, problem, fit) {
  failed <- list(reason = problem)
  if (row$kind == "plane") return(failed)
  row$kind <- "plane"
  cut <- tryCatch(fit(row), crestline_error = function(e) failed)
  if (!is.null(cut$path)) cut$reason <- paste("the shortest cut instead:", problem)
  cut
}

#' A curve comes after the one whose side it keeps to
#' @noRd
fitting_order <- function(curves) {
  before <- match(curves$side_of, curves$curve)
  depth <- integer(nrow(curves))
  at <- before
  while (!all(is.na(at))) {
    depth <- depth + !is.na(at)
    at <- before[at]
  }
  order(depth)
}

#' Curvature for all curves of one radius, estimated where they ask for it
#'
#' @return List by radius of functions as of [curvature_source()].
#' @noRd
scheme_curvatures <- function(specimen, curves, settings, threads) {
  radius <- unique(curves$radius[curves$kind != "plane"])
  sources <- lapply(radius, function(r) {
    tryCatch(curvature_source(specimen, r, settings$order, threads), crestline_error = function(e) {
      function(vertices) rlang::cnd_signal(e)
    })
  })
  stats::setNames(sources, radius)
}

fit_scheme_curve <- function(row, specimen, sources, fits, settings, passes) {
  curve <- if (row$kind == "plane" && is.na(row$angle_limit)) {
    ridge_curve(specimen, row$from, row$to, "plane", n = row$n)
  } else if (row$kind == "plane") {
    path <- limited_reference(row, specimen, NULL, NULL, settings)
    new_curve(specimen, path, path, row$n, about_curve(row, specimen, settings, passes))
  } else {
    fit_curved(row, specimen, sources[[as.character(row$radius)]], fits, settings, passes)
  }
  list(points = curve$points[c(mesh_columns, "s", "se")], path = curve$path, length = curve$length,
       strength = curve$strength, se = curve$se, competing = c(attr(curve$reference, "competing"), NA)[1],
       reason = curve$reason)
}

#' A ridge or valley with the constraints of its row
#' @noRd
fit_curved <- function(row, specimen, curvature, fits, settings, passes) {
  away <- kept_away(row)
  if (!is.na(row$side_of)) curvature <- on_side(curvature, row, specimen, fits[[row$side_of]])
  free <- is.na(row$angle_limit) && row$trust_from == 0 && row$trust_to == 1
  if (free) {
    return(ridge_curve(specimen, row$from, row$to, row$kind, row$radius, row$width, row$n, away, settings, passes,
                       curvature))
  }
  path <- if (is.na(row$angle_limit)) {
    reference_path(specimen, row$from, row$to, row$kind, row$radius, away, curvature, longest = settings$longest)
  } else {
    limited_reference(row, specimen, curvature, away, settings)
  }
  about <- about_curve(row, specimen, settings, passes)
  fit <- fit_passes(specimen, path, trusted(curvature, row, specimen, path), away, about)
  new_curve(specimen, fit$path, fit$reference, row$n, about, fit)
}

#' The regions of a row, NULL where it has none
#' @noRd
kept_away <- function(row) {
  c(if (!is.na(row$keep_away_from)) {
    list(keep_away(row$keep_away_from, row$keep_away_to, row$keep_away_radius, row$keep_away_extension))
  }, if (!is.na(row$keep_side_from)) list(keep_side(row$keep_side_from, row$keep_side_to, row$keep_side_towards)))
}

about_curve <- function(row, specimen, settings, passes) {
  list(id = specimen$id, from = row$from, to = row$to, type = row$kind, settings = settings, passes = passes,
       radius = row$radius, width = row$width)
}

#' Reference path among the angles that a row allows
#'
#' @param angles Number of angles.
#' @param reach,spacing As in [reference_path()].
#' @noRd
limited_reference <- function(row, specimen, curvature, away, settings, angles = 61, reach = 0.5, spacing = 0.25) {
  surface <- walkable(specimen)
  ends <- path_ends(specimen, surface, row$from, row$to)
  if (is.null(curvature)) return(limited_cut(surface, ends, row$angle_limit, angles, reach))
  strength <- path_strength(curvature, row$kind, away, specimen)
  rate <- function(axis, found) cut_strength(surface, ends, axis, found, reach, spacing * row$radius, strength)
  limited_cut(surface, ends, row$angle_limit, angles, reach, rate, settings$longest)
}

#' Curvature with none on the wrong side of another curve
#' @noRd
on_side <- function(curvature, row, specimen, other) {
  if (is.null(other$path)) {
    crestline_abort(sprintf("the curve whose side it keeps to, %s, was not found.", row$side_of),
                    "Mend that curve first.", stage = "curves", id = specimen$id, class = "crestline_path_error")
  }
  reach <- attr(other$path, "length") / 2 + row$radius
  near <- path_coordinates(specimen, other$path, reach, margin = row$radius)
  wrong <- if (row$side == "left") near$d <= 0 else near$d >= 0
  without_curvature(curvature, near$vertex[wrong])
}

#' Curvature with none beside the parts of a path that are not trusted
#' @noRd
trusted <- function(curvature, row, specimen, path) {
  near <- path_coordinates(specimen, path, row$width, margin = row$radius)
  share <- near$s / attr(path, "length")
  without_curvature(curvature, near$vertex[share < row$trust_from | share > row$trust_to])
}

without_curvature <- function(curvature, vertex) {
  force(curvature)
  function(vertices) {
    curved <- curvature(vertices)
    none <- vertices %in% vertex & !is.na(curved$k1)
    curved$k1[none] <- 0
    curved$k2[none] <- 0
    curved
  }
}

#' Cut off the curves that a scheme cuts, all of one specimen by one factor
#'
#' Where a curve is shorter than its share the factor is lowered until all are long enough, so that no two curves from
#' one landmark keep it both.
#' @noRd
cut_curves <- function(specimen, curves, fits, cut_scale) {
  wanted <- cut_lengths(specimen, curves)
  found <- vapply(fits, function(fit) if (is.null(fit$path)) NA_real_ else fit$length, 0)
  factor <- min(cut_scale, found / wanted, na.rm = TRUE)
  for (i in which(!is.na(curves$cut_share) & !is.na(found))) {
    fits[[i]] <- if (is.na(wanted[i])) {
      list(reason = sprintf("%s or %s is missing: where to cut it is not known", curves$cut_from[i], curves$cut_to[i]))
    } else {
      cut_curve(specimen$mesh, fits[[i]], factor * wanted[i], curves$n[i])
    }
    if (factor < cut_scale && !is.null(fits[[i]]$path)) {
      note <- sprintf("cut at %.3g of the scheme's share, as curves are short", factor)
      fits[[i]]$reason <- paste(c(stats::na.omit(fits[[i]]$reason), note), collapse = "; ")
    }
  }
  fits
}

#' Length that the scheme leaves of every curve, NA where it is not cut or a landmark is missing
#' @noRd
cut_lengths <- function(specimen, curves) {
  at <- function(name) specimen$landmarks[match(name, rownames(specimen$landmarks)), , drop = FALSE]
  curves$cut_share * sqrt(rowSums((at(curves$cut_from) - at(curves$cut_to))^2))
}

cut_curve <- function(mesh, fit, length, n) {
  start <- max(fit$length - length, 0)
  path <- part_of_path(mesh, fit$path, start, fit$length)
  placed <- resample_path(mesh, path, n)
  se <- rep(NA_real_, n)
  if (any(is.finite(fit$points$se))) se <- stats::approx(fit$points$s, fit$points$se, placed$s + start, rule = 2)$y
  points <- cbind(placed[c(mesh_columns, "s")], se = se)
  cut <- list(points = points, path = path, length = attr(path, "length"), se = stats::median(se))
  fit[names(cut)] <- cut
  fit
}
