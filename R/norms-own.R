# Size and measurements of one face on a norm's scales, with their own errors.

#' Standard errors of size and measurements of a norm's faces, and what errors added to them
#' @param most Number of faces that are measured with their errors.
#' @return The norm's table with `se_norm` and `bias_norm`, on the scales of the values.
#' @noRd
with_value_errors <- function(norms, sample, most = 20) {
  chosen <- unique(round(seq(1, length(sample), length.out = min(most, length(sample)))))
  each <- lapply(sample$shapes[chosen], function(shape) own_errors(shape, norms))
  of <- function(name) do.call(cbind, lapply(each, `[[`, name))
  squares <- rowMeans(of("se")^2, na.rm = TRUE)
  bias <- rowMeans(of("bias"), na.rm = TRUE)
  table <- norms$table
  rest <- nrow(table) - length(bias)
  table$se_norm <- c(signif(ifelse(is.finite(squares), sqrt(squares), 0), 4), rep(0, rest))
  table$bias_norm <- c(signif(ifelse(is.finite(bias), bias, NA), 4), rep(0, rest))
  table
}

#' Log size and measurements of a shape with their standard errors, on the norm's scales
#'
#' What errors add on average is taken off where it was taken off the norm's faces. Where it is not
#' known of this shape, its errors are taken to be as large as theirs.
#' @param together As in [place_errors()].
#' @return List: `value`, `se` (NA where unknown), `bias` (that of this shape, NA where unknown),
#'   `reason` (why there is no value, or NA).
#' @noRd
own_errors <- function(shape, norms, error = NULL, draws = 100, together = NULL) {
  size <- size_error(shape, norms)
  if (!NROW(norms$measurements)) return(size)
  own <- measured_rows(list(shape), norms$measurements, error, draws, together)
  logs <- norms$table$transform[1 + seq_len(nrow(own))] == "log"
  scaled <- function(x) {
    ifelse(logs, ifelse(!is.na(x) & x > 0, log(pmax(x, .Machine$double.xmin)), NA), x)
  }
  base <- norms$table$bias_norm[1 + seq_len(nrow(own))]
  if (is.null(base)) base <- rep(NA_real_, nrow(own))
  plain <- scaled(own$value)
  clean <- scaled(own$value - own$bias)
  value <- ifelse(is.na(base), plain, ifelse(is.na(own$bias), plain - base, clean))
  reason <- ifelse(is.na(own$value), "a point that it needs is missing",
                   ifelse(is.na(value), not_above_errors(), NA_character_))
  list(value = c(size$value, value), se = c(size$se, ifelse(logs, own$se / own$value, own$se)),
       bias = c(size$bias, plain - clean), reason = c(size$reason, reason))
}

#' Log size and its standard error, `bias` and `reason` as in [own_errors()]
#' @noRd
size_error <- function(shape, norms) {
  points <- shape$points[shape$points$level == "surface", ]
  row <- match(norms$points$point, paste(points$part, points$point))
  xyz <- as.matrix(points[row, c("x", "y", "z")])
  laid <- lay_face(xyz, as.matrix(norms$points[c("x", "y", "z")]))
  off <- sweep(xyz, 2, colMeans(xyz, na.rm = TRUE))
  # Each point moves log size by its distance from the centre over the size's square.
  known <- !is.na(points$se[row])
  se <- sqrt(sum((points$se[row]^2 * rowSums(off^2))[known])) / laid$size^2
  value <- unbiased_log_size(laid$size, points$se[row])
  list(value = value, se = if (mean(known) < 0.5) NA_real_ else se, bias = log(laid$size) - value,
       reason = if (is.na(value)) not_above_errors() else NA_character_)
}
