# A picture for print: a file of a size in centimetres, with title, legend and scale bar.

#' Write a picture for print
#'
#' Draws an object by `plot()` with the engine "picture" into a file: PNG or TIFF with pixels, PDF
#' with the surface as pixels and all else as lines and text. A scale bar below it has the unit of
#' the mesh.
#'
#' @param x Anything that `plot()` draws: a [specimen()], a `shape`, a comparison.
#' @param file Path of the file, ending in `.png`, `.tiff` or `.pdf`.
#' @param ... Arguments of its `plot()`, such as the specimen of a shape, `what`, `view`, and
#'   settings of [picture_settings()].
#' @param title Title above the picture. NULL: none.
#' @param size Width and height in cm, two numbers.
#' @param dpi Pixels per inch, of the surface in a PDF too (there at least 150).
#' @param unit Name of the unit of the mesh, for the scale bar.
#' @param ruler Whether to draw the scale bar. Pictures without a surface have none.
#' @return The path of the file, invisibly.
#' @section Errors: of class `crestline_error`: the file has another ending, or its folder does not
#'   exist; those of `plot()`.
#' @template glossary
#' @seealso [plot.specimen()], [plot.shape()], [write_page()] for the browser
#' @examples
#' ball <- specimen(Rvcg::vcgSphere(3), id = "ball")
#' file <- tempfile(fileext = ".png")
#' write_picture(ball, file, title = "A ball", size = c(8, 8), dpi = 150, unit = "radii")
#' file.size(file)
#' unlink(file)
#' @export
write_picture <- function(x, file, ..., title = NULL, size = c(16, 14), dpi = 300, unit = "mm",
                          ruler = TRUE) {
  check_given()
  file <- check_path_to_write(file, "file", c("png", "tiff", "pdf"), "picture")
  title <- check_text(title, "title", null = TRUE)
  size <- check_numbers(size, "size", 2, lower = 0.5, upper = 200)
  dpi <- check_number(dpi, "dpi", lower = 10, upper = 2400)
  unit <- check_text(unit, "unit")
  check_flags(ruler)
  more <- list(...)
  check_pixels(prod(size / 2.54) * dpi^2, dpi)
  more$engine <- "picture"
  # The key of a map names the unit too
  map <- inherits(x, "group_comparison") && identical(more$what, "map")
  if (map && !missing(unit) && is.null(more$length_unit)) more$length_unit <- unit
  made <- tempfile(fileext = paste0(".", file_extension(file)))
  # A PDF has no pixels of its own
  old <- options(crestline.dpi = dpi)
  on.exit({
    unlink(made)
    options(old)
  })
  before <- grDevices::dev.cur()
  open_device(made, size / 2.54, dpi)
  tryCatch({
    graphics::par(oma = c(if (ruler) 2.2 else 0, 0, if (is.null(title)) 0 else 2, 0))
    scene <- do.call(plot, c(list(x), more), quote = TRUE)
    if (!is.null(title)) graphics::mtext(title, 3, outer = TRUE, line = 0.4, cex = 1.2)
    if (ruler && inherits(scene, "picture_scene")) draw_ruler(scene, unit)
  }, finally = {
    grDevices::dev.off()
    if (before > 1) grDevices::dev.set(before)
  })
  if (!file.copy(made, file, overwrite = TRUE)) refuse_page(file)
  invisible(file)
}

open_device <- function(file, inches, dpi) {
  type <- if (capabilities("cairo")) "cairo" else getOption("bitmapType")
  switch(file_extension(file),
         png = grDevices::png(file, inches[1], inches[2], "in", res = dpi, type = type),
         tiff = grDevices::tiff(file, inches[1], inches[2], "in", res = dpi, type = type,
                                compression = "lzw"),
         pdf = grDevices::pdf(file, inches[1], inches[2]))
}

#' A bar below the scene, of a round length near a share of its width
#' @noRd
draw_ruler <- function(scene, unit, share = 0.2) {
  width <- scene$pixel * ncol(scene$depth)
  length <- round_length(share * width)
  on_scene(scene, {
    line <- diff(graphics::grconvertY(0:1, "lines", "user"))
    left <- mean(scene$usr[1:2]) - length / 2
    below <- scene$usr[3] - 0.7 * line
    graphics::rect(left, below - 0.12 * line, left + length, below + 0.12 * line, col = "black",
                   border = NA)
    graphics::text(left + length / 2, below - 0.8 * line, paste(format(length), unit), cex = 0.85)
  })
}

#' 1, 2 or 5 times a power of ten, the greatest that is not above a length
#' @noRd
round_length <- function(x) {
  power <- 10^floor(log10(x))
  power * max(c(1, 2, 5)[c(1, 2, 5) * power <= x * (1 + 1e-9)])
}
