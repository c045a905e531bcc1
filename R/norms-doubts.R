# What must be known of a shape before it is judged: its unit, whether it was slid, its red parts.

#' Refuse a shape whose size differs from the expected one as units do
#'
#' @param ratio Its size over the expected one.
#' @param of What it is compared with, in words.
#' @param size Greatest ratio, or its inverse, as in [sample_limits()].
#' @noRd
check_size_ratio <- function(ratio, of, id, stage, size = sample_limits()$size,
                             call = rlang::caller_env()) {
  if (is.na(ratio) || ratio <= size && ratio >= 1 / size) return(invisible())
  crestline_abort(sprintf("its size is %.3g times that of %s: another unit.", ratio, of),
                  sprintf("Read its scan with `rescale = %s`, measure and slide it again.",
                          format(signif(1 / ratio, 1), scientific = FALSE)), stage = stage, id = id,
                  class = "crestline_unit_error", call = call)
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
