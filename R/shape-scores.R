# Lengths of many specimens against each other.

#' Robust z-scores of lengths, relative to each specimen's size
#'
#' Tukey's median polish takes the specimen's size and the part's usual length off the logarithms,
#' so that a large specimen is not flagged and one wrong curve does not change its size. What is
#' left of a length is compared with the median and MAD of the others' (not its own).
#'
#' @param lengths Matrix, specimens x parts, NA where missing.
#' @param others Fewest other specimens.
#' @param spread Least spread, as a share of a length.
#' @return Matrix of the same size, NA where there are too few others.
#' @noRd
length_scores <- function(lengths, others, spread) {
  share <- stats::medpolish(log(lengths), trace.iter = FALSE, na.rm = TRUE)$residuals
  score <- function(x) {
    vapply(seq_along(x), function(i) {
      rest <- x[-i][!is.na(x[-i])]
      if (length(rest) < others) return(NA_real_)
      (x[i] - stats::median(rest)) / max(stats::mad(rest), spread)
    }, 0)
  }
  scores <- matrix(apply(share, 2, score), nrow(lengths))
  dimnames(scores) <- dimnames(lengths)
  scores
}
