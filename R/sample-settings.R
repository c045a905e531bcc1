# Shapes of one scheme whose curves were measured differently.

#' A warning of curves that shapes of a sample measured by another radius, window or kind
#'
#' The lengths are in the unit of the meshes, which differs between shapes by rounding only.
#'
#' @param shapes Named list of shapes of one scheme.
#' @param alike Greatest difference of equal lengths, as a share.
#' @noRd
warn_curve_tables <- function(shapes, alike = 1e-6) {
  first <- shapes[[1]]$scheme$curves
  differs <- function(shape, column) {
    a <- first[[column]]
    b <- shape$scheme$curves[[column]]
    if (is.numeric(a) && is.numeric(b)) {
      return(is.na(a) != is.na(b) | abs(a - b) > alike * pmax(abs(a), abs(b)) & !is.na(a + b))
    }
    !mapply(identical, as.character(a), as.character(b))
  }
  columns <- intersect(c("kind", "radius", "width"), names(first))
  other <- lapply(shapes, function(shape) vapply(columns, function(column) {
    first$curve[which(differs(shape, column))][1]
  }, ""))
  found <- vapply(other, function(one) any(!is.na(one)), NA)
  if (!any(found)) return(invisible())
  each <- vapply(other[found], function(one) {
    sprintf("%s of %s", names(one)[!is.na(one)][1], one[!is.na(one)][1])
  }, "")
  crestline_warn(
    sprintf("curves were measured otherwise than on %s: %s.", shapes[[1]]$id,
            shorten(paste0(each, " (", names(each), ")"))),
    "Measure all specimens by one scheme, fit_shapes(..., scheme = ).", stage = "homologise",
    class = "crestline_other_radius"
  )
}
