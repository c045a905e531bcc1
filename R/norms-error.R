# Standard errors of measurements: from the places' own errors to first order, and by draws.

#' What is known of the errors of a shape's places
#'
#' Curves that were measured have errors across themselves. Where most surface points have an error
#' of their own (simulated faces, repeated scans), all errors are those of co-ordinates.
#'
#' @param error Standard errors of landmarks by name, see [check_landmark_error()].
#' @param together List `range`, `share` of errors that go together, see [together_at()]; `NULL`:
#'   see [measurements()].
#' @param rows Places that are needed; curves of others are left out.
#' @return List: `se` (of each place in every direction: of landmarks), `every` (as of
#'   [coordinate_errors()], or NULL), `landmarks` (their places), `curves`, a list by curve:
#'   `rows` (places), `ends` (places of its two landmarks), `inside` (points that are no landmark),
#'   `known` (whether it has errors of its own), `se` (across), `across` (unit vectors), `share` (of
#'   the way between both ends), `root` (of the correlation along the curve).
#' @noRd
place_errors <- function(shape, error, together, rows) {
  scheme <- shape$scheme
  points <- shape$points
  place <- match(scheme$points$place, unique(scheme$points$place))
  own <- which(points$level == "landmarks")
  se <- rep(NA_real_, max(place))
  known <- ifelse(is.na(points$se[own]), error[points$part[own]], points$se[own])
  se[place[own]] <- known
  every <- coordinate_errors(shape, place, se, together)
  if (!is.null(every)) return(list(se = se, every = every))
  xyz <- places_of(shape)
  curves <- lapply(which(scheme$curves$n > 2), function(i) {
    at <- which(points$level == "curves" & points$part == scheme$curves$curve[i])
    inside <- at[-c(1, length(at))]
    if (!any(place[inside] %in% rows)) return(NULL)
    ends <- place[own][match(unlist(scheme$curves[i, c("from", "to")]), points$part[own])]
    list(rows = place[at], ends = ends, points = at,
         range = if (is.null(together)) scheme$curves$radius[i] else together$range)
  })
  curves <- Filter(Negate(is.null), curves)
  normal <- if (length(curves)) place_normals(xyz, scheme)
  curves <- lapply(curves, function(one) {
    across_errors(xyz, one[c("rows", "ends")], points$se[one$points], normal, one$range)
  })
  list(se = se, landmarks = place[own], curves = Filter(Negate(is.null), curves))
}

#' Errors of the co-ordinates of all places, where at least half of the surface points have some
#'
#' @param place Place of each point; `se` of each place, NA but for landmarks.
#' @param together As in [place_errors()].
#' @return List: `se` (of each place), `range`, `share` (of the variance that goes together), or
#'   NULL.
#' @noRd
coordinate_errors <- function(shape, place, se, together) {
  if (!has_coordinate_errors(shape)) return(NULL)
  given <- which(!is.na(shape$points$se))
  all <- replace(rep(NA_real_, length(se)), place[given], shape$points$se[given])
  all[!is.na(se)] <- se[!is.na(se)]
  if (is.null(together)) together <- shared_errors(list(shape))
  list(se = all, range = together$range, share = if (together$range == 0) 0 else together$share)
}

has_coordinate_errors <- function(shape) {
  there <- shape$points$level == "surface" & !is.na(shape$points$x)
  any(there) && mean(!is.na(shape$points$se[there])) >= 0.5
}

#' How errors of all co-ordinates go together, by some shapes; NULL where others have errors alone
#' @noRd
shared_errors <- function(shapes) {
  own <- Filter(has_coordinate_errors, shapes)
  if (!length(own)) return(NULL)
  range <- stats::median(own[[1]]$scheme$curves$radius, na.rm = TRUE)
  # Without radii: the reach of third differences, three steps along a curve
  if (is.na(range)) range <- 3 * curve_step(own[[1]])
  list(range = range, share = 1 - independent_share(own))
}

#' Median distance between neighbouring points of curves, 0 without any
#' @noRd
curve_step <- function(shape) {
  own <- which(shape$points$level == "curves")
  step <- unlist(lapply(split(own, shape$points$part[own]), function(rows) {
    row_lengths(diff(as.matrix(shape$points[rows, c("x", "y", "z")])))
  }))
  if (any(!is.na(step))) stats::median(step, na.rm = TRUE) else 0
}

#' How much of the variance of errors may be independent from point to point, by curves of shapes
#'
#' Third differences of the points of a curve are at least those of independent errors. Where they
#' are smaller by more than chance, the rest of the variance goes together.
#' @param sure Standard errors that are chance.
#' @noRd
independent_share <- function(shapes, sure = 2) {
  ratio <- unlist(lapply(shapes, third_differences))
  ratio <- ratio[is.finite(ratio)]
  if (!length(ratio)) return(1)
  # By the median, since corners of curves are few; 2 / n, as differences overlap three times
  share <- stats::median(ratio) / stats::qchisq(0.5, 3)
  if (share >= 1 - sure * 1.25 * sqrt(2 / length(ratio))) 1 else share
}

#' Squared third differences of the points of curves over their variance by independent errors
#' @noRd
third_differences <- function(shape) {
  own <- which(shape$points$level == "curves")
  unlist(lapply(split(own, shape$points$part[own]), function(rows) {
    n <- length(rows) - 2
    if (n < 4) return(NULL)
    inside <- rows[1 + seq_len(n)]
    third <- diff(as.matrix(shape$points[inside, c("x", "y", "z")]), differences = 3)
    square <- shape$points$se[inside]^2
    by <- square[seq_len(n - 3)] + 9 * square[2:(n - 2)] + 9 * square[3:(n - 1)] + square[4:n]
    rowSums(third^2) / by
  }))
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

#' Places that each measurement needs
#' @return List of rows by measurement.
#' @noRd
plan_rows <- function(plan) {
  rows <- lapply(plan, function(one) {
    unique(c(unlist(one$lines), one$triangles, one$base, one$at))
  })
  for (i in seq_along(plan)) if (length(plan[[i]]$of)) rows[[i]] <- unlist(rows[plan[[i]]$of])
  rows
}

#' Standard errors as the spread over draws of the places, and what errors add on average
#'
#' Every draw has its mirror image, which leaves of the bias what is of second order alone. With the
#' errors once and twice their variance, the means of the draws are extrapolated to none (Cook and
#' Stefanski).
#' @param value Measurements of `xyz`.
#' @return List: `se`, `bias`, a number a measurement, NA where errors are not known.
#' @noRd
drawn_errors <- function(plan, xyz, value, spread, draws, seed) {
  needs <- plan_rows(plan)
  shift <- with_seed(seed, drawn_shifts(xyz, spread, draws, unique(unlist(needs))))
  moved <- function(by) measure_places(plan, array(xyz, dim(shift)) + by * shift)
  once <- cbind(moved(1), moved(-1))
  twice <- cbind(moved(sqrt(2)), moved(-sqrt(2)))
  se <- sqrt(rowMeans((once - rowMeans(once))^2))
  bias <- 3 * (rowMeans(once) - value) - (rowMeans(twice) - value)
  unknown <- unknown_places(spread)
  lost <- vapply(needs, function(rows) any(rows %in% unknown), NA)
  list(se = replace(se, lost, NA), bias = replace(bias, lost, NA))
}

#' Places of whose errors nothing is known: a measurement has an error if all landmarks do, and each
#' curve on it has its own or its ends'
#' @noRd
unknown_places <- function(spread) {
  if (!is.null(spread$every)) return(which(is.na(spread$every$se)))
  known <- which(!is.na(spread$se))
  each <- lapply(spread$curves, function(curve) {
    c(curve$ends, if (!curve$known && !all(curve$ends %in% known)) curve$rows)
  })
  setdiff(c(spread$landmarks, unlist(each)), known)
}

#' k x 3 x draws: errors of landmarks, and of curves across themselves; or of all co-ordinates
#' @param rows Places that are needed.
#' @noRd
drawn_shifts <- function(xyz, spread, draws, rows) {
  if (!is.null(spread$every)) return(coordinate_shifts(xyz, spread$every, draws, rows))
  marks <- which(!is.na(spread$se))
  shift <- array(0, c(nrow(xyz), 3, draws))
  drawn <- stats::rnorm(3 * draws * length(marks))
  shift[marks, , ] <- spread$se[marks] * in_own_frame(drawn, xyz, draws)
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
  shift
}

#' The same where all co-ordinates have errors
#' @param every Of [coordinate_errors()].
#' @param jitter Added to the diagonal of a correlation, which is singular for smooth errors.
#' @noRd
coordinate_shifts <- function(xyz, every, draws, rows, jitter = 1e-6) {
  rows <- rows[!is.na(xyz[rows, 1]) & !is.na(every$se[rows])]
  shift <- array(0, c(nrow(xyz), 3, draws))
  drawn <- matrix(stats::rnorm(length(rows) * 3 * draws), length(rows))
  if (every$share > 0) {
    squares <- as.matrix(stats::dist(xyz[rows, , drop = FALSE]))^2
    root <- chol(exp(-squares / (2 * every$range^2)) + diag(jitter, length(rows)))
    apart <- matrix(stats::rnorm(length(drawn)), length(rows))
    drawn <- sqrt(every$share) * crossprod(root, drawn) + sqrt(1 - every$share) * apart
  }
  shift[rows, , ] <- every$se[rows] * in_own_frame(drawn, xyz, draws)
  shift
}

#' Numbers drawn by place, co-ordinate and draw, in a frame that turns with the shape
#' @return rows x 3 x draws.
#' @noRd
in_own_frame <- function(drawn, xyz, draws) {
  k <- length(drawn) / (3 * draws)
  flat <- matrix(aperm(array(drawn, c(k, 3, draws)), c(1, 3, 2)), ncol = 3)
  aperm(array(tcrossprod(flat, own_frame(xyz)), c(k, draws, 3)), c(1, 3, 2))
}

#' Three axes that turn with a configuration, as columns: by its first point, that farthest from it,
#' and that farthest from the line of both
#' @noRd
own_frame <- function(xyz) {
  off <- xyz[!is.na(xyz[, 1]), , drop = FALSE]
  if (!nrow(off)) return(diag(3))
  off <- sweep(off, 2, off[1, ])
  far <- off[which.max(rowSums(off^2)), ]
  if (sum(far^2) == 0) return(diag(3))
  first <- far / sqrt(sum(far^2))
  off <- off - tcrossprod(off %*% first, first)
  far <- off[which.max(rowSums(off^2)), ]
  if (sum(far^2) == 0) return(diag(3))
  second <- far / sqrt(sum(far^2))
  cbind(first, second, cross_product(first, second), deparse.level = 0)
}
