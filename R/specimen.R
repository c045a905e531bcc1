# A specimen: a checked mesh, its named landmarks and an id.

#' A specimen: a surface and its landmarks
#'
#' Checks a mesh and its landmarks. Faults that can be mended without harm are mended, and listed in
#' `report`. Any other fault is an error that names the specimen, the landmark and the remedy.
#' Vertices and faces that are kept stay in their order. [crestline-package] has a glossary.
#'
#' @param mesh A `mesh3d`, as `Rvcg::vcgImport()` or rgl make it: `vb` 4 x n, `it` 3 x m. Quads
#'   (`ib`) are cut into two triangles. A point cloud without faces is triangulated by
#'   `Rvcg::vcgBallPivoting()`.
#' @param landmarks k x 3 numeric matrix with row names, or a data frame with columns `name` (or
#'   `landmark`, `label`), `x`, `y`, `z`; in the unit of the mesh. NA: this specimen lacks the
#'   landmark. NULL: no landmarks.
#' @param id Name of the specimen, one string.
#' @param outward Orientation of the triangles. Ridges and valleys swap if the triangles face
#'   inwards. "detect" turns a piece round, with a warning, if its triangles clearly face the middle
#'   of the mesh. The measure is the area-weighted mean cosine between the normal and the direction
#'   away from the centroid; the limit is -0.4 (face scans have 0.55 to 0.85). "keep" leaves all
#'   pieces as they are; use it for a small or hollow surface. "flip" turns all pieces.
#' @param tolerance Greatest distance of a landmark from the surface, as a share of the object's
#'   size (0.01 is 3 to 4 mm on a face), at most 0.25. Closer landmarks are moved onto the surface.
#'   Farther landmarks are an error. The size is that of the part where most of the surface lies, on
#'   the pieces that carry the landmarks. On a face it is about the diagonal of the bounding box. A
#'   platform or a stray vertex does not change it.
#' @param debris Pieces with less than this share of the mesh's faces are removed (no unit).
#' @param midline Names of midline landmarks from top to bottom. Together with the landmarks whose
#'   names end in L and R they serve two checks. If left and right are mirrored, you get a warning
#'   of class `crestline_mirrored`. If two landmarks look exchanged (left for right, two of the
#'   midline, or two of one side), you get a warning of class `crestline_exchanged`.
#' @param rescale Factor by which the co-ordinates of mesh and landmarks are multiplied (no unit).
#'   1000 turns metres into millimetres. All specimens of a sample need one unit.
#' @return An object of class `specimen`, a list:
#'   * `id` (character);
#'   * `mesh` (`mesh3d`; `vb` with fourth row 1, `it`, outward unit `normals` 4 x n, and
#'     `material$color`, one colour a vertex, where there is natural colour);
#'   * `landmarks` (k x 3 matrix with row names, exactly on the surface; 0 x 3 without landmarks);
#'   * `report` (data frame with a row for every check: `check`, `count`, `action`; `count` is 0 if
#'     nothing was found. "rescaled vertices" is there only with `rescale`);
#'   * `vertices` (integer, for every vertex of the input its number in `mesh`; NA if it was left
#'     out: `values[!is.na(vertices)]` belong to `vertices[!is.na(vertices)]`);
#'   * `file` (path of the mesh; NA for a mesh from memory) and `origin` (data frame `landmark`,
#'     `how`, `file`, `time`: the source of each landmark, see [summary.specimen()]);
#'   * `key` (hash of the vertices and triangles, in their order): curves, shapes and curvatures of
#'     the mesh carry it. They are refused with any other mesh (errors of class
#'     `crestline_wrong_mesh`);
#'   * `geometry` (internal: neighbours of the triangles and the landmarks' faces and weights).
#'
#'   Fields are changed by assignment, which checks them: see [`$<-.specimen`][specimen-fields].
#' @section Warnings: Of class `crestline_warning`, each with a class of its own:
#'   * `crestline_triangulated`: triangles were made from points;
#'   * `crestline_triangles_dropped`: more than 1 % of the triangles are left out;
#'   * `crestline_far_vertices`: vertices are left out, as they are more than 50 times the median
#'     distance from the middle;
#'   * `crestline_loose_triangles`: triangles touch no other;
#'   * `crestline_seam`: borders lie beside one another;
#'   * `crestline_double_skin`: the surface is double, with one skin very close to the other;
#'   * `crestline_far_landmarks`: with a greater `tolerance`, landmarks were moved onto the surface
#'     by more than 0.01 of the size;
#'   * `crestline_bare_piece`: a piece with more than 20 % of the triangles has no landmark, while
#'     another piece has some. It may be a second object of the same kind. [find_landmarks()] warns
#'     of it too;
#'   * `crestline_partial_landmarks`: a landmark lacks one or two of its three co-ordinates, and is
#'     taken as missing;
#'   * `crestline_same_place`: two landmarks have the same co-ordinates.
#'
#'   Corners within 1e-6 of the size are joined without a warning: both sides of a seam, single
#'   triangles, vertices on the edge of another triangle.
#' @section Errors: Of class `crestline_mesh_error`: the mesh has no triangles and none can be made,
#'   or its faces refer to missing vertices. Of class `crestline_landmark_error`: landmarks have no
#'   names, share a name, lie off the surface, or are in another unit. Both are of class
#'   `crestline_error`.
#' @seealso [read_specimen()], [read_landmarks()]
#' @examples
#' ball <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1), front = c(1, 0, 0)), id = "ball")
#' ball
#' ball$report
#' @export
specimen <- function(mesh, landmarks = NULL, id = NULL, outward = "detect", tolerance = 0.01,
                     debris = 0.001,
                     midline = c("n", "se", "pn", "sn", "ls", "st", "li", "sl", "gn"),
                     rescale = 1) {
  check_given()
  rescale <- check_number(rescale, "rescale", lower = 0, open = TRUE)
  midline <- check_names(midline, "midline", null = TRUE)
  id <- check_id(id)
  tolerance <- check_tolerance(tolerance)
  landmarks <- as_landmarks(landmarks, id) * rescale
  warn_same_place(landmarks, id)
  door <- check_mesh(rescaled_mesh(mesh, rescale), id, outward, debris)
  placed <- check_landmarks(landmarks, door$mesh, id, tolerance, midline, door$topology$piece)
  # What the report says of a specimen in another unit than it was given
  rescaled_row <- if (rescale == 1) NULL else {
    data.frame(check = "rescaled vertices", count = ncol(door$mesh$vb),
               action = sprintf("multiplied by %.6g, landmarks too", rescale))
  }
  report <- rbind(door$report, placed$report, rescaled_row)
  made <- new_specimen(
    id, door$mesh, placed$landmarks, report = report,
    origin = new_origin(placed$landmarks, "given"),
    geometry = list(twin = door$topology$twin, piece = door$topology$piece,
                    landmarks = placed$landmarks, located = placed$located,
                    size = placed$size, slips = placed$slips),
    vertices = door$vertices
  )
  warn_bare_piece(made)
  made
}

#' A share of the object's size, which is easily taken for a length
#' @param most Greatest share: a landmark so far away is on no surface.
#' @noRd
check_tolerance <- function(tolerance, most = 0.25) {
  number <- check_number(tolerance, "tolerance", lower = 0)
  if (number > most) {
    refuse_argument("tolerance", tolerance,
                    sprintf(paste("It is a share of the object's size, not a length: 0.01 is 3 to",
                                  "4 mm on a face. Give at most %g."), most))
  }
  number
}

#' A mesh in another unit; what is no mesh is left for the door to refuse
#' @noRd
rescaled_mesh <- function(mesh, factor) {
  if (factor == 1 || !is.list(mesh) || !is.matrix(mesh$vb) || !is.numeric(mesh$vb)) return(mesh)
  at <- seq_len(min(3, nrow(mesh$vb)))
  mesh$vb[at, ] <- mesh$vb[at, ] * factor
  mesh
}

#' A specimen from its parts: all its fields are declared here, NULL or NA until they are filled
#'
#' @param id,mesh,landmarks,report As [specimen()] gives them.
#' @param geometry List: `twin` and `piece` of [mesh_topology()]; `landmarks` and `located`: places
#'   that were worked out; `size` of [mesh_size()]; `slips` of [exchanged_landmarks()] at the door.
#' @param key Of [mesh_key()].
#' @param file Path that the mesh was read from, NA where there is none.
#' @param origin How each landmark came: data frame `landmark`, `how` ("file", "given", "found",
#'   "predicted", "placed", "moved", "defined"), `file`, `time`.
#' @param placing,match Of [find_landmarks()]; `refinement` of [refine_landmarks()].
#' @param vertices For every vertex that was given, its number in `mesh`, NA where it was left out.
#' @param warnings Data frame `stage`, `class`, `problem`, `remedy`: what was warned of.
#' @noRd
new_specimen <- function(id, mesh, landmarks, report, geometry, key = mesh_key(mesh),
                         file = NA_character_, origin = NULL,
                         placing = NULL, match = NULL, refinement = NULL, vertices = NULL,
                         warnings = no_warnings()) {
  structure(
    list(id = id, mesh = mesh, landmarks = landmarks, report = report, key = key, file = file,
         origin = origin,
         placing = placing, match = match, refinement = refinement, vertices = vertices,
         warnings = warnings,
         geometry = geometry),
    class = "specimen"
  )
}

no_warnings <- function() {
  data.frame(stage = character(), class = character(), problem = character(), remedy = character())
}

check_id <- function(id, name = "id") {
  if (is.null(id)) return("unnamed")
  if (!is.atomic(id) || length(id) != 1 || is.na(id) || !nzchar(as.character(id))) {
    refuse_argument(name, id, "Give one string.")
  }
  as.character(id)
}

#' @export
print.specimen <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    count <- function(n, what) paste0(format(n, big.mark = ","), " ", what)
    cat("<specimen> ", x$id, ": ", count(ncol(x$mesh$vb), "vertices, "),
        count(ncol(x$mesh$it), "triangles"),
        if (!is.null(x$mesh$material$color)) ", natural colour", "\n", sep = "")
    size <- apply(x$mesh$vb[1:3, , drop = FALSE], 1, function(v) diff(range(v)))
    cat("size", paste(signif(size, 4), collapse = " x "), "\n")
    name <- rownames(x$landmarks)
    absent <- is.na(x$landmarks[, 1])
    cat(strwrap(paste0(count(length(name), "landmarks"), if (length(name)) ": ",
                       shorten(name[!absent], 40)),
                exdent = 2), sep = "\n")
    if (any(absent)) cat("missing:", shorten(name[absent], 20), "\n")
    print_placing(x$placing)
    unit <- unit_line(x$match)
    if (!is.null(unit)) cat(unit, "\n", sep = "")
    # What print() says of exchanged landmarks
    words <- exchange_words(x$geometry$slips)
    if (length(words))
      cat(strwrap(paste("- landmarks look exchanged:", toString(words)), exdent = 2), sep = "\n")
    found <- x$report[x$report$count > 0, ]
    one <- found$count == 1
    found$check[one] <- sub("vertices", "vertex", sub("(face|hole|piece|landmark|triangle)s\\b",
                                                      "\\1", found$check[one]))
    for (line in sprintf("- %d %s: %s", found$count, found$check, found$action)) {
      cat(strwrap(line, width = 80, exdent = 2), sep = "\n")
    }
    invisible(x)
  })
}

#' What find_landmarks() took the unit for; nothing where it is the template's
#' @noRd
unit_line <- function(match) {
  if (isFALSE(match$unit_known)) {
    return(sprintf("- unit unknown: about %.3g mm to 1, as if it were as large as the template",
                   match$unit))
  }
  if (is.null(match$unit) || isTRUE(all.equal(match$unit, 1))) return(NULL)
  sprintf("- unit: lengths times %.4g are in the unit of the template", match$unit)
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
    !anyNA(at[i, ]) && (is.na(known[i]) ||
                        !identical(unname(at[i, ]), unname(before$landmarks[known[i], ])))
  }, NA))
  if (!length(changed)) return(specimen)
  found <- surface_points(specimen$mesh, at[changed, , drop = FALSE])
  away <- row_lengths(as.matrix(found[c("x", "y", "z")]) - at[changed, , drop = FALSE])
  for (i in which(away <= tolerance * specimen_size(specimen))) {
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

#' An object with its scan, which may still be in its file
#' @noRd
whole_specimen <- function(x) UseMethod("whole_specimen")

#' @exportS3Method
whole_specimen.default <- function(x) x

#' An object with some fields at other values, without the checks of `$<-`
#' @noRd
with_fields <- function(x, ...) {
  new <- list(...)
  if (!identical(names(new), "id")) x <- whole_specimen(x)
  fields <- unclass(x)
  fields[names(new)] <- new
  class(fields) <- oldClass(x)
  fields
}

#' The record of where landmarks came from
#'
#' @param landmarks k x 3 matrix with row names; of a missing one nothing is recorded (NA).
#' @param how "file", "given", "found", "predicted", "placed", "moved" (both by hand), "defined"
#'   (moved by its definition).
#' @param file,time NA where there is none; time of what was done by hand, see [time_stamp()].
#' @return Data frame `landmark`, `how`, `file`, `time`.
#' @noRd
new_origin <- function(landmarks, how, file = NA_character_, time = NA_character_) {
  n <- nrow(landmarks)
  origin <- data.frame(landmark = as.character(rownames(landmarks)), how = rep_len(how, n),
                       file = rep_len(file, n),
                       time = rep_len(time, n))
  origin[is.na(landmarks[, 1]), c("how", "file", "time")] <- NA_character_
  origin
}

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


end_name <- function(at) {
  if (is.character(at)) return(at)
  sprintf("(%s)", paste(signif(unlist(at[1:3]), 4), collapse = ", "))
}

#' A place on a mesh, given as the name of a landmark, one row of points on the mesh, or a position
#'
#' @param specimen Where landmarks are looked up; a `mesh3d` has none.
#' @param scan Its mesh: list of `vb`, `it`, `diagonal`, `id`.
#' @param name What `at` is called.
#' @return Numeric, named as `mesh_columns`.
#' @noRd
end_vector <- function(specimen, scan, at, name) {
  said <- sprintf("`%s`", name)
  row <- is.data.frame(at) && nrow(at) == 1 && all(mesh_columns %in% names(at))
  if (row && !is.null(attr(at, "key"))) check_same_mesh(at, specimen, said)
  if (row && anyNA(at$face)) {
    crestline_abort(sprintf("%s is missing (NA).", said), "Choose a point that is there.",
                    stage = "path", id = scan$id, class = "crestline_path_error", call = NULL)
  }
  if (row) at <- unlist(unclass(at)[mesh_columns])
  if (is.numeric(at) && identical(names(at), mesh_columns)) {
    check_places(t(at), scan, said, scan$id)
    return(at)
  }
  if (is.character(at) && inherits(specimen, "specimen")) {
    known <- rownames(specimen$landmarks)
    if (!all(at %in% known)) {
      refuse_landmarks(sprintf("there is no landmark %s (%s).", describe_value(at), said),
                       near_names(at, known), specimen$id)
    }
    place <- landmark_point(specimen, at)
  } else if (is.numeric(at) && length(at) == 3 && all(is.finite(at))) {
    place <- surface_points(scan, matrix(at, 1))
  } else {
    crestline_abort(sprintf("%s is %s.", said, describe_value(at)),
                    end_words(at, "a landmark of a specimen"),
                    stage = "path", class = "crestline_path_error", call = NULL)
  }
  unlist(unclass(place)[mesh_columns])
}

#' Key of a specimen's mesh; worked out where an older version made it
#' @noRd
specimen_key <- function(x) if (is.null(x$key)) passed_mesh(x$mesh, x$id)$key else x$key

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
