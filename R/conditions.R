# Errors and warnings that say which specimen, at which stage, and what to do.

#' Stop with a condition that names specimen, stage and remedy
#'
#' @param problem What is wrong, one sentence, plain text.
#' @param remedy What the user can do about it, one sentence.
#' @param stage Where it happened: "reading", "landmarks", "curvature", ...
#' @param id Identifier of the specimen, where there is one.
#' @param class Further class in front of `crestline_error`.
#' @param call The call to blame; NULL: none.
#' @return Never returns; the condition carries `id`, `stage`, `problem`, `remedy`.
#' @noRd
crestline_abort <- function(problem, remedy, stage, id = NULL, class = NULL,
                            call = called_function()) {
  where <- if (is.null(id)) stage else sprintf("specimen %s, %s", id, stage)
  rlang::abort(
    c(paste0(where, ": ", problem), i = remedy), class = c(class, "crestline_error"),
    id = id, stage = stage, problem = problem, remedy = remedy, call = call
  )
}

#' The frame of the function that the user called: the outermost one of the package
#' @noRd
called_function <- function() {
  for (i in seq_len(sys.nframe())) {
    if (identical(topenv(environment(sys.function(i))), topenv())) return(sys.frame(i))
  }
}

#' Warn with the same parts as [crestline_abort()]
#' @noRd
crestline_warn <- function(problem, remedy, stage, id = NULL, class = NULL) {
  where <- if (is.null(id)) stage else sprintf("specimen %s, %s", id, stage)
  rlang::warn(
    c(paste0(where, ": ", problem), i = remedy), class = c(class, "crestline_warning"),
    id = id, stage = stage, problem = problem, remedy = remedy
  )
}

#' Say what was taken for granted: one sentence
#' @noRd
crestline_inform <- function(said) rlang::inform(said, class = "crestline_message")

#' Say, once a session, that a call is of a former form, and how it is written today
#' @noRd
inform_former <- function(former, today) {
  rlang::inform(sprintf("`%s` is deprecated. Write `%s`.", former, today),
                class = c("crestline_deprecated", "crestline_message"), .frequency = "once",
                .frequency_id = paste("crestline:", former))
}

#' What could not be done, as a value
#'
#' Inner functions hand a failure up. It becomes an error at the door only, see [in_context()].
#' @param problem,remedy,stage,id,class As in [crestline_abort()].
#' @noRd
no_result <- function(problem, remedy, stage, id = NULL, class = NULL) {
  structure(list(problem = problem, remedy = remedy, stage = stage, id = id, class = class),
            class = "no_result")
}

failed <- function(x) inherits(x, "no_result")

#' The value of code, or the error that it raises as a failure
#' @noRd
as_value <- function(code) {
  tryCatch(code, crestline_error = function(e) {
    own <- setdiff(class(e), c("crestline_error", "rlang_error", "error", "condition"))
    no_result(e$problem, e$remedy, e$stage, e$id, own)
  })
}

#' The value of code; a failure becomes an error here, with the specimen and what was being done
#' where it names no specimen
#' @noRd
in_context <- function(code, id, doing = NULL) {
  found <- as_value(code)
  if (!failed(found)) return(found)
  said <- if (is.null(found$id) && !is.null(doing)) paste0(doing, ": ", found$problem) else
    found$problem
  crestline_abort(said, found$remedy, found$stage, if (is.null(found$id)) id else found$id,
                  class = found$class, call = NULL)
}

#' Print an object; of a damaged one an error of ours, in place of R's
#'
#' @param code What prints it.
#' @noRd
printed <- function(x, code) {
  tryCatch(code, error = function(e) {
    if (inherits(e, "crestline_error")) rlang::cnd_signal(e)
    id <- if (is.list(x)) unclass(x)[["id"]]
    crestline_abort(sprintf("the %s cannot be printed: it is damaged (%s).", class(x)[1],
                            rlang::cnd_message(e)),
                    "Make it anew; str(unclass(x)) shows what is left of it.", stage = "printing",
                    id = if (is.character(id) && length(id) == 1) id, call = NULL)
  })
}
