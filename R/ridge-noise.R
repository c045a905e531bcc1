# The noise of a scanner, known from two scans of one subject.

#' The setting `noise`: NA, or standard deviations and correlation length
#' @noRd
noise_setting <- function(noise, call = rlang::caller_env()) {
  if (inherits(noise, "scan_noise")) noise <- unlist(noise[c("independent", "smooth", "range")])
  if (length(noise) == 1 && is.na(noise)) return(NA)
  known <- is.numeric(noise) && length(noise) == 3 && all(is.finite(noise)) && all(noise >= 0)
  if (known) return(stats::setNames(as.numeric(noise), c("independent", "smooth", "range")))
  crestline_abort(sprintf("`noise` is %s.", describe_value(noise)),
                  "Give what scan_noise() returns, or NA.", stage = "arguments", call = call)
}
