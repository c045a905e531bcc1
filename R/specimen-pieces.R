# A scan in several pieces: whether a large one is without landmarks, as a second face would be.

#' Warn of a piece of the mesh that is large, and without a landmark while another piece has some
#'
#' Two skins of one surface are pieces too; of these there is a warning already.
#'
#' @param x A `specimen`, its landmarks located.
#' @param share Least share of the triangles (no unit). The scraps of scans have less than 0.01; two
#'   like objects have 0.5 each.
#' @noRd
warn_bare_piece <- function(x, share = 0.2) {
  piece <- x$geometry$piece
  face <- x$geometry$located$face
  face <- face[!is.na(face)]
  skins <- x$report$count[x$report$check == "per cent of the surface with a second skin"]
  if (!length(face) || max(piece) == 1 || any(skins > 0)) return(invisible())
  size <- tabulate(piece) / length(piece)
  size[unique(piece[face])] <- 0
  if (max(size) < share) return(invisible())
  crestline_warn(
    sprintf("a piece of the mesh with %.0f %% of the triangles has no landmark.", 100 * max(size)),
    paste("Is it a second object of the same kind? Its curves are not measured. Keep one piece:",
          "Rvcg::vcgIsolated(mesh, split = TRUE) gives them one by one."),
    stage = "landmarks", id = x$id, class = "crestline_bare_piece"
  )
}
