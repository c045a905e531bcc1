# Methods of a study, and what makes two of them the same.

#' The methods of a study by name
#' @noRd
study_methods <- function(settings) {
  if (inherits(settings, "ridge_settings")) {
    settings <- stats::setNames(list(settings), attr(settings, "preset"))
  }
  known <- function(x) inherits(x, "ridge_settings") || is.function(x)
  listed <- is.list(settings) && length(settings) && !is.null(names(settings))
  if (!listed || !all(vapply(settings, known, NA))) {
    crestline_abort("`settings` holds what is neither settings nor a function, or has no names.",
                    "Give ridge_settings(), or a named list of ridge_settings() and functions.",
                    stage = "arguments")
  }
  settings
}

#' A value as one that can be hashed: functions with what they use
#'
#' Of a function its arguments, its body, and what its names stand for: everything in the
#' environments between it and the workspace or a package; of the workspace those names, and texts,
#' that it has. Functions of packages go by name and version.
#'
#' @param seen Environment: `list`, the environments that are being looked at or have been.
#' @noRd
value_print <- function(x, seen = rlang::env(list = list())) {
  if (is.function(x)) return(function_print(x, seen))
  if (is.environment(x)) return(environment_print(x, seen))
  if (is.list(x)) {
    about <- attributes(x)
    return(list(lapply(unclass(x), value_print, seen), names(about),
                lapply(unname(about), function(one) {
      if (is.list(one) || is.function(one) || is.environment(one)) value_print(one, seen) else one
    })))
  }
  if (is.language(x)) return(deparse(x))
  if (typeof(x) %in% c("externalptr", "weakref")) return(typeof(x))
  x
}

function_print <- function(x, seen) {
  if (is.primitive(x)) return(deparse(x))
  home <- environment(x)
  text <- deparse(utils::removeSource(x), control = c(
    "keepNA", "keepInteger", "niceNames", "showAttributes", "hexNumeric"
  ))
  if (is_package(home)) return(list(text, environmentName(home)))
  # Names and texts in a function
  code <- utils::removeSource(x)
  names <- c(all.names(body(code)), all.names(as.call(c(quote(f), formals(code)))))
  quoted <- unlist(regmatches(deparse(code), gregexpr('"[^"]*"', deparse(code))))
  # What a function sees outside its own body
  words <- setdiff(unique(c(names, gsub('"', "", quoted))), "")
  used <- list()
  while (!is_package(home) && !identical(home, globalenv())) {
    used <- c(used, list(environment_print(home, seen)))
    home <- parent.env(home)
  }
  if (identical(home, globalenv())) {
    own <- sort(words[vapply(words, exists, NA, globalenv(), inherits = FALSE)])
    fresh <- setdiff(own, names(seen$workspace))
    seen$workspace[fresh] <- TRUE
    used <- c(used, own, lapply(mget(fresh, globalenv()), value_print, seen))
  }
  c(list(text), used)
}

environment_print <- function(x, seen) {
  if (is_package(x) || identical(x, globalenv())) return(environmentName(x))
  if (any(vapply(seen$list, identical, NA, x))) return("seen")
  seen$list <- c(seen$list, x)
  lapply(mget(sort(ls(x, all.names = TRUE)), x), value_print, seen)
}

#' Packages, their namespaces and imports, and R's own environments
#' @noRd
is_package <- function(x) {
  identical(x, emptyenv()) || identical(x, baseenv()) || isNamespace(x) || !is.null(attr(x, "name"))
}
