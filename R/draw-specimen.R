# The colours of a specimen's surface and their legend.

specimen_scale <- function(x, colour, curvature, palette = NULL) {
  natural <- x$mesh$material$color
  switch(colour, "shape index" = shape_legend(shape_index(curvature),
                                               attr(curvature, "radius"), palette),
         "curvature" = curvature_legend(curvature, palette),
         list(colours = if (colour == "natural" && length(natural) == ncol(x$mesh$vb)) {
           natural
         } else {
           "#E3CDB8"
         }))
}

shape_legend <- function(index, radius, palette = NULL) {
  scale <- shape_scale()
  list(colours = shape_colours(index, palette = palette),
       ramp = shape_colours(seq(-1, 1, length.out = 200), palette = palette),
       at = (scale$index + 1) / 2, labels = scale$category,
       title = sprintf("shape index, radius %.3g (unit of the mesh)", radius))
}

curvature_legend <- function(curvature, palette = NULL, quantile = 0.95, missing = "#BEBEBE") {
  if (is.null(palette)) palette <- grDevices::hcl.colors(11, "Blue-Red")
  palette <- check_colour(palette, "palette")
  greater <- ifelse(abs(curvature$k1) > abs(curvature$k2), -curvature$k1, -curvature$k2)
  limit <- stats::quantile(abs(greater), quantile, na.rm = TRUE)
  share <- (pmin(pmax(greater / limit, -1), 1) + 1) / 2
  at <- seq(-1, 1, by = 0.5)
  list(colours = ramp_colours(share, palette, missing),
       ramp = ramp_colours(seq(0, 1, length.out = 200), palette, missing), at = (at + 1) / 2,
       labels = paste(signif(abs(at) * limit, 2), c("valley", "", "", "", "ridge")),
       title = sprintf("1 / unit of the mesh, radius %.3g", attr(curvature, "radius")))
}

# The colour of every vertex; for a legend the colours from bottom to top, and labels at shares of
# the way. What the colours of a specimen's surface may show.
surface_choices <- c("natural", "shape index", "curvature", "plain")

# Colours of curves by their kind.
kind_colours <- c(ridge = "#C8102E", valley = "#2350C8", plane = "#202020")
