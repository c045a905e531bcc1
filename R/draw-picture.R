# Pictures without a display: a z-buffered raster of the surface, base graphics on top of it.

#' Settings of pictures
#'
#' Settings of the engine "picture", such as light and resolution. Every function that draws a
#' surface takes them by name in its `...`.
#'
#' @param light Direction towards the light, three numbers: right, up, towards the viewer.
#' @param ambient Share of ambient light, 0 to 1.
#' @param wrap Softness of the shade, 0 to 1. 0: Lambert's law. 1: every place gets some light.
#' @param gloss Strength of highlights, 0 to 1. Large values hide colours.
#' @param sharpness Exponent of the highlights (Blinn-Phong). Highlights are smaller for larger
#'   values.
#' @param resolution Pixels per inch of the surface's raster. The default is the resolution of the
#'   device, in a file of [write_picture()] its `dpi`, but at least 150.
#' @param samples Root of the number of samples in a pixel.
#' @param margin Margin of the picture, as a share of the size of its content.
#' @param around Points (as `x` of [draw_lines()]) to which the picture is cropped. NULL: the whole
#'   mesh.
#' @param tolerance Greatest distance behind the surface at which a point is still drawn, as a share
#'   of the diagonal of the mesh's bounding box.
#' @param inside Colour of the backs of triangles. NA: backs are not drawn, and an open surface is
#'   transparent from behind.
#' @return A list of these settings.
#' @template glossary
#' @template experimental
#' @examples
#' str(picture_settings(gloss = 0))
#' @export
picture_settings <- function(light = c(-0.45, 0.55, 1), ambient = 0.3, wrap = 0.4, gloss = 0.1,
                             sharpness = 20,
                             resolution = max(150,
                                              grDevices::dev.size("px") /
                                              grDevices::dev.size("in"),
                                              getOption("crestline.dpi")),
                             samples = 3, margin = 0.02, around = NULL, tolerance = 0.005,
                             inside = NA) {
  if (!is.numeric(light) || length(light) != 3 || any(!is.finite(light)) || all(light == 0)) {
    crestline_abort("`light` is not a direction.", "Give three finite numbers, not all 0.",
                    stage = "picture")
  }
  list(light = unit_vector(light),
       ambient = check_number(ambient, "ambient", 0, 1), wrap = check_number(wrap, "wrap", 0, 1),
       gloss = check_number(gloss, "gloss", 0, 1),
       sharpness = check_number(sharpness, "sharpness", 0),
       resolution = check_number(resolution, "resolution", 1),
       samples = check_count(samples, "samples", upper = 64),
       margin = check_number(margin, "margin", 0),
       around = if (!is.null(around)) point_matrix(around, name = "around"),
       tolerance = check_number(tolerance, "tolerance", 0),
       inside = check_colour(inside, "inside", none = TRUE))
}

picture_surface <- function(mesh, colour, rotation, settings) {
  turned <- rotation %*% mesh$vb[1:3, , drop = FALSE]
  shown <- if (is.null(settings$around)) turned else rotation %*% t(settings$around)
  frame <- picture_frame(shown, settings)
  xyz <- rbind((turned[1, ] - frame$usr[1]) / frame$pixel,
               (frame$usr[4] - turned[2, ]) / frame$pixel, turned[3, ])
  normals <- rotation %*% mesh$normals[1:3, , drop = FALSE]
  tolerance <- settings$tolerance * mesh_diagonal(mesh)
  render <- function(xyz, rgb, it) cpp_render_mesh(
    xyz, rgb, it, frame$width, frame$height, settings$samples
  )
  seen <- render(xyz, shade_vertices(colour, normals, settings), mesh$it)
  if (!is.na(settings$inside)) {
    # Fronts and backs; where a back is seen, what lies on its front side is not, so that its
    # depth is brought forward.
    inside <- rep(settings$inside, ncol(xyz))
    rgb <- cbind(shade_vertices(colour, normals, settings),
                 shade_vertices(inside, -normals, settings))
    both <- render(cbind(xyz, xyz), rgb, cbind(mesh$it, mesh$it[c(1, 3, 2), ] + ncol(xyz)))
    back <- both$depth > seen$depth
    both$depth[back] <- both$depth[back] + 2 * tolerance
    seen <- both
  }
  right <- frame$usr[1] + frame$width * frame$pixel
  bottom <- frame$usr[4] - frame$height * frame$pixel
  graphics::rasterImage(seen$rgba, frame$usr[1], bottom, right, frame$usr[4])
  structure(list(rotation = rotation, pixel = frame$pixel, depth = seen$depth, usr = frame$usr,
                 plt = graphics::par("plt"), tolerance = tolerance),
            class = "picture_scene")
}

# A new plot, equal in scale, that just holds the turned points (3 x n); its limits, and the size of
# a pixel in their unit.
picture_frame <- function(turned, settings) {
  limits <- apply(turned[1:2, , drop = FALSE], 1, range)
  room <- settings$margin * max(limits[2, ] - limits[1, ])
  graphics::plot.new()
  graphics::plot.window(limits[, 1] + c(-room, room), limits[, 2] + c(-room, room), asp = 1,
                        xaxs = "i", yaxs = "i")
  usr <- graphics::par("usr")
  pixels <- pmax(1, ceiling(graphics::par("pin") * settings$resolution))
  check_pixels(prod(pixels) * settings$samples^2, settings$resolution)
  list(usr = usr, width = pixels[1], height = pixels[2],
       pixel = max((usr[2] - usr[1]) / pixels[1], (usr[4] - usr[3]) / pixels[2]))
}

check_pixels <- function(pixels, resolution) {
  most <- argument_limits()$pixels
  if (pixels <= most) return(invisible())
  refuse_argument("resolution", resolution,
                  sprintf("Give less, or fewer `samples`: %.3g pixels, at most %g.", pixels, most))
}

# 3 x n colours in [0, 1] under ambient light, one lamp (Lambert, wrapped) and its highlight (Blinn
# and Phong).
shade_vertices <- function(colour, normals, settings) {
  rgb <- grDevices::col2rgb(colour) / 255
  normals <- normals / rep(pmax(sqrt(colSums(normals^2)), .Machine$double.xmin), each = 3)
  half <- settings$light + c(0, 0, 1)
  half <- unit_vector(half)
  lit <- pmax(0, drop(settings$light %*% normals) + settings$wrap) / (1 + settings$wrap)
  lamp <- settings$ambient + (1 - settings$ambient) * lit
  shine <- settings$gloss * pmax(0, drop(half %*% normals))^settings$sharpness
  pmin(rgb * rep(lamp, each = 3) + rep(shine, each = 3), 1)
}

#' @rdname draw_surface
#' @export
visible_points <- function(scene, x) {
  check_given()
  check_class(scene, "picture_scene", "scene", "draw_surface(engine = \"picture\")")
  seen_from(scene, view_points(scene, point_matrix(x)))
}

view_points <- function(scene, x) x %*% t(scene$rotation)

seen_from <- function(scene, view) {
  column <- floor((view[, 1] - scene$usr[1]) / scene$pixel) + 1
  row <- floor((scene$usr[4] - view[, 2]) / scene$pixel) + 1
  inside <- !is.na(column + row) & column >= 1 & column <= ncol(scene$depth) & row >= 1 &
    row <= nrow(scene$depth)
  depth <- scene$depth[cbind(row, column)[inside, , drop = FALSE]]
  seen <- inside
  seen[inside] <- view[inside, 3] >= depth - scene$tolerance
  seen
}

# Evaluate drawing in the plot region and co-ordinates of the scene, whatever has become of them
# since.
on_scene <- function(scene, drawing) {
  old <- graphics::par(plt = scene$plt, usr = scene$usr, xpd = NA)
  on.exit(graphics::par(old))
  force(drawing)
  invisible(scene)
}

#' @export
draw_lines.picture_scene <- function(scene, x, colour = "black", width = 2, halo = NA,
                                     name = NULL) {
  view <- view_points(scene, point_matrix(x))
  view[!seen_from(scene, view), ] <- NA
  on_scene(scene, {
    if (!is.na(halo)) graphics::lines(view[, 1:2], col = halo, lwd = 2.2 * width)
    graphics::lines(view[, 1:2], col = colour, lwd = width)
  })
}

#' @export
draw_points.picture_scene <- function(scene, x, colour = "black", size = 1, halo = NA,
                                      labels = NULL, name = NULL) {
  x <- point_matrix(x)
  view <- view_points(scene, x)
  seen <- seen_from(scene, view)
  on_scene(scene, {
    at <- view[seen, 1:2, drop = FALSE]
    if (is.na(halo)) graphics::points(at, pch = 16, col = colour, cex = size)
    else graphics::points(at, pch = 21, bg = colour, col = halo, cex = size)
    if (!is.null(labels) && any(seen)) {
      graphics::text(at, labels[seen], pos = 4, offset = 0.3, cex = 0.7 * size, col = colour)
    }
  })
}

#' @export
draw_band.picture_scene <- function(scene, left, right, colour = "black", opacity = 0.4) {
  left <- view_points(scene, point_matrix(left))
  right <- view_points(scene, point_matrix(right))
  seen <- seen_from(scene, left) & seen_from(scene, right)
  on_scene(scene, for (run in runs_of(seen)) {
    corners <- rbind(left[run, 1:2, drop = FALSE], right[rev(run), 1:2, drop = FALSE])
    graphics::polygon(corners, col = grDevices::adjustcolor(colour, opacity), border = NA)
  })
}

# Indices of each unbroken run of TRUE.
runs_of <- function(x) {
  at <- which(x)
  unname(split(at, cumsum(c(TRUE, diff(at) > 1))[seq_along(at)]))
}

# n x 3 co-ordinates from a matrix or from columns x, y, z.
point_matrix <- function(x, name = "x") {
  if (is.data.frame(x) && all(c("x", "y", "z") %in% names(x))) x <- as.matrix(x[c("x", "y", "z")])
  if (!is.matrix(x) || !is.numeric(x) || ncol(x) != 3) {
    refuse_argument(name, x,
                    "Give points: a matrix with three columns or a data frame with x, y and z.")
  }
  x
}
