# Calls with fields of settings objects beside the arguments: short to write in tests.

#' @param makers Makers of settings, by the argument of `fn` that takes them.
#' @noRd
by_fields <- function(fn, makers, ...) {
  given <- list(...)
  for (argument in names(makers)) {
    field <- names(given) %in% setdiff(names(formals(makers[[argument]])), c("preset", "..."))
    own <- given[field]
    given <- given[!field]
    if (length(own)) given[[argument]] <- do.call(makers[[argument]], own)
  }
  do.call(fn, given)
}

comparing <- function(...) by_fields(compare_groups, list(settings = comparison_settings), ...)

fitting <- function(...) by_fields(fit_shape, list(measuring = shape_settings), ...)

simulating <- function(...) {
  by_fields(simulate_faces, list(population = population_settings), ...)
}

studying <- function(...) by_fields(ridge_study, list(study = study_settings), ...)
