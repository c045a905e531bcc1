# A specimen: a checked mesh, its named landmarks and an id.

#' A specimen: a surface and its landmarks
#'
#' Checks mesh and landmarks at the door: what can be mended without harm is mended and listed in
#' `report`; what cannot is refused with an error that names specimen, landmark and remedy. Vertices and
#' faces keep their order; only what has to go leaves.
#'
#' @param mesh A `mesh3d` (as of `Rvcg::vcgImport()` or rgl): `vb` 4 x n, `it` 3 x m; quads (`ib`) are cut
#'   in two, a point cloud without faces is triangulated by `Rvcg::vcgBallPivoting()`.
#' @param landmarks k x 3 numeric matrix with row names, or a data frame with columns `name` (or `landmark`,
#'   `label`), `x`, `y`, `z`; in the mesh's unit; NA: missing on this specimen.
#' @param id Name of the specimen, one string.
#' @param outward Ridges and valleys swap when triangles face inwards. "detect" turns a piece round, with a
#'   warning, when its triangles clearly look towards the middle of the mesh (the area-weighted mean cosine
#'   between normal and direction away from the centroid is below -0.4; face scans have 0.55 to 0.85);
#'   "keep" leaves the sense as it is (a small or hollow surface), "flip" turns all.
#' @param tolerance Greatest distance of a landmark from the surface, as a share of the diagonal of the mesh's
#'   bounding box (0.01 is 3 to 4 mm on a face). Nearer landmarks are put on the surface; farther ones are an error.
#' @param debris Pieces with less than this share of the mesh's faces are left out.
#' @param midline Names of midline landmarks from top to bottom; with names that end in L and R they
#'   tell whether left and right are mirrored (a warning of class `crestline_mirrored`).
#' @return An object of class `specimen`, a list:
#'   * `id` (character);
#'   * `mesh` (`mesh3d`; `vb` with fourth row 1, `it`, outward unit `normals` 4 x n, and `material$color`, one
#'     colour a vertex, where there is natural colour);
#'   * `landmarks` (k x 3 matrix with row names, exactly on the surface; perhaps no row);
#'   * `report` (data frame: `check`, `count`, `action`; a row for every check, also where nothing was found);
#'   * `geometry` (internal: neighbours of the triangles and the landmarks' faces and weights).
#' @section Errors: Of class `crestline_error`: the mesh (class `crestline_mesh_error`) has no triangles and gives
#'   none, faces name missing vertices; landmarks (class `crestline_landmark_error`) without names, named twice, off
#'   the surface, in another unit.
#' @seealso [read_specimen()], [read_landmarks()]
#' @examples
#' ball <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1), front = c(1, 0, 0)), id = "ball")
#' ball
#' ball$report
#' @export
specimen <- function(mesh, landmarks = NULL, id = NULL, outward = "detect", tolerance = 0.01, debris = 0.001,
                     midline = c("n", "se", "pn", "sn", "ls", "st", "li", "sl", "gn")) {
  check_given()
  midline <- check_names(midline, "midline", null = TRUE)
  id <- check_id(id)
  tolerance <- check_number(tolerance, "tolerance", lower = 0)
  landmarks <- as_landmarks(landmarks, id)
  door <- check_mesh(mesh, id, outward, debris)
  placed <- check_landmarks(landmarks, door$mesh, id, tolerance * mesh_diagonal(door$mesh), midline)
  structure(
    list(id = id, mesh = door$mesh, landmarks = placed$landmarks,
         report = rbind(door$report, placed$report),
         geometry = list(twin = door$topology$twin, piece = door$topology$piece,
                         landmarks = placed$landmarks, located = placed$located)),
    class = "specimen"
  )
}

check_id <- function(id, name = "id", call = NULL) {
  if (is.null(id)) return("unnamed")
  if (!is.atomic(id) || length(id) != 1 || is.na(id) || !nzchar(as.character(id))) {
    refuse_argument(name, id, "Give one string.", call)
  }
  as.character(id)
}

#' @export
print.specimen <- function(x, ...) {
  check_method_dots(...)
  count <- function(n, what) paste0(format(n, big.mark = ","), " ", what)
  cat("<specimen> ", x$id, ": ", count(ncol(x$mesh$vb), "vertices, "), count(ncol(x$mesh$it), "triangles"),
      if (!is.null(x$mesh$material$color)) ", natural colour", "\n", sep = "")
  size <- apply(x$mesh$vb[1:3, , drop = FALSE], 1, function(v) diff(range(v)))
  cat("size", paste(signif(size, 4), collapse = " x "), "\n")
  name <- rownames(x$landmarks)
  absent <- is.na(x$landmarks[, 1])
  cat(strwrap(paste0(count(length(name), "landmarks"), if (length(name)) ": ", shorten(name[!absent], 40)),
              exdent = 2), sep = "\n")
  if (any(absent)) cat("missing:", shorten(name[absent], 20), "\n")
  found <- x$report[x$report$count > 0, ]
  for (i in seq_len(nrow(found))) cat("- ", found$count[i], " ", found$check[i], ": ", found$action[i], "\n", sep = "")
  invisible(x)
}

#' One landmark as a point on the specimen's mesh
#'
#' @param specimen A specimen.
#' @param name Name of the landmark.
#' @param tolerance As in [specimen()], for landmarks changed since.
#' @return One-row data frame `x, y, z, face, w1, w2, w3`.
#' @noRd
landmark_point <- function(specimen, name, tolerance = 0.01) {
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  id <- specimen$id
  known <- rownames(specimen$landmarks)
  if (!is.character(name) || length(name) != 1 || is.na(name) || !name %in% known) {
    refuse_landmarks(sprintf("there is no landmark %s.", describe_value(name)), near_names(name, known), id)
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
  check_landmarks(landmarks, specimen$mesh, id, tolerance * mesh_diagonal(specimen$mesh), character())$located
}

#' A specimen whose landmarks that were changed since are located once, for many uses
#'
#' Those that cannot be (missing, off the surface) are left for [landmark_point()] to tell of.
#'
#' @param tolerance As in [specimen()].
#' @noRd
with_located <- function(specimen, tolerance = 0.01) {
  before <- specimen$geometry
  at <- specimen$landmarks
  known <- match(rownames(at), rownames(before$landmarks))
  changed <- which(vapply(seq_along(known), function(i) {
    !anyNA(at[i, ]) && (is.na(known[i]) || !identical(unname(at[i, ]), unname(before$landmarks[known[i], ])))
  }, NA))
  if (!length(changed)) return(specimen)
  found <- surface_points(specimen$mesh, at[changed, , drop = FALSE])
  away <- row_lengths(as.matrix(found[c("x", "y", "z")]) - at[changed, , drop = FALSE])
  for (i in which(away <= tolerance * mesh_diagonal(specimen$mesh))) {
    name <- rownames(at)[changed[i]]
    row <- match(name, rownames(before$landmarks), nomatch = nrow(before$landmarks) + 1)
    before$landmarks <- with_row(before$landmarks, row, at[name, ], name)
    before$located[row, ] <- found[i, ]
  }
  specimen$geometry <- before
  specimen
}

with_row <- function(x, row, values, name) {
  if (row > nrow(x)) return(rbind(x, matrix(values, 1, dimnames = list(name, colnames(x)))))
  x[row, ] <- values
  x
}

near_names <- function(name, known) {
  if (!length(known)) return("The specimen has no landmarks: give them to specimen() or read_specimen().")
  near <- if (is.character(name) && length(name) == 1 && !is.na(name)) {
    known[order(utils::adist(name, known, ignore.case = TRUE))]
  } else {
    known
  }
  sprintf("Near names: %s.", shorten(near))
}
