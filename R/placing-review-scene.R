# What the page of a review shows, as an rgl scene, and what has changed in it since.

#' Colours of landmarks by state, as in [plot.specimen()], and of curves by kind, as in
#' [plot.shape()]
#' @noRd
review_colours <- function() {
  list(state = c(found = "#1B9E77", doubtful = "#C8102E", predicted = "#3060C0", placed = "#D9A400",
                 given = "#202020"),
       selected = "#E08A00", curve = kind_colours)
}

#' The mesh that is shown: coarser where it has many triangles, in the colours of the specimen
#'
#' @param most Number of triangles.
#' @return List: `mesh`, in the frame of the scene; `colour`; `frame`.
#' @noRd
shown_surface <- function(specimen, surface, radius, most) {
  frame <- scene_frame(specimen$mesh)
  curved <- if (surface %in% c("shape index", "curvature")) curvature(specimen$mesh, radius)
  colour <- rep_len(specimen_scale(specimen, surface, curved)$colours, ncol(specimen$mesh$vb))
  mesh <- specimen$mesh[c("vb", "it", "normals")]
  mesh$vb[1:3, ] <- t(into_scene(t(mesh$vb[1:3, ]), frame))
  class(mesh) <- "mesh3d"
  if (ncol(mesh$it) <= most) return(list(mesh = mesh, colour = colour, frame = frame))
  coarse <- Rvcg::vcgQEdecim(mesh, tarface = most, silent = TRUE)
  nearest <- as.vector(Rvcg::vcgKDtree(mesh, coarse, k = 1)$index)
  list(mesh = coarse, colour = colour[nearest], frame = frame)
}

#' Open a scene of the surface, to which landmarks and curves are added
#'
#' @param shown As of [shown_surface()].
#' @param view As in [draw_surface()].
#' @return List: `device` of rgl; `scene` as of [draw_surface()]; `frame`.
#' @noRd
open_scene <- function(shown, view) {
  rgl::open3d(useNULL = TRUE)
  scene <- draw_surface(shown$mesh, shown$colour, view, "rgl", polygon_offset = 2)
  # The wheel turned away from the hand comes nearer, as in most programs.
  rgl::par3d(mouseMode = replace(rgl::par3d("mouseMode"), "wheel", "push"))
  list(device = rgl::cur3d(), scene = scene, frame = shown$frame)
}

#' Everything that is drawn on the surface, by name; a line that was drawn by hand stands for the
#' curve that was found
#' @noRd
review_items <- function(review, width = 3, wider = 5) {
  paths <- lapply(review$fitting$fits, `[[`, "path")
  drawn <- Filter(Negate(is.null), lapply(review$drawn, `[[`, "path"))
  paths[names(drawn)] <- drawn
  paths <- Filter(Negate(is.null), paths)
  curves <- review$fitting$scheme$curves
  items <- lapply(names(paths), function(name) {
    path <- unbridged_path(paths[[name]], review$specimen)
    list(path = as.matrix(path[c("x", "y", "z")]),
         colour = if (identical(name, review$pen)) review_colours()$selected else
           review_colours()$curve[[curves$kind[match(name, curves$curve)]]],
         width = if (name %in% names(drawn)) wider else width)
  })
  c(stats::setNames(items, paste("curve", names(paths), recycle0 = TRUE)), landmark_items(review))
}

#' The knots of the curve that is drawn now
#' @noRd
knot_items <- function(review, size = 1.2) {
  if (!length(review$pen)) return(list())
  knots <- review$drawn[[review$pen]]$knots
  stats::setNames(lapply(seq_len(NROW(knots)), function(i) {
    list(landmark = "", at = knots[i, 1:3], colour = review_colours()$selected, size = size)
  }), paste("knot", seq_len(NROW(knots)), recycle0 = TRUE))
}

#' The balls that can be dragged: knots of the curve that is drawn now, else the chosen landmark
#'
#' @return List of lists: `name`, `at` (in the scene), `out` (direction of the surface there).
#' @noRd
review_balls <- function(review, frame) {
  mesh <- review$specimen$mesh
  if (length(review$pen)) {
    knots <- review$drawn[[review$pen]]$knots
    return(lapply(seq_len(NROW(knots)), function(i) {
      drag_ball(as.character(i), knots[i, 1:3], knots[i, "face"], mesh, frame)
    }))
  }
  found <- if (length(review$selected)) {
    as_value(found_landmark(review$specimen, review$selected))
  }
  if (is.null(found) || failed(found)) return(list())
  list(drag_ball(review$selected, unlist(found[c("x", "y", "z")]), found$face, mesh, frame))
}

drag_ball <- function(name, at, face, mesh, frame) {
  corner <- t(mesh$vb[1:3, mesh$it[, face]])
  out <- unit_vector(cross_product(corner[2, ] - corner[1, ], corner[3, ] - corner[1, ]))
  list(name = name, at = as.vector(into_scene(matrix(at, 1), frame)), out = as.vector(out))
}

#' Both ends of a ray that the page sent, in the unit of the mesh
#' @noRd
scene_ray <- function(ray, frame) {
  from_scene(rbind(as.numeric(unlist(ray$from)), as.numeric(unlist(ray$towards))), frame)
}

landmark_items <- function(review, size = 1.6, larger = 1.25) {
  colours <- review_colours()
  at <- review$specimen$landmarks
  names <- intersect(review$about$landmark, rownames(at)[!is.na(at[, 1])])
  if (!length(names)) return(list())
  state <- ifelse(is_doubtful(review), "doubtful",
                  review$state)[match(names, review$about$landmark)]
  items <- Map(function(name, state) {
    chosen <- identical(name, review$selected)
    list(landmark = name, at = at[name, ],
         colour = if (chosen) colours$selected else colours$state[[state]],
         size = size * if (chosen) larger else 1)
  }, names, state)
  stats::setNames(items, paste("landmark", names))
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
  drawn[new] <- lapply(items[new], function(item) {
    before <- length(scene$scene$ids)
    shown <- if (is.null(item$path)) {
      at <- into_scene(matrix(item$at, 1), scene$frame)
      draw_points(scene$scene, at, item$colour, item$size, labels = item$landmark)
    } else {
      draw_lines(scene$scene, into_scene(item$path, scene$frame), item$colour, item$width)
    }
    list(item = item, ids = shown$ids[-seq_len(before)])
  })
  list(drawn = drawn, delete = delete,
       add = unlist(lapply(drawn[new], `[[`, "ids"), use.names = FALSE))
}
