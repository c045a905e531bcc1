# The quality of one specimen or many as a page for the browser.

#' Write a page with the quality of measured specimens
#'
#' Writes one self-contained HTML file, which needs no network. The page has
#'
#' * the numbers of green, amber and red parts of each specimen;
#' * for several specimens, a matrix of specimens by curves, patches and landmarks;
#' * pictures of the specimens, with curves and points in the colours of their grades;
#' * the table of [quality()] with the reasons, which can be sorted and filtered.
#'
#' @inheritParams quality
#' @template page-file
#' @param specimens Specimens of the shapes, for the pictures: one [specimen()], or a list in any
#'   order (matched by `id`). A shape without a specimen is drawn as its own surface.
#' @template page-title
#' @param pictures Number of specimens that are drawn, the worst first.
#' @param size Width and height of a specimen's picture in pixels.
#' @return The path of the file, invisibly.
#' @section Errors: of class `crestline_error`: those of [quality()]; the file has another ending,
#'   or its folder does not exist; a specimen has no shape.
#' @template glossary
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' page <- tempfile(fileext = ".html")
#' quality_report(fit_shape(face, face_scheme()), page, face)
#' file.size(page)
#' unlink(page)
#' }
#' @export
quality_report <- function(x, file, specimens = NULL, limits = quality_limits(), others = NULL,
                           title = "Quality of measured specimens", pictures = 12,
                           size = c(1500, 640)) {
  check_given()
  title <- check_text(title, "title")
  size <- check_size(size)
  rlang::check_installed("htmltools", "to write a page.")
  file <- check_page_file(file)
  pictures <- check_count(pictures, "pictures", lower = 0)
  shapes <- named_shapes(x)
  table <- quality(if (inherits(x, "shape_batch")) x else shapes, limits, others)
  specimens <- specimens_of(specimens, shapes)
  counts <- summary(table)
  counts$grade <- ifelse(counts$red > 0, "red", ifelse(counts$amber > 0, "amber", "green"))
  drawn <- counts$specimen[order(-counts$red, -counts$amber)]
  drawn <- utils::head(drawn[!vapply(shapes[drawn], is.null, NA)], pictures)
  figures <- lapply(drawn, function(name) {
    graded <- table[table$specimen == name, ]
    report_figure(name, grade_picture(shapes[[name]], graded, specimens[[name]], size), graded,
                  length(drawn) == 1)
  })
  tags <- htmltools::tags
  share <- function(name) sum(table$grade == name)
  said <- sprintf("%s, %s: %d green, %d amber, %d red.", amount(nrow(counts), "specimen"),
                  amount(nrow(table), "part"), share("green"), share("amber"), share("red"))
  bar <- report_bar(share("green"), share("amber"), share("red"))
  page <- page_document(
    title, report_overview(counts), report_matrix(counts), report_figures(figures),
    report_parts(table), report_limits(limits), provenance_block(shapes_provenance(shapes)),
    report_data(table), tags$script(htmltools::HTML(report_text("quality.js"))),
    lead = tags$div(class = "sum", bar, tags$p(said))
  )
  save_page(page, file, TRUE)
  invisible(file)
}

#' The specimens by name of shape; NULL where there is none
#' @noRd
specimens_of <- function(specimens, shapes) {
  if (is.null(specimens)) return(list())
  specimens <- check_list(specimens, "specimen", "specimens", "specimen() or read_specimen()")
  id <- vapply(specimens, `[[`, "", "id")
  own <- vapply(shapes, function(shape) if (is.null(shape)) NA_character_ else shape$id, "")
  strange <- setdiff(id, own)
  if (length(strange)) {
    crestline_abort(sprintf("there is no shape of specimen %s.", shorten(strange)),
                    "Give the specimens of the shapes, each with the `id` of its shape.",
                    stage = "page")
  }
  found <- stats::setNames(specimens[match(own, id)], names(shapes))
  for (name in names(shapes)) if (!is.null(found[[name]])) check_shape_on(shapes[[name]],
                                                                          found[[name]])
  found
}

#' A shape's pictures as the text of a data address; NULL where there is nothing to draw
#' @noRd
grade_picture <- function(shape, graded, specimen, size, resolution = 120) {
  if (all(is.na(shape$points$x)) || (is.null(specimen) && is.null(own_surface(shape)))) return(NULL)
  file <- tempfile(fileext = ".png")
  on.exit(unlink(file))
  type <- if (capabilities("cairo")) "cairo" else getOption("bitmapType")
  grDevices::png(file, size[1], size[2], res = resolution, type = type)
  tryCatch(draw_grades(shape, graded, specimen), finally = grDevices::dev.off())
  png_address(file)
}

#' A picture in a file as a data address
#' @noRd
png_address <- function(file) {
  bytes <- readBin(file, "raw", file.size(file))
  paste0("data:image/png;base64,", gsub("\n", "", jsonlite::base64_enc(bytes), fixed = TRUE))
}
