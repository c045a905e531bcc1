#' @param title Heading of the page.
