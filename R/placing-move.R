# A landmark of a specimen moved to another place of its mesh, or taken away.

#' Move a landmark, or add one
#'
#' @param specimen A specimen.
#' @param name Name of the landmark.
#' @param point One-row data frame `x, y, z, face, w1, w2, w3`, a place on the specimen's mesh;
#'   NULL: the landmark is not on this specimen.
#' @return The specimen. Where it has `placing`, the landmark's state there is "placed" or "absent",
#'   and what was measured of its finding is NA.
#' @noRd
move_landmark <- function(specimen, name, point) {
  if (is.null(point)) point <- surface_points(specimen$mesh, rep(NA_real_, 3))
  there <- isTRUE(!is.na(specimen$landmarks[match(name, rownames(specimen$landmarks)), 1]))
  same <- there &&
    identical(unname(specimen$landmarks[name, ]), unname(unlist(point[c("x", "y", "z")])))
  specimen <- with_landmark_at(specimen, name, point)
  specimen <- with_origin(
    specimen, name, if (there && !same) "moved" else "placed", time = time_stamp()
  )
  if (!is.null(specimen$placing)) {
    specimen$placing <- moved_placing(specimen$placing, name, unlist(point[c("x", "y", "z")]))
  }
  specimen
}

#' A specimen with one landmark at a point of its mesh, whoever put it there
#' @noRd
with_landmark_at <- function(specimen, name, point) {
  at <- unlist(point[c("x", "y", "z")])
  specimen$landmarks <- with_row(
    specimen$landmarks, match(name, rownames(specimen$landmarks), nrow(specimen$landmarks) + 1), at,
    name
  )
  known <- specimen$geometry
  row <- match(name, rownames(known$landmarks), nrow(known$landmarks) + 1)
  known$landmarks <- with_row(known$landmarks, row, at, name)
  known$located[row, mesh_columns] <- point[mesh_columns]
  specimen$geometry <- known
  specimen
}
