# Curves that were drawn by hand at a desk, read again from its records with the specimen's files.

#' Read a record
#' @return List: `specimen`, `observer`, `mesh`, `scheme`, `landmarks` (data frame), `curves`
#'   (list), `steps` (data frame as of [no_steps()]).
#' @noRd
read_record <- function(path) {
  record <- tryCatch(
    jsonlite::fromJSON(path, simplifyVector = TRUE, simplifyDataFrame = FALSE,
                       simplifyMatrix = FALSE),
    error = function(e) NULL
  )
  fields <- c("specimen", "observer", "mesh", "landmarks", "curves", "steps")
  if (!is.list(record) || !identical(record$crestline, "desk 1") ||
      !all(fields %in% names(record))) {
    crestline_abort(sprintf("%s is no record of a desk.", path),
                    "Take it away to begin that specimen anew.", stage = "desk",
                    class = "crestline_desk_error", call = NULL)
  }
  text <- function(rows, name) {
    vapply(rows, function(row) c(row[[name]], NA_character_)[1], "", USE.NAMES = FALSE)
  }
  marks <- data.frame(landmark = text(record$landmarks, "landmark"),
                      state = text(record$landmarks, "state"))
  for (name in c("x", "y", "z")) marks[[name]] <- as.numeric(text(record$landmarks, name))
  record$landmarks <- marks
  record$curves <- lapply(record$curves, function(line) {
    knots <- do.call(rbind, lapply(line$knots, function(row) as.numeric(unlist(row))))
    colnames(knots) <- mesh_columns
    list(curve = line$curve, snapped = isTRUE(line$snapped), knots = knots)
  })
  record$steps <- as.data.frame(lapply(stats::setNames(nm = names(no_steps())), function(name) {
    text(record$steps, name)
  }))
  record
}

no_steps <- function() {
  data.frame(part = character(), level = character(), action = character(), by = character(),
             time = character())
}

#' How a curve was drawn, with observer and time of the last step
#' @param steps As of [no_steps()].
#' @noRd
drawn_words <- function(name, snapped, steps) {
  last <- utils::tail(steps[steps$part == name & steps$level == "curves", ], 1)
  paste0("drawn by hand", if (snapped) ", snapped", if (nrow(last)) {
    sprintf(" (%s%s)", if (nzchar(last$by)) paste0(last$by, ", ") else "", last$time)
  })
}

#' The curves of a record, whose points are in the table beside it
#'
#' @param table As of [desk_paths()].
#' @return As of [drawn_points()].
#' @noRd
recorded_curves <- function(record, table) {
  names <- vapply(record$curves, `[[`, "", "curve")
  found <- if (length(names) && file.exists(table)) attr(read_landmarks(table), "curves")
  # A line of one point only is no curve yet
  whole <- vapply(record$curves, function(line) nrow(line$knots) > 1, NA)
  if (length(names) && !file.exists(table) || !all(names[whole] %in% names(found))) {
    crestline_abort(sprintf("the table of its curves is not there, or not whole: %s.", table),
                    "Put it back, or open the specimen with digitise() and make a step.",
                    stage = "desk", id = record$specimen, class = "crestline_desk_error",
                    call = NULL)
  }
  for (line in record$curves[names %in% names(found)]) {
    attr(found[[line$curve]], "drawn") <- drawn_words(line$curve, line$snapped, record$steps)
  }
  found
}

#' The record beside a table of a desk; "" if there is none
#' @noRd
record_beside <- function(table) {
  name <- sub("[.]csv$", ".json", basename(table))
  path <- file.path(dirname(table), "records", name)
  if (grepl("[.]csv$", table) && file.exists(path)) path else ""
}

#' A specimen with the curves that were drawn on it at a desk, if its landmarks are a table of one;
#' curves of other tables are not measured, and that is said
#'
#' @param table Path of the file of its landmarks; NA: none.
#' @param curves Names of the curves in that file.
#' @noRd
with_desk_curves <- function(specimen, table, curves = character()) {
  if (is.na(table)) return(specimen)
  path <- record_beside(table)
  if (!nzchar(path)) {
    if (length(curves)) {
      crestline_inform(sprintf(paste(
        "%s has %s (%s), which %s not measured as drawn: its record is not beside it. Give the",
        "folder that digitise() wrote as `landmarks`, such as \"desk/AB\"."
      ), basename(table), amount(length(curves), "curve"), shorten(curves, 3),
      if (length(curves) == 1) "is" else "are"))
    }
    return(specimen)
  }
  record <- read_record(path)
  curves <- recorded_curves(record, table)
  if (!length(curves)) return(specimen)
  if (identical(record$mesh, specimen_key(specimen))) return(with_fields(specimen, drawn = curves))
  crestline_warn(
    sprintf("its curves drawn by hand are left out: they are of another mesh (%s).", path),
    "Measure the mesh on which they were drawn, without `rescale`.", stage = "desk",
    id = specimen$id, class = "crestline_desk_warning"
  )
  specimen
}
