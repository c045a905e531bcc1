# Where every point of a simulated face truly is.

#' True places of the template's points on simulated faces
#'
#' @param x A `simulated_faces`, as [simulate_faces()] returns it.
#' @param at Places of the template: k x 3 matrix or data frame `x`, `y`, `z`, in the unit of the
#'   template. An example is `coords(fit_shape(faces$template, scheme), "curves")`. `NULL`: its
#'   landmarks.
#' @return `true_points()`: k x 3 x n array, with the names of `at` and of the faces, without noise,
#'   in the frame of each face. `true_effect()`: k x 3 matrix, the displacement from the mean of the
#'   first group to the mean of the second, without the effect of size. Both are in the unit of the
#'   template.
#' @section Errors: of class `crestline_error`: `x` is not a `simulated_faces`, or `at` has no
#'   points.
#' @template glossary
#' @template experimental
#' @seealso [simulate_faces()]
#' @examples
#' faces <- simulate_faces(4, effect = c(brow = 2), scan = NULL, seed = 1)
#' dim(true_points(faces))
#' places <- face_effect()
#' cbind(places["part"], true_effect(faces, places[c("x", "y", "z")])) # 2 mm along the normal
#' max(abs(true_effect(faces))) # no landmark has any of it
#' @export
true_points <- function(x, at = NULL) {
  check_given()
  at <- template_points(x, at)
  each <- lapply(x$deformations, function(map) map(at))
  array(unlist(each), c(dim(at), length(each)), list(rownames(at), c("x", "y", "z"), names(each)))
}

#' @rdname true_points
#' @export
true_effect <- function(x, at = NULL) {
  check_given()
  at <- template_points(x, at)
  step <- effect_field(x$places, x$effect)(at)
  structure(step, dimnames = list(rownames(at), c("x", "y", "z")))
}

template_points <- function(x, at) {
  check_class(x, "simulated_faces", "x", "simulate_faces()")
  if (is.null(at)) return(x$template$landmarks)
  point_matrix(at, "at")
}
