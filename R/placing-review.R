# Landmarks looked at, moved and placed by a person, on a page in the browser.

#' Review landmarks, or place them, by hand
#'
#' Opens a page in the browser (package shiny). It shows the turning specimen, its landmarks, and
#' the curves of the scheme between them. Choose a landmark in the list or by a click on its ball. A
#' click on the surface puts it there, exactly on the mesh. The curves that end on it are fitted
#' again at once. Drag to turn, use the wheel to zoom, and the right button to shift.
#'
#' `review_landmarks()` begins with the landmarks of the specimen. Those in which [find_landmarks()]
#' has little confidence are red, and are chosen one after the other: move each, confirm it, or mark
#' it as not on this scan. Found landmarks are green, predicted ones blue, placed ones violet, and
#' the chosen one is yellow. `place_landmarks()` begins without any, and names and describes the
#' next landmark of the scheme. Names that end in L belong to the subject's own left. Use
#' `review_landmarks()` to continue with a specimen that has some landmarks.
#'
#' @param specimen A [specimen()], with landmarks that were found or given.
#' @param scheme A [curve_scheme()]: its landmarks, with their words `name` and `where`, and its
#'   curves; NULL: the landmarks of the specimen alone.
#' @param surface What the colours of the surface show, as `colour` of [plot.specimen()].
#' @param least Least confidence of a found landmark that is not doubtful, as in [check_placing()].
#' @param settings [ridge_settings()] of the curves.
#' @param view Where to look from, see [draw_surface()]; NULL: from the front, as [find_landmarks()]
#'   has it where the landmarks were found.
#' @param radius Of the curvature that `surface` shows, as in [plot.specimen()].
#' @param faces Number of triangles of the surface that is shown. A finer mesh is thinned out for
#'   the browser; landmarks are put on the mesh as it is.
#' @param bridge,unit As in [fit_shape()].
#' @param ... Passed to [shiny::runApp()]: `port`, `host`, `quiet`, `launch.browser` (a function
#'   gets the address of the page).
#' @inheritParams curvature
#' @details The address of the page has a random token. R answers nobody who does not know it, and
#'   no page of another site. With `launch.browser = FALSE` the address is printed.
#' @return The [specimen()] with its landmarks as the person left them ("Done", or the page closed)
#'   or as they were ("Cancel"). In its `placing`, where it has that, moved and confirmed landmarks
#'   have the state "placed", those said not to be there "absent", both without confidence:
#'   [check_placing()] has no doubts about them. `place_landmarks()`: a specimen with a row for each
#'   landmark of the scheme, NA where it was not placed. A warning of class `crestline_mirrored`
#'   tells where left and right look mirrored, one of class `crestline_exchanged` which landmarks
#'   look exchanged.
#' @section Errors: of class `crestline_error`, when specimen, mesh or scheme are not what they
#'   should be.
#' @template glossary
#' @templateVar where sections 1 and 7 (which take landmarks as given)
#' @template paper
#' @seealso [find_landmarks()], [calibrate_template()]
#' @examplesIf interactive() && requireNamespace("shiny", quietly = TRUE)
#' data(humface, package = "Rvcg")
#' face <- find_landmarks(humface, id = "humface")
#' face <- review_landmarks(face)
#' mine <- calibrate_template(face_template(), list(face))
#' again <- place_landmarks(humface, face_scheme(), id = "humface")
#' @export
review_landmarks <- function(specimen, scheme = face_scheme(),
                             surface = c("natural", "shape index", "curvature", "plain"),
                             least = 0.5, settings = ridge_settings(error = FALSE), view = NULL,
                             radius = mesh_diagonal(specimen$mesh) / 25, faces = 60000, unit = NULL,
                             bridge = 0.2,
                             threads = getOption("crestline.threads", 1L), ...) {
  check_given()
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  rlang::check_installed("shiny", "to review landmarks.")
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  if (!is.null(scheme)) {
    check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
    scheme <- scheme_in_unit(scheme, unit, specimen)
  }
  surface <- check_choice(surface, c("natural", "shape index", "curvature", "plain"), "surface")
  least <- check_number(least, "least", 0, 1)
  bridge <- check_number(bridge, "bridge", 0, 1)
  threads <- check_threads(threads)
  radius <- check_number(radius, "radius", 0, open = TRUE)
  faces <- check_count(faces, "faces")
  if (!is.null(view)) view_rotation(view)
  check_dots(..., known = names(formals(shiny::runApp))[-1])
  review <- begin_review(specimen, scheme, least, settings, bridge, threads)
  review$selected <- next_open(review)
  if (is.null(view)) view <- if (is.null(specimen$match)) "front" else t(specimen$match$rotation)
  shown <- shown_surface(specimen, surface, radius, faces)
  reviewed <- run_review(
    review_page(paste("Landmarks of", specimen$id)), review_server(review, shown, view), ...
  )
  warn_exchanged(specimen_slips(reviewed), reviewed$id)
  reviewed
}

#' @rdname review_landmarks
#' @param mesh A `mesh3d`, or a [specimen()], whose own landmarks are not looked at.
#' @param id Name of the specimen, where a mesh is given.
#' @export
place_landmarks <- function(mesh, scheme = face_scheme(), id = NULL, ...) {
  check_given()
  check_surface(mesh, "mesh")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  review_landmarks(without_landmarks(mesh, scheme, id), scheme, ...)
}

#' A specimen on which every landmark of a scheme is missing
#' @noRd
without_landmarks <- function(mesh, scheme, id = NULL) {
  names <- scheme$landmarks$landmark
  empty <- matrix(NA_real_, length(names), 3, dimnames = list(names, c("x", "y", "z")))
  if (inherits(mesh, "specimen")) {
    return(with_fields(specimen(as_mesh(mesh), empty, mesh$id, outward = "keep"), file = mesh$file))
  }
  specimen(mesh, empty, id)
}
