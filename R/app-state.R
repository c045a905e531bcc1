# The state of the app: the code that was run, and what it made. What is shown is what was run, so
# that the code, run again, gives the same.

#' Begin
#' @return List: `code` (lines that were run, the whole analysis), `values` (environment of what
#'   they made), `shown` (what the last step printed), `told` (warnings and messages of it),
#'   `failed` (whether it failed), `steps` (names of the steps that were done).
#' @noRd
begin_app <- function() {
  list(code = "library(crestline)", values = new.env(parent = app_parent()), shown = character(),
       told = character(), failed = FALSE, steps = character())
}

#' Names of the package and of base R, as after library(crestline)
#' @noRd
app_parent <- function() {
  exported <- new.env(parent = globalenv())
  for (name in getNamespaceExports("crestline")) {
    assign(name, getExportedValue("crestline", name), exported)
  }
  exported
}

#' Do a step: its lines are run, and are added to the code if all of them ran
#'
#' What was made of former objects of the same name is taken away, so that no later step mixes both.
#'
#' @param form As in [step_code()].
#' @param around Function of an expression, in which the lines run: for a bar of progress.
#' @noRd
do_step <- function(state, name, form, around = identity) {
  lacking <- setdiff(app_needs()[[name]], ls(state$values))
  if (length(lacking)) {
    return(after_failure(state, sprintf("This step needs %s: do the steps before it first.",
                                        shorten(lacking))))
  }
  code <- tryCatch(step_code(name, form), error = identity)
  if (inherits(code, "error")) return(after_failure(state, conditionMessage(code)))
  around(run_lines(state, name, code))
}

run_lines <- function(state, name, code) {
  # The values are changed in a copy: a step that fails changes nothing
  values <- list2env(as.list(state$values, all.names = TRUE),
                     parent = parent.env(state$values))
  told <- character()
  hear <- function(condition) {
    told <<- c(told, trimws(conditionMessage(condition)))
    rlang::cnd_muffle(condition)
  }
  shown <- tryCatch(
    withCallingHandlers(
      utils::capture.output(for (line in code) {
        value <- withVisible(eval(parse(text = line, keep.source = FALSE), values))
        if (value$visible) print(value$value)
      }), warning = hear, message = hear
    ), error = identity
  )
  if (inherits(shown, "error")) {
    said <- if (inherits(shown, "crestline_error")) c(shown$problem, shown$remedy) else
      conditionMessage(shown)
    return(after_failure(state, c(paste(said, collapse = " "), told)))
  }
  rm(list = intersect(app_outdated(name), ls(values)), envir = values)
  state$values <- values
  state$code <- c(state$code, sprintf("# %s", app_titles()[[name]]), code)
  state$steps <- c(setdiff(state$steps, name), name)
  state[c("shown", "told", "failed")] <- list(shown, told, FALSE)
  state
}

after_failure <- function(state, told) {
  state[c("shown", "told", "failed")] <- list(character(), told, TRUE)
  state
}

#' What each step does, in words
#' @noRd
app_titles <- function() {
  list(folder = "The scans of a folder", find = "Landmarks: found by machine where a scan has none",
       beside = "Landmarks: those beside the scans", hand = "Landmarks: placed by hand",
       measure = "Every scan measured", quality = "Quality", homologise = "Homologous points",
       groups = "Groups from a table", compare = "Groups compared", pictures = "Pictures",
       exports = "Tables for other programs")
}

#' The specimens to look at by hand: those that were measured, else the files
#' @return List: `sources` (as in [digitise()]), `blank`.
#' @noRd
app_desk <- function(state) {
  values <- state$values
  measured <- if (!is.null(values$shapes)) {
    Filter(Negate(is.null), lapply(as.list(values$shapes), function(shape) shape$specimen))
  }
  if (length(measured)) return(list(sources = measured, blank = FALSE))
  list(sources = values$files, blank = !identical(values$found, FALSE))
}
