# The files of a desk: for each observer and specimen the landmarks and curves, and how they came to
# their places.

#' Paths of a specimen's files in the folder of a desk
#'
#' @return List: `record` (the whole, to go on with), `table` (landmarks and curves, as
#'   [write_landmarks()] writes them).
#' @noRd
desk_paths <- function(dir, observer, id) {
  own <- file.path(dir, file_word(observer))
  list(record = file.path(own, "records", paste0(file_word(id), ".json")),
       table = file.path(own, paste0(file_word(id), ".csv")))
}

#' Numbers as text that reads back to the same
#' @noRd
exact_text <- function(x) ifelse(is.na(x), NA_character_, sprintf("%.17g", x))

#' Write the files of a review; each is whole or as it was
#' @noRd
keep_review <- function(review, dir) {
  specimen <- review$specimen
  paths <- desk_paths(dir, review$observer, specimen$id)
  dir.create(dirname(paths$record), showWarnings = FALSE, recursive = TRUE)
  at <- specimen$landmarks
  marks <- data.frame(landmark = names(review$state), state = unname(review$state))
  row <- match(marks$landmark, rownames(at))
  marks[c("x", "y", "z")] <- lapply(1:3, function(i) exact_text(at[row, i]))
  curves <- lapply(names(review$drawn), function(name) {
    line <- review$drawn[[name]]
    knots <- matrix(exact_text(line$knots), ncol = ncol(line$knots))
    list(curve = name, snapped = line$snapped, knots = knots)
  })
  record <- list(crestline = "desk 1", specimen = specimen$id, observer = review$observer,
                 mesh = specimen_key(specimen), scheme = c(review$fitting$scheme$name, "")[1],
                 landmarks = marks, curves = curves, steps = review$log)
  put_file(jsonlite::toJSON(record, auto_unbox = TRUE, dataframe = "rows", na = "null",
                            pretty = TRUE), paths$record)
  part <- paste0(paths$table, ".part.csv")
  write_landmarks(located_landmarks(specimen), part, curves = drawn_points(review))
  put_in_place(part, paths$table)
  invisible(paths$record)
}

put_file <- function(text, path) {
  part <- paste0(path, ".part")
  writeLines(enc2utf8(text), part, useBytes = TRUE)
  put_in_place(part, path)
}

#' Give a file that is whole its name
#' @noRd
put_in_place <- function(part, path) {
  if (suppressWarnings(file.rename(part, path))) return(invisible(path))
  crestline_abort(sprintf("the record cannot be written to %s.", path),
                  "Close the program that has the file open, or check who may write there.",
                  stage = "desk", class = "crestline_desk_error", call = NULL)
}

#' Refuse a record that is of another specimen, observer or mesh than a review
#' @noRd
check_record <- function(record, review, path) {
  # On disks without capitals two names may have one file
  if (!identical(c(record$specimen, record$observer), c(review$specimen$id, review$observer))) {
    crestline_abort(sprintf("its record would be that of %s by %s.", record$specimen,
                            record$observer),
                    "Give specimens and observers names that differ by more than capitals.",
                    stage = "desk", id = review$specimen$id, class = "crestline_desk_error",
                    call = NULL)
  }
  if (!identical(record$mesh, specimen_key(review$specimen))) {
    crestline_abort("its record in the desk's folder is of another mesh.",
                    sprintf("Give the mesh as it was, or take %s away.", path),
                    stage = "desk", id = review$specimen$id, class = "crestline_desk_error",
                    call = NULL)
  }
}

#' The landmarks of a specimen that are somewhere
#' @noRd
located_landmarks <- function(specimen) {
  specimen$landmarks[!is.na(specimen$landmarks[, 1]), , drop = FALSE]
}

#' A review that goes on where its record ended
#' @noRd
resumed_review <- function(review, path) {
  if (!file.exists(path)) return(review)
  record <- read_record(path)
  check_record(record, review, path)
  marks <- record$landmarks
  touched <- marks$landmark %in% record$steps$part[record$steps$level == "landmarks"]
  # What nobody has touched is where the specimen has it now, if it has it: it may be found anew
  there <- marks$landmark %in% rownames(located_landmarks(review$specimen))
  laid <- touched | !there
  for (i in which(laid & !is.na(marks$x))) {
    point <- surface_points(review$specimen$mesh, as.matrix(marks[i, c("x", "y", "z")]))
    at <- unlist(marks[i, c("x", "y", "z")])
    point[c("x", "y", "z")] <- as.list(at)
    if (!same_place(review, marks$landmark[i], point)) {
      review$specimen <- move_landmark(review$specimen, marks$landmark[i], point)
    }
  }
  gone <- marks$landmark[touched & is.na(marks$x) & marks$state == "absent"]
  for (name in gone) review$specimen <- move_landmark(review$specimen, name, NULL)
  # What was still missing then may have been found since
  told <- laid & (marks$state != "missing" | !marks$landmark %in% names(review$state))
  review$state[marks$landmark[told]] <- marks$state[told]
  review$about <- with_new_marks(review$about, marks$landmark)
  if (!is.null(review$fitting)) review$fitting <- at_landmarks(review$fitting, review$specimen)
  review$log <- record$steps
  review$specimen <- with_recorded(review$specimen, record$steps)
  for (line in record$curves) {
    own <- joined_line(review, line$curve, line$knots)
    again <- if (line$snapped && !is.null(own$path)) snapped_line(review, line$curve, own)
    review$drawn[[line$curve]] <- if (is.null(again) || failed(again)) own else again
  }
  review$selected <- next_open(review)
  with_said(review, if (nrow(record$steps)) sprintf("Resumed after %s, the last at %s.",
                                                    amount(nrow(record$steps), "step"),
                                                    utils::tail(record$steps$time, 1)) else "")
}

#' A specimen whose landmarks were placed when the record says
#' @noRd
with_recorded <- function(specimen, steps) {
  steps <- steps[steps$action %in% c("placed", "moved"), ]
  steps <- steps[!duplicated(steps$part, fromLast = TRUE) &
                   steps$part %in% rownames(specimen$landmarks), ]
  for (i in seq_len(nrow(steps))) {
    specimen <- with_origin(specimen, steps$part[i], steps$action[i], time = steps$time[i])
  }
  specimen
}

#' Words for landmarks that only the record knows
#' @noRd
with_new_marks <- function(about, names) {
  new <- setdiff(names, about$landmark)
  rbind(about, data.frame(landmark = new, name = rep("", length(new)),
                          where = rep("", length(new))))
}

#' A fitting that knows where the landmarks are now, without any curve fitted
#' @noRd
at_landmarks <- function(fitting, specimen) {
  fitting$scan$specimen <- specimen
  fitting$scan$bridged <- with_landmarks_of(fitting$scan$bridged, specimen)
  placed <- scan_landmarks(fitting$scan)
  fitting$scan[names(placed)] <- placed
  fitting
}

#' Every record in the folder of a desk
#'
#' @param observer Names of observers; NULL: all.
#' @noRd
desk_records <- function(dir, observer = NULL) {
  files <- Sys.glob(file.path(dir, "*", "records", "*.json"))
  records <- lapply(files, read_record)
  if (is.null(observer)) return(records)
  Filter(function(record) record$observer %in% observer, records)
}
