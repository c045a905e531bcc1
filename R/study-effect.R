# Where the groups of simulated faces differ, and by how much.

#' Places at which the simulated groups of faces differ
#'
#' Gives the table of places at which the two groups of [simulate_faces()] differ by default. You
#' can change it and give it to that function. One place is the middle of each brow ridge, which is
#' more prominent in the second group (`share` 1). The other is the cheek between the curves from
#' nose and mouth to the ear, which is flatter (`share` -1). No radius (26 and 24 mm) reaches a
#' landmark. The curves get at most a third of the cheek's difference.
#'
#' @return Data frame `part`, `x, y, z` (in the frame of Rvcg's `humface`, mm), `radius` (mm),
#'   `share`.
#' @template glossary
#' @template experimental
#' @seealso [simulate_faces()]
#' @examples
#' face_effect()
#' @export
face_effect <- function() {
  utils::read.csv(system.file("extdata", "face_effect.csv", package = "crestline", mustWork = TRUE))
}

no_places <- function() {
  data.frame(part = character(), x = numeric(), y = numeric(), z = numeric(), radius = numeric(),
             share = numeric())
}

#' The places of an effect on a template, with directions
#' @noRd
effect_places <- function(places, template) {
  wanted <- names(no_places())
  lacking <- if (is.data.frame(places)) setdiff(wanted, names(places)) else wanted
  numbers <- if (!length(lacking)) data.matrix(places[wanted[-1]])
  counted <- !length(lacking) && all(vapply(places[wanted[-1]], is.numeric, NA))
  if (!counted || !all(is.finite(numbers)) || any(places$radius <= 0)) {
    crestline_abort("`places` does not say where, how wide and how strong.",
                    paste0("Give a data frame as face_effect() does: part, x, y, z, radius (above ",
                           "0), share."),
                    stage = "arguments")
  }
  at <- surface_points(template$mesh, numbers[, c("x", "y", "z")])
  if (!all(c("dx", "dy", "dz") %in% names(places))) {
    normals <- list(vb = template$mesh$normals, it = template$mesh$it)
    normal <- place_on_faces(normals, at$face, as.matrix(at[c("w1", "w2", "w3")]))
    places[c("dx", "dy", "dz")] <- as.data.frame(normal / row_lengths(normal))
  }
  places[c("x", "y", "z")] <- at[c("x", "y", "z")]
  places$part <- as.character(places$part)
  places
}

#' @return Named numeric, one for each part.
#' @noRd
effect_by_part <- function(effect, parts) {
  named <- !is.null(names(effect))
  ok <- is.numeric(effect) && all(is.finite(effect)) &&
    (if (named) all(names(effect) %in% parts) else length(effect) == 1)
  if (!ok || (length(parts) == 0 && any(effect != 0))) {
    there <- if (length(parts)) shorten(parts) else "no part"
    crestline_abort(sprintf("`effect` is %s, with %s in `places`.", describe_value(effect), there),
                    paste0("Give one number, or numbers with names of parts; and `places` where ",
                           "the template is your own."),
                    stage = "arguments")
  }
  if (!named) return(stats::setNames(rep(effect, length(parts)), parts))
  found <- stats::setNames(numeric(length(parts)), parts)
  found[names(effect)] <- effect
  found
}

effect_field <- function(places, effect) {
  places$share <- places$share * effect[places$part]
  bump_field(places)
}
