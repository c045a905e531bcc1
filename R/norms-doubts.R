# What must be known of a shape before it is judged: its unit, whether it was slid, its red parts.

#' Refuse a shape whose size differs from the expected one as units do
#'
#' @param ratio Its size over the expected one.
#' @param of What it is compared with, in words.
#' @param size Greatest ratio, or its inverse, as in [sample_limits()].
#' @noRd
check_size_ratio <- function(ratio, of, id, stage, size = sample_limits()$size) {
  if (is.na(ratio) || ratio <= size && ratio >= 1 / size) return(invisible())
  crestline_abort(sprintf("its size is %.3g times that of %s: another unit.", ratio, of),
                  sprintf("Read its scan with `rescale = %s`, measure and slide it again.",
                          format(signif(1 / ratio, 1), scientific = FALSE)), stage = stage, id = id,
                  class = "crestline_unit_error")
}

#' Refuse a shape that fits better as its mirror image
#' @param x,reference k x 3, NA where missing; `of` names the reference.
#' @noRd
check_not_mirrored <- function(x, reference, of, id, stage) {
  known <- !is.na(x[, 1]) & !is.na(reference[, 1])
  centred <- function(a) sweep(a[known, , drop = FALSE], 2, colMeans(a[known, , drop = FALSE]))
  fit <- function(sign) {
    sum(nearest_rotation(centred(x) %*% diag(c(sign, 1, 1)), centred(reference))$d)
  }
  if (sum(known) < 4 || fit(1) >= fit(-1)) return(invisible())
  crestline_abort(sprintf("it is the mirror image of %s: left and right are exchanged.", of),
                  "Exchange the names of its left and right landmarks, or mirror its scan.",
                  stage = stage, id = id, class = "crestline_mirrored")
}

#' Warn of a shape that was slid against another template than the faces of a norm
#' @noRd
warn_other_template <- function(shape, norms) {
  own <- shape$provenance$template$hash
  theirs <- norms$scheme$template
  if (is.null(own) || is.null(theirs) || identical(own, theirs)) return(invisible())
  crestline_warn("it was slid against another template than the faces of the norm.",
                 "Slide it against the template of the norm's sample: slide(shape, sample).",
                 stage = "norms", id = shape$id, class = "crestline_other_template")
}

#' Warn of a measured shape that was not slid, and of red parts
#' @noRd
warn_unready <- function(shape, stage) {
  if (!is.null(shape_key(shape)) && is.null(shape$sliding)) {
    crestline_warn("it was not slid: its points are not homologous to those of others.",
                   "Slide it against the template of the sample: slide(shape, sample).",
                   stage = stage, id = shape$id, class = "crestline_not_slid")
  }
  warn_red(red_parts(stats::setNames(list(shape), shape$id), quality_limits()), stage,
           "quality(shape) has the reasons. Mend the scan or its landmarks, or leave them out.")
}
