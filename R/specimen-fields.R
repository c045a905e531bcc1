# The fields of a specimen: which there are, what they may hold, how they are changed.

#' Refuse a specimen whose mesh, landmarks or neighbours were changed behind its back
#'
#' What was validated lately is known again by its place in memory, see [passed_mesh()].
#' @noRd
validate_specimen <- function(x) {
  if (passed_lately(x, "specimen")) return(invisible(x))
  whole <- is.list(x) && all(c("id", "mesh", "landmarks", "geometry") %in% names(x))
  if (!whole) refuse_specimen("a specimen lacks its mesh, landmarks or id.", if (is.list(x)) x$id)
  known <- passed_mesh(x$mesh, x$id)
  if (!is.null(x$key) && !identical(x$key, known$key)) {
    refuse_specimen(paste("its mesh was changed since it was checked: landmarks and neighbours",
                          "are those of the mesh before."), x$id)
  }
  if (!fits_vertices(x$mesh$normals,
                     ncol(known$vb))) refuse_specimen("its normals do not fit its vertices.", x$id)
  if (!is_landmark_matrix(x$landmarks)) {
    refuse_specimen(paste("its landmarks are no k x 3", "numeric matrix with row names."), x$id)
  }
  validate_geometry(x$geometry, known, x$id)
  remember_passed(x, "specimen")
}

#' @exportS3Method
validate.specimen <- function(x) validate_specimen(x)

refuse_specimen <- function(problem, id) {
  id <- if (is.character(id) && length(id) == 1) id
  crestline_abort(problem, "Make it anew: specimen(mesh, landmarks, id).", stage = "specimen",
                  id = id,
                  class = "crestline_changed_specimen", call = NULL)
}

is_landmark_matrix <- function(x) {
  is.numeric(x) && is.matrix(x) && ncol(x) == 3 &&
    (nrow(x) == 0 || !is.null(rownames(x)) && !anyDuplicated(rownames(x)))
}

#' @param known As of [passed_mesh()].
#' @noRd
validate_geometry <- function(geometry, known, id) {
  right <- is.list(geometry) && all(c("twin", "piece", "landmarks", "located") %in% names(geometry))
  if (!right) refuse_geometry(id)
  if (!is_the_same(geometry$twin, known$twin) || !is_the_same(geometry$piece, known$piece)) {
    validate_topology(geometry, known$it, id)
    known$twin <- geometry$twin
    known$piece <- geometry$piece
  }
  if (!is_the_same(geometry$located, known$located)) {
    validate_located(geometry, known, id)
    known$located <- geometry$located
  }
}

validate_topology <- function(geometry, it, id) {
  right <- is.integer(geometry$twin) && identical(dim(geometry$twin), dim(it)) &&
    is.numeric(geometry$piece) && length(geometry$piece) == ncol(it)
  if (!right || cpp_twin_faults(it, geometry$twin) > 0) refuse_geometry(id)
}

validate_located <- function(geometry, known, id) {
  right <- is_landmark_matrix(geometry$landmarks) && is.data.frame(geometry$located) &&
    nrow(geometry$located) == nrow(geometry$landmarks)
  if (!right) refuse_geometry(id)
  check_places(geometry$located, known, "its landmarks", id)
}

refuse_geometry <- function(id) refuse_specimen("its `geometry` is not that of its mesh.", id)

#' Change a field of a specimen
#'
#' `specimen$landmarks["tL", ] <- c(x, y, z)` moves a landmark. `specimen$landmarks <-
#' rbind(specimen$landmarks, tL = c(x, y, z))` adds one. Functions that use the landmark put it on
#' the surface. `specimen$mesh <- other` replaces the mesh. New colours or normals are taken as they
#' are. New vertices or triangles are checked as by [specimen()], and the landmarks are put on them
#' or refused. The fields `report` and `key` are updated.
#'
#' @param x A [specimen()].
#' @param name,i Name of a field.
#' @param value New value of the field.
#' @return The specimen.
#' @section Errors: of class `crestline_error`: the landmarks are not a k x 3 numeric matrix with
#'   row names; [specimen()] refuses the mesh; specimens have no such field.
#' @template glossary
#' @seealso [specimen()]
#' @examples
#' ball <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1)), id = "ball")
#' ball$landmarks["top", ] <- c(0, 0.6, 0.8)
#' ball
#' @rdname specimen-fields
#' @aliases specimen-fields
#' @export
`$<-.specimen` <- function(x, name, value) {
  known <- union(names(formals(new_specimen)), names(unclass(x)))
  if (!name %in% known) {
    crestline_abort(sprintf("a specimen has no field %s.", name),
                    sprintf("Its fields are %s.", shorten(known, 20)),
                    stage = "specimen", id = x$id, call = NULL)
  }
  if (name == "mesh") return(with_other_mesh(x, value))
  if (name == "key") {
    crestline_abort("the key of a specimen is worked out from its mesh.",
                    "Change `mesh`, not `key`.", stage = "specimen",
                    id = x$id, call = NULL)
  }
  if (name == "landmarks") value <- as_landmarks(value, x$id)
  if (name == "id") value <- check_id(value)
  fields <- unclass(x)
  if (name == "landmarks") fields["origin"] <- list(origin_after(x, value))
  fields[name] <- list(value)
  class(fields) <- oldClass(x)
  fields
}

#' @rdname specimen-fields
#' @export
`[[<-.specimen` <- function(x, i, value) {
  if (length(i) > 1) {
    part <- unclass(x)[[i[1]]]
    part[[i[-1]]] <- value
    value <- part
    i <- i[1]
  }
  if (is.numeric(i)) i <- names(unclass(x))[i]
  if (!is.character(i) || is.na(i)) {
    crestline_abort("a specimen has no such field.", "Give the name of a field.",
                    stage = "specimen", id = x$id, call = NULL)
  }
  `$<-.specimen`(x, i, value)
}

#' @rdname specimen-fields
#' @export
`[<-.specimen` <- function(x, i, value) {
  value <- rep_len(if (is.list(value)) value else list(value), length(i))
  for (k in seq_along(i)) x[[i[k]]] <- value[[k]]
  x
}

#' A specimen with another mesh: dressed anew where its vertices and triangles are the same, else
#' through the door again
#' @noRd
with_other_mesh <- function(x, mesh) {
  known <- tryCatch(passed_mesh(mesh, x$id), crestline_mesh_error = function(e) NULL)
  if (identical(known$key, specimen_key(x))) {
    mesh[c("vb", "it")] <- list(known$vb, known$it)
    if (!fits_vertices(mesh$normals, ncol(known$vb))) mesh$normals <- vertex_normals(mesh)
    return(with_fields(x, mesh = mesh))
  }
  made <- specimen(mesh, x$landmarks, x$id)
  with_fields(x, mesh = made$mesh, landmarks = made$landmarks, report = made$report, key = made$key,
              geometry = made$geometry, vertices = made$vertices, file = made$file)
}

#' @exportS3Method
mesh_of.specimen <- function(x) list(key = specimen_key(x), id = x$id)
