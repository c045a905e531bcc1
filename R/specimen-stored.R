# A specimen whose scan lies in its file: everything but mesh and neighbours is here, and these are
# read when they are asked for.

#' A specimen without its scan
#'
#' @param x A whole `specimen`.
#' @param source List: `file` (path of the mesh), `hash` (of the file's bytes), `reading` (named
#'   list of arguments of [read_specimen()] by which it was read).
#' @return A `stored_specimen`.
#' @noRd
stored_specimen <- function(x, source) {
  fields <- unclass(x)
  fields["mesh"] <- list(NULL)
  fields$geometry <- fields$geometry[setdiff(names(fields$geometry), c("twin", "piece"))]
  fields$source <- source
  structure(fields, class = c("stored_specimen", "specimen"))
}

#' @exportS3Method
whole_specimen.stored_specimen <- function(x) {
  fields <- unclass(x)
  scan <- stored_scan(x)
  fields$mesh <- scan$mesh
  fields$geometry <- scan$geometry
  fields$source <- NULL
  structure(fields, class = "specimen")
}

#' The scan of a stored specimen; the last one that was read is in memory still. What is known of
#' landmarks is the specimen's own: another result may have others on the same scan
#' @return List: `mesh`, `geometry`.
#' @noRd
stored_scan <- function(x) {
  fields <- unclass(x)
  at <- stored_place(fields)
  about <- file.info(at, extra_cols = FALSE)
  now <- list(fields$key, fields$id, at, about$size, about$mtime)
  if (!identical(now, last_scan$what)) {
    scan <- scan_from(at, fields)
    last_scan$scan <- list(mesh = scan$mesh, geometry = scan$geometry[c("twin", "piece")])
    last_scan$what <- now
  }
  list(mesh = last_scan$scan$mesh, geometry = c(last_scan$scan$geometry, fields$geometry))
}

last_scan <- new.env(parent = emptyenv())

#' Where the file of a scan is now
#'
#' The path of the run; the same relative to the folder of results, where both were moved together;
#' the file's name in a folder of the option `crestline.scans`. Of several that are there, the first
#' that has not changed.
#' @noRd
stored_place <- function(fields) {
  source <- fields$source
  folders <- getOption("crestline.scans")
  at <- unique(c(source$file, if (!is.null(source$beside)) source$beside,
                 if (length(folders)) file.path(folders, basename(source$file))))
  there <- at[file.exists(at)]
  if (length(there) > 1) {
    own <- vapply(there, rlang::hash_file, "") == source$hash
    there <- c(there[own], there[!own])
  }
  if (length(there)) return(there[1])
  refuse_scan(sprintf("its scan is not there: %s.", source$file), fields$id)
}

refuse_scan <- function(problem, id) {
  crestline_abort(
    problem, paste("Put the file back, or name the folder where it is:",
                   "options(crestline.scans = \"folder\"). Points and grades need no scan."),
    stage = "scan", id = id, class = "crestline_scan_error", call = NULL
  )
}

#' A scan read as it was read for the run; its bytes and its mesh are those of the run
#' @noRd
scan_from <- function(at, fields) {
  if (!identical(rlang::hash_file(at), fields$source$hash)) {
    refuse_scan(sprintf("its scan has changed since it was measured: %s.", at), fields$id)
  }
  # What was warned of then is kept with the shape.
  scan <- suppressWarnings(do.call(read_specimen, c(list(at, NULL, fields$id),
                                                    fields$source$reading)))
  if (!identical(specimen_key(scan), fields$key)) {
    refuse_scan(sprintf("its scan is read in another way than when it was measured: %s.", at),
                fields$id)
  }
  scan
}

#' @export
`$.stored_specimen` <- function(x, name) {
  if (name %in% c("mesh", "geometry")) return(stored_scan(x)[[name]])
  unclass(x)[[name]]
}

#' @export
`[[.stored_specimen` <- function(x, i, ...) {
  name <- if (is.numeric(i)) names(unclass(x))[i[1]] else i[1]
  if (!name %in% c("mesh", "geometry")) return(unclass(x)[[i, ...]])
  part <- stored_scan(x)[[name]]
  if (length(i) > 1) part[[i[-1], ...]] else part
}

#' @export
`[.stored_specimen` <- function(x, ...) unclass(whole_specimen(x))[...]

#' @export
names.stored_specimen <- function(x) setdiff(names(unclass(x)), "source")

#' @export
`$<-.stored_specimen` <- function(x, name, value) {
  if (name == "id") return(with_fields(x, id = check_id(value)))
  `$<-.specimen`(whole_specimen(x), name, value)
}

#' @export
`[[<-.stored_specimen` <- function(x, i, value) `[[<-.specimen`(whole_specimen(x), i, value)

#' @export
`[<-.stored_specimen` <- function(x, i, value) `[<-.specimen`(whole_specimen(x), i, value)
