#' @param ... Nothing: settings are given by name, and an unknown name is an error.
