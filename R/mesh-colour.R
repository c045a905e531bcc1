# Natural colour of the vertices: kept from the mesh, or taken from an image.

# One "#RRGGBB" a vertex, or NULL. rgl and Rvcg keep one colour a vertex, a corner, or for the whole
# mesh.
vertex_colours <- function(mesh) {
  colour <- as.vector(mesh$material$color)
  n <- ncol(mesh$vb)
  if (length(colour) == n) return(colour)
  if (length(mesh$it) && length(colour) == length(mesh$it) &&
      isTRUE(all(mesh$it >= 1 & mesh$it <= n))) {
    by_vertex <- rep(NA_character_, n)
    by_vertex[mesh$it[rev(seq_along(colour))]] <- rev(colour)
    return(ifelse(is.na(by_vertex), "#BFBFBF", by_vertex))
  }
  if (length(colour) == 1) rep(colour, n)
}

# n x 3 numbers, 0 to 255, or 0 to 1 where none is greater, as hex colours; not numbers give grey.
colour_hex <- function(rgb, top = if (max(rgb, 0, na.rm = TRUE) > 1) 255 else 1) {
  rgb <- pmin(pmax(rgb / top, 0), 1)
  rgb[!is.finite(rgb)] <- 0.75
  grDevices::rgb(rgb[, 1], rgb[, 2], rgb[, 3])
}

#' Colours of an image at texture co-ordinates
#'
#' @param image h x w x channels array of numbers in 0 to 1 (1 or 2 channels: grey), first row on
#'   top.
#' @param uv n x 2 matrix; (0, 0) is the lower left corner, (1, 1) the upper right; the image
#'   repeats beyond.
#' @return n hex colours, those of the nearest pixels.
#' @noRd
sample_image <- function(image, uv) {
  if (length(dim(image)) == 2) dim(image) <- c(dim(image), 1)
  wrapped <- ifelse(uv >= 0 & uv <= 1, uv, uv - floor(uv))
  column <- pmin(floor(wrapped[, 1] * dim(image)[2]) + 1, dim(image)[2])
  row <- pmin(floor((1 - wrapped[, 2]) * dim(image)[1]) + 1, dim(image)[1])
  channel <- if (dim(image)[3] >= 3) 1:3 else c(1, 1, 1)
  colour_hex(vapply(channel, function(i) image[cbind(row, column, i)],
                    numeric(nrow(uv))) |> matrix(ncol = 3), top = 1)
}

# A jpg or png as an array, or NULL with a warning: a picture is never worth a specimen.
read_image <- function(file, id) {
  reader <- switch(file_extension(file), jpg = , jpeg = "jpeg", png = "png", "none")
  problem <- if (!file.exists(file)) "the texture image %s is not there" else
    if (reader == "none") "the texture image %s is neither jpg nor png" else
      if (!requireNamespace(reader,
                            quietly = TRUE)) paste0("the texture image %s needs the package ",
                                                    reader)
  # A pipe, which would keep R waiting, has no size.
  image <- if (is.null(problem) && isTRUE(file.size(file) > 0)) tryCatch(
    if (reader == "jpeg") jpeg::readJPEG(file) else png::readPNG(file), error = function(e) NULL
  )
  if (is.null(image)) {
    if (is.null(problem)) problem <- "the texture image %s cannot be read"
    crestline_warn(paste0(sprintf(problem, basename(file)),
                          "; the specimen has no natural colour."),
                   "Put it beside the .mtl file, convert it, or install what is missing.",
                   stage = "reading", id = id)
  }
  image
}

#' One colour for each vertex of a mesh
#'
#' @param colour One colour, one for each vertex, "patch", or a number for each vertex.
#' @param palette,limits,missing Of numbers, see [write_mesh()].
#' @noRd
surface_colours <- function(mesh, colour, palette = grDevices::hcl.colors(11, "Viridis"),
                            limits = NULL, missing = "#BEBEBE", apart = 0.618) {
  if (identical(colour, "patch")) {
    # A colour for each patch, grey where there are strips only. `apart`: hues of patches that
    # follow one another are this share of the palette apart (the golden ratio, so that none of
    # the next few is near).
    group <- attr(mesh, "group")
    if (is.null(group)) {
      crestline_abort("the mesh has no patches.", "Give a shape, or what shape_mesh() returns.",
                      stage = "colours",
                      call = NULL)
    }
    patches <- unique(group[!startsWith(group, "strip ")])
    n <- length(patches)
    hues <- grDevices::hcl.colors(n, "Dark 3")[rank((seq_len(n) * apart) %% 1)]
    colours <- rep("#BEBEBE", ncol(mesh$vb))
    own <- group %in% patches
    colours[mesh$it[, own]] <- rep(hues[match(group[own], patches)], each = 3)
    return(colours)
  }
  if (!is.numeric(colour)) return(check_colours(colour, ncol(mesh$vb)))
  if (is.null(limits)) limits <- if (any(is.finite(colour))) range(colour[is.finite(colour)]) else
    0:1
  span <- max(limits[2] - limits[1], .Machine$double.xmin)
  share <- ifelse(is.finite(colour), pmin(pmax((colour - limits[1]) / span, 0), 1), NA)
  ramp_colours(share, palette, missing)
}

# Colours at shares x of the way through `anchors`.
ramp_colours <- function(x, anchors, missing) {
  out <- rep(missing, length(x))
  known <- !is.na(x)
  out[known] <- grDevices::rgb(grDevices::colorRamp(anchors)(x[known]), maxColorValue = 255)
  out
}
