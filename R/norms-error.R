# Standard errors of measurements: from the places' own errors to first order, and by draws.

#' What is known of the errors of a shape's places
#'
#' @param error Standard errors of landmarks by name, see [check_landmark_error()].
#' @return List: `se` (of each place in every direction: of landmarks), `curves`, a list by curve:
#'   `rows` (places), `ends` (places of its two landmarks), `inside` (points that are no landmark),
#'   `known` (whether it has errors of its own), `se` (across), `across` (unit vectors), `share` (of
#'   the way between both ends), `root` (of the correlation along the curve).
#' @noRd
place_errors <- function(shape, error, range) {
  scheme <- shape$scheme
  points <- shape$points
  place <- match(scheme$points$place, unique(scheme$points$place))
  own <- which(points$level == "landmarks")
  se <- rep(NA_real_, max(place))
  known <- ifelse(is.na(points$se[own]), error[points$part[own]], points$se[own])
  se[place[own]] <- known
  xyz <- places_of(shape)
  normal <- place_normals(xyz, scheme)
  curves <- lapply(which(scheme$curves$n > 2), function(i) {
    at <- which(points$level == "curves" & points$part == scheme$curves$curve[i])
    if (is.null(range)) range <- scheme$curves$radius[i]
    ends <- place[own][match(unlist(scheme$curves[i, c("from", "to")]), points$part[own])]
    across_errors(xyz, list(rows = place[at], ends = ends), points$se[at], normal, range)
  })
  list(se = se, curves = Filter(Negate(is.null), curves))
}

across_errors <- function(xyz, at, se, normal, range) {
  line <- xyz[at$rows, , drop = FALSE]
  if (anyNA(line)) return(NULL)
  n <- nrow(line)
  tangent <- line[c(2:n, n), ] - line[c(1, 1:(n - 1)), ]
  across <- cross_rows(normal[at$rows, , drop = FALSE], tangent)
  across <- across / pmax(row_lengths(across), .Machine$double.xmin)
  s <- cumsum(c(0, row_lengths(line[-1, , drop = FALSE] - line[-n, , drop = FALSE])))
  off <- lapply(at$ends, function(row) row_lengths(sweep(line, 2, xyz[row, ])))
  inside <- which(!at$rows %in% at$ends)
  together <- if (isTRUE(range > 0)) exp(-outer(s, s, `-`)^2 / (2 * range^2)) else diag(n)
  c(at, list(inside = inside, known = !all(is.na(se[inside])), se = ifelse(is.na(se), 0, se),
             across = across, share = off[[1]] / (off[[1]] + off[[2]]),
             root = chol(together + diag(1e-9, n))))
}

#' Normals of places; a place without triangles has that of the nearest one that has some
#' @noRd
place_normals <- function(xyz, scheme) {
  triangles <- model_triangles(scheme, TRUE)
  if (is.null(triangles)) return(matrix(rep(c(0, 0, 1), each = nrow(xyz)), ncol = 3))
  whole <- which(colSums(matrix(is.na(xyz[triangles, 1]), 3)) == 0)
  triangles <- triangles[, whole, drop = FALSE]
  if (!ncol(triangles)) return(matrix(rep(c(0, 0, 1), each = nrow(xyz)), ncol = 3))
  normal <- point_normals(xyz, triangles)
  there <- which(is.finite(normal[, 1]))
  for (row in setdiff(which(!is.na(xyz[, 1])), there)) {
    nearest <- which.min(rowSums(sweep(xyz[there, , drop = FALSE], 2, xyz[row, ])^2))
    normal[row, ] <- normal[there[nearest], ]
  }
  normal
}

#' Standard errors to first order, by central differences
#'
#' @param se Of each place, in every direction.
#' @param step Step of the differences, as a share of the extent of the shape.
#' @return A number a measurement, NA where a place that it depends on has no `se`.
#' @noRd
delta_errors <- function(plan, xyz, se, step = 1e-5) {
  used <- lapply(plan, function(one) unique(c(one$at, one$base)))
  for (i in seq_along(plan)) if (length(plan[[i]]$of)) used[[i]] <- unlist(used[plan[[i]]$of])
  rows <- unique(unlist(used))
  if (!length(rows)) return(rep(NA_real_, length(plan)))
  step <- step * sqrt(sum(apply(xyz, 2, stats::var, na.rm = TRUE)))
  moved <- array(xyz, c(dim(xyz), 6 * length(rows)))
  at <- cbind(rep(rows, each = 6), rep(c(1, 1, 2, 2, 3, 3), length(rows)),
              seq_len(6 * length(rows)))
  moved[at] <- moved[at] + c(step, -step)
  value <- measure_places(plan, moved)
  odd <- seq(1, ncol(value), 2)
  slope <- (value[, odd, drop = FALSE] - value[, odd + 1, drop = FALSE]) / (2 * step)
  own <- rep(se[rows], each = 3)
  vapply(seq_along(plan), function(i) {
    if (anyNA(se[used[[i]]]) || anyNA(slope[i, ])) return(NA_real_)
    sqrt(sum((slope[i, ] * ifelse(is.na(own), 0, own))^2))
  }, 0)
}

#' Standard errors as the spread over draws of the places
#' @noRd
drawn_errors <- function(plan, xyz, spread, draws, seed) {
  value <- with_seed(seed, measure_places(plan, drawn_places(xyz, spread, draws)))
  se <- apply(value, 1, stats::sd)
  needs <- lapply(plan, function(one) unique(c(unlist(one$lines), one$triangles, one$base, one$at)))
  for (i in seq_along(plan)) if (length(plan[[i]]$of)) needs[[i]] <- unlist(needs[plan[[i]]$of])
  # A measurement has an error if all landmarks do, and each curve on it has its own or its ends'.
  # Places of curves of whose errors nothing is known
  known <- which(!is.na(spread$se))
  each <- lapply(spread$curves, function(curve) {
    c(curve$ends, if (!curve$known && !all(curve$ends %in% known)) curve$rows)
  })
  unknown <- setdiff(unlist(each), known)
  se[vapply(needs, function(rows) any(rows %in% unknown), NA)] <- NA
  se
}

#' k x 3 x draws: places moved by errors of landmarks, and of curves across themselves
#' @noRd
drawn_places <- function(xyz, spread, draws) {
  moved <- array(xyz, c(dim(xyz), draws))
  marks <- which(!is.na(spread$se))
  shift <- array(0, c(nrow(xyz), 3, draws))
  shift[marks, , ] <- spread$se[marks] * stats::rnorm(3 * draws * length(marks))
  ends <- shift
  for (curve in spread$curves) {
    n <- length(curve$rows)
    off <- if (curve$known) {
      curve$se * crossprod(curve$root, matrix(stats::rnorm(n * draws), n))
    } else {
      from <- curve$across %*% matrix(ends[curve$ends[1], , ], 3)
      to <- curve$across %*% matrix(ends[curve$ends[2], , ], 3)
      (1 - curve$share) * from + curve$share * to
    }
    for (d in 1:3) {
      shift[curve$rows[curve$inside], d, ] <- (curve$across[, d] * off)[curve$inside, ]
    }
  }
  moved + shift
}
