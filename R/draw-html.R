# A gathered scene as HTML: few objects of rgl, and around them title, key, scale and layers.

#' The scene as an element of a page
#'
#' @param id Of the element that holds the scene; NULL: one that htmlwidgets makes up.
#' @noRd
widget_html <- function(scene, id = NULL) {
  rlang::check_installed(c("htmltools", "htmlwidgets"), "to draw with the engine \"widget\".")
  drawn <- scene$drawn
  tags <- htmltools::tags
  size <- drawn$settings$size
  # The scene is as wide as the page, up to `size`, and never higher than that width.
  style <- sprintf("max-width:%gpx;height:min(%gpx,92vw)", size[1], size[2])
  look <- htmltools::htmlDependency("crestline-scene", "1", system.file(
    "report", package = "crestline", mustWork = TRUE
  ), stylesheet = "scene.css", all_files = FALSE)
  htmltools::attachDependencies(tags$div(
    class = "crestline-scene",
    if (!is.null(drawn$title)) tags$p(class = "scene-title", drawn$title),
    tags$div(class = "scene-row",
             tags$div(class = "scene-stage", style = style, scene_widget(scene, id),
                      tags$div(class = "scene-tip", hidden = NA)),
             scene_bar(drawn$bar)),
    scene_layers(drawn), scene_key(drawn$key),
    tags$output(class = "scene-said", paste0(
      "Drag to turn, wheel to come nearer",
      if (has_names(drawn)) "; rest on a point or a line for its name, click to print it", "."
    )),
    lapply(unique(drawn$notes), function(note) tags$p(class = "scene-note", note))
  ), look)
}

scene_bar <- function(bar) {
  if (is.null(bar)) return(NULL)
  tags <- htmltools::tags
  ramp <- bar$ramp[unique(round(seq(1, length(bar$ramp), length.out = 40)))]
  at <- sprintf("bottom:%.2f%%", 100 * bar$at)
  tags$div(class = "scene-bar", tags$div(class = "scene-unit", bar$title), tags$div(
    class = "scene-ramp",
    style = sprintf("background:linear-gradient(to top,%s)", paste(ramp, collapse = ",")),
    Map(function(at, label) tags$span(style = at, label), at, as.character(bar$labels)) |> unname()
  ))
}

scene_key <- function(key) {
  key <- key[!duplicated(names(key))]
  if (!length(key)) return(NULL)
  tags <- htmltools::tags
  tags$div(class = "scene-key", unname(Map(function(colour, name) {
    tags$span(tags$i(style = paste0("background:", colour)), name)
  }, key, names(key))))
}

#' A tick for each layer: what is ticked is shown
#' @noRd
scene_layers <- function(drawn) {
  layers <- drawn_layers(drawn)
  if (length(layers) < 2) return(NULL)
  tags <- htmltools::tags
  tags$div(class = "scene-layers", "shown: ", lapply(layers, function(layer) tags$label(
    tags$input(type = "checkbox", `data-layer` = layer, checked = NA), layer
  )))
}

drawn_layers <- function(drawn) {
  unique(unlist(lapply(c("surfaces", "bands", "lines", "points"),
                       function(kind) lapply(drawn[[kind]], `[[`, "layer"))))
}

#' The scene as rgl's widget, with names on hover
#' @noRd
scene_widget <- function(scene, id) {
  device <- rgl::cur3d()
  rgl::open3d(useNULL = TRUE)
  own <- rgl::cur3d()
  on.exit({
    rgl::close3d(own)
    if (device != 0) rgl::set3d(device)
  })
  drawn <- scene$drawn
  layers <- joined_objects(drawn)
  rotation <- rbind(cbind(drawn$rotation, 0), c(0, 0, 0, 1))
  rgl::par3d(userMatrix = rotation, FOV = 15, zoom = drawn$settings$zoom,
             mouseMode = replace(rgl::par3d("mouseMode"), "wheel", "push"))
  rgl::aspect3d("iso")
  widget <- rgl::rglwidget(width = drawn$settings$size[1], height = drawn$settings$size[2],
                           elementId = id)
  widget$width <- widget$height <- "100%"
  data <- c(list(layers = lapply(layers, as.list), moves = drawn$moves), scene_names(drawn),
            drawn$frame)
  htmlwidgets::onRender(widget, report_text("scene.js"), data)
}

#' Draw what was gathered as few objects: those of a layer and a kind are one
#' @return Named list by layer: ids of rgl's objects.
#' @noRd
joined_objects <- function(drawn) {
  ids <- stats::setNames(lapply(drawn_layers(drawn), function(layer) {
    of <- function(kind) Filter(function(one) one$layer == layer, drawn[[kind]])
    c(unlist(lapply(of("surfaces"), surface_object, drawn$frame)),
      by_look(of("bands"), "opacity", bands_object, drawn$frame),
      by_look(of("lines"), "width", lines_object, drawn$frame),
      by_look(of("points"), "size", points_object, drawn$frame, drawn$settings$balls))
  }), drawn_layers(drawn))
  Filter(length, ids)
}

by_look <- function(parts, field, draw, ...) {
  if (!length(parts)) return(NULL)
  look <- vapply(parts, function(one) as.numeric(one[[field]]), 0)
  unlist(lapply(split(parts, look), draw, ...), use.names = FALSE)
}

ids_of <- function(ids) as.vector(unclass(ids))

surface_object <- function(one, frame) {
  ids_of(rgl::triangles3d(into_scene(one$xyz, frame), normals = one$normals, indices = one$it,
                          color = one$colour, alpha = one$alpha, specular = "#202020",
                          polygon_offset = 2))
}

lines_object <- function(parts, frame) {
  ends <- lapply(parts, function(one) {
    n <- nrow(one$xyz)
    known <- is.finite(rowSums(one$xyz))
    first <- which(known[-n] & known[-1])
    one$xyz[rbind(first, first + 1), , drop = FALSE]
  })
  xyz <- do.call(rbind, ends)
  if (!NROW(xyz)) return(NULL)
  colour <- rep(vapply(parts, `[[`, "", "colour"), vapply(ends, nrow, 0L))
  ids_of(rgl::segments3d(into_scene(xyz, frame), color = colour, lwd = parts[[1]]$width,
                         lit = FALSE))
}

bands_object <- function(parts, frame) {
  corners <- do.call(rbind, lapply(parts, function(one) rbind(one$left, one$right)))
  if (!nrow(corners)) return(NULL)
  before <- 0L
  it <- do.call(cbind, lapply(parts, function(one) {
    n <- nrow(one$left)
    i <- before + seq_len(max(n - 1, 0))
    before <<- before + 2L * n
    cbind(rbind(i, i + 1L, i + n + 1L), rbind(i, i + n + 1L, i + n))
  }))
  colour <- rep(vapply(parts, `[[`, "", "colour"),
                2 * vapply(parts, function(one) nrow(one$left), 0L))
  ids_of(rgl::triangles3d(into_scene(corners, frame), indices = it, color = colour,
                          alpha = parts[[1]]$opacity, lit = FALSE, polygon_offset = 1))
}

#' Points as balls, whose diameter at size 1 is a 200th of the box's diagonal, or as round dots
#' @noRd
points_object <- function(parts, frame, balls) {
  xyz <- into_scene(do.call(rbind, lapply(parts, `[[`, "xyz")), frame)
  colour <- unlist(lapply(parts, `[[`, "colour"))
  known <- is.finite(rowSums(xyz))
  size <- parts[[1]]$size
  drawn <- if (!any(known)) NULL else if (sum(known) > balls) {
    ids_of(rgl::points3d(xyz[known, , drop = FALSE], color = colour[known], size = 6 * size,
                         point_antialias = TRUE, lit = FALSE))
  } else {
    balls_object(xyz[known, , drop = FALSE], colour[known], size / 2)
  }
  labels <- unlist(lapply(parts, `[[`, "labels"))
  if (is.null(labels) || !any(known)) return(drawn)
  labelled <- do.call(rbind, lapply(parts, function(one) if (!is.null(one$labels)) one$xyz))
  c(drawn, ids_of(rgl::text3d(
    into_scene(labelled, frame), texts = labels, cex = max(1, 0.8 * size), adj = c(-0.5, 0.5),
    lit = FALSE,
    color = rep(colour, length.out = nrow(labelled)), depth_test = "always"
  )))
}

#' All balls as one object
#' @noRd
balls_object <- function(xyz, colour, radius) {
  ball <- Rvcg::vcgSphere(2)
  unit <- t(ball$vb[1:3, ])
  n <- nrow(unit)
  of <- rep(seq_len(nrow(xyz)), each = n)
  normals <- unit[rep(seq_len(n), nrow(xyz)), ]
  it <- matrix(ball$it, 3, ncol(ball$it) * nrow(xyz)) +
    rep(n * (seq_len(nrow(xyz)) - 1L), each = length(ball$it))
  ids_of(rgl::triangles3d(xyz[of, ] + radius * normals, normals = normals, indices = it,
                          color = colour[of], specular = "black"))
}

has_names <- function(drawn) {
  any(vapply(c(drawn$points, drawn$lines), function(one) !is.null(one$name), NA))
}

#' What is named in a scene: places in its frame, the surface's normal there, and whose they are
#'
#' @param most Greatest number of places of a line.
#' @noRd
scene_names <- function(drawn, most = 40) {
  named <- Filter(function(one) !is.null(one$name), c(drawn$points, drawn$lines))
  each <- lapply(named, function(one) {
    known <- which(is.finite(rowSums(one$xyz)))
    several <- length(one$name) == nrow(one$xyz)
    if (!several && length(known) > most) {
      known <- known[unique(round(seq(1, length(known), length.out = most)))]
    }
    list(xyz = one$xyz[known, , drop = FALSE], layer = rep(one$layer, length(known)),
         name = if (several) one$name[known] else rep(one$name[1], length(known)))
  })
  xyz <- do.call(rbind, lapply(each, `[[`, "xyz"))
  if (!NROW(xyz)) return(list(at = list(), out = list(), of = list(), names = list()))
  name <- unlist(lapply(each, `[[`, "name"))
  layer <- unlist(lapply(each, `[[`, "layer"))
  flat <- function(x, digits) as.list(round(as.vector(t(x)), digits))
  known <- unique(data.frame(name, layer))
  list(at = flat(into_scene(unname(xyz), drawn$frame), 4), out = flat(normals_near(drawn, xyz), 2),
       of = as.list(match(paste(name, layer), paste(known$name, known$layer)) - 1L),
       names = as.list(known$name), within = as.list(known$layer))
}

#' Normals of the surfaces at their vertices next to points; 0 without a surface
#' @noRd
normals_near <- function(drawn, xyz) {
  if (!length(drawn$surfaces)) return(matrix(0, nrow(xyz), 3))
  vertices <- do.call(rbind, lapply(drawn$surfaces, `[[`, "xyz"))
  normals <- do.call(rbind, lapply(drawn$surfaces, `[[`, "normals"))
  normals[as.vector(Rvcg::vcgKDtree(vertices, xyz, k = 1)$index), , drop = FALSE]
}

#' A file of the package's pages as one text
#' @noRd
report_text <- function(name) {
  file <- system.file("report", name, package = "crestline", mustWork = TRUE)
  paste(readLines(file, encoding = "UTF-8", warn = FALSE), collapse = "\n")
}
