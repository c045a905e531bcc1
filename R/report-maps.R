# Pictures of a face for a page: maps in colour whose signs can also be read in black and white.

# What the people of the norm share with this one: a norm may be of both sexes together.
norm_of <- function(x) if (x$sex == "all") "age" else "age and sex"

#' Four pictures beside each other: the face, both maps, the healed face; asymmetry where it differs
#' @param span z from which on the colours are full.
#' @noRd
assessment_maps <- function(x, span = 6) {
  tags <- htmltools::tags
  points <- x$points
  xyz <- as.matrix(points[c("x", "y", "z")])
  found <- nrow(x$findings) > 0
  card <- function(title, text, ...) {
    tags$figure(face_image(x, ..., alt = title), tags$figcaption(tags$b(title), text))
  }
  asymmetric <- any(x$verdicts$verdict[x$verdicts$family == "asymmetry"] == "real")
  cards <- list(
    card("The face", " at the points that were measured.", xyz),
    card("Each place against the norm", sprintf(" of this %s.", norm_of(x)), xyz, points$z_map,
         span, x$limits[["map"]]),
    card("Does each place fit the rest of the face?",
         " This finds small differences that the other map cannot see.", xyz, points$z_scan, span,
         x$limits[["scan"]]),
    card("Expected shape", if (found) {
      " with the outlined places replaced by what faces with such surroundings have there."
    } else " is the face itself, as nothing was found that does not fit the rest.", x$healed,
    ring = points$healed_sd > 0 & points$assessed),
    if (asymmetric) card("Asymmetry against the norm's",
                         " on one side. Outward: further out against the other than usual.", xyz,
                         points$z_asymmetry, span, x$limits[["asymmetry"]])
  )
  tags$section(tags$h2("Pictures"), tags$div(class = "maps", Filter(Negate(is.null), cards)),
               sign_legend(span), tags$p(class = "note",
                 "+ and \u2212 mark places beyond the limit that 95 % of people keep over the",
                 "whole face. Holes: missing in the scan. Grey: not assessed. Below each: from the",
                 "right and from the left."), grey_print())
}

#' What of the pictures can be read without colours, for paper only
#' @noRd
grey_print <- function() {
  htmltools::tags$p(class = "note paper", "Without colours, only outlined places can be read.")
}

#' @param what "z", or the unit of what is coloured.
#' @noRd
sign_legend <- function(span, what = "z", palette = sign_colours()) {
  ends <- sprintf(if (what == "z") "%2$s %1$s" else "%1$s %2$s",
                  paste0(c("\u2212", "+"), format(span)), what)
  text <- function(x, at, anchor, y = 28) {
    sprintf("<text x=\"%g\" y=\"%g\" text-anchor=\"%s\">%s</text>", x, y, anchor, at)
  }
  stop <- sprintf("<stop offset=\"%g\" stop-color=\"%s\"/>", seq(0, 1, length.out = 3), palette)
  htmltools::HTML(paste0(
    "<svg class=\"legend\" viewBox=\"0 0 420 34\" role=\"img\" aria-label=\"scale of colours\">",
    "<defs><linearGradient id=\"sign\">", paste(stop, collapse = ""), "</linearGradient></defs>",
    "<rect x=\"80\" width=\"240\" height=\"12\" y=\"2\" fill=\"url(#sign)\" stroke=\"#444\"/>",
    text(74, "\u2212 inward", "end", 12), text(326, "+ outward", "start", 12),
    text(80, ends[1], "middle"), text(200, "0", "middle"), text(320, ends[2], "middle"), "</svg>"
  ))
}

#' Light enough for a black sign upon them
#' @noRd
sign_colours <- function() c("#6FA8DC", "#FFFFFF", "#EE9080")

#' One picture as an image of a page: from the front, below from both sides
#'
#' @param x List: `triangles`, `front`.
#' @param xyz k x 3.
#' @param value k numbers for the colours, or NULL; `span` of the palette; `most`: beyond it a sign.
#' @param ring k logical values: points to outline.
#' @noRd
face_image <- function(x, xyz, value = NULL, span = 1, most = Inf, ring = NULL, alt = "",
                       size = c(480, 680), resolution = 130) {
  file <- tempfile(fileext = ".png")
  on.exit(unlink(file))
  type <- if (capabilities("cairo")) "cairo" else getOption("bitmapType")
  grDevices::png(file, size[1], size[2], res = resolution, type = type)
  tryCatch({
    graphics::layout(matrix(c(1, 1, 2, 3), 2, byrow = TRUE), heights = c(1.75, 1))
    graphics::par(mar = rep(0.1, 4))
    for (round in c(0, -0.9, 0.9)) {
      view <- view_rotation(c(round, 0)) %*% x$front
      draw_signs(x$triangles, xyz, value, span, most, ring, view, signs = round == 0)
    }
  }, finally = grDevices::dev.off())
  htmltools::tags$img(src = png_address(file), alt = alt)
}

#' A surface in the colours of values, an outline, and signs where they are beyond a limit
#' @noRd
draw_signs <- function(triangles, xyz, value, span, most, ring, view, signs) {
  mesh <- points_mesh(xyz, triangles)
  row <- attr(mesh, "row")
  plain <- is.null(value)
  if (plain) value <- rep(NA_real_, nrow(xyz))
  colour <- if (plain) "#DDD6CD" else {
    surface_colours(mesh, value[row], grDevices::colorRampPalette(sign_colours())(101),
                    c(-span, span))
  }
  scene <- draw_surface(mesh, colour, view, "picture", ambient = 0.6, gloss = 0.03)
  edge <- if (is.null(ring)) is.finite(value) & abs(value) > most else ring
  if (any(edge)) {
    line <- level_lines(mesh, ifelse(edge[row], 1, 0), 0.5)
    if (nrow(line)) draw_lines(scene, line, "black", 1.5)
  }
  # Points of no triangle would float beside the face
  drawn <- seq_along(value) %in% triangles
  beyond <- which(signs & drawn & is.finite(value) & abs(value) > most)
  seen <- beyond[visible_points(scene, xyz[beyond, , drop = FALSE])]
  if (length(seen)) {
    at <- view_points(scene, xyz[seen, , drop = FALSE])
    on_scene(scene, graphics::text(at[, 1], at[, 2], ifelse(value[seen] > 0, "+", "\u2212"),
                                   cex = 0.6, font = 2))
  }
}
