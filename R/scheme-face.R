# The scheme of the human face.

#' The facial model: 23 landmarks, 40 curves, 922 surface points
#'
#' The model of the paper. It has 467 curve points, and 29 patches with 922 points at 907 places.
#' There are 1,602 triangles; 36 more close the nose from below, and 38 close the eyes. Lengths are
#' in mm. [read_scheme()] reads the tables from the package's folder `extdata/face_scheme`. Copy the
#' folder to make a scheme of your own.
#'
#' The landmarks are pn, acL, acR, sn, se, n, exL, exR, enL, enR, tL, tR, ls, cphL, cphR, chL, chR,
#' st, li, sl, gn, oiL and oiR. `as.data.frame(face_scheme(), "landmarks")` gives their full names
#' and positions. The landmark n is here the midline point at the level of the brow ridge, as in the
#' authors' data. It lies above the nasion of anthropometry.
#'
#' Of the 40 curves 14 are found by curvature: 12 ridges and 2 valleys. The other 26 are shortest
#' plane cuts between landmarks (column `kind`). On 23 faces in dense correspondence these cuts were
#' closer to the corresponding line than a curve by curvature. "lower eye socket" runs along the
#' margin of the lower lid. "nasal bridge" runs from the tip of the nose over its wing.
#'
#' To change the radius of a curve, change its table: `tables <- face_scheme()`,
#' `tables$curves$radius[tables$curves$curve == "lower lip left"] <- 7`, and the same on the right
#' side. Use one scheme for all specimens.
#'
#' Left is the subject's own left. The five curves on each side that start at the ear (`t`, `oi`)
#' are cut off at a multiple of the distance between the inner corners of the eyes. Some curves are
#' of another kind than in the authors' model (column `authors_kind`). Column `note` has the reason.
#'
#' @return A [curve_scheme()].
#' @template glossary
#' @templateVar where Fig. 1 (23 landmarks and 467 curve points) and Fig. 6 (922 surface points)
#' @template paper
#' @details The paper does not list its curves and patches; they were read from its authors' data.
#' @examples
#' face_scheme()
#' @export
face_scheme <- function() {
  once("face scheme", function() {
    read_scheme(system.file("extdata", "face_scheme", package = "crestline", mustWork = TRUE),
                name = "face")
  })
}
