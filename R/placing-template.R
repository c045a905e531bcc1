# What landmarks are carried over from: a surface with landmarks, in a frame of its own.

#' Templates for finding landmarks
#'
#' `landmark_template()` makes a template of any specimen with landmarks. `face_template()` is the
#' package's own template of the face. [find_landmarks()] uses templates.
#'
#' The template of the face is the symmetric mean of two heads of the package Rvcg, `dummyhead` and
#' `humface` (S. Schlager, GPL). The script `face-template.R` of the sources makes it, and describes
#' how its landmarks were placed.
#'
#' @param specimen A [specimen()] with at least four landmarks, in mm or any other unit.
#' @param predicted Names of landmarks for which the surface has no evidence, such as those at the
#'   ears, which most scans lack. They are placed by the positions of the others.
#' @param unit Factor on the lengths of [find_settings()], in the template's unit. These lengths are
#'   mm on a face. By default the template's diagonal is 280 of these lengths, as on a face.
#' @param mirror TRUE if left and right are alike. Landmarks whose names end in L and R are then
#'   partners, and the deformations are mostly symmetric. `NA`: TRUE if there are at least two such
#'   pairs.
#' @param start Name of the landmark that [find_landmarks()] places on every prominent part of a
#'   scan. Choose one on the most prominent part of the object, as the nose tip of a face. `NULL`:
#'   the most prominent position of the template.
#' @param hinge,moves,slit Names of landmarks by which an open mouth is tried. `hinge`: on the axis
#'   that the jaw turns about. `moves`: those that go with the jaw. `slit`: the corners and the
#'   middle of the mouth. Without a `slit` no expressions are tried. They need a `mirror`.
#' @return Object of class `landmark_template`, a list of `id`, `specimen`, `landmarks`,
#'   `predicted`, `unit`, `mirror`, `start` (the position of that landmark, or NULL), `modes` (what
#'   expressions move), `judged`, and `ear` (for the face: points of an ear with its tragion).
#'   `landmarks` and `predicted` are k x 3 matrices of the landmarks that are found and predicted.
#'   `judged` is TRUE if the setting `agree` of [find_settings()] was measured for the template, as
#'   for the face. All positions are in the template's own frame. With `mirror`, left is at positive
#'   x, and the mirror plane is x = 0. Lengths are in the unit of `specimen`.
#' @section Errors: of class `crestline_error`: the specimen has fewer than four landmarks, or
#'   `predicted` names others.
#' @template glossary
#' @seealso [find_landmarks()], [calibrate_template()]
#' @examples
#' face_template()
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' landmark_template(face, predicted = c("tL", "tR", "oiL", "oiR"))
#' @export
landmark_template <- function(specimen, predicted = character(),
                              unit = mesh_diagonal(specimen$mesh) / 280, mirror = NA,
                              start = NULL, hinge = character(), moves = character(),
                              slit = character()) {
  check_given()
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  predicted <- check_names(predicted, "predicted")
  if (!identical(mirror, NA)) check_flags(mirror)
  unit <- check_number(unit, "unit", lower = 0, open = TRUE)
  at <- specimen$landmarks[stats::complete.cases(specimen$landmarks), , drop = FALSE]
  check_predicted(predicted, rownames(at), specimen$id)
  if (!is.null(start)) {
    start <- check_choice(start, setdiff(rownames(at), predicted), "start")
  }
  pairs <- side_pairs(rownames(at))
  if (is.na(mirror)) mirror <- nrow(pairs) >= 2
  if (length(slit)) {
    check_choices(slit, rownames(at), "slit")
    check_choices(hinge, rownames(at), "hinge")
    check_choices(moves, rownames(at), "moves")
  }
  if (mirror && !nrow(pairs)) {
    refuse_landmarks("it has no pair of landmarks whose names end in L and R.",
                     "Name the sides so, or give mirror = FALSE.",
                     specimen$id)
  }
  if (mirror) specimen <- turned_specimen(specimen, at, pairs)
  at <- specimen$landmarks[rownames(at), , drop = FALSE]
  found <- !rownames(at) %in% predicted
  modes <- if (length(slit)) template_modes(at, hinge, moves, slit)
  structure(list(id = specimen$id, specimen = specimen, landmarks = at[found, , drop = FALSE],
                 predicted = at[!found, , drop = FALSE], unit = unit, mirror = mirror,
                 start = if (!is.null(start)) at[start, ], modes = modes, judged = FALSE,
                 ear = NULL),
            class = "landmark_template")
}

#' That the landmarks that are only predicted are there, and leave four to be found
#' @noRd
check_predicted <- function(predicted, names, id) {
  missing <- setdiff(predicted, names)
  if (length(missing)) {
    refuse_landmarks(sprintf("`predicted` names %s, which it does not have.", shorten(missing)),
                     near_names(missing[1], names), id)
  }
  left <- length(names) - length(predicted)
  if (left < 4) {
    refuse_landmarks(sprintf("it has %d landmarks to be found.", left),
                     "A template needs four or more: place them, or give fewer `predicted`.", id)
  }
}

#' @export
print.landmark_template <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat("<landmark_template> ", x$id, ": ", amount(ncol(x$specimen$mesh$vb), "vertex", "vertices"),
        if (x$mirror) ", with a mirror",
        ", unit ", signif(x$unit, 3), "\n", sep = "")
    names <- shorten(rownames(x$landmarks), 40)
    cat(strwrap(paste0(amount(nrow(x$landmarks), "landmark"), ": ", names), exdent = 2), sep = "\n")
    if (nrow(x$predicted)) cat("predicted by these:", shorten(rownames(x$predicted), 40), "\n")
    invisible(x)
  })
}

#' A specimen turned so that its landmarks' mirror is x = 0 and left is positive
#' @noRd
turned_specimen <- function(specimen, at, pairs) {
  across <- at[pairs$left, , drop = FALSE] - at[pairs$right, , drop = FALSE]
  axis <- main_direction(across)
  axis <- axis * sign(sum(across %*% axis))
  sided <- is_sided(rownames(at))
  middle <- rbind((at[pairs$left, , drop = FALSE] + at[pairs$right, , drop = FALSE]) / 2,
                  at[!sided, , drop = FALSE])
  origin <- colMeans(middle)
  # The smallest rotation that takes a unit vector to x
  turn <- if (axis[1] < -1 + 1e-12) diag(c(-1, -1, 1)) else {
    v <- cross_product(axis, c(1, 0, 0))
    skew <- rbind(c(0, -v[3], v[2]), c(v[3], 0, -v[1]), c(-v[2], v[1], 0))
    diag(3) + skew + skew %*% skew / (1 + axis[1])
  }
  moved_specimen(specimen, turn, origin)
}

#' A specimen after rotation about an origin, which goes to 0
#' @noRd
moved_specimen <- function(specimen, rotation, origin) {
  mesh <- specimen$mesh
  mesh$vb[1:3, ] <- rotation %*% (mesh$vb[1:3, ] - origin)
  mesh$normals[1:3, ] <- rotation %*% mesh$normals[1:3, ]
  landmarks <- structure(
    t(rotation %*% (t(specimen$landmarks) - origin)), dimnames = dimnames(specimen$landmarks)
  )
  geometry <- specimen$geometry
  geometry[c("landmarks", "located")] <- list(landmarks[0, , drop = FALSE], geometry$located[0, ])
  with_fields(specimen, mesh = mesh, key = passed_mesh(mesh, specimen$id)$key,
              landmarks = landmarks, geometry = geometry)
}

#' A template with what matching needs: its cloud, anchors and displacements
#'
#' That of the template used last is kept, as it takes half a second and a sample's scans share it.
#'
#' @param settings Of [find_settings()], as given.
#' @return List: as [scan_cloud()]'s, with `settings` (in the template's unit), `landmarks` (k x 3),
#'   `basis` (see [warp_basis()]), `sd` (of the landmarks where every point has a match, see
#'   [warp_sd()]).
#' @noRd
prepared_template <- function(template, settings, threads) {
  asked <- list(template[c("specimen", "landmarks", "unit", "mirror", "start")], settings)
  if (!identical(asked, last_template$asked)) {
    scaled <- scaled_settings(settings, template$unit)
    mesh <- template$specimen$mesh
    thin <- scaled
    thin$cluster <- sqrt(sum(row_lengths(face_normals(mesh))) / 2 / settings$points)
    thin$coarse <- sqrt(settings$points / settings$thin) * thin$cluster
    thin$anchors <- settings$own
    cloud <- with_curvature(scan_cloud(template$specimen, 1, thin), thin, threads)
    cloud <- with_anchors(cloud, thin, threads)
    cloud$light <- cell_vertices(
      t(cloud$xyz), thin$cluster * sqrt(settings$points / settings$light_points)
    )
    cloud$settings <- scaled
    cloud$mirror <- template$mirror
    cloud$start <- template_start(cloud, template$start, scaled)
    last_template$prepared <- with_landmarks(cloud, template$landmarks)
    last_template$asked <- asked
  }
  c(last_template$prepared, template[c("judged", "modes")])
}

last_template <- new.env(parent = emptyenv())

#' A prepared template with other landmarks
#' @noRd
with_landmarks <- function(prepared, landmarks) {
  prepared$landmarks <- landmarks
  n <- ncol(prepared$xyz)
  prepared$basis <- warp_basis(
    rbind(t(prepared$xyz), landmarks), n, prepared$mirror, prepared$settings
  )
  weight <- rep(1 / prepared$settings$error^2, n)
  root <- warp_root(prepared$basis, seq_len(n), prepared$normal, weight, prepared$settings)
  prepared$sd <- warp_sd(lapply(prepared$basis, function(b) b[-seq_len(n), , drop = FALSE]), root)
  prepared
}

#' @rdname landmark_template
#' @export
face_template <- function() once("face template", read_face_template)

read_face_template <- function() {
  folder <- system.file("extdata", "face_template", package = "crestline", mustWork = TRUE)
  at <- read_landmarks(file.path(folder, "landmarks.csv"))
  ears <- c("tL", "tR", "oiL", "oiR")
  # Its lips and lids are slits, borders beside one another.
  face <- suppressWarnings(
    read_specimen(file.path(folder, "mesh.ply.gz"), at[!rownames(at) %in% ears, ], id = "face"),
    classes = "crestline_seam"
  )
  face$landmarks <- at
  template <- landmark_template(face, ears, unit = 1, start = "pn",
                                hinge = c("tL", "tR"), moves = c("li", "sl", "gn"),
                                slit = c("chL", "st", "chR"))
  template$judged <- TRUE
  template$ear <- read_ears(file.path(folder, "ear.csv"))
  template
}

#' A template, or a specimen made into one
#' @noRd
check_template <- function(template) {
  if (inherits(template, "specimen")) {
    check_class(template, "specimen", "template", "specimen() or read_specimen()")
    return(landmark_template(template))
  }
  check_class(template, "landmark_template", "template", "landmark_template() or face_template()")
}
