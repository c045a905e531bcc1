# Where a shape, and what is made of shapes, came from.

#' Hash of a template's places
#' @noRd
template_provenance <- function(id, xyz) list(id = id, hash = content_hash(unname(xyz)))

#' What several shapes have in common, and a row for each; of one its own
#' @noRd
shapes_provenance <- function(shapes) {
  each <- lapply(Filter(Negate(is.null), unname(shapes)), `[[`, "provenance")
  if (!length(each)) return(made_with())
  if (length(each) == 1 && length(each[[1]])) return(each[[1]])
  fields <- stats::setNames(nm = c("scheme", "template"))
  common <- lapply(fields, function(field) {
    values <- unique(lapply(each, `[[`, field))
    if (length(values) == 1) values[[1]]
  })
  # Settings by stage; of a stage in which they differ, that they do
  settings <- lapply(each, `[[`, "settings")
  stages <- unique(unlist(lapply(settings, names)))
  common$settings <- lapply(stats::setNames(nm = stages), function(stage) {
    values <- unique(lapply(settings, `[[`, stage))
    if (length(values) == 1) values[[1]] else list(differs = "between specimens")
  })
  c(made_with(), Filter(Negate(is.null), common), list(specimens = specimens_provenance(shapes)))
}

#' A row a specimen: `id`, `file`, `key`, `landmarks` (in words)
#' @noRd
specimens_provenance <- function(shapes) {
  shapes <- unname(Filter(Negate(is.null), shapes))
  text <- function(f) {
    vapply(shapes, function(shape) c(as.character(f(shape)), NA_character_)[1], "")
  }
  data.frame(id = text(function(shape) shape$id),
             file = text(function(shape) shape$provenance$mesh$file),
             key = text(function(shape) shape$provenance$mesh$key),
             landmarks = text(function(shape) origin_words(shape$provenance$landmarks)))
}

#' The factor from a shape's unit to that of its scheme; NA where it is not known
#' @noRd
shape_unit <- function(shape) c(as.numeric(shape$provenance$scheme$unit), NA)[1]

#' Co-ordinates in two units are not one sample
#' @noRd
check_same_unit <- function(shape, other) {
  unit <- c(shape_unit(shape), shape_unit(other))
  if (anyNA(unit) || isTRUE(all.equal(unit[1], unit[2]))) return(invisible())
  odd <- if (unit[1] == 1) 2 else 1
  crestline_abort(
    sprintf("it was measured with `unit = %.4g` and %s with `unit = %.4g`: two units.", unit[1],
            other$id, unit[2]),
    unit_remedy(c(shape$id, other$id)[odd], unit[odd] / unit[-odd]),
    stage = "unit", id = shape$id, class = "crestline_unit_error"
  )
}

#' @rdname provenance
#' @export
summary.shape <- function(object, ...) {
  new_summary(printed_lines(object, most = 4), object$provenance)
}

#' @exportS3Method
provenance_of.shape <- function(x) x$provenance

#' @exportS3Method
comment_lines.shape <- function(x) provenance_comments(provenance_of(x))
