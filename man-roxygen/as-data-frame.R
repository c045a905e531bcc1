#' @param row.names,optional,... Ignored.
