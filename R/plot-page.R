# A page for the browser: the specimen that turns, its curves, and a table of them.

#' Write a page with the turning specimen and its curves
#'
#' Writes one self-contained HTML file, or a file and a folder. Of a specimen, the page has the
#' surface coloured by shape index, the curves with their bands, the colour scale with its radius,
#' and a table with the meaning and unit of each column. For a shape it also has the triangles of
#' its surface. Ticks hide each layer of the scene. A pointer that rests on a curve or point shows
#' its name. Of an assessment ([assess()]) or of two visits ([compare_visits()]) it is a page
#' without scripts, which prints on A4, also in black and white; see the sections below.
#'
#' @param x A [specimen()]. Or a shape of [fit_shape()], which then is `curves` too. Or an
#'   `assessment` of [assess()] or a `visit_comparison` of [compare_visits()]; for these only `file`
#'   and `title` may be given.
#' @template page-file
#' @param curves One curve of [ridge_curve()], or a list of curves, whose names are in the table. Or
#'   a `shape`, as [fit_shape()] returns it.
#' @param table Data frame that is shown below the picture. NULL: none.
#' @template page-title
#' @param caption A sentence below the picture.
#' @param surface As in [plot_curves()].
#' @param selfcontained TRUE: the page is one file. FALSE: a folder named after the file, ending in
#'   `_files`, is written beside it.
#' @param size Width and height of the picture, two numbers, in pixels of the browser.
#' @param ... Passed to [plot_curves()] or, with a shape, [plot.shape()]: `colour`, `width` (4
#'   here), `curvature`, `radius`, `view`, `band`. Settings of [widget_settings()]. `length_unit`:
#'   name of the unit of lengths, such as "mm". `specimen`, the former name of `x`, still works.
#' @return The path of the file, invisibly.
#' @section Page of an assessment: The person, the norm and the error of the scan; the answers to
#'   six questions ("differs by more than chance", "no difference shown", "could not be assessed"),
#'   with the place, direction and height of what was found; pictures of the face, of both maps and
#'   of the expected shape; the places that do not fit, with 95 % intervals; growth charts of size
#'   and of the measurements with the largest z; all measurements with z, centile and both errors;
#'   what could not be assessed, by part; limits; where it came from. Missing places are holes in
#'   the pictures. Lengths are in mm for a norm of [face_scheme()]. The page gives no diagnosis.
#' @section Page of two visits: What changed, where and by how much, and from what size on a change
#'   could have been seen; what could not be compared, by part; the change along the normals as a
#'   picture, whose colours are full from at least six standard errors on; all curves, patches and
#'   measurements with their growth (if it is subtracted), change, standard error and smallest
#'   detectable change; the limits. Without any errors the page has the changes alone.
#' @section Errors: of class `crestline_error`: the file has another ending, or its folder does not
#'   exist; the curves belong to another mesh; an argument is given that the page has not.
#' @template glossary
#' @seealso [assess()], [compare_visits()], [quality_report()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' lip <- ridge_curve(face, "chL", "st", "valley", radius = 5, width = 6, n = 9)
#' page <- tempfile(fileext = ".html")
#' write_page(face, page, list("mid-line lip left" = lip), radius = 10)
#' file.size(page)
#' unlink(page)
#' }
#' @export
write_page <- function(x, file, curves = list(), table = curve_table(curves),
                       title = paste("Specimen", x$id), caption = NULL,
                       surface = "shape index", selfcontained = TRUE, size = c(900, 800), ...) {
  turned <- object_first(x, file, "write_page", "specimen", ...)
  x <- turned$x
  if (inherits(x, c("assessment", "visit_comparison"))) {
    given <- setdiff(names(match.call())[-1], c("", "x", "file", "title"))
    return(other_page(x, turned$file, if (!missing(title)) title, given))
  }
  if (inherits(x, "shape")) x <- specimen_of_page(curves <- x)
  check_class(x, "specimen", "x", "specimen() or read_specimen()")
  title <- check_text(title, "title")
  caption <- check_text(caption, "caption", null = TRUE)
  surface <- check_choice(surface, surface_choices, "surface")
  check_flags(selfcontained)
  size <- check_size(size)
  if (inherits(curves, "shape")) check_class(curves, "shape", "curves", "fit_shape()") else
    curves <- check_curves(curves)
  table <- check_table(table, "table", null = TRUE)
  rlang::check_installed("htmltools", "to write a page.")
  file <- check_page_file(turned$file)
  more <- turned$more
  unit <- check_text(if (is.null(more$length_unit)) "unit of the mesh" else more$length_unit,
                     "length_unit")
  more$length_unit <- NULL
  scene <- page_scene(curves, x, surface, size, more)
  scene$drawn$bar$title <- sub("unit of the mesh", unit, scene$drawn$bar$title, fixed = TRUE)
  of <- provenance_of(if (inherits(curves, "shape")) curves else x)
  page <- page_document(
    title, widget_html(scene, "crestline"),
    if (!is.null(caption)) htmltools::tags$p(caption),
    if (NROW(table)) page_section(paste0("Curves", if (inherits(curves, "shape")) " of the shape"),
                                  column_table(table, curve_meanings(unit))),
    lead = htmltools::tags$div(class = "sum", page_lead(curves, x)), provenance = of
  )
  save_page(page, file, selfcontained)
  invisible(file)
}

#' The specimen that a shape keeps, or an error with the call that gives it
#' @noRd
specimen_of_page <- function(shape) {
  if (!is.null(shape$specimen)) return(shape$specimen)
  crestline_abort("`x` is a shape without its specimen.",
                  "Give the specimen first: write_page(specimen, file, curves = shape).",
                  stage = "arguments", id = shape$id)
}

#' The page of an object that is no specimen
#'
#' @param given Names of other arguments, which such a page has not.
#' @noRd
other_page <- function(x, file, title, given) {
  if (length(given)) {
    crestline_abort(sprintf("`%s` is for pages of a specimen.", given[1]),
                    sprintf("Of an object of class %s give a file, and perhaps a `title`.",
                            class(x)[1]), stage = "arguments")
  }
  title <- check_text(title, "title", null = TRUE)
  rlang::check_installed("htmltools", "to write a page.")
  file <- check_page_file(file)
  page_of(x, file, title)
  invisible(file)
}

#' Methods are where their pages are made
#' @noRd
page_of <- function(x, file, title) UseMethod("page_of")

#' What a page shows on the specimen, as a scene
#'
#' @param more Dots of [write_page()].
#' @noRd
page_scene <- function(curves, specimen, surface, size, more, edges = "#505050", raised = 0.004) {
  # Not modifyList(), by which a NULL that is given would pass as not given.
  usual <- list(width = 4, view = "front")
  more <- c(more, usual[setdiff(names(usual), names(more))])
  more$engine <- "widget"
  more$size <- size
  more$surface <- surface
  of_shape <- inherits(curves, "shape")
  if (!is.null(more$colour)) check_colour(more$colour, "colour")
  if (of_shape && is.null(more$patches)) more$patches <- FALSE
  scene <- do.call(if (of_shape) plot.shape else plot_curves, c(list(curves, specimen), more),
                   quote = TRUE)
  if (of_shape && any(curves$status$level == "surface" & curves$status$ok)) {
    draw_edges(in_layer(scene, "surface model"), shape_mesh(curves), edges, 1, raised)
  }
  scene
}

#' What the page is about, in one line
#' @noRd
page_lead <- function(curves, specimen) {
  mesh <- sprintf("surface of %d triangles", ncol(specimen$mesh$it))
  words <- if (inherits(curves, "shape")) {
    found <- curves$status$level == "curves" & curves$status$ok
    c(amount(sum(found), "curve"), amount(sum(!is.na(curves$points$x)), "point"),
      paste("scheme", curves$scheme$name))
  } else if (length(curves)) amount(length(curves), "curve")
  htmltools::tags$p(paste(c(words, mesh), collapse = ", "))
}

#' What each column of the table of curves means, with its unit
#' @noRd
curve_meanings <- function(unit) {
  list(
    kind = "ridge or valley: found by curvature; plane: shortest plane cut between its landmarks",
    length = sprintf("arc length (%s)", unit),
    strength = sprintf("mean curvature of the kind sought along the curve (1 / %s)", unit),
    se = sprintf("median standard error of the curve's place, across it (%s)", unit),
    competing = "how good the best other path is, as a share of the one chosen; near 1 is doubtful",
    converged = "whether the search for the curve came to an end",
    reason = "why a curve is not there, or what had to be done without"
  )
}

# One row a curve: what it is, how long, how strong, how sure.
curve_table <- function(curves) {
  if (inherits(curves, "shape")) {
    return(curves$status[curves$status$level == "curves",
                         c("part", "kind", "length", "strength", "se", "competing", "reason")])
  }
  curves <- check_curves(curves)
  pick <- function(name, type) vapply(
    curves, function(curve) type(curve[[name]]), type(NA), USE.NAMES = FALSE
  )
  name <- if (is.null(names(curves))) character(length(curves)) else names(curves)
  table <- data.frame(curve = name, kind = pick("type", as.character),
                      from = pick("from", as.character),
                      to = pick("to", as.character), length = pick("length", as.numeric),
                      strength = pick("strength", as.numeric))
  table$se <- pick("se", as.numeric)
  table$converged <- pick("converged", as.logical)
  table[if (all(name == "")) -1 else TRUE]
}
