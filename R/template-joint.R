# The joint step: points of curves and patches slid together over the mesh, in one energy, curve
# points drawn to the curves that were measured.

#' Whether curve points leave their curves
#' @noRd
slides_free <- function(settings) settings$curves == "free"

#' The energy of the places that a specimen has, its landmarks as sure as they came
#'
#' @param places Their names.
#' @param nugget Of its landmarks, by name.
#' @return Matrix with a row a place.
#' @noRd
joint_energy <- function(places, nugget, plan) {
  all <- rownames(plan$xyz)[!is.na(plan$xyz[, 1])]
  whole <- kept(plan, "joint", function() {
    settings <- plan$settings
    nugget <- ifelse(rownames(plan$xyz) %in% landmark_keys(plan$scheme), settings$placed_nugget,
                     settings$joint_nugget)
    kernel <- function(r) {
      r <- r / plan$radius
      near <- sqrt(3) * r / settings$range
      (1 + near) * exp(-near) - settings$rough * r
    }
    b <- energy_matrix(plan$xyz, nugget, settings$rank, kernel)
    attr(b, "affine") <- NULL
    b
  })[match(all, rownames(plan$xyz)), match(all, rownames(plan$xyz))]
  b <- energy_without(whole, match(places, all))
  more <- nugget[intersect(places, names(nugget))] - plan$settings$placed_nugget
  energy_loosened(b, match(names(more), places)[more != 0], more[more != 0])
}

#' The energy of some points, the others left out: least over all places of these
#' @param keep Rows that stay, in their order.
#' @noRd
energy_without <- function(b, keep) {
  gone <- setdiff(seq_len(nrow(b)), keep)
  own <- b[keep, keep]
  if (!length(gone)) return(own)
  across <- b[gone, keep, drop = FALSE]
  own <- own - crossprod(across, solve(b[gone, gone], across))
  (own + t(own)) / 2
}

#' The energy with more of a nugget on some points
#' @param rows,more The points, and by how much; other than 0.
#' @noRd
energy_loosened <- function(b, rows, more) {
  if (!length(rows)) return(b)
  own <- b[, rows, drop = FALSE]
  b <- b - own %*% solve(diag(1 / more, length(more)) + b[rows, rows], t(own))
  (b + t(b)) / 2
}

#' Nuggets of a shape's landmarks by how they came: placed, found, predicted or found with little
#' confidence
#' @noRd
landmark_nuggets <- function(shape, settings) {
  names <- shape$scheme$landmarks$landmark
  nugget <- stats::setNames(rep(settings$placed_nugget, length(names)), names)
  placing <- shape$placing
  if (!is.null(placing)) {
    at <- function(state) intersect(names, placing$landmark[placing$state %in% state])
    nugget[at("found")] <- settings$found_nugget
    nugget[c(at("predicted"), intersect(names, placing_doubt(placing)$names))] <-
      settings$doubtful_nugget
  }
  stats::setNames(nugget, landmark_keys(shape$scheme))
}

#' Where a shape's points begin: the places of the mesh that are closest to the warp by landmarks
#'
#' @param store As of [cut_between_slid()]. Points that the template lacks stay as they are there.
#' @return List: `store`; `image` (of the warp, before it was put on the mesh); `places` (those of
#'   the energy), `free` (those of them that slide); `energy` (of the start, a place and direction;
#'   unit of the mesh, squared).
#' @noRd
joint_start <- function(shape, store, plan, specimen) {
  there <- rownames(store)[!is.na(store[, "x"]) & !is.na(plan$xyz[rownames(store), 1])]
  given <- as.character(shape$provenance$settings$fit$given)
  points <- shape$scheme$points
  cut <- with(shape$scheme$curves, curve[!is.na(cut_share) & plan$settings$cut_ends == "stay"])
  on_curve <- points$level == "curves"
  held <- c(landmark_keys(plan$scheme),
            points$place[on_curve & (points$part %in% given |
                                     points$part %in% cut & points$point == "1")])
  free <- setdiff(there, held)
  image <- landmark_warp(
    plan$xyz[there, , drop = FALSE], store[there, c("x", "y", "z"), drop = FALSE],
    intersect(landmark_keys(plan$scheme), there), plan$settings$rank
  )
  store[free, mesh_columns] <- columns_of(surface_points(
    specimen$mesh, image[free, , drop = FALSE]
  ))
  x <- store[there, c("x", "y", "z"), drop = FALSE]
  energy <- quadratic_form(joint_energy(there, landmark_nuggets(shape, plan$settings), plan), x)
  list(store = store, image = image, places = there, free = free,
       energy = energy / (3 * max(length(there) - 4, 1)))
}

#' The scale of the energy in a sample: the mean over its shapes' starts, as in a variance
#'
#' @param own_mean Whether the template is the mean of these shapes: then one of them is no witness.
#' @noRd
energy_scale <- function(starts, own_mean = FALSE) {
  n <- length(starts)
  sum(vapply(starts, `[[`, 0, "energy")) / max(n - own_mean, 1)
}

#' Slide all free points together
#'
#' @param cut As of [cut_between_slid()]: its points are the anchors.
#' @param start As of [joint_start()].
#' @return List: `store`, `sliding`, `trace` as of [slide_surface()]; `offset` (by place, signed, of
#'   curve points from their own curve).
#' @noRd
slide_joint <- function(shape, cut, start, plan, specimen) {
  settings <- plan$settings
  if (!length(start$free)) return(list(store = cut$store, offset = numeric()))
  across <- across_directions(shape, cut$store, specimen)
  error <- curve_errors(shape, cut$store, settings)[start$free]
  error[is.na(across[start$free, 1])] <- NA
  drawn <- !is.na(error)
  rows <- cbind(match(start$free, start$places), wanted_steps(shape, start),
                cut$store[start$free, c("x", "y", "z")], across[start$free, ], error)
  rows[!drawn, 10:15] <- 0
  surface <- walkable(specimen)
  chosen <- list(scale = settings$pull * plan$scale, reach = settings$reach,
                 relaxation = settings$relaxation, gap = settings$gap,
                 tolerance = settings$joint_tolerance * plan$radius, halvings = settings$halvings,
                 sweeps = settings$joint_sweeps)
  slid <- cpp_slide_jointly(
    surface$vb, surface$it, surface$twin,
    joint_energy(start$places, landmark_nuggets(shape, settings), plan),
    start$store[start$places, c("x", "y", "z"), drop = FALSE], rows,
    start$store[start$free, c("face", "w1", "w2", "w3"), drop = FALSE], chosen
  )
  store <- cut$store
  store[start$free, mesh_columns] <- slid$points
  moved <- store[, c("x", "y", "z")] - cut$store[, c("x", "y", "z")]
  offset <- rowSums(moved * across)
  trace <- list(joint = c(slid$trace, points = length(start$free)))
  list(store = store, trace = lapply(trace, trace_table), offset = offset[!is.na(offset)],
       sliding = sliding_table(trace, "joint", c(joint = max(row_lengths(moved), na.rm = TRUE))))
}

#' Unit vectors of the surface, square to the curve of every curve point, to its left as seen from
#' outside; NA for other places and landmarks
#' @noRd
across_directions <- function(shape, store, specimen) {
  across <- matrix(NA_real_, nrow(store), 3, dimnames = list(rownames(store), NULL))
  normals <- vertex_normals(specimen$mesh)
  by_curve <- rev(places_by_curve(shape$scheme))
  closed <- with(shape$scheme$curves, curve[closed_curves(shape$scheme$curves)])
  for (curve in names(by_curve)) {
    place <- by_curve[[curve]]
    place <- place[!is.na(store[place, "x"])]
    n <- length(place)
    if (n < 3) next
    x <- store[place, c("x", "y", "z")]
    beyond <- if (curve %in% closed) c(1, n) else c(n, 1)
    along <- x[c(2:n, beyond[1]), ] - x[c(beyond[2], 1:(n - 1)), ]
    corners <- specimen$mesh$it[, store[place, "face"]]
    weights <- t(store[place, c("w1", "w2", "w3")])
    normal <- t(vapply(seq_len(n), function(i) normals[1:3, corners[, i]] %*% weights[, i],
                       numeric(3)))
    side <- cross_rows(normal, along)
    across[place, ] <- side / row_lengths(side)
  }
  across[landmark_keys(shape$scheme), ] <- NA
  replace(across, !is.finite(across), NA)
}

#' Places of every curve with points between its ends, in order
#' @noRd
places_by_curve <- function(scheme) {
  curves <- scheme$curves$curve[scheme$curves$n > 2]
  own <- scheme$points[scheme$points$level == "curves", ]
  split(own$place, factor(own$part, curves))
}

#' Standard errors of the points of ridges and valleys as homologous lines, by place; NA where there
#' is none
#'
#' A point without a standard error has the largest of its face.
#' @noRd
curve_errors <- function(shape, store, settings) {
  error <- stats::setNames(rep(NA_real_, nrow(store)), rownames(store))
  largest <- suppressWarnings(max(store[, "se"], na.rm = TRUE))
  curves <- shape$scheme$curves
  for (i in rev(which(curves$kind != "plane" & curves$n > 2))) {
    place <- places_by_curve(shape$scheme)[[curves$curve[i]]]
    own <- store[place, "se"]
    own[is.na(own)] <- max(largest, 0)
    error[place] <- sqrt(own^2 + (settings$floor * curves$radius[i])^2)
  }
  if (any(error == 0, na.rm = TRUE)) {
    crestline_abort("its ridges have no standard errors, and `floor` is 0.",
                    "Measure it with ridge_settings(error = TRUE), or give a `floor` above 0.",
                    stage = "slide", id = shape$id, call = NULL)
  }
  error
}

#' Neighbours of the free points on their curves, and the steps from and to them that are wanted:
#' those of the warp's image
#' @return Matrix with a row a free point: rows of the neighbours among the places (0: none), steps
#'   over their squared lengths.
#' @noRd
wanted_steps <- function(shape, start) {
  rows <- matrix(0, length(start$free), 8)
  by_curve <- rev(places_by_curve(shape$scheme))
  closed <- with(shape$scheme$curves, curve[closed_curves(shape$scheme$curves)])
  for (curve in names(by_curve)) {
    place <- by_curve[[curve]]
    place <- place[place %in% start$places]
    n <- length(place)
    if (n < 2) next
    round <- curve %in% closed
    image <- start$image[if (round) place[c(seq_len(n), 1)] else place, ]
    step <- diff(image)
    step <- step / pmax(rowSums(step^2), .Machine$double.xmin)
    at <- match(place, start$places)
    mine <- match(place, start$free)
    ends <- if (round) at[c(n, 1)] else c(0, 0)
    seam <- if (round) step[n, ] else 0
    inner <- step[seq_len(n - 1), , drop = FALSE]
    own <- cbind(c(ends[1], at[-n]), c(at[-1], ends[2]), rbind(seam, inner), rbind(inner, seam))
    rows[mine[!is.na(mine)], ] <- own[!is.na(mine), ]
  }
  rows
}
