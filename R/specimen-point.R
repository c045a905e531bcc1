# Points of a specimen by name or place: landmarks and the ends of paths.

#' One landmark as a point on the specimen's mesh
#'
#' @param specimen A specimen.
#' @param name Name of the landmark.
#' @param tolerance As in [specimen()], for landmarks changed since.
#' @return One-row data frame `x, y, z, face, w1, w2, w3`.
#' @noRd
landmark_point <- function(specimen, name, tolerance = 0.01) {
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  found_landmark(specimen, name, tolerance)
}

#' The same of a specimen that has passed the door
#' @noRd
found_landmark <- function(specimen, name, tolerance = 0.01) {
  id <- specimen$id
  known <- rownames(specimen$landmarks)
  if (!is.character(name) || length(name) != 1 || is.na(name) || !name %in% known) {
    refuse_landmarks(sprintf("there is no landmark %s.", describe_value(name)),
                     near_names(name, known), id)
  }
  at <- specimen$landmarks[name, ]
  if (anyNA(at)) {
    refuse_landmarks(sprintf("landmark %s is missing (NA) on this specimen.", name),
                     "Place it, or choose curves that do without it.", id)
  }
  before <- match(name, rownames(specimen$geometry$landmarks))
  if (!is.na(before) && identical(unname(at), unname(specimen$geometry$landmarks[before, ]))) {
    return(specimen$geometry$located[before, ])
  }
  landmarks <- as_landmarks(specimen$landmarks[name, , drop = FALSE], id)
  check_landmarks(landmarks, specimen$mesh, id, tolerance, character(),
                  size = specimen_size(specimen))$located
}

end_point <- function(mesh, at, name) {
  if (is.character(at) && inherits(mesh, "specimen")) {
    known <- rownames(mesh$landmarks)
    if (!all(at %in% known)) {
      refuse_landmarks(sprintf("there is no landmark %s (`%s`).", describe_value(at), name),
                       near_names(at, known), mesh$id)
    }
    return(landmark_point(mesh, at))
  }
  if (is.data.frame(at) && all(mesh_columns %in% names(at)) &&
      nrow(at) == 1) return(checked_point(mesh, at, name))
  if (!is.numeric(at) || length(at) != 3 || !all(is.finite(at))) {
    crestline_abort(sprintf("`%s` is %s.", name, describe_value(at)),
                    "Give the name of a landmark of a specimen, or three finite co-ordinates.",
                    stage = "path", class = "crestline_path_error", call = NULL)
  }
  surface_points(as_mesh(mesh), matrix(at, 1))
}

end_name <- function(at) {
  if (is.character(at)) return(at)
  sprintf("(%s)", paste(signif(unlist(at[1:3]), 4), collapse = ", "))
}

#' An end of a path as one row of its columns
#' @noRd
end_vector <- function(mesh, surface, at, name) {
  if (is.numeric(at) && identical(names(at), mesh_columns)) {
    check_places(t(at), surface, sprintf("`%s`", name), surface$id)
    return(at)
  }
  unlist(unclass(end_point(mesh, at, name))[mesh_columns])
}

#' One row of a point on a mesh, after a check that it lies on this one
#' @noRd
checked_point <- function(mesh, at, name) {
  name <- sprintf("`%s`", name)
  if (!is.null(attr(at, "key"))) check_same_mesh(at, mesh, name)
  if (anyNA(at$face)) {
    crestline_abort(sprintf("%s is missing (NA).", name), "Choose a point that is there.",
                    stage = "path",
                    id = mesh_of(mesh)$id, class = "crestline_path_error", call = NULL)
  }
  check_places(at, passed_mesh(as_mesh(mesh), NULL), name, mesh_of(mesh)$id)
  at[mesh_columns]
}
