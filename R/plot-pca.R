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
#' @param labels For "scores": whether to write the names of the specimens. By default they are
#'   written if there are 20 specimens at most.
#' @param ellipse For "scores": share of a normal distribution inside the ellipse of each group,
#'   such as 0.95. 0: no ellipses. A group of two has no ellipse.
#' @param view,... For "shapes", as in [draw_surface()], `engine` too ("rgl" draws as "picture").
#'   For "scores", passed to [graphics::plot.default()].
#' @return Invisibly: the scores that are drawn (n x 2 matrix), or a list of the two scenes. With
#'   `engine = "widget"` one scene.
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
                           labels = nrow(x$x) <= 20, ellipse = 0, ...) {
  validate(x)
  check_flags(labels)
  check_colour(colour, "colour")
  ellipse <- check_number(ellipse, "ellipse", 0, 1)
  sd <- check_number(sd, "sd", lower = 0, open = TRUE)
  what <- check_choice(what, c("scores", "shapes"), "what")
  for (one in component) check_number(one, "component", 1, length(x$sdev))
  drawn <- if (what == "scores") plot_scores(x, component, group, colour, labels, ellipse, ...) else
    plot_ends(x, component[1], colour, sd, view, ...)
  shown(drawn)
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
  drawn_or_refused(do.call(graphics::plot, c(list(at), given), quote = TRUE))
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

plot_ends <- function(pca, component, colour, sd, view, ..., engine = drawing_engine()) {
  view <- posed_view(view, pca$mean)
  engine <- check_engine(engine)
  if (engine == "rgl") engine <- "picture"
  if (is.null(pca$triangles)) {
    shapes <- lapply(c(0, -sd, sd), function(at) shape_at(pca, component, at))
    names(shapes) <- c("mean", sprintf("%+g sd", c(-sd, sd)))
    title <- sprintf("PC%d (%.0f %%)", component, 100 * pca$share[component])
    draw <- if (engine == "widget") configurations_scene else plot_configurations
    return(draw(shapes, pca$level, c("grey70", rep_len(colour, 2)), view, TRUE, title))
  }
  meshes <- lapply(c(-sd, sd), function(at) shape_at(pca, component, at, "mesh"))
  if (engine == "widget") {
    names(meshes) <- sprintf("%+g sd", c(-sd, sd))
    scene <- widget_overlay(beside(meshes, view), rep_len(colour, 2), 1, view, ...)
    return(draw_title(scene, sprintf("PC%d (%.0f %%), %+g sd and %+g sd", component,
                                     100 * pca$share[component], -sd, sd)))
  }
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

#' Two meshes moved apart across the direction of view
#' @noRd
beside <- function(meshes, view, gap = 0.1) {
  across <- view_rotation(view)[1, ]
  reach <- range(unlist(lapply(meshes, function(mesh) across %*% mesh$vb[1:3, ])))
  Map(function(mesh, shift) {
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] + shift * (1 + gap) * diff(reach) * across
    mesh
  }, meshes, c(-0.5, 0.5))
}

#' Write a page with a slider for every principal component
#'
#' Writes one self-contained HTML file. For each component it shows the turning mean, and a slider
#' that moves it along the component. A level with triangles is shown as a surface, curves as tubes,
#' landmarks as balls.
#'
#' @param x A `shape_pca`.
#' @template page-file
#' @param component Numbers of the components.
#' @param sd Range of the sliders on either side of the mean, in standard deviations.
#' @param colour Colour of the surface, tubes or balls.
#' @template page-title
#' @param size Width and height of each picture, two numbers, in pixels of the browser.
#' @param view First direction of view, as in [draw_surface()].
#' @param selfcontained As in [write_page()].
#' @param ... `pca`, the former name of `x`.
#' @return The path of the file, invisibly.
#' @section Errors: of class `crestline_error`: there is no such component, or the folder of the
#'   file does not exist.
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
  page <- page_document(
    title, tags$div(class = "blocks", blocks),
    lead = tags$div(class = "sum", tags$p(sprintf(
      paste("%d specimens, %d points (%s). The sliders move the mean by -%g to %g standard",
            "deviations of a component."), nrow(x$x), nrow(x$mean), x$level, sd, sd
    ))),
    provenance = x$provenance
  )
  save_page(page, file, selfcontained)
  invisible(file)
}

#' One component's scene with its slider
#' @noRd
component_block <- function(component, pca, sd, colour, size, view) {
  moving <- moving_parts(pca, component, sd, colour)
  scene <- new_widget_scene(points_frame(with_depth(pca$mean)), view_rotation(view),
                            widget_settings(size, triangles = max(1, ncol(moving$mesh$it))))
  add_surface(in_layer(scene, moving$layer), moving$mesh, moving$colour)
  scale <- scene$drawn$frame$scale
  flat <- function(x) as.list(signif(as.vector(t(x)), 5))
  scene$drawn$moves <- list(by = flat(scale * moving$by), normals = flat(moving$turns),
                            layer = moving$layer)
  tags <- htmltools::tags
  slider <- tags$label(
    class = "slider", sprintf("PC%d", component),
    tags$input(type = "range", min = -sd, max = sd, step = sd / 30, value = 0), tags$output("0 sd")
  )
  tags$section(class = "component",
               tags$h2(sprintf("PC%d, %.1f %% of the variance", component,
                               100 * pca$share[component])),
               widget_html(scene, paste0("crestline-pc", component)), slider)
}

#' The mean as triangles, and how far each vertex and normal moves for one standard deviation
#'
#' Surfaces are themselves; curves are tubes, other points balls.
#'
#' @return List: `mesh`, `colour`, `by` and `turns` (a row a vertex), `layer`.
#' @noRd
moving_parts <- function(pca, component, sd, colour) {
  if (!is.null(pca$triangles)) {
    ends <- lapply(c(-sd, 0, sd), function(at) shape_at(pca, component, at, "mesh"))
    moved <- function(field) t(ends[[3]][[field]][1:3, ] - ends[[1]][[field]][1:3, ]) / (2 * sd)
    return(list(mesh = ends[[2]], colour = colour, by = moved("vb"), turns = moved("normals"),
                layer = pca$level))
  }
  mean <- with_depth(shape_at(pca, component, 0))
  by <- (with_depth(shape_at(pca, component, sd)) - mean) / sd
  radius <- sqrt(sum(apply(mean, 2, function(v) diff(range(v)))^2)) / 200
  rows <- curve_rows(rownames(mean), pca$level)
  parts <- if (length(rows)) lapply(rows, function(own) tube_of(mean, own, radius)) else {
    lapply(seq_len(nrow(mean)), function(own) ball_at(mean, own, 2 * radius))
  }
  before <- c(0, cumsum(vapply(parts, function(one) nrow(one$xyz), 0L)))
  it <- do.call(rbind, lapply(seq_along(parts), function(i) parts[[i]]$it + before[i]))
  of <- function(field) do.call(rbind, unname(lapply(parts, `[[`, field)))
  mesh <- structure(list(vb = rbind(t(of("xyz")), 1), it = t(it), normals = t(of("normals"))),
                    class = "mesh3d")
  row <- unlist(lapply(parts, `[[`, "row"))
  list(mesh = mesh, colour = colour, by = by[row, , drop = FALSE],
       turns = matrix(0, length(row), 3), layer = pca$level)
}

tube_of <- function(xyz, own, radius, sides = 6) {
  if (length(own) < 2) return(ball_at(xyz, own, radius))
  tube <- tube_around(xyz[own, , drop = FALSE], radius, sides)
  c(tube[c("xyz", "it", "normals")], list(row = rep(own, each = sides)))
}

ball_at <- function(xyz, own, radius) {
  ball <- Rvcg::vcgSphere(2)
  normals <- t(ball$vb[1:3, ])
  list(xyz = sweep(radius * normals, 2, xyz[own, ], "+"), it = t(ball$it), normals = normals,
       row = rep(own, nrow(normals)))
}
