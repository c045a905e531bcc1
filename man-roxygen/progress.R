#' @param progress Whether to show a progress bar.
