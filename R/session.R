# What belongs to the session: values worked out once, and the random stream, which is left alone.

session_values <- new.env(parent = emptyenv())

once <- function(name, make) {
  if (is.null(session_values[[name]])) session_values[[name]] <- make()
  session_values[[name]]
}

#' Evaluate with the random stream started at a seed, and leave the user's stream and its kind as
#' they were
#'
#' The kind is R's own whatever the user has set, since parallel workers have others.
#' @noRd
with_seed <- function(seed, code) {
  if (is.null(seed)) return(code)
  old <- globalenv()$.Random.seed
  kind <- RNGkind()
  on.exit({
    do.call(RNGkind, as.list(kind))
    if (is.null(old)) rm(".Random.seed", envir = globalenv()) else
      assign(".Random.seed", old, envir = globalenv())
  })
  set.seed(seed, "Mersenne-Twister", "Inversion", "Rejection")
  code
}
