#' @param file Path of the page, ending in ".html".
