# What one scan says of its own noise: the noise factor of its curves together.

#' The noise factor of a specimen: the median over its ridges and valleys; NA without any
#'
#' @param factor Of its parts, NULL in shapes of former versions.
#' @noRd
specimen_noise <- function(factor) {
  if (is.null(factor) || all(is.na(factor))) NA_real_ else stats::median(factor, na.rm = TRUE)
}

#' What the noise factor of a specimen means, in a sentence
#'
#' @param factor One number.
#' @param plain Up to this factor the noise may be independent: the band is at most sqrt(2) as wide.
#' @noRd
noise_text <- function(factor, plain = 2) {
  if (factor <= plain) {
    return(sprintf("noise: independent from vertex to vertex, or known (F = %.2g)", factor))
  }
  sprintf(paste("noise: this scan's noise is correlated, or its relief is fine: F = %.2g;",
                "standard errors are %.2g times those of independent noise"), factor, sqrt(factor))
}
