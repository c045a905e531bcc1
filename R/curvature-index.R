# From two principal curvatures to one number for the kind of shape and one for its amount.

#' Shape index and curvedness
#'
#' The shape index describes the kind of shape of a place, independent of its size. The scale runs
#' from -1 (a cup) over -0.5 (a rut, or valley), 0 (a symmetric saddle) and 0.5 (a ridge) to 1 (a
#' cap): \deqn{S = \frac{2}{\pi} \arctan \frac{k_1 + k_2}{k_2 - k_1}, \quad k_1 \ge k_2.}{S = (2/pi)
#' atan((k1 + k2)/(k2 - k1)), k1 >= k2.} The curvedness \eqn{\sqrt{(k_1^2 + k_2^2)/2}}{sqrt((k1^2 +
#' k2^2)/2)} is the amount of curvature.
#'
#' The formula as printed in the paper gives values in \[0, 1\]. The paper's text has cups at -1 and
#' caps at 1. The formula here follows the text.
#'
#' @param x A `curvature`, as [curvature()] returns it, or a numeric vector of principal
#'   curvatures, in 1 / the unit of length; positive where the surface bends towards its normal.
#' @param k2 The other principal curvatures, as many as in `x`, when `x` is numeric. The greater of
#'   the two at each place is taken as k1.
#' @return A numeric vector with one value for each place. `shape_index()`: in \[-1, 1\], without
#'   unit. It is NA if the surface is plane (both curvatures are 0) or a curvature is NA.
#'   `curvedness()`: in 1 / the unit of length.
#' @template glossary
#' @templateVar where section 2
#' @template paper
#' @references Koenderink, J. J. and van Doorn, A. J. (1992) Surface shape and curvature scales.
#'   *Image and Vision Computing* 10(8), 557-564.
#' @seealso [shape_category()] for the names of the shapes, [plot_shape_scale()] for their colours.
#' @examples
#' shape_index(c(1, 1, 1, 0), c(1, 0, -1, -1))
#' curvedness(c(1, 1, 1, 0), c(1, 0, -1, -1))
#' @export
shape_index <- function(x, k2 = NULL) {
  check_given()
  k <- principal_pair(x, k2)
  index <- -2 / pi * atan2(k$k1 + k$k2, k$k1 - k$k2)
  index[k$k1 == 0 & k$k2 == 0] <- NA
  index
}

#' @rdname shape_index
#' @export
curvedness <- function(x, k2 = NULL) {
  check_given()
  k <- principal_pair(x, k2)
  sqrt((k$k1^2 + k$k2^2) / 2)
}

principal_pair <- function(x, k2) {
  if (inherits(x, "curvature") && is.numeric(x$k1) && is.numeric(x$k2)) return(x[c("k1", "k2")])
  if (!is.numeric(x) || !is.numeric(k2) || length(x) != length(k2)) {
    crestline_abort("`x` and `k2` are not two numeric vectors of one length.",
                    "Give a `curvature` as `x`, or k1 as `x` and k2 as `k2`.",
                    stage = "curvature")
  }
  list(k1 = pmax(x, k2), k2 = pmin(x, k2))
}

# Koenderink and van Doorn (1992), their figure of the scale: from cup to cap in steps of 1/4.
shape_scale <- function(palette = "safe") {
  data.frame(
    category = c("spherical cup", "trough", "rut", "saddle rut", "saddle", "saddle ridge", "ridge",
                 "dome", "spherical cap"),
    index = seq(-1, 1, by = 0.25),
    colour = if (is.character(palette) && length(palette) == 1) shape_palettes[[palette]] else {
      grDevices::colorRampPalette(palette)(9)
    }
  )
}

# "safe": any two of the nine are at least 25 apart (CIE 1976) for eyes without red or green cones.
shape_palettes <- list(
  paper = c("#00C800", "#00E6E6", "#3C50FF", "#A9C4FF", "#FFFFFF", "#FFF7A8", "#FFE600", "#FF9100",
            "#E60000"),
  safe = c("#00153F", "#1B3FA0", "#3E7BFF", "#A3C2FF", "#FFFFFF", "#FFEE8C", "#E8B400", "#A36A00",
           "#4A1F00")
)

#' A palette of the shape index: a name, or colours
#' @noRd
check_shape_palette <- function(palette) {
  if (is.null(palette)) palette <- getOption("crestline.palette", "safe")
  if (is.character(palette) && length(palette) == 1) {
    return(check_choice(palette, names(shape_palettes), "palette"))
  }
  if (length(palette) < 2) {
    refuse_argument("palette", palette, "Give \"safe\", \"paper\", or two colours or more.")
  }
  check_colour(palette, "palette")
}

#' Names and colours of shapes
#'
#' Koenderink and van Doorn divide the shape index into nine named categories, centred at -1, -0.75,
#' ..., 1. Each is 1/4 wide; the two at the ends are half as wide. Their colours are those of the
#' palette "safe": valleys are blue, darker towards the cup, saddles are white, and ridges are
#' yellow, darker towards the cap. Any two of the nine can be told apart by eyes without red or
#' green cones. The palette "paper" has the colours of the paper: cup green, trough cyan, rut blue,
#' saddle rut pale blue, saddle white, saddle ridge pale yellow, ridge yellow, dome orange, cap red.
#'
#' @param index Numeric vector of shape indices, in \[-1, 1\] or NA.
#' @param missing Colour for an index that is NA.
#' @param palette "safe", "paper", or two or more colours from cup to cap, evenly spaced. NULL: that
#'   of `options(crestline.palette = )`, "safe" if it is not set.
#' @return `shape_category()`: a factor with nine levels, from "spherical cup" to "spherical cap",
#'   one value for each index. A value on a limit belongs to the category above it.
#'   `shape_colours()`: colours `#RRGGBB`, one for each index. The centre of a category has its
#'   colour; colours between are interpolated linearly in red, green and blue.
#' @inherit shape_index references
#' @template glossary
#' @examples
#' shape_category(c(-1, -0.5, 0, 0.5, 1))
#' shape_colours(c(-1, -0.5, 0, 0.5, 1, NA))
#' @export
shape_category <- function(index) {
  check_given()
  check_index(index)
  scale <- shape_scale()
  limits <- c(-1, scale$index[-1] - 1 / 8, 1)
  factor(scale$category[findInterval(index, limits, rightmost.closed = TRUE)], scale$category)
}

#' @rdname shape_category
#' @export
shape_colours <- function(index, missing = "#BEBEBE", palette = NULL) {
  check_given()
  missing <- check_colour(missing, "missing")
  check_index(index)
  ramp_colours((index + 1) / 2, shape_scale(check_shape_palette(palette))$colour, missing)
}

check_index <- function(index) {
  number <- is.null(dim(index)) && (is.numeric(index) || (is.logical(index) && all(is.na(index))))
  if (!number || any(abs(index) > 1, na.rm = TRUE)) {
    crestline_abort("`index` is not a vector of numbers in [-1, 1].",
                    "Compute it with shape_index().", stage = "curvature")
  }
}
