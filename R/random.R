# Random numbers that leave the session's stream alone.

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
