# Red parts of a sample: a warning names them, and they are left out on demand.

#' The shapes as they go into the sample: with their red parts, after a warning or none, or without
#' @param red As in [homologise()].
#' @noRd
with_red <- function(shapes, red, limits) {
  if (red == "keep") return(shapes)
  parts <- red_parts(shapes, limits)
  if (red == "warn") {
    warn_red(parts, "homologise", paste(
      "quality(shapes) has the reasons. Leave these parts out with red = \"leave out\", or",
      "keep them without a warning with red = \"keep\"."
    ))
    return(shapes)
  }
  lapply(shapes, function(shape) without_parts(shape, parts[parts$specimen == shape$id, ]))
}

#' A shape without some parts, as if they could not be measured
#'
#' Landmarks that are not among the parts stay, also at the ends of a curve that goes. What hangs on
#' a curve goes with it: the points of patches on it, and, when the patches are cut again, their
#' columns that begin there.
#'
#' @param parts Rows of [quality()].
#' @noRd
without_parts <- function(shape, parts) {
  if (!NROW(parts)) return(shape)
  gone <- paste(parts$level, parts$part)
  points <- shape$points
  place <- shape$scheme$points$place
  own <- paste(points$level, points$part) %in% gone
  held <- place[!own & points$level == "landmarks" | !own & points$level == "curves" &
                  !place %in% place[own & points$level != "surface"]]
  lost <- place %in% setdiff(place[own], held)
  shape$points[lost, intersect(c(mesh_columns, "se"), names(points))] <- NA
  curves <- parts$part[parts$level == "curves"]
  shape$paths[curves] <- list(NULL)
  shape$tracks <- shape$tracks[setdiff(names(shape$tracks), curves)]
  row <- match(gone, paste(shape$status$level, shape$status$part))
  shape$status$ok[row] <- FALSE
  shape$status$reason[row] <- paste("left out, as it is red:", parts$why)
  shape$checks$missing <- missing_share(shape)
  shape
}

#' Points inside the patches that were left out of a shape: not those of landmarks and curves
#' @noRd
places_left_out <- function(shape) {
  left <- startsWith(as.character(shape$status$reason), "left out, as it is red") &
    shape$status$level == "surface"
  points <- shape$scheme$points
  own <- points$place[points$level == "surface" & points$part %in% shape$status$part[which(left)]]
  setdiff(own, bound_places(shape$scheme))
}
