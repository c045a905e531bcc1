#' @param specimen The [specimen()] that the shape was measured on.
