#' @param x A `shape`, as [fit_shape()] returns it.
