# Reference paths of least cost: along a crest that bows away from every plane through its ends, and
# once round on a closed one.

#' A path of least cost along a feature, or a failure
#'
#' The cost of a unit of length is f / (f + rho), with f = `search$floor` and rho the radius times
#' the strength: 1 off the feature.
#' @param ends As of [path_ends()]; a failure is handed on.
#' @param type,strength,radius,search As in [find_reference()].
#' @return A `mesh_path` with `type`, `criterion` (its mean strength), `competing` (its cost as a
#'   share of that of the best other path).
#' @noRd
find_crest <- function(ends, type, strength, radius, search) {
  if (failed(ends)) return(ends)
  scan <- ends$scan
  at_vertices <- strength(seq_len(ncol(scan$vb)))
  cost <- search$floor / (search$floor + radius * at_vertices)
  stops <- rbind(ends$exact[1, ], ends$via, ends$exact[2, ])
  arcs <- crest_arcs(scan, stops, cost, radius, search, ends)
  if (failed(arcs)) return(arcs)
  path <- if (ends$closed) loop_through(scan, arcs, cost, radius, search, stops) else
    crest_through(scan, arcs, cost, radius, search)
  corner <- matrix(at_vertices[scan$it[, path$face]], 3)
  mean_of <- colSums(rbind(path$w1, path$w2, path$w3) * corner)
  middle <- (mean_of[-1] + mean_of[-length(mean_of)]) / 2
  attr(path, "type") <- type
  attr(path, "criterion") <- stats::weighted.mean(middle, diff(path$s))
  attr(path, "competing") <- competing_cost(scan, arcs, cost, radius, search, ends)
  path
}

#' The way of least cost between two places
#'
#' @param angle As in the kernel: numeric by vertex, or of no length.
#' @return List: `places` (k x 7 matrix), `cost`; NULL where there is no way.
#' @noRd
least_cost <- function(scan, from, to, cost, angle = numeric(), round = FALSE) {
  found <- cpp_crest_path(scan$vb, scan$it, scan$twin, from[4:7], to[4:7], cost, angle, round)
  if (!found$arrived) return(NULL)
  colnames(found$places) <- mesh_columns
  found[c("places", "cost")]
}

#' Ways of least cost from stop to stop; those of a closed curve keep off the ones before, lest they
#' run back over them
#'
#' @param stops k x 7 matrix.
#' @return List: `each` (list of matrices), `cost` of all; or a failure.
#' @noRd
crest_arcs <- function(scan, stops, cost, radius, search, ends) {
  each <- list()
  total <- 0
  for (i in seq_len(nrow(stops) - 1)) {
    arc <- least_cost(scan, stops[i, ], stops[i + 1, ], cost)
    if (is.null(arc)) {
      return(no_result(
        sprintf("no way over the mesh leads from %s to %s by its stops.", ends$names[1],
                ends$names[2]),
        "Check that the landmarks and `via` lie on one piece of the mesh.", "reference path",
        scan$id, "crestline_path_error"
      ))
    }
    each[[i]] <- arc$places
    total <- total + arc$cost
    if (ends$closed) {
      cost <- dearer_beside(scan, cost, list(arc$places), search$block, radius, search)
    }
  }
  list(each = each, cost = total)
}

#' Costs that are raised beside paths, but for their ends
#'
#' @param reach Greatest distance from a path, in radii.
#' @noRd
dearer_beside <- function(scan, cost, paths, reach, radius, search) {
  for (places in paths) {
    s <- c(0, cumsum(row_lengths(diff(places[, 1:3]))))
    free <- search$block_free * radius
    inner <- places[s > free & s < s[length(s)] - free, 1:3, drop = FALSE]
    if (!nrow(inner)) next
    box <- apply(inner, 2, range) + c(-1, 1) * reach * radius
    near <- cpp_vertices_in_box(scan$vb, box[1, ], box[2, ])
    vertex <- t(scan$vb[1:3, near, drop = FALSE])
    off <- Rvcg::vcgKDtree(inner, vertex, k = 1)$distance
    # The greatest cost is 1, off every feature.
    cost[near[off <= reach * radius]] <- search$block_cost
  }
  cost
}

#' Cost of a path as a share of that of the best other one: near 1 where another is as good
#' @noRd
competing_cost <- function(scan, arcs, cost, radius, search, ends) {
  other <- dearer_beside(scan, cost, arcs$each, search$rival_reach, radius, search)
  stops <- rbind(ends$exact[1, ], ends$via, ends$exact[2, ])
  rival <- crest_arcs(scan, stops, other, radius, search, ends)
  if (failed(rival) || !(rival$cost > 0)) NA_real_ else min(1, arcs$cost / rival$cost)
}

#' Ways put one behind the other, k x 7
#' @noRd
joined_arcs <- function(arcs) {
  do.call(rbind, c(arcs$each[1], lapply(arcs$each[-1], function(x) x[-1, , drop = FALSE])))
}

#' The smooth open path of some ways; stops on the way have a say only in where it runs, within a
#' corridor about it
#' @noRd
crest_through <- function(scan, arcs, cost, radius, search) {
  rough <- joined_arcs(arcs)
  path <- smooth_path(scan, rough, radius, search)
  if (length(arcs$each) == 1) return(path)
  window <- near_path(scan, path, search$corridor * radius, 0)
  angle <- replace(rep(NaN, ncol(scan$vb)), window$vertex, 0)
  relaxed <- least_cost(scan, rough[1, ], rough[nrow(rough), ], cost, angle)
  if (is.null(relaxed)) path else smooth_path(scan, relaxed$places, radius, search)
}

#' The smooth loop of some ways, in which their stops have no say
#'
#' Its way of least cost once round a corridor about it begins at its cheapest place. The result
#' begins at the place that is nearest to the first stop, and runs by the order of the stops; with
#' two of them anticlockwise as seen from outside.
#' @noRd
loop_through <- function(scan, arcs, cost, radius, search, stops) {
  rough <- joined_arcs(arcs)[-1, , drop = FALSE]
  loop <- loop_places(smooth_loop(scan, rough, radius, search, search$corridor))
  own <- rowSums(loop[, 5:7] * t(matrix(cost[scan$it[, loop[, 4]]], 3)))
  first <- which.min(own)
  loop <- loop[c(first:nrow(loop), seq_len(first - 1)), ]
  window <- near_path(scan, closed_path(loop, scan), search$corridor * radius, 0)
  angle <- rep(NaN, ncol(scan$vb))
  angle[window$vertex] <- 2 * pi * window$s / attr(window, "length")
  relaxed <- least_cost(scan, loop[1, ], loop[1, ], cost, angle, TRUE)
  if (!is.null(relaxed)) rough <- relaxed$places[-1, , drop = FALSE]
  path <- smooth_loop(scan, rough, radius, search)
  path <- begun_at(scan, path, nearest_along(path, stops[1, 1:3]))
  if (nrow(stops) > 3 || seen_turn(scan, path) >= 0) return(path)
  reversed_loop(scan, path)
}

#' What is wrong with a path of least cost, NA where nothing
#'
#' @param path The curve.
#' @noRd
crest_fault <- function(path, ends, radius, search) {
  twice <- share_twice(path, search$twice_reach * radius, search$twice_apart * radius)
  length <- attr(path, "length")
  if (twice > search$twice) {
    return(sprintf(paste("%.0f %% of it run twice over: give a landmark or `via` on the other",
                         "side"), 100 * twice))
  }
  if (!is_closed(path)) return(NA_character_)
  if (length < search$loop_shortest * radius) {
    return(sprintf("it closed in on itself: its length, %.3g, is below %g radii", length,
                   search$loop_shortest))
  }
  span <- max(stats::dist(rbind(ends$exact[1, 1:3], ends$via[, 1:3])))
  if (length <= search$loop_longest * span) return(NA_character_)
  sprintf(paste("it is %.2g times as long as its stops are apart, more than %g: it may have gone",
                "elsewhere"), length / span, search$loop_longest)
}

#' The route that a call asks for
#'
#' @param path,via As in [reference_path()].
#' @return List: `path`, "plane" or "crest"; `via`, a list of places, NULL where there is none.
#' @noRd
check_route <- function(path, via, type) {
  path <- check_choice(path, c("plane", "crest"), "path")
  via <- listed_places(via)
  if (!is.null(via)) path <- "crest"
  if (path == "crest" && type == "plane") {
    crestline_abort("a plane cut has no crest to follow.",
                    "Give `path` and `via` for a ridge or a valley.", stage = "arguments")
  }
  list(path = path, via = via)
}

#' Places on the way as a list of names and positions, NULL where there is none
#' @noRd
listed_places <- function(via) {
  if (is.null(via)) return(NULL)
  if (is.character(via)) via <- as.list(via)
  if (is.numeric(via) && is.null(dim(via))) via <- list(via)
  if (is.data.frame(via)) via <- lapply(seq_len(nrow(via)), function(i) via[i, ])
  if (is.matrix(via)) via <- unname(split(via, seq_len(nrow(via))))
  if (!is.list(via) || !length(via)) {
    refuse_argument("via", via, "Give names of landmarks, or positions.")
  }
  for (at in via) check_ends(via = at)
  via
}
