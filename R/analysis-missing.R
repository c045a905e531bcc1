# Points that specimens lack: estimated by the thin-plate spline, or dropped from all.

#' Configurations without gaps
#'
#' @param given As of [configurations()].
#' @return `given` with complete `coords`, and `missing` (data frame `id`, `point`, `action`),
#'   `kept` (rows of the given points), `given` (their number), `reference` (filled).
#' @noRd
complete_configurations <- function(given, missing) {
  coords <- given$coords
  gap <- gaps(coords)
  at <- which(gap, arr.ind = TRUE)
  action <- c(estimate = "estimated", drop = "dropped", stop = "")[[missing]]
  given$missing <- data.frame(
    id = colnames(gap)[at[, 2]], point = rownames(gap)[at[, 1]], action = rep(action, nrow(at))
  )
  given$given <- dim(coords)[1]
  given$kept <- seq_len(given$given)
  if (any(gap)) {
    if (missing == "stop") abort_missing(given$missing)
    nowhere <- rowSums(!gap) == 0
    if (missing == "estimate" && any(nowhere) && sum(!nowhere) > dim(coords)[2] + 1) {
      tell_nowhere(rownames(gap)[nowhere])
      given$missing$action[nowhere[at[, 1]]] <- "dropped"
      given <- without_points(given, nowhere)
      gap <- gap[!nowhere, , drop = FALSE]
    }
    check_enough(rowSums(gap), colSums(!gap), dim(coords)[2], missing)
    if (missing == "drop") given <- without_points(given, rowSums(gap) > 0) else
      if (any(gap)) given <- estimated(given, gap)
  }
  if (is.null(given$reference) ||
      anyNA(given$reference)) given$reference <- unnamed_slice(given$coords, 1)
  given
}

#' k x n: which points lack a co-ordinate
#' @noRd
gaps <- function(coords) {
  each <- lapply(seq_len(dim(coords)[2]), function(d) is.na(coords[, d, ]))
  matrix(Reduce(`|`, each), dim(coords)[1], dimnames = dimnames(coords)[c(1, 3)])
}

unnamed_slice <- function(coords, i) matrix(coords[, , i], dim(coords)[1])

abort_missing <- function(missing) {
  crestline_abort(sprintf("%s missing, of %s.", amount(nrow(missing), "point"),
                          shorten(unique(missing$id), 5)),
                  "Let them be estimated or dropped: see `missing`.", stage = "align")
}

#' A face without ears is no reason to stop: nothing is known of these points
#' @noRd
tell_nowhere <- function(points) {
  crestline_inform(sprintf("align: %s missing in every specimen, left out: %s.",
                           amount(length(points), "point"), shorten(points, 5)))
}

#' @param lacking k, with names: how many specimens lack each point.
#' @param there n, with names: how many points each specimen has.
#' @noRd
check_enough <- function(lacking, there, dim, missing) {
  fail <- function(problem, remedy, id = NULL) crestline_abort(
    problem, remedy, stage = "align", id = id
  )
  if (missing == "drop") {
    if (sum(lacking == 0) <= dim) {
      fail("no more than three points are there in every specimen.",
           "Estimate them, or leave out the worst specimens.")
    }
    return(invisible())
  }
  nowhere <- which(lacking == length(there))
  if (length(nowhere)) {
    fail(sprintf("%s missing in every specimen: %s.", amount(length(nowhere), "point"),
                 shorten(names(lacking)[nowhere], 5)),
         "Use missing = \"drop\".")
  }
  few <- which(there <= dim + 1)
  if (length(few)) {
    fail(sprintf("%s only.", amount(there[few[1]], "point")),
         "Leave this specimen out: too few to place the others by.",
         names(there)[few[1]])
  }
}

#' Some points left out of all specimens, and of the triangles
#' @noRd
without_points <- function(given, out) {
  given$kept <- which(!out)
  given$coords <- given$coords[given$kept, , , drop = FALSE]
  given$places <- given$places[given$kept]
  if (!is.null(given$reference)) given$reference <- given$reference[given$kept, , drop = FALSE]
  if (!is.null(given$triangles)) {
    renumbered <- matrix(match(given$triangles, given$kept), 3)
    given$triangles <- renumbered[, colSums(is.na(renumbered)) == 0, drop = FALSE]
  }
  given
}

#' Missing points put where the spline from the mean takes them
#'
#' The mean of a point that some lack is not that of the same specimens as its neighbours': so the
#' mean is taken again with the points put in, and they from it, until they stand still.
#'
#' @param tolerance Greatest move of an estimated co-ordinate between two rounds, as a share of its
#'   specimen's centroid size (1e-6: about a thousandth of a millimetre on a face).
#' @param rounds Most rounds.
#' @noRd
estimated <- function(given, gap, tolerance = 1e-6, rounds = 50) {
  given$reference <- if (is.null(given$reference) || anyNA(given$reference)) NULL else
    given$reference
  mean <- mean_with_gaps(given$coords, gap)
  before <- given$coords
  for (round in seq_len(rounds)) {
    given$coords <- with_spline_places(given$coords, mean, gap)
    moved <- max(abs(given$coords - before)[rep_gap(gap, dim(before)[2])])
    share <- moved / sqrt(sum(mean^2))
    if (!is.na(share) && share <= tolerance) break
    before <- given$coords
    fit <- fit_alignment(list(coords = before, reference = mean), rep(1, nrow(mean)), 1L, tolerance,
                         rounds)
    mean <- fit$mean * mean(fit$size)
  }
  if (is.na(share) || share > tolerance) {
    crestline_warn(sprintf("after %d rounds estimated points still move, by %.2g of the size.",
                           rounds, share),
                   "Leave out specimens that lack many points, or give `missing = \"drop\"`.",
                   stage = "align", class = "crestline_not_converged")
  }
  if (is.null(given$reference)) given$reference <- mean
  given
}

rep_gap <- function(gap, dim) aperm(array(gap, c(dim(gap), dim)), c(1, 3, 2))

with_spline_places <- function(coords, mean, gap) {
  for (i in which(colSums(gap) > 0)) {
    own <- unnamed_slice(coords, i)
    own[gap[, i], ] <- spline_places(mean, own, gap[, i], colnames(gap)[i])
    coords[, , i] <- own
  }
  coords
}

#' Procrustes mean of the points that are there; flat configurations are laid into space
#' @noRd
mean_with_gaps <- function(coords, gap) {
  flat <- dim(coords)[2] == 2
  each <- lapply(seq_len(dim(coords)[3]), function(i) {
    own <- unnamed_slice(coords, i)
    own[gap[, i], ] <- NA
    if (flat) cbind(own, ifelse(gap[, i], NA, 0)) else own
  })
  mean <- procrustes_mean(each, each[[which.min(colSums(gap))]])
  if (flat) mean[, 1:2] else mean
}

#' The interpolating thin-plate spline from one configuration onto the known points of another
#'
#' Kernel r in space and r^2 log r in the plane. The template is brought to unit size: no answer
#' depends on the unit.
#'
#' @param template k x d, complete.
#' @param own k x d.
#' @param gap Logical, k: which points to place.
#' @param rank Points whose least extent is below this share of the greatest lie in a plane (in the
#'   plane: on a line).
#' @return Matrix, a row a TRUE of `gap`.
#' @noRd
spline_places <- function(template, own, gap, id, rank = 1e-6) {
  template <- template / sqrt(sum(sweep(template, 2, colMeans(template))^2))
  known <- which(!gap)
  known <- known[!duplicated(template[known, , drop = FALSE])]
  from <- template[known, , drop = FALSE]
  at <- template[gap, , drop = FALSE]
  distance <- function(a) sqrt(pmax(
    outer(rowSums(a^2), rowSums(from^2), `+`) - 2 * tcrossprod(a, from), 0
  ))
  kernel <- if (ncol(template) == 3) function(r) -r else function(r) ifelse(r > 0, r^2 * log(r), 0)
  affine <- cbind(1, from)
  system <- rbind(cbind(kernel(distance(from)), affine),
                  cbind(t(affine), matrix(0, ncol(affine), ncol(affine))))
  diag(system)[seq_along(known)] <- 0
  right <- rbind(own[known, , drop = FALSE], matrix(0, ncol(affine), ncol(template)))
  spread <- svd(sweep(from, 2, colMeans(from)), 0, 0)$d
  if (min(spread) < rank * max(spread)) {
    crestline_abort("the points that are there lie in a plane: the others cannot be placed.",
                    "Leave this specimen out, or use missing = \"drop\".", stage = "align", id = id)
  }
  weight <- solve(system, right, tol = 0)
  cbind(kernel(distance(at)), 1, at) %*% weight
}
