# Landmarks and curves by hand on several specimens: the desk, and what comes of it.

#' Digitise landmarks and curves by hand, on several specimens
#'
#' Opens the page of [place_landmarks()] for one specimen after the other. You place the landmarks
#' of a scheme by clicks, and draw its curves by clicks along them. Every step is written to the
#' folder `dir` at once, with the observer's name and the time. After a closed window the same call
#' goes on where it ended: what the observer did is as it was left, and landmarks that nobody has
#' touched are those of the specimen now. A second observer with another name begins without sight
#' of the first.
#'
#' * *Landmarks*: choose one in the list, and click on the surface. Drag its ball to move it.
#' * *Curves*: choose one in the list, and click along it. The line runs over the surface from point
#'   to point, and from landmark to landmark at its ends. A new point goes in between the two points
#'   where it lengthens the line least. Drag a point to move it; a click on it removes it. "Snap"
#'   lays the line onto the ridge or valley beside it: the ridge is estimated as in [ridge_curve()],
#'   in a window along the drawn line. "Erase" gives the curve back to the machine.
#' * *Keys*: N and P, next and previous specimen; arrows up and down, next row of the list; Enter,
#'   "It is right"; Delete, not on this scan, or erase; S, snap; U or Ctrl+Z, undo; R or Ctrl+Y,
#'   redo.
#'
#' @param specimens Paths of meshes, or a list of [specimen()]s or of `mesh3d` with names. Files are
#'   read when their turn comes. NULL (`read_digitised()`): no specimen is read, marks and steps
#'   only.
#' @param scheme A [curve_scheme()]: its landmarks and curves.
#' @param dir Folder for the records, or NULL: nothing is written.
#' @param observer Name of the person.
#' @param blank TRUE: begin without landmarks. FALSE: begin with those that a specimen has, such as
#'   found ones, or with those beside its file.
#' @param settings [ridge_settings()] of the curves on the page.
#' @param view As in [review_landmarks()].
#' @param page Constants of the page, as of [review_settings()].
#' @param x,row.names,optional,level,... `x`: value of `digitise()` or `read_digitised()`. `level`:
#'   "landmarks", "curves" or, for the array, both. Others: for `digitise()` passed to
#'   [shiny::runApp()], as in [review_landmarks()]; not used by methods.
#' @details The page runs on this computer only. Its address has a random token. R answers only
#'   requests with this token, and none from pages of another site. The folder has a folder for each
#'   observer, with a table for each specimen (`id.csv`, see [write_landmarks()]) and the records
#'   (JSON: states, points of lines, steps). [fit_shapes()] takes an observer's folder as its
#'   `landmarks`, and measures the curves as they were drawn: `fit_shapes(files, landmarks =
#'   "desk/AB")`.
#' @return Object of class `digitised`, a list:
#'   * `marks`: data frame with a row for each point: `specimen`, `observer`, `level` ("landmarks",
#'     "curves"), `part`, `point`, `x`, `y`, `z` (NA: not placed), `state` ("found", "predicted",
#'     "given", "placed", "absent", "missing"; of curves "drawn", "snapped"), `action` and `time`
#'     (the last step of the part, as in `steps`; NA: nobody has touched it);
#'   * `steps`: data frame with a row for each step: `specimen`, `observer`, `part`, `level`,
#'     `action` ("placed", "moved", "confirmed", "absent", "point set", "point moved", "point
#'     removed", "snapped", "erased"), `time` (UTC);
#'   * `specimens`: list by id of the [specimen()]s with landmarks and drawn curves, which
#'     [fit_shape()] measures as they were drawn: those that were shown, and those that the observer
#'     did before, by their records. `read_digitised()` has those of its argument `specimens` that
#'     have a record; with several observers their names are "specimen observer".
#'
#'   `as.data.frame()` gives `marks`. `as.array()` gives a k x 3 x n array of the measurements, as
#'   geomorph takes it. Geomorph refuses missing landmarks: `A[rowSums(is.na(A)) == 0, , ]` leaves
#'   them out. Names of the third dimension are "specimen", or "specimen observer" with
#'   several observers.
#' @section Errors: of class `crestline_error`: an argument is wrong, or the package shiny is not
#'   installed. Of class `crestline_desk_error`: a record is damaged, or of another mesh.
#' @template glossary
#' @seealso [place_landmarks()] for one specimen, [repeatability()] for several observers,
#'   [build_scheme()] for a scheme of your own
#' @examplesIf interactive() && requireNamespace("shiny", quietly = TRUE)
#' data(humface, package = "Rvcg")
#' desk <- digitise(list(humface = humface), dir = "desk", observer = "AB")
#' shape <- fit_shape(desk$specimens$humface)
#' # Two observers
#' again <- digitise(list(humface = humface), dir = "desk", observer = "CD")
#' both <- read_digitised("desk")
#' who <- unique(both$marks[c("specimen", "observer")])
#' repeatability(as.array(both, "landmarks"), who$specimen, who$observer, "landmarks")
#' @export
digitise <- function(specimens, scheme = face_scheme(), dir = NULL, observer = "",
                     blank = TRUE, settings = ridge_settings(error = FALSE), view = NULL,
                     page = review_settings(), ...) {
  check_given()
  rlang::check_installed("shiny", "to digitise on a page.")
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  check_class(page, "review_settings", "page", "review_settings()")
  check_flags(blank)
  observer <- trimws(check_text(observer, "observer"))
  dir <- check_text(dir, "dir", null = TRUE)
  if (!is.null(dir) && !nzchar(observer)) {
    refuse_argument("observer", observer, "Records in a folder need the observer's name.")
  }
  if (!is.null(view)) view_rotation(view)
  sources <- desk_sources(specimens)
  check_dots(..., known = names(formals(shiny::runApp))[-1])
  desk <- desk_from(sources, scheme, dir, observer, blank, settings, page)
  desk <- run_review(
    review_page("Digitise", several = length(sources) > 1, cancel = is.null(dir),
                kept = desk_kept(dir)),
    desk_server(desk, desk_surfaces("natural", page, view), result = identity), ...
  )
  digitised_from(with_recorded_reviews(desk, dir))
}

#' Where the work of a desk is, as its page says at the end
#' @noRd
desk_kept <- function(dir) {
  paste0("All landmarks and curves are in the value of digitise() in R",
         if (!is.null(dir)) sprintf(", and in the folder %s", normalizePath(dir, mustWork = FALSE)),
         ".")
}

#' @rdname digitise
#' @export
read_digitised <- function(dir, observer = NULL, specimens = NULL, scheme = face_scheme()) {
  check_given()
  dir <- check_text(dir, "dir")
  observer <- check_names(observer, "observer", null = TRUE)
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme(), read_scheme() or face_scheme()")
  sources <- if (!is.null(specimens)) desk_sources(specimens)
  records <- desk_records(dir, observer)
  if (!length(records)) {
    crestline_abort(sprintf("%s has no records of a desk.", dir),
                    "Give the folder of digitise(dir = ).", stage = "desk",
                    class = "crestline_desk_error")
  }
  new_digitised(do.call(rbind, lapply(records, record_marks, dir = dir)),
                do.call(rbind, lapply(records, record_steps)),
                if (length(sources)) recorded_specimens(records, sources, scheme, dir) else list())
}
