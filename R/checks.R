# One small checker owns one kind of argument: it says what is wrong and what to do.

check_number <- function(x, name, lower = -Inf, upper = Inf, open = FALSE,
                         call = rlang::caller_env()) {
  ok <- is.numeric(x) && length(x) == 1 && is.finite(x) &&
    (if (open) x > lower && x < upper else x >= lower && x <= upper)
  if (!ok) {
    crestline_abort(
      sprintf("`%s` is %s.", name, describe_value(x)),
      sprintf("Give one finite number %s.", describe_range(lower, upper, open)),
      stage = "arguments", call = call
    )
  }
  as.numeric(x)
}

check_count <- function(x, name, lower = 1, call = rlang::caller_env()) {
  x <- check_number(x, name, lower = lower, call = call)
  if (x != round(x)) {
    crestline_abort(sprintf("`%s` is %s.", name, describe_value(x)),
                    "Give a whole number.", stage = "arguments", call = call)
  }
  as.integer(x)
}

check_choice <- function(x, choices, name, call = rlang::caller_env()) {
  if (!is.character(x) || length(x) < 1 || !x[[1]] %in% choices) {
    crestline_abort(
      sprintf("`%s` is %s.", name, describe_value(x)),
      paste0("Choose one of ", paste0('"', choices, '"', collapse = ", "), "."),
      stage = "arguments", call = call
    )
  }
  x[[1]]
}

check_flag <- function(x, name, call = rlang::caller_env()) {
  if (!isTRUE(x) && !isFALSE(x)) {
    crestline_abort(sprintf("`%s` is %s.", name, describe_value(x)), "Give TRUE or FALSE.", stage = "arguments", call = call)
  }
  x
}

check_class <- function(x, class, name, maker, call = rlang::caller_env()) {
  if (!inherits(x, class)) {
    crestline_abort(
      sprintf("`%s` is %s, not of class \"%s\".", name, describe_value(x), class),
      sprintf("Make one with %s.", maker), stage = "arguments", call = call
    )
  }
  validate(x)
  invisible(x)
}

#' Refuse an object that breaks the rules of its class: validate_<class>() of the classes that have rules
#' @noRd
validate <- function(x) UseMethod("validate")

#' @exportS3Method
validate.default <- function(x) invisible(x)

describe_value <- function(x) {
  if (is.null(x)) return("NULL")
  if (!is.atomic(x)) return(paste0("of class ", class(x)[1]))
  shown <- paste(utils::head(format(x), 3), collapse = ", ")
  if (length(x) > 3) paste0(shown, ", ... (", length(x), " values)") else if (length(x)) shown else "empty"
}

describe_range <- function(lower, upper, open) {
  words <- if (open) c("above", "below") else c("of at least", "of at most")
  bounds <- c(lower, upper)
  paste(paste(words, bounds)[is.finite(bounds)], collapse = " and ")
}
