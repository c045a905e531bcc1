# Warnings of a specimen's measuring: kept with its shape, counted by kind.

#' What to hear warnings with: an environment whose `heard` is a data frame as `warnings` of a shape
#' @noRd
new_ear <- function() rlang::env(heard = no_warnings())

#' Run code; what it warns of goes into the ear and no further
#' @param stage Of warnings that are not the package's own.
#' @noRd
hear <- function(code, stage, ear) {
  withCallingHandlers(code, warning = function(w) {
    own <- inherits(w, "crestline_warning")
    row <- data.frame(stage = if (own) w$stage else stage, class = class(w)[1],
                      problem = if (own) w$problem else conditionMessage(w),
                      remedy = if (own) w$remedy else "")
    ear$heard <- rbind(ear$heard, row)
    tryInvokeRestart("muffleWarning")
  })
}

batch_warnings <- function(x) {
  failed <- attr(x, "failed")
  # By place, not by name: names are searched one after the other.
  each <- Map(function(one, name) {
    if (is.null(one)) failed[[name]]$warnings else
      if (inherits(one, "kept_shape")) attr(one, "warnings") else one$warnings
  }, unclass(x), names(x))
  bind_warnings(stats::setNames(each, names(x)))
}

bind_warnings <- function(each) {
  each <- each[vapply(each, NROW, 0L) > 0]
  none <- cbind(id = character(), no_warnings())
  if (!length(each)) return(none)
  column <- function(name) unlist(lapply(each, function(one) as.character(one[[name]])),
                                  use.names = FALSE)
  data.frame(id = rep(names(each), vapply(each, NROW, 0L)),
             lapply(stats::setNames(nm = names(none)[-1]), column))
}

#' Lines that tell warnings, one a kind with the ids
#'
#' Warnings are of one kind where they are of one class; those without a class of their own where
#' their texts differ in nothing but numbers and the specimen's id.
#' @noRd
warning_lines <- function(warnings) {
  if (!nrow(warnings)) return(character())
  plain <- warnings$class %in% c("crestline_warning", "simpleWarning", "warning", "rlang_warning")
  own <- paste0("\\b\\Q", warnings$id, "\\E\\b")
  text <- mapply(function(own, problem) gsub(own, "", problem, perl = TRUE), own, warnings$problem)
  kind <- ifelse(plain, gsub("[0-9.]+", "", text), warnings$class)
  lines <- lapply(split(warnings, factor(kind, unique(kind))), function(rows) {
    ids <- unique(rows$id)
    others <- if (length(unique(rows$problem)) > 1) sprintf(" (%s)", ids[1]) else ""
    trimws(sprintf("%s: %s%s %s In: %s.", amount(length(ids), "specimen"), rows$problem[1], others,
                   rows$remedy[1],
                   shorten(ids, 12)))
  })
  unlist(lines, use.names = FALSE)
}
