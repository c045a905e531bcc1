# Shapes along principal components: pictures, and a page with sliders.

#' Plot principal components of shape
#'
#' Draws the scores of the specimens on two components, or the shapes at both ends of one.
#'
#' @param x A `shape_pca`.
#' @param what "scores": the scores on two components. "shapes": the shapes at `-sd` and `sd`
#'   standard deviations; surfaces are drawn side by side, landmarks and curves over each other with
#'   the mean.
#' @param component Two components for "scores", one for "shapes".
#' @param group Group of each specimen, as in [compare_groups()], or `NULL`.
#' @param colour Colours of the groups, or of the surfaces.
#' @param sd For "shapes": distance from the mean, in standard deviations.
#' @param labels For "scores": whether to write the names of the specimens.
#' @param ellipse For "scores": share of a normal distribution inside the ellipse of each group,
#'   such as 0.95. 0: no ellipses. A group of two has no ellipse.
#' @param view,... For "shapes", as in [draw_surface()]. For "scores", passed to
#'   [graphics::plot.default()].
#' @return Invisibly: the scores that are drawn (n x 2 matrix), or a list of the two scenes.
#' @template glossary
#' @seealso [shape_pca()], [write_pca_page()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' pca <- shape_pca(align(shapes + rnorm(120, sd = 0.05)))
#' plot(pca)
#' @export
plot.shape_pca <- function(x, what = c("scores", "shapes"),
                           component = if (what[1] == "scores") 1:2 else 1, group = NULL,
                           colour = c("#2F7FD1", "#E0553F"), sd = 3, view = "front",
                           labels = FALSE, ellipse = 0, ...) {
  validate(x)
  check_flags(labels)
  check_colour(colour, "colour")
  ellipse <- check_number(ellipse, "ellipse", 0, 1)
  sd <- check_number(sd, "sd", lower = 0, open = TRUE)
  what <- check_choice(what, c("scores", "shapes"), "what")
  for (one in component) check_number(one, "component", 1, length(x$sdev))
  drawn <- if (what == "scores") plot_scores(x, component, group, colour, labels, ellipse, ...) else
    plot_ends(x, component[1], colour, sd, view, ...)
  invisible(drawn)
}

plot_scores <- function(pca, component, group, colour, labels, ellipse, ...) {
  group <- if (is.null(group)) factor(rep("", nrow(pca$x))) else check_group(group, rownames(pca$x))
  colour <- if (length(colour) >= nlevels(group)) colour else
    grDevices::hcl.colors(nlevels(group), "Dark 3")
  names <- sprintf("PC%d (%.1f %%)", component, 100 * pca$share[component])
  draw_scores(pca$x[, rep_len(component, 2)], group, colour, names, labels, ellipse, ...)
}

#' Scores on two axes, in the colours of the groups
#' @param at n x 2, with the names of the specimens.
#' @param names Of the axes.
#' @noRd
draw_scores <- function(at, group, colour, names, labels, ellipse, ...) {
  rings <- if (ellipse == 0) list() else {
    lapply(split(seq_len(nrow(at)), group), function(own) normal_ellipse(at[own, ], ellipse))
  }
  reach <- rbind(at, do.call(rbind, rings))
  given <- list(...)
  given <- utils::modifyList(
    list(xlim = range(reach[, 1]), ylim = range(reach[, 2]), asp = 1, pch = 16,
         xlab = names[1], ylab = names[length(names)],
         col = grDevices::adjustcolor(colour[as.integer(group)], 0.8)),
    given
  )
  do.call(graphics::plot, c(list(at), given), quote = TRUE)
  for (g in seq_along(rings)) graphics::lines(rings[[g]], col = colour[g])
  if (labels) graphics::text(at, rownames(at), pos = 3, offset = 0.35, cex = 0.6, xpd = NA)
  graphics::abline(h = 0, v = 0, col = "grey80", lwd = 0.6)
  if (nlevels(group) > 1) {
    graphics::legend("topright", levels(group), pch = 16, col = colour, bty = "n")
  }
  at
}

#' The ellipse of a bivariate normal distribution that holds a share of it
#' @noRd
normal_ellipse <- function(xy, share, n = 100) {
  if (nrow(xy) < 3) return(NULL)
  turn <- seq(0, 2 * pi, length.out = n)
  root <- eigen(stats::cov(xy), symmetric = TRUE)
  axes <- root$vectors %*% diag(sqrt(pmax(root$values, 0) * stats::qchisq(share, 2)))
  t(axes %*% rbind(cos(turn), sin(turn)) + colMeans(xy))
}

plot_ends <- function(pca, component, colour, sd, view, ...) {
  view <- posed_view(view, pca$mean)
  if (is.null(pca$triangles)) {
    shapes <- lapply(c(0, -sd, sd), function(at) shape_at(pca, component, at))
    names(shapes) <- c("mean", sprintf("%+g sd", c(-sd, sd)))
    title <- sprintf("PC%d (%.0f %%)", component, 100 * pca$share[component])
    return(plot_configurations(
      shapes, pca$level, c("grey70", rep_len(colour, 2)), view, TRUE, title
    ))
  }
  meshes <- lapply(c(-sd, sd), function(at) shape_at(pca, component, at, "mesh"))
  around <- t(do.call(cbind, lapply(meshes, function(mesh) mesh$vb[1:3, ])))
  old <- graphics::par(mfrow = c(1, 2), mar = c(0.5, 0.5, 2, 0.5))
  on.exit(graphics::par(old))
  Map(function(mesh, at, colour) {
    scene <- draw_surface(mesh, colour, view, "picture", around = around, ...)
    graphics::title(sprintf("PC%d (%.0f %%), %+g sd", component, 100 * pca$share[component], at),
                    font.main = 1,
                    cex.main = 1)
    scene
  }, meshes, c(-sd, sd), rep_len(colour, 2))
}

#' Write a page with a slider for every principal component
#'
#' Writes one self-contained HTML file. For each component it shows the turning mean surface, and a
#' slider that moves it along the component.
#'
#' @param x A `shape_pca` of a level with a surface.
#' @template page-file
#' @param component Numbers of the components.
#' @param sd Range of the sliders on either side of the mean, in standard deviations.
#' @param colour Colour of the surface.
#' @template page-title
#' @param size Width and height of each picture, two numbers, in pixels of the browser.
#' @param view First direction of view, as in [draw_surface()].
#' @param selfcontained As in [write_page()].
#' @param ... `pca`, the former name of `x`.
#' @return The path of the file, invisibly.
#' @section Errors: of class `crestline_error`: the level has no surface, there is no such
#'   component, or the folder of the file does not exist.
#' @template glossary
#' @examplesIf requireNamespace("htmltools", quietly = TRUE)
#' ball <- Rvcg::vcgSphere(2)
#' xyz <- t(ball$vb[1:3, ])
#' balls <- simplify2array(lapply(1:8, function(i) xyz %*% diag(c(1 + rnorm(1, sd = 0.1), 1, 1))))
#' pca <- shape_pca(align(balls, "ball", triangles = ball$it))
#' page <- tempfile(fileext = ".html")
#' write_pca_page(pca, page, 1)
#' file.size(page)
#' unlink(page)
#' @export
write_pca_page <- function(x, file, component = seq_len(min(3, length(x$sdev))), sd = 3,
                           colour = "#E3CDB8",
                           title = "Principal components of shape", size = c(420, 460),
                           view = "front",
                           selfcontained = TRUE, ...) {
  turned <- object_first(x, file, "write_pca_page", "pca", ...)
  do.call(check_dots, turned$more)
  x <- turned$x
  colour <- check_colour(colour, "colour")
  title <- check_text(title, "title")
  size <- check_size(size)
  check_flags(selfcontained)
  view_rotation(view)
  rlang::check_installed("htmltools", "to write a page.")
  file <- check_page_file(turned$file)
  check_class(x, "shape_pca", "x", "shape_pca()")
  check_component(component, x)
  view <- posed_view(view, x$mean)
  sd <- check_number(sd, "sd", lower = 0, open = TRUE)
  blocks <- lapply(component, component_block, x, sd, colour, size, view)
  tags <- htmltools::tags
  page <- tags$div(
    style = "font-family:sans-serif;margin:20px", tags$head(tags$title(title)), tags$h2(title),
    tags$p(sprintf("%d specimens, %d points (%s). ", nrow(x$x), nrow(x$mean), x$level),
           sprintf("Sliders: standard deviations from the mean, -%g to %g.", sd, sd)),
    tags$div(style = "display:flex;flex-wrap:wrap;gap:16px", blocks), provenance_block(x$provenance)
  )
  save_page(page, file, selfcontained)
  invisible(file)
}

#' One component's scene with its slider
#' @noRd
component_block <- function(component, pca, sd, colour, size, view) {
  rgl::open3d(useNULL = TRUE)
  device <- rgl::cur3d()
  on.exit(rgl::close3d(device))
  scene <- draw_surface(shape_at(pca, component, 0, "mesh"), colour, view, "rgl")
  stops <- c(-sd, 0, sd)
  values <- t(vapply(stops, function(at) {
    mesh <- shape_at(pca, component, at, "mesh")
    c(t(mesh$vb[1:3, ]), t(mesh$normals[1:3, ]))
  }, numeric(6 * ncol(shape_at(pca, component, 0, "mesh")$vb))))
  vertices <- rep(seq_len(ncol(values) / 6), 6)
  attributes <- rep(c("x", "y", "z", "nx", "ny", "nz"), each = ncol(values) / 6)
  id <- paste0("crestline-pc", component)
  control <- rgl::vertexControl(
    value = 0, values = values, vertices = vertices, attributes = attributes, objid = scene$ids[1],
    param = stops
  )
  steps <- seq(-sd, sd, length.out = 61)
  player <- rgl::playwidget(
    id, control, start = -sd, stop = sd, step = sd / 30, components = c("Slider", "Label"),
    labels = sprintf("%+.1f", steps)
  )
  # It begins at the mean.
  player$x$value <- 0
  tags <- htmltools::tags
  tags$div(tags$h4(style = "margin:4px 0",
                   sprintf("PC%d, %.1f %% of the variance", component, 100 * pca$share[component])),
           rgl::rglwidget(width = size[1], height = size[2], elementId = id), player)
}
