# What the page of a review shows, as an rgl scene, and what has changed in it since.

#' Colours of landmarks by state, as in [plot_placing()], and of curves by kind, as in [plot.shape()]
#' @noRd
review_colours <- function() {
  list(state = c(found = "#108040", doubtful = "#C02020", predicted = "#3060C0", placed = "#6A3D9A", given = "#202020"),
       selected = "#E08A00", curve = eval(formals(plot.shape)$colour))
}

#' The mesh that is shown: coarser where it has many triangles, in the colours of the specimen
#'
#' @param most Number of triangles.
#' @return List: `mesh`, `colour`.
#' @noRd
shown_surface <- function(specimen, surface, radius, most) {
  mesh <- specimen$mesh
  curved <- if (surface %in% c("shape index", "curvature")) curvature(mesh, radius)
  colour <- rep_len(specimen_scale(specimen, surface, curved)$colours, ncol(mesh$vb))
  if (ncol(mesh$it) <= most) return(list(mesh = mesh, colour = colour))
  size <- mesh_diagonal(mesh)
  middle <- rowMeans(mesh$vb[1:3, ])
  unit <- structure(list(vb = rbind((mesh$vb[1:3, ] - middle) / size, 1), it = mesh$it), class = "mesh3d")
  coarse <- Rvcg::vcgQEdecim(unit, tarface = most, silent = TRUE)
  nearest <- as.vector(Rvcg::vcgKDtree(unit, coarse, k = 1)$index)
  coarse$vb[1:3, ] <- coarse$vb[1:3, ] * size + middle
  list(mesh = coarse, colour = colour[nearest])
}

#' Open a scene of the surface, to which landmarks and curves are added
#'
#' @param shown As of [shown_surface()].
#' @param view As in [draw_surface()].
#' @return List: `device` of rgl; `scene` as of [draw_surface()].
#' @noRd
open_scene <- function(shown, view) {
  rgl::open3d(useNULL = TRUE)
  scene <- draw_surface(shown$mesh, shown$colour, view, "rgl", polygon_offset = 2)
  list(device = rgl::cur3d(), scene = scene)
}

#' Everything that is drawn on the surface, by name
#' @noRd
review_items <- function(review) {
  c(curve_items(review), landmark_items(review))
}

landmark_items <- function(review, size = 1.6, larger = 1.25) {
  colours <- review_colours()
  at <- review$specimen$landmarks
  names <- intersect(review$about$landmark, rownames(at)[!is.na(at[, 1])])
  if (!length(names)) return(list())
  state <- ifelse(is_doubtful(review), "doubtful", review$state)[match(names, review$about$landmark)]
  items <- Map(function(name, state) {
    chosen <- identical(name, review$selected)
    list(landmark = name, at = place_of(review, name), colour = if (chosen) colours$selected else colours$state[[state]],
         size = size * if (chosen) larger else 1)
  }, names, state)
  stats::setNames(items, paste("landmark", names))
}

curve_items <- function(review, width = 3) {
  fits <- Filter(function(fit) !is.null(fit$path), review$fitting$fits)
  if (!length(fits)) return(list())
  curves <- review$fitting$scheme$curves
  colour <- review_colours()$curve[curves$kind[match(names(fits), curves$curve)]]
  items <- Map(function(fit, colour) {
    list(path = as.matrix(unbridged_path(fit$path, review$specimen$mesh)[c("x", "y", "z")]), colour = colour, width = width)
  }, fits, unname(colour))
  stats::setNames(items, paste("curve", names(fits)))
}

#' Draw what is new or has changed, take away what is gone
#'
#' @param scene As of [open_scene()].
#' @param drawn List by name of what is drawn: `item`, `ids`.
#' @param items As of [review_items()].
#' @return List: `drawn`; `delete` and `add`, the ids of rgl's objects.
#' @noRd
redraw <- function(scene, drawn, items) {
  rgl::set3d(scene$device)
  same <- vapply(names(drawn), function(name) identical(drawn[[name]]$item, items[[name]]), NA)
  delete <- unlist(lapply(drawn[!same], `[[`, "ids"), use.names = FALSE)
  if (length(delete)) rgl::pop3d(id = delete)
  drawn <- drawn[same]
  new <- setdiff(names(items), names(drawn))
  drawn[new] <- lapply(items[new], function(item) list(item = item, ids = draw_item(scene$scene, item)))
  list(drawn = drawn, delete = delete, add = unlist(lapply(drawn[new], `[[`, "ids"), use.names = FALSE))
}

draw_item <- function(scene, item) {
  before <- length(scene$ids)
  scene <- if (is.null(item$path)) {
    draw_points(scene, matrix(item$at, 1), item$colour, item$size, labels = item$landmark)
  } else {
    draw_lines(scene, item$path, item$colour, item$width)
  }
  scene$ids[-seq_len(before)]
}

#' Radius of the ball of a landmark, in the unit of the mesh
#' @noRd
ball_radius <- function(scene) formals(landmark_items)$size * scene$scene$diagonal / 400
