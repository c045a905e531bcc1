# Curves given in (s, d) about a path, walked through the triangles of the mesh.

#' A line about an open path walked from triangle to triangle, or a failure
#'
#' @param scan As of [walkable()].
#' @param coordinates,path,s,alpha As in [lift()].
#' @noRd
walked_line <- function(scan, coordinates, path, s, alpha) {
  at <- columns_of(path)
  ends <- path_ends(scan, at[c(1, nrow(at)), ], c(end_name(at[1, ]), end_name(at[nrow(at), ])))
  if (failed(ends)) return(ends)
  # d - alpha(s) at the vertices of the window, shifted to vanish at both ends
  offset <- stats::splinefun(s, alpha, method = "natural")
  own <- coordinates$d - offset(coordinates$s)
  first <- match(scan$it[, ends$from[1]], coordinates$vertex)
  last <- match(scan$it[, ends$to[1]], coordinates$vertex)
  share <- pmin(pmax(coordinates$s / max(s), 0), 1)
  share[first] <- 0
  share[last] <- 1
  level <- own - (1 - share) * sum(ends$from[2:4] * own[first]) -
    share * sum(ends$to[2:4] * own[last])
  # Direction in which the curve leaves the first point: along the path and, by the slope, across
  # it
  start <- lapply(unclass(path)[mesh_columns], `[`, 1)
  tangent <- columns_of(without_stubs(path), c("x", "y", "z"))[2, ] - at[1, 1:3]
  tangent <- tangent / sqrt(sum(tangent^2))
  across <- cross_product(path_normals(scan, start)[, 1], tangent)
  towards <- tangent + ((alpha[2] - alpha[1]) / (s[2] - s[1])) * across / sqrt(sum(across^2))
  walked <- cpp_level_path(scan$vb, scan$it, scan$twin, ends$from[1], ends$to[1],
                           coordinates$vertex, level, towards)
  if (walked$end != "arrived") return(not_walked(walked$end))
  path_through(rbind(ends$exact[1, ], walked$points, ends$exact[2, ]), scan, lifted = TRUE)
}

not_walked <- function(end) {
  no_result(sprintf("the line cannot be walked over the mesh (it ends: %s).", end),
            "Give a smaller `width`, or use the plane cut.", "lift", class = "crestline_path_error")
}

#' A line about a closed path walked once round, or a failure
#'
#' @param tries Where along the path walks begin, as shares of its length: the next where one before
#'   met a fold.
#' @param least Length of a walk that has come round, as a share of the path's.
#' @noRd
walked_loop <- function(scan, coordinates, s, alpha, tries = c(0, 0.31, 0.62, 0.9), least = 0.9) {
  length <- attr(coordinates, "length")
  offset <- stats::splinefun(s, alpha, method = "periodic")
  level <- along <- rep(NaN, ncol(scan$vb))
  level[coordinates$vertex] <- coordinates$d - offset(coordinates$s)
  along[coordinates$vertex] <- coordinates$s
  # Faces in which a level at the vertices changes its sign
  known <- matrix(!is.nan(level)[scan$it], 3)
  faces <- which(known[1, ] & known[2, ] & known[3, ])
  positive <- colSums(matrix(level[scan$it[, faces]] >= 0, 3))
  crossed <- faces[positive %in% 1:2]
  if (!length(crossed)) return(not_walked("nowhere near the path"))
  corners <- scan$it[, crossed, drop = FALSE]
  off <- matrix(abs(level[corners]), 3)
  for (at in tries * length) {
    away <- abs((matrix(along[corners], 3) - at + length / 2) %% length - length / 2)
    first <- which.min(colMeans(away) + colMeans(off))
    row <- match(corners[1, first], coordinates$vertex)
    tangent <- unlist(unclass(coordinates)[c("tx", "ty", "tz")], use.names = FALSE)
    tangent <- tangent[row + c(0, 1, 2) * nrow(coordinates)]
    # No face is number 0: the walk ends where it began.
    walked <- cpp_level_path(scan$vb, scan$it, scan$twin, crossed[first], 0, seq_along(level),
                             level, tangent)
    if (walked$end != "round") next
    path <- closed_path(walked$points, scan, lifted = TRUE)
    if (attr(path, "length") > least * length) return(path)
  }
  not_walked(walked$end)
}
