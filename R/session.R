# Values that are worked out once a session and do not change.

session_values <- new.env(parent = emptyenv())

once <- function(name, make) {
  if (is.null(session_values[[name]])) session_values[[name]] <- make()
  session_values[[name]]
}
