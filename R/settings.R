# One helper makes every settings object, one prints it.

#' The settings object that a function makes of its arguments
#'
#' Fields are arguments after `...`: their names are completed, and none is taken for another by its
#' first letters. `...` catches former names and what is no field.
#'
#' @param class Of the object.
#' @param check Function of the list of fields, which returns it checked. Defaults need no check.
#' @param change The further arguments of the call, a list.
#' @param preset List of the fields whose values are others than the defaults, where the call does
#'   not give them.
#' @param former Names of today, by former ones: these still work, with a message.
#' @param noun What a field is called.
#' @return List of class `class`, the fields in the order of the arguments.
#' @noRd
new_settings <- function(class, check, change = list(), preset = list(), former = character(),
                         noun = "setting", frame = parent.frame(),
                         fn = sys.function(sys.parent())) {
  fields <- setdiff(names(formals(fn)), c("preset", "..."))
  is_default <- function(field) eval(as.call(list(base::missing, as.name(field))), frame)
  given <- fields[!vapply(fields, is_default, NA)]
  settings <- mget(fields, frame)
  settings[names(preset)] <- preset
  settings[given] <- mget(given, frame)
  settings <- changed_settings(settings, change, former, noun)
  structure(if (length(given) || length(change)) check(settings) else settings, class = class)
}

#' Settings with those that a call changes
#'
#' @param settings List of all settings.
#' @param change,former,noun As in [new_settings()].
#' @noRd
changed_settings <- function(settings, change, former = character(), noun = "setting") {
  for (old in intersect(names(change), names(former))) {
    inform_former(paste(old, "="), paste(former[[old]], "="))
    names(change)[names(change) == old] <- former[[old]]
  }
  unknown <- setdiff(names(change), names(settings))
  if (length(unknown) || (length(change) && is.null(names(change)))) {
    # What to do about names that are columns of a scheme's curves, in words
    own <- intersect(unknown, c("radius", "width", "n", "kind"))
    scheme_column_words <- if (!length(own)) "" else {
      sprintf(paste("`%s` belongs to the curves of a scheme: scheme <- face_scheme();",
                    "scheme$curves$%s[scheme$curves$curve == \"...\"] <- ..., or is an argument of",
                    "ridge_curve(). "), own[1], own[1])
    }
    crestline_abort(
      sprintf("there is no %s %s.", noun,
              if (any(nzchar(unknown))) {
                paste0("\"", unknown[nzchar(unknown)], "\"", collapse = ", ")
              } else {
                "without a name"
              }),
      paste0(scheme_column_words,
             sprintf("%ss are: %s.", tools::toTitleCase(noun),
                     paste(names(settings), collapse = ", "))),
      stage = "arguments"
    )
  }
  settings[names(change)] <- change
  settings
}

#' Settings with fields that a call gives as arguments of their own, as was usual formerly
#'
#' @param ... The dots of the function that asks.
#' @param maker Name of the function that makes the settings, which is their class.
#' @noRd
settings_with_former <- function(settings, maker, ...) {
  check_dots(..., known = names(settings))
  with_former(list(settings = settings), list(settings = names(settings)), list(...))$settings
}

#' Several settings objects with those fields of theirs that a call gives formerly
#'
#' @param objects Named list of settings, by the argument that takes them today.
#' @param fields Named list: fields of each that were arguments.
#' @param given Named list of arguments; each is a field of one of them.
#' @param silent Arguments whose fields may go on being given by themselves.
#' @noRd
with_former <- function(objects, fields, given, silent = character()) {
  for (argument in names(fields)) {
    own <- given[names(given) %in% fields[[argument]]]
    if (!length(own)) next
    maker <- class(objects[[argument]])[1]
    for (name in setdiff(names(own), if (argument %in% silent) fields[[argument]])) {
      inform_former(paste(name, "="), sprintf("%s = %s(%s = )", argument, maker, name))
    }
    values <- unclass(objects[[argument]])
    values[names(own)] <- own
    preset <- attr(values, "preset")
    attr(values, "preset") <- NULL
    objects[[argument]] <- do.call(maker, c(if (!is.null(preset)) list(preset = preset), values),
                                   quote = TRUE)
  }
  objects
}

#' Print settings as they are written in a call
#' @param header The first line.
#' @noRd
print_settings <- function(x, header) {
  printed(x, {
    cat(header, "\n", sep = "")
    written <- vapply(x, function(value) {
      if (is.null(value)) return("NULL")
      if (is.list(value) || length(value) > 20) return(sprintf("<%s>", describe_value(value)))
      value <- if (is.character(value)) dQuote(value, FALSE) else format(value, trim = TRUE)
      if (length(value) == 1) value else sprintf("c(%s)", paste(value, collapse = ",\r"))
    }, "")
    lines <- strwrap(paste(names(x), written, sep = "\r=\r", collapse = ", "), indent = 2,
                     exdent = 2)
    # No line is broken within a setting.
    cat(gsub("\r", " ", lines), sep = "\n")
    invisible(x)
  })
}
