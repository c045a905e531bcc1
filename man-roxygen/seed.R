#' @param seed A whole number; the random stream of the session is then not changed. `NULL`: the
#'   session's stream is used.
