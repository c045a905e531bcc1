#' @section Lifecycle: Experimental. Arguments, names and values may change without a period of
#'   deprecation.
