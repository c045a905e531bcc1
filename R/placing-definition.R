# The place that a landmark's definition says: one row of a scheme's table `definitions`.

#' Peak of a field as a place
#' @noRd
peak_near <- function(field, definition, start, settings) {
  radius <- definition$radius
  peak <- if (nrow(field$at) > 0) {
    strongest_peak(field, start, definition$reach, settings$apart * radius,
                   settings$window * radius,
                   settings$faint / radius)
  }
  if (is.null(peak)) list(reason = "nothing near") else peak
}

#' Strongest cap or cup: the greatest of the lesser curvature, both having its sign
#' @noRd
place_of_summit <- function(specimen, definition, start, pairs, curvature, settings) {
  near <- near_vertices(specimen$mesh, start, definition$reach + definition$radius)
  curved <- curvature(definition$radius)(near)
  value <- if (definition$kind == "cap") -curved$k1 else curved$k2
  peak_near(field_at(t(specimen$mesh$vb[1:3, near, drop = FALSE]), value, 2, curved$normal),
            definition, start, settings)
}

field_at <- function(at, value, dimensions, normal = NULL) {
  known <- is.finite(value)
  list(at = at[known, , drop = FALSE], value = value[known], dimensions = dimensions,
       normal = if (!is.null(normal)) normal[known, , drop = FALSE])
}

#' Vertices within a distance of a place, joined over edges to those nearest to it
#' @noRd
near_vertices <- function(mesh, place, distance) {
  box <- cpp_vertices_in_box(mesh$vb, place - distance, place + distance)
  gap <- sqrt(colSums((mesh$vb[1:3, box, drop = FALSE] - place)^2))
  member <- logical(ncol(mesh$vb))
  member[box[gap <= distance]] <- TRUE
  which(cpp_joined_to(mesh$it, member, box[which.min(gap)]))
}

#' Extreme of the curvature of a profile: of the cut of a plane with the surface
#' @noRd
place_of_profile <- function(specimen, definition, start, pairs, curvature, settings) {
  mesh <- specimen$mesh
  plane <- definition_plane(specimen, definition, pairs)
  foot <- start - sum((start - plane$origin) * plane$normal) * plane$normal
  near <- near_vertices(mesh, start, definition$reach + definition$radius)
  # Where a plane cuts the edges between some vertices
  inside <- logical(ncol(mesh$vb))
  inside[near] <- TRUE
  faces <- which(colSums(matrix(inside[mesh$it], 3)) == 3)
  it <- mesh$it[, faces, drop = FALSE]
  edges <- rbind(t(it[1:2, , drop = FALSE]), t(it[2:3, , drop = FALSE]),
                 t(it[c(3, 1), , drop = FALSE]))
  edges <- unique(cbind(pmin(edges[, 1], edges[, 2]), pmax(edges[, 1], edges[, 2])))
  height <- numeric(ncol(mesh$vb))
  height[near] <- drop(crossprod(mesh$vb[1:3, near, drop = FALSE] - plane$origin, plane$normal))
  edges <- edges[(height[edges[, 1]] > 0) != (height[edges[, 2]] > 0), , drop = FALSE]
  share <- height[edges[, 1]] / (height[edges[, 1]] - height[edges[, 2]])
  from <- t(mesh$vb[1:3, edges[, 1], drop = FALSE])
  at <- from + share * (t(mesh$vb[1:3, edges[, 2], drop = FALSE]) - from)
  section <- data.frame(a = edges[, 1], b = edges[, 2], share = share, x = at[, 1], y = at[, 2],
                        z = at[, 3])
  if (!nrow(section)) return(list(reason = "nothing near"))
  bent <- curvature(definition$radius)
  along <- function(vertex) {
    curved <- bent(vertex)
    across <- matrix(plane$normal, length(vertex), 3, byrow = TRUE)
    normal_curvature(curved, seq_along(vertex), cross_rows(curved$normal, across))
  }
  value <- (1 - section$share) * along(section$a) + section$share * along(section$b)
  if (definition$bend == "out") value <- -value
  peak_near(field_at(as.matrix(section[c("x", "y", "z")]), value, 1), definition, foot, settings)
}

#' The plane of a profile: the mirror of pairs of landmarks, or that straight into the surface
#' through two landmarks
#' @return List `origin`, `normal`.
#' @noRd
definition_plane <- function(specimen, definition, pairs) {
  if (!is.na(definition$mirror)) {
    left <- mirror_names(definition$mirror)
    right <- pairs$right[match(left, pairs$left)]
    # The mirror that takes points nearest to their partners
    left <- specimen$landmarks[left, , drop = FALSE]
    right <- specimen$landmarks[right, , drop = FALSE]
    return(list(origin = colMeans((left + right) / 2), normal = main_direction(left - right)))
  }
  ends <- in_context(
    located_ends(specimen, walkable(specimen), definition$across_from, definition$across_to),
    specimen$id
  )
  list(origin = unname(ends$exact[1, 1:3]), normal = ends$across)
}

#' The curve that a definition is taken on, as a path
#' @noRd
definition_path <- function(specimen, definition, from, to, type, curvature, settings) {
  job <- curve_job(located_ends(specimen, walkable(specimen), from, to), type, 2, settings$ridge,
                   definition$radius, definition$width,
                   source = if (type != "plane") curvature(definition$radius))
  doing <- sprintf("%s from %s to %s", type, end_name(from), end_name(to))
  in_context(trace_curve(job), specimen$id, doing)$path
}

#' Crossing of a curve with a mirror plane or another curve: that nearest to the landmark
#' @noRd
place_of_crossing <- function(specimen, definition, start, pairs, curvature, settings) {
  path <- definition_path(
    specimen, definition, definition$from, definition$to, definition$type, curvature, settings
  )
  at <- columns_of(path, c("x", "y", "z"))
  side <- if (!is.na(definition$mirror)) {
    plane <- definition_plane(specimen, definition, pairs)
    drop((at - rep(plane$origin, each = nrow(at))) %*% plane$normal)
  } else {
    other <- without_stubs(definition_path(
      specimen, definition, definition$across_from, definition$across_to, definition$across_type,
      curvature, settings
    ))
    cpp_path_coordinates(t(at), t(columns_of(other, c("x", "y", "z"))),
                         path_normals(specimen$mesh, other))$d
  }
  before <- which(side[-1] * side[-length(side)] <= 0 & side[-1] != side[-length(side)])
  share <- side[before] / (side[before] - side[before + 1])
  place <- at[before, ,
              drop = FALSE] + share * (at[before + 1, , drop = FALSE] - at[before, , drop = FALSE])
  gap <- row_lengths(place - rep(start, each = nrow(place)))
  if (!any(gap <= definition$reach)) return(list(reason = "nothing near"))
  list(at = place[which.min(gap), ], value = NA_real_)
}

#' Extreme of the geodesic curvature along a curve
#' @noRd
place_of_turn <- function(specimen, definition, start, pairs, curvature, settings) {
  path <- definition_path(specimen, definition, definition$from, definition$to, definition$type,
                          curvature, settings)
  turning <- path_turning(specimen$mesh, path, definition$radius)
  value <- if (definition$bend == "left") turning$value else -turning$value
  peak_near(field_at(turning$at, value, 1), definition, start, settings)
}

#' Geodesic curvature of a path, positive where it turns to the left seen from outside
#'
#' A parabola in the tangent plane is fitted to the path within a radius, weights falling smoothly
#' to 0.
#'
#' @param spacing Distance of the points, as a share of the radius.
#' @return List `at` (n x 3), `value` (n; NA within half a radius of the ends, where a parabola is
#'   not held).
#' @noRd
path_turning <- function(mesh, path, radius, spacing = 0.1) {
  n <- max(ceiling(attr(path, "length") / (spacing * radius)), 2)
  s <- attr(path, "length") * (0:n) / n
  at <- points_along(path, s)
  clear <- without_stubs(path)
  normals <- path_normals(mesh, clear)
  normal <- vapply(1:3, function(k) stats::approx(clear$s, normals[k, ], s, rule = 2)$y, s)
  tangent <- at[c(2:(n + 1), n + 1), ] - at[c(1, 1:n), ]
  left <- cross_rows(normal, tangent)
  left <- left / row_lengths(left)
  forward <- cross_rows(left, normal / row_lengths(normal))
  value <- vapply(seq_along(s), function(i) {
    if (min(s[i], attr(path, "length") - s[i]) < radius / 2) return(NA_real_)
    weight <- pmax(1 - ((s - s[i]) / radius)^2, 0)^2
    apart <- at - rep(at[i, ], each = n + 1)
    along <- drop(apart %*% forward[i, ])
    fit <- stats::lm.wfit(cbind(1, along, along^2), drop(apart %*% left[i, ]), weight)$coefficients
    unname(2 * fit[3] / (1 + fit[2]^2)^1.5)
  }, 0)
  list(at = at, value = value)
}

#' End of a ridge or valley that comes from another landmark: where its strength has fallen to a
#' share of its greatest
#' @noRd
place_of_end <- function(specimen, definition, start, pairs, curvature, settings, spacing = 0.1) {
  # A place on the surface beyond a landmark, as far as the definition reaches, straight on from
  # where its curve begins
  from <- specimen$landmarks[definition$from, ]
  onward <- unit_vector(start - from)
  beyond <- surface_points(specimen$mesh, matrix(start + definition$reach * onward, 1))
  path <- definition_path(
    specimen, definition, definition$from, beyond, definition$type, curvature, settings
  )
  # Strength along a path, smoothed as local fits are
  curved <- curvature(definition$radius)
  corner <- specimen$mesh$it[, path$face]
  strength <- matrix(strength_at(curved(as.vector(corner)), definition$type), 3)
  raw <- colSums(rbind(path$w1, path$w2, path$w3) * strength)
  s <- seq(0, attr(path, "length"), by = spacing * definition$radius)
  value <- vapply(s, function(at) {
    weight <- pmax(1 - ((path$s - at) / (settings$window * definition$radius))^2, 0)^2
    if (sum(weight) > 0) sum(weight * raw) / sum(weight) else stats::approx(path$s, raw, at)$y
  }, 0)
  fading <- list(s = s, value = value)
  most <- which.max(fading$value)
  level <- settings$share * fading$value[most]
  fallen <- which(fading$value <= level & seq_along(fading$s) > most)
  if (level * definition$radius < settings$share * settings$faint ||
      !length(fallen)) return(list(reason = "nothing near"))
  i <- fallen[1]
  share <- (fading$value[i - 1] - level) / (fading$value[i - 1] - fading$value[i])
  at <- drop(points_along(path, fading$s[i - 1] + share * (fading$s[i] - fading$s[i - 1])))
  if (sqrt(sum((at - start)^2)) > definition$reach) return(list(reason = "nothing near"))
  list(at = at, value = level)
}
