# Landmarks looked at, moved and placed by a person, on a page in the browser.

#' Review landmarks, or place them by hand
#'
#' Opens a page in the browser (package shiny). It shows the turning specimen, its landmarks, and
#' the curves of the scheme between them. Choose a landmark in the list or by a click on its ball. A
#' click on the surface puts it there, exactly on the mesh. The curves that end on it are fitted
#' again at once. Drag to turn, use the wheel to zoom, and the right button to shift. Drag the
#' chosen ball to move it. Curves can be drawn by hand, and keys press the buttons, see
#' [digitise()].
#'
#' `review_landmarks()` begins with the landmarks of the specimen. Landmarks in which
#' [find_landmarks()] has little confidence are red. They are selected one after the other: move
#' each, confirm it, or mark it as not on this scan. Found landmarks are green, predicted ones blue,
#' placed ones yellow, and the chosen one is orange. `place_landmarks()` begins without landmarks.
#' It names and describes the next landmark of the scheme. Names that end in L belong to the
#' subject's own left. Use `review_landmarks()` to continue with a specimen that has some landmarks.
#'
#' @param specimen A [specimen()], with landmarks that were found or given.
#' @param scheme A [curve_scheme()]: its landmarks, with their columns `name` and `where`, and its
#'   curves. NULL: only the landmarks of the specimen.
#' @param surface Quantity that the colours of the surface show, as `colour` of [plot.specimen()].
#' @param least Least confidence of a found landmark (0 to 1); below it the landmark is doubtful, as
#'   in [check_placing()].
#' @param settings [ridge_settings()] of the curves.
#' @param view Direction of view, see [draw_surface()]. NULL: from the front, as [find_landmarks()]
#'   determined it, if it found the landmarks.
#' @param unit As in [fit_shape()].
#' @param page Constants of the page, as of [review_settings()].
#' @param ... Passed to [shiny::runApp()]: `port`, `host`, `quiet`, `launch.browser` (a function
#'   gets the address of the page). Fields of [review_settings()], the former form, give a message
#'   of class `crestline_deprecated`.
#' @inheritParams curvature
#' @details The address of the page has a random token. R answers only requests with this token, and
#'   none from pages of another site. With `launch.browser = FALSE` the address is printed.
#' @return `review_landmarks()`: the [specimen()] with the edited landmarks ("Done", or the page was
#'   closed) or with the original ones ("Cancel"). If it has `placing`, moved and confirmed
#'   landmarks get the state "placed" there. Landmarks that were marked as not on the scan get the
#'   state "absent". Both have no confidence, and [check_placing()] accepts them. Curves that were
#'   drawn are its field `drawn`, which [fit_shape()] takes.
#'   `place_landmarks()`: a specimen with a row for each landmark of the scheme; NA if it was not
#'   placed.
#' @section Errors: of class `crestline_error`: `specimen`, `mesh` or `scheme` has the wrong class,
#'   or the package shiny is not installed.
#' @section Warnings: of class `crestline_mirrored`: left and right look mirrored. Of class
#'   `crestline_exchanged`: landmarks look exchanged; the warning names them.
#' @template glossary
#' @templateVar where sections 1 and 7 (which take landmarks as given)
#' @template paper
#' @section In place of geomorph's digit.fixed(): geomorph gave up digitising in three dimensions
#'   (4.1.1). `place_landmarks()` needs a browser only. [digitise()] goes through several specimens:
#'
#'   ```
#'   files <- list.files("scans", "[.]ply$", full.names = TRUE)
#'   desk <- digitise(files, dir = "desk", observer = "AB")
#'   A <- as.array(desk, "landmarks")   # p x 3 x n
#'   geomorph::gpagen(A)
#'   ```
#' @seealso [digitise()] for several specimens and curves; [find_landmarks()],
#'   [calibrate_template()]
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
                             unit = NULL, threads = getOption("crestline.threads", 1L),
                             page = review_settings(), ...) {
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
  threads <- check_threads(threads)
  if (!is.null(view)) view_rotation(view)
  check_class(page, "review_settings", "page", "review_settings()")
  check_dots(..., known = c(names(formals(shiny::runApp))[-1], names(page)))
  given <- list(...)
  page <- with_former(list(page = page), list(page = names(page)), given)$page
  review <- begin_review(specimen, scheme, least, settings, page$bridge, threads)
  if (!is.null(scheme)) review <- with_drawn(review)
  review$selected <- next_open(review)
  reviewed <- do.call(run_review, c(
    list(review_page(paste("Landmarks of", specimen$id)),
         desk_server(desk_of(review), desk_surfaces(surface, page, view))),
    given[!names(given) %in% names(page)]
  ))
  warn_exchanged(specimen_slips(reviewed), reviewed$id)
  reviewed
}

#' @rdname review_landmarks
#' @template bare-mesh
#' @template bare-id
#' @export
place_landmarks <- function(mesh, scheme = face_scheme(), id = NULL, ...) {
  check_given()
  check_surface(mesh, "mesh")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  review_landmarks(without_landmarks(mesh, scheme, id), scheme, ...)
}

#' Settings of review_landmarks()
#'
#' @template setting-names
#' @param radius Radius of the curvature that `surface` shows, in the unit of the mesh. `NULL`: 1/25
#'   of the diagonal of the mesh's bounding box, as in [plot.specimen()].
#' @param faces Number of triangles of the surface that is shown. A finer mesh is reduced for the
#'   browser. Landmarks are always put on the full mesh.
#' @param bridge As in [shape_settings()].
#' @return List of class `review_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @examples
#' review_settings(faces = 20000)
#' @export
review_settings <- function(..., radius = NULL, faces = 60000, bridge = 0.2) {
  new_settings("review_settings", check_review_settings, list(...))
}

check_review_settings <- function(settings) {
  if (!is.null(settings$radius)) check_number(settings$radius, "radius", 0, open = TRUE)
  check_count(settings$faces, "faces")
  check_number(settings$bridge, "bridge", 0, 1)
  settings
}

#' @export
print.review_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<review_settings> of review_landmarks()")
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
