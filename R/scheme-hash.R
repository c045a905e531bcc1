# What a scheme is, in one string.

#' Hash of a scheme's tables
#'
#' Names of rows, the order of columns, the scheme's own name, and whether numbers are integers do
#' not count.
#'
#' @return One string of 32 characters.
#' @noRd
scheme_hash <- function(scheme) {
  rlang::hash(lapply(unclass(scheme)[names(scheme_columns)], function(table) {
    table <- as.list(table)
    lapply(table[order(names(table), method = "radix")], plain_values)
  }))
}

plain_values <- function(x) {
  if (is.factor(x)) x <- as.character(x)
  as.vector(if (is.character(x)) enc2utf8(x) else if (is.integer(x)) as.double(x) else x)
}
