# A page for the browser: the specimen that turns, its curves, and a table of them.

#' Write a page with the turning specimen and its curves
#'
#' Writes one self-contained HTML file, or a file and a folder. Of a specimen, the page has the
#' surface coloured by shape index, the curves with their bands, the colour scale and a table. For a
#' shape it also has the triangles of its surface. Buttons hide each layer of the scene. Of an
#' assessment ([assess()]) or of two visits ([compare_visits()]) it is a page without scripts, which
#' prints on A4, also in black and white; see the sections below.
#'
#' @param x A [specimen()], or an `assessment` of [assess()] or a `visit_comparison` of
#'   [compare_visits()]; for these only `file` and `title` may be given.
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
#'   here), `curvature`, `radius`, `view`, `band`. `specimen`, the former name of `x`, still works.
#' @return The path of the file, invisibly.
#' @section Page of an assessment: The person, the norm and the errors; the verdicts; pictures of
#'   the face, of both maps and of the expected shape; the places that do not fit; growth charts of
#'   size and of the measurements with the largest z; all measurements with z, centile and both
#'   errors; what could not be assessed; limits; where it came from. Lengths are in mm for a norm of
#'   [face_scheme()]. The page gives no diagnosis.
#' @section Page of two visits: The change along the normals as a picture, the curves, patches and
#'   measurements that changed, their standard errors and smallest detectable changes, and the
#'   limits.
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
  check_class(x, "specimen", "x", "specimen() or read_specimen()")
  title <- check_text(title, "title")
  caption <- check_text(caption, "caption", null = TRUE)
  surface <- check_choice(surface, surface_choices, "surface")
  check_flags(selfcontained)
  size <- check_size(size)
  curves <- if (inherits(curves, "shape")) {
    check_class(curves, "shape", "curves", "fit_shape()")
  } else {
    check_curves(curves)
  }
  table <- check_table(table, "table", null = TRUE)
  rlang::check_installed("htmltools", "to write a page.")
  file <- check_page_file(turned$file)
  rgl::open3d(useNULL = TRUE)
  device <- rgl::cur3d()
  on.exit(rgl::close3d(device))
  plot(x, "plain", engine = "rgl", landmarks = FALSE, polygon_offset = 2)
  layers <- do.call(page_layers, c(list(curves, x, surface), turned$more), quote = TRUE)
  tags <- htmltools::tags
  page <- tags$div(style = "font-family:sans-serif;margin:20px", tags$head(tags$title(title)),
                   tags$h2(title),
                   page_scene(layers, size), page_legend(surface), tags$p(caption),
                   html_table(table),
                   provenance_block(provenance_of(if (inherits(curves, "shape")) curves else x)))
  save_page(page, file, selfcontained)
  invisible(file)
}

#' The page of an object that is no specimen
#'
#' @param given Names of other arguments, which such a page has not.
#' @noRd
other_page <- function(x, file, title, given, call = rlang::caller_env()) {
  if (length(given)) {
    crestline_abort(sprintf("`%s` is for pages of a specimen.", given[1]),
                    sprintf("Of an object of class %s give a file, and perhaps a `title`.",
                            class(x)[1]), stage = "arguments", call = call)
  }
  title <- check_text(title, "title", null = TRUE, call = call)
  rlang::check_installed("htmltools", "to write a page.")
  file <- check_page_file(file, call)
  page_of(x, file, title)
  invisible(file)
}

#' Methods are where their pages are made
#' @noRd
page_of <- function(x, file, title) UseMethod("page_of")

#' The object and the file of a writer; those of a call in the former order, file first, turned
#' round
#'
#' @param x,file Arguments of the writer, given or not.
#' @param writer Its name.
#' @param former Former name of `x`.
#' @param ... The dots of the writer.
#' @return List `x`, `file` and `more`, the rest of the dots.
#' @noRd
object_first <- function(x, file, writer, former, ..., call = rlang::caller_env()) {
  more <- list(...)
  given <- c(x = !missing(x), file = !missing(file))
  if (former %in% names(more)) {
    if (sum(given) != 1) {
      crestline_abort(sprintf("`%s`, the former name of `x`, does not go with these arguments.",
                              former),
                      sprintf("Write %s(x, file), and all that follows by name.", writer),
                      stage = "arguments", call = call)
    }
    inform_former(paste0(writer, "(", former, " = )"), sprintf("%s(x, file)", writer))
    return(list(x = more[[former]], file = if (given[["file"]]) file else x,
                more = more[names(more) != former]))
  }
  check_given(frame = call, fn = rlang::caller_fn())
  if (!is.character(x) || is.character(file)) return(list(x = x, file = file, more = more))
  inform_former(sprintf("%s(file, x)", writer), sprintf("%s(x, file)", writer))
  list(x = file, file = x, more = more)
}

#' Make a page in a folder of our own, then put it where it belongs: what stands there may be the
#' user's
#' @noRd
save_page <- function(page, file, selfcontained) {
  made <- tempfile("page")
  dir.create(made)
  on.exit(unlink(made, recursive = TRUE))
  draft <- file.path(made, "page.html")
  files <- basename(made)
  htmltools::save_html(page, draft, libdir = files)
  html <- safe_scripts(paste(readLines(draft, encoding = "UTF-8", warn = FALSE), collapse = "\n"))
  if (selfcontained) {
    html <- inline_files(html, made, '<script src="([^"]+)"></script>', "script", "</script")
    html <- inline_files(html, made, '<link href="([^"]+)" rel="stylesheet" />', "style", "</style")
  } else {
    folder <- paste0(tools::file_path_sans_ext(basename(file)), "_files")
    # Copy the files that a page needs into a folder, which may be there already; none of another
    # content is written over
    from <- file.path(made, files)
    to <- file.path(dirname(file), folder)
    found <- list.files(from, recursive = TRUE, all.files = TRUE)
    target <- file.path(to, found)
    there <- file.exists(target)
    same <- unname(tools::md5sum(file.path(from, found))) == unname(tools::md5sum(target))
    if (any(there & !same %in% TRUE)) {
      crestline_abort(sprintf("`file` needs the folder %s, where %s is another file already.", to,
                              shorten(found[there & !same %in% TRUE])),
                      "Give another name to the page, or move that folder.", stage = "page",
                      call = NULL)
    }
    new <- which(!there)
    for (dir in unique(dirname(target[new]))) dir.create(dir, FALSE, recursive = TRUE)
    if (!all(suppressWarnings(file.copy(file.path(from, found[new]), target[new])))) refuse_page(to)
    address <- utils::URLencode(folder, reserved = TRUE, repeated = TRUE)
    html <- gsub(paste0('"', files, "/"), paste0('"', address, "/"), html, fixed = TRUE)
  }
  write_html(html, file)
}

write_html <- function(html, file) {
  tryCatch(suppressWarnings(writeLines(enc2utf8(html), file, useBytes = TRUE)),
           error = function(e) refuse_page(file))
}

refuse_page <- function(path) {
  crestline_abort(sprintf("`file`: %s cannot be written.", path),
                  "Check the folder, and the right to write there.",
                  stage = "page", call = NULL)
}

#' The data of widgets in a page, so written that no text in them can end or open a script
#' @noRd
safe_scripts <- function(html, opening = '<script type="application/json"') {
  part <- strsplit(html, opening, fixed = TRUE)[[1]]
  end <- regexpr("</script>", part, fixed = TRUE)
  data <- seq_along(part) > 1 & end > 0
  part[data] <- paste0(script_json(substr(part[data], 1, end[data] - 1)),
                       substr(part[data], end[data], nchar(part[data])))
  paste(part, collapse = opening)
}

#' JSON as it may stand between script tags: `<!--<script>` and the line ends of JavaScript are
#' written as escapes
#' @noRd
script_json <- function(json) {
  json <- enc2utf8(json)
  for (sign in c("<", "\u2028", "\u2029")) {
    json <- gsub(sign, sprintf("\\u%04x", utf8ToInt(sign)), json, fixed = TRUE)
  }
  json
}

# Every reference to a file, as `pattern` finds it in the page, replaced by an element that holds
# the file's text.
inline_files <- function(html, folder, pattern, element, closing) {
  for (reference in unique(regmatches(html, gregexpr(pattern, html))[[1]])) {
    name <- utils::URLdecode(sub(pattern, "\\1", reference))
    text <- paste(readLines(file.path(folder, name), encoding = "UTF-8", warn = FALSE),
                  collapse = "\n")
    text <- gsub(closing, sub("/", "\\/", closing, fixed = TRUE), text, fixed = TRUE)
    parts <- strsplit(html, reference, fixed = TRUE)[[1]]
    html <- paste(parts, collapse = paste0("<", element, ">\n", text, "\n</", element, ">"))
  }
  html
}

check_page_file <- function(file, call = rlang::caller_env()) {
  file <- check_path_to_write(file, "file", c("html", "htm"), "page", call)
  file.path(normalizePath(dirname(file)), basename(file))
}

#' Draw what a page shows on the specimen
#' @return Named list of the ids of what belongs together.
#' @noRd
page_layers <- function(curves, specimen, surface, ..., colour = NULL, width = 4,
                        edges = "#505050", raised = 0.004) {
  if (!is.null(colour)) check_colour(colour, "colour", call = rlang::caller_env())
  width <- check_number(width, "width", lower = 0, call = rlang::caller_env())
  of_shape <- inherits(curves, "shape")
  scene <- if (of_shape) {
    chosen <- if (is.null(colour)) list() else list(colour = colour)
    do.call(plot, c(list(curves, specimen, surface = surface, width = width, engine = "rgl",
                         patches = FALSE), chosen, list(...)), quote = TRUE)
  } else {
    plot_curves(check_curves(curves), specimen, surface, colour, width = width, engine = "rgl", ...)
  }
  layers <- stats::setNames(list(scene$ids[1], scene$ids[-1]), c(surface, "curves"))
  if (of_shape && any(curves$status$level == "surface" & curves$status$ok)) {
    layers[["surface model"]] <- draw_edges(scene, shape_mesh(curves), edges, width / 4,
                                            raised)$ids[-seq_along(scene$ids)]
  }
  Filter(length, layers)
}

# The turning scene, with a button that hides each of its layers.
page_scene <- function(layers, size) {
  scene <- rgl::rglwidget(width = size[1], height = size[2], elementId = "crestline")
  buttons <- Map(function(ids, label) rgl::toggleWidget("crestline", ids = ids, label = label),
                 layers, names(layers))
  htmltools::tagList(scene, htmltools::tags$div(style = "display:flex;gap:8px", unname(buttons)))
}

page_legend <- function(surface) {
  if (surface != "shape index") return(NULL)
  scale <- shape_scale()
  cells <- Map(function(category, colour) {
    style <- paste0("background:", colour, ";color:", if (category == "rut") "white" else "black",
                    ";padding:4px 8px;display:inline-block;font:12px sans-serif")
    htmltools::tags$span(style = style, category)
  }, scale$category, scale$colour)
  htmltools::tags$div(style = "margin:10px 0", unname(cells))
}

html_table <- function(table, digits = 3) {
  if (is.null(table) || nrow(table) == 0) return(NULL)
  cell <- "padding:3px 12px;border-bottom:1px solid #ddd;text-align:left"
  shown <- vapply(table, function(column) {
    if (is.numeric(column)) column <- signif(column, digits)
    ifelse(is.na(column), "", vapply(column, format, "", USE.NAMES = FALSE))
  }, character(nrow(table)))
  shown <- matrix(shown, nrow(table))
  rows <- apply(shown, 1,
                function(row) htmltools::tags$tr(lapply(row, htmltools::tags$td, style = cell)),
                simplify = FALSE)
  htmltools::tags$table(style = "border-collapse:collapse;font:13px sans-serif",
                        htmltools::tags$tr(lapply(names(table), htmltools::tags$th, style = cell)),
                        rows)
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
