# Other ways to a ridge between two landmarks, as functions for ridge_study(): (specimen, radius,
# width, n) -> points k x 3. Sourced by tools/studies.R.

alternatives <- function() {
  ways <- list(crestline = crestline::ridge_settings(error = FALSE),
               "one pass" = crestline::ridge_settings("one pass", error = FALSE),
               "two passes" = twice,
               "paper's settings" = crestline::ridge_settings("paper", error = FALSE),
               "forced quadratic" = crestline::ridge_settings("one pass", order = "forced",
                                                              error = FALSE),
               "reference path" = by_reference, "shortest plane cut" = by_plane,
               geodesic = by_geodesic, "crest points joined" = by_crest_points)
  if (requireNamespace("princurve", quietly = TRUE)) ways$"principal curve" <- by_principal_curve
  ways
}

positions <- function(x) as.matrix(as.data.frame(x)[c("x", "y", "z")])

# Our own ridge with a whole second pass and no kernel.
twice <- function(specimen, radius, width, n) {
  settings <- crestline::ridge_settings("one pass", error = FALSE, passes = 2)
  positions(crestline::ridge_curve(specimen, "from", "to", "ridge", radius, width, n,
                                   settings = settings)$path)
}

# The cut that the ridge is sought beside, and no ridge.
by_reference <- function(specimen, radius, width, n) {
  cubic <- crestline::path_settings(order = "adaptive cubic")
  positions(crestline::reference_path(specimen, "from", "to", "ridge", radius, settings = cubic))
}

by_plane <- function(specimen, radius, width, n) {
  positions(crestline::reference_path(specimen, "from", "to", "plane"))
}

# --- The shortest path over the surface: steepest descent of the distance from the other landmark
# -------------------------

by_geodesic <- function(specimen, radius, width, n) {
  mesh <- specimen$mesh
  ends <- crestline:::surface_points(mesh, specimen$landmarks)
  distance <- as.vector(crestline:::geodesic_distances(mesh, ends[1, ]))
  down <- descent(t(mesh$vb[1:3, ]), t(mesh$it), distance, ends$face[2], specimen$landmarks["to", ],
                  ends$face[1])
  rbind(specimen$landmarks["from", ], down[nrow(down):1, ])
}

# Points of the steepest descent from a place in face `start` until face `goal`.
descent <- function(vertex, faces, value, start, at, goal, most = 2000) {
  line <- matrix(at, 1)
  face <- start
  for (step in seq_len(most)) {
    if (face == goal) return(line)
    corner <- faces[face, ]
    out <- way_out(vertex[corner, ], value[corner], at)
    if (is.null(out)) {
      move <- from_vertex(vertex, faces, value, corner[which.min(value[corner])])
    } else {
      edge <- corner[out$edge]
      beyond <- which(rowSums(faces == edge[1]) > 0 & rowSums(faces == edge[2]) > 0)
      beyond <- setdiff(beyond, face)
      back <- length(beyond) == 1 &&
        !is.null(way_out(vertex[faces[beyond, ], ], value[faces[beyond, ]], out$at))
      move <- if (back) list(at = out$at, face = beyond, through = out$at) else
        from_vertex(vertex, faces, value, edge[which.min(value[edge])])
      if (!back) move$through <- rbind(out$at, move$through)
    }
    line <- rbind(line, move$through)
    at <- move$at
    face <- move$face
    if (any(faces[face, ] %in% faces[goal, ][value[faces[goal, ]] == min(value)])) return(line)
  }
  stop("the descent does not arrive")
}

# Where a descent leaves a triangle: the point and its edge (two corners); NULL where it does not
# move.
way_out <- function(corners, value, at, least = 1e-9) {
  sides <- rbind(corners[2, ] - corners[1, ], corners[3, ] - corners[1, ])
  slope <- -drop(solve(tcrossprod(sides), value[-1] - value[1]))
  direction <- c(-sum(slope), slope)
  own <- solve(tcrossprod(sides), sides %*% (at - corners[1, ]))
  weight <- pmax(c(1 - sum(own), own), 0)
  falling <- which(direction < 0)
  reach <- weight[falling] / -direction[falling]
  first <- falling[which.min(reach)]
  if (min(reach) * sqrt(sum((direction %*% corners)^2)) < least) return(NULL)
  weight <- pmax(weight + min(reach) * direction, 0)
  weight[first] <- 0
  list(at = drop(weight %*% corners / sum(weight)), edge = setdiff(1:3, first))
}

# From a vertex down the steepest of its triangles or edges.
from_vertex <- function(vertex, faces, value, v) {
  around <- which(rowSums(faces == v) > 0)
  at <- vertex[v, ]
  ring <- setdiff(unique(as.vector(faces[around, ])), v)
  fall <- (value[v] - value[ring]) /
    sqrt(rowSums((vertex[ring, , drop = FALSE] - rep(at, each = length(ring)))^2))
  best <- list(fall = max(fall), at = vertex[ring[which.max(fall)], ])
  best$face <- which(rowSums(faces == ring[which.max(fall)]) > 0)[1]
  for (face in around) {
    out <- way_out(vertex[faces[face, ], ], value[faces[face, ]], at)
    if (is.null(out)) next
    edge <- faces[face, out$edge]
    if (v %in% edge) next
    share <- sqrt(sum((out$at - vertex[edge[1], ])^2) /
                  sum((vertex[edge[2], ] - vertex[edge[1], ])^2))
    fell <- (value[v] - ((1 - share) * value[edge[1]] + share * value[edge[2]])) /
      sqrt(sum((out$at - at)^2))
    if (fell > best$fall) {
      beyond <- setdiff(which(rowSums(faces == edge[1]) > 0 & rowSums(faces == edge[2]) > 0), face)
      if (length(beyond) == 1) best <- list(fall = fell, at = out$at, face = beyond)
    }
  }
  best$through <- rbind(at, best$at)
  best
}

# --- Vertices that are near the straight way, with their curvature
# ---------------------------------------------------------

window_of <- function(specimen, radius, width, window = 1.5) {
  path <- suppressWarnings(crestline::reference_path(specimen, "from", "to", "plane"),
                           classes = "crestline_warning")
  near <- crestline::path_coordinates(specimen, path, min(width, window * radius))
  vertex <- near$vertex[near$inside]
  list(vertex = vertex,
       curved = crestline::curvature(specimen, radius, order = "adaptive cubic", vertices = vertex))
}

# --- Crest points: where k2 is least along its own direction, between the ends of edges, joined to
# a path -------------------

by_crest_points <- function(specimen, radius, width, n) {
  near <- window_of(specimen, radius, width)
  points <- crest_points(specimen$mesh, near$curved)
  join_points(rbind(specimen$landmarks["from", ], points, specimen$landmarks["to", ]))
}

crest_points <- function(mesh, curved) {
  known <- !is.na(curved$k2)
  slope <- along_slope(mesh, curved$k2, curved$direction2)
  ridge <- known & !is.na(slope) & curved$k2 < 0 & -curved$k2 > abs(curved$k1)
  edges <- t(cbind(mesh$it[1:2, ], mesh$it[2:3, ], mesh$it[c(1, 3), ]))
  edges <- edges[ridge[edges[, 1]] & ridge[edges[, 2]], , drop = FALSE]
  edges <- unique(cbind(pmin(edges[, 1], edges[, 2]), pmax(edges[, 1], edges[, 2])))
  place <- t(mesh$vb[1:3, ])
  one <- edges[, 1]
  two <- edges[, 2]
  step <- place[two, , drop = FALSE] - place[one, , drop = FALSE]
  towards <- function(v) slope[v] * sign(rowSums(step * curved$direction2[v, , drop = FALSE]))
  crossing <- towards(one) < 0 & towards(two) > 0
  share <- abs(slope[one]) / (abs(slope[one]) + abs(slope[two]))
  (place[one, , drop = FALSE] + share * step)[crossing, , drop = FALSE]
}

# Derivative of a function of the vertices along a direction at each: mean of its triangles'
# gradients, by area.
along_slope <- function(mesh, value, direction) {
  place <- t(mesh$vb[1:3, ])
  corner <- function(i) place[mesh$it[i, ], ]
  a <- corner(2) - corner(1)
  b <- corner(3) - corner(1)
  normal <- crestline:::cross_rows(a, b)
  double <- sqrt(rowSums(normal^2))
  turned <- function(edge) crestline:::cross_rows(normal / double, edge)
  flow <- (value[mesh$it[2, ]] - value[mesh$it[1, ]]) * turned(-b) +
    (value[mesh$it[3, ]] - value[mesh$it[1, ]]) * turned(a)
  flow[is.na(flow)] <- 0
  double[is.na(colSums(matrix(value[mesh$it], 3)))] <- 0
  at <- factor(as.vector(mesh$it), seq_len(nrow(place)))
  total <- rowsum(flow[rep(seq_len(nrow(flow)), each = 3), ], at)
  area <- rowsum(rep(double, each = 3), at)
  rowSums(total * direction) / area[, 1]
}

# The way from the first point to the last whose steps have the least sum of squares (Dijkstra):
# near neighbours are joined.
join_points <- function(points) {
  n <- nrow(points)
  cost <- c(0, rep(Inf, n - 1))
  before <- integer(n)
  open <- rep(TRUE, n)
  while (open[n]) {
    now <- which(open)[which.min(cost[open])]
    open[now] <- FALSE
    through <- cost[now] + colSums((t(points) - points[now, ])^2)
    nearer <- open & through < cost
    cost[nearer] <- through[nearer]
    before[nearer] <- now
  }
  way <- n
  while (way[1] > 1) way <- c(before[way[1]], way)
  points[way, , drop = FALSE]
}

# --- A principal curve through the places of the window with most ridge curvature
# -------------------------------------------

by_principal_curve <- function(specimen, radius, width, n, share = 0.2) {
  near <- window_of(specimen, radius, width)
  strength <- pmax(-near$curved$k2[near$vertex], 0)
  high <- near$vertex[which(strength >= stats::quantile(strength, 1 - share, na.rm = TRUE))]
  ends <- specimen$landmarks
  start <- ends[rep("from", n), ] + seq(0, 1, length.out = n) *
    rep(ends["to", ] - ends["from", ], each = n)
  # Its smoother warns where a coordinate is nearly constant along the curve.
  fit <- suppressWarnings(princurve::principal_curve(t(specimen$mesh$vb[1:3, high]), start = start,
                                                     stretch = 0))
  line <- fit$s[fit$ord, ]
  if (sum((line[1, ] - ends["from", ])^2) > sum((line[nrow(line), ] - ends["from", ])^2))
    line <- line[nrow(line):1, ]
  rbind(ends["from", ], line, ends["to", ])
}
