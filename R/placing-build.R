# A scheme built by hand, on a page in the browser.

#' Build a scheme on a page
#'
#' Opens a page in the browser (package shiny) that shows the turning object. There you place and
#' name landmarks, join them by curves, bound patches by curves, and save the folder that
#' [read_scheme()] takes. R fits every curve and patch at once, and the page shows it.
#'
#' * *Landmarks*: click on the surface. The landmark gets the name in the field, exactly on the
#'   mesh, or on the nearest ridge, valley, cap or cup within a radius (see [snap()]). Drag a ball
#'   to move it; its curves follow. "Suggest" shows the places of [suggest_landmarks()] in grey; a
#'   click on one puts a landmark there.
#' * *Curves*: click on the balls of two landmarks, choose kind, radius, width and number of points,
#'   and press "Join". A click on a curve in the list shows its row; "Join" with its name fits it
#'   again with other values. With more than two landmarks the ones between are `via` places, and
#'   with "Closed" the curve returns to the first one.
#' * *Patches*: choose two curves and a number of rows, and press "Bound". The columns of the patch
#'   join their points.
#' * *Pairs*: "Pairs" proposes the left-right pairs. It takes the plane that mirrors most landmarks
#'   onto each other. Names that end in L and R give the sides; else the landmark that was placed
#'   first is left.
#' * "Undo" takes any step back. "Save" writes the folder. "Done" ends the page.
#'
#' @param mesh A [specimen()], whose landmarks are kept, or a `mesh3d`.
#' @param scheme A [curve_scheme()] to continue, or NULL.
#' @param dir Folder that the page proposes to save to, or NULL.
#' @param radius Radius of suggestions and snaps, and the first radius of a curve, in the unit of
#'   the mesh.
#' @param points First number of points of a curve.
#' @param settings [ridge_settings()] of the curves on the page.
#' @param view Direction of view, see [draw_surface()].
#' @param faces As in [review_landmarks()].
#' @param ... Passed to [shiny::runApp()], as in [review_landmarks()].
#' @details The page runs on this computer only. Its address has a random token. R answers only
#'   requests with this token, and none from pages of another site.
#' @return A list: `specimen` with its landmarks, and `scheme`, a [curve_scheme()] whose landmarks
#'   have the places on this specimen (`NULL` without a curve). "Cancel" gives what there was at the
#'   beginning. `fit_shape(built$specimen, built$scheme)` measures what the page showed, with
#'   standard errors.
#' @section Errors: of class `crestline_error`: an argument is wrong, or the package shiny is not
#'   installed. If a step fails, the page gives the reason.
#' @template glossary
#' @seealso [suggest_landmarks()], [check_scheme()], [write_scheme()], [review_landmarks()]
#' @examplesIf interactive() && requireNamespace("shiny", quietly = TRUE)
#' data(boneData, package = "Morpho")
#' built <- build_scheme(skull_0144_ch_fe.mesh, dir = "my scheme", radius = 4)
#' check_scheme(built$scheme, built$specimen)
#' @export
build_scheme <- function(mesh, scheme = NULL, dir = NULL,
                         radius = mesh_diagonal(as_mesh(mesh)) / 25,
                         points = 15, settings = ridge_settings(error = FALSE), view = "front",
                         faces = 60000, ...) {
  check_given()
  check_surface(mesh, "mesh")
  rlang::check_installed("shiny", "to build a scheme on a page.")
  if (!is.null(scheme)) check_class(scheme, "curve_scheme", "scheme", "curve_scheme()")
  dir <- check_text(dir, "dir", null = TRUE)
  radius <- check_number(radius, "radius", 0, open = TRUE)
  points <- check_count(points, "points", lower = 2)
  check_class(settings, "ridge_settings", "settings", "ridge_settings()")
  faces <- check_count(faces, "faces")
  view_rotation(view)
  if (!inherits(mesh, "specimen")) mesh <- specimen(mesh)
  check_radius(radius, mesh)
  check_dots(..., known = names(formals(shiny::runApp))[-1])
  name <- c(scheme$name, if (!is.null(dir)) basename(dir), "scheme")[1]
  begin <- begin_build(mesh, scheme, list(
    ridge = settings, bridge = shape_settings()$bridge,
    threads = getOption("crestline.threads", 1L), radius = radius, name = name
  ))
  shown <- shown_surface(mesh, "natural", radius, faces)
  defaults <- list(radius = radius, points = points, dir = c(dir, "")[1])
  run_review(build_page(paste("Scheme of", mesh$id), defaults),
             scene_server(begin, build_answers(shown, view), shiny::stopApp), ...)
}
