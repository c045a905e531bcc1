# .mrk.json of 3D Slicer (markups schema 1.0): an array of lists, each of a type, in a co-ordinate
# system, of control points. Fiducial lists are landmarks; Curve, ClosedCurve, Line and Angle are
# curves. The orientation of a point is not a change of frame.

read_landmarks_mrkjson <- function(file, options) {
  content <- tryCatch(jsonlite::parse_json(paste(file_lines(file), collapse = "\n")),
                      error = function(e) {
    reason <- strsplit(conditionMessage(e), "\n")[[1]][1]
    refuse_landmark_file(file, paste("not JSON:", reason), "Save it anew from Slicer.")
  })
  markup <- if (is.list(content)) content[["markups"]]
  if (!is.null(names(markup))) markup <- list(markup)
  if (!is.list(markup) || !length(markup) || !all(vapply(markup, is.list, TRUE))) {
    refuse_landmark_file(file, "no markups in it", "Save a markups node from Slicer, as .mrk.json.")
  }
  type <- vapply(markup, json_string, "", "type", "Fiducial")
  other <- setdiff(type, c("Fiducial", "Curve", "ClosedCurve", "Line", "Angle"))
  if (length(other)) {
    crestline_warn(sprintf("%s: lists of type %s are left out.", basename(file), shorten(other)),
                   "Landmarks and curves only are read.", stage = "landmarks",
                   class = "crestline_format_warning")
  }
  point <- Map(function(one, i) mrkjson_points(one, i, file, options), markup, seq_along(markup))
  # A unit is a word or DICOM's triple, whose first is the word.
  unit <- vapply(markup, function(one) {
    given <- one[["coordinateUnits"]]
    json_string(list(unit = if (is.list(given) && length(given)) given[[1]] else given), "unit",
                "mm")
  }, "")
  if (length(unique(unit)) > 1) {
    refuse_landmark_file(file, sprintf("lists in different units: %s", shorten(unique(unit))),
                         "Save them in one unit.")
  }
  is_curve <- type %in% c("Curve", "ClosedCurve", "Line", "Angle")
  curves <- Map(landmark_curve, point[is_curve], type[is_curve] == "ClosedCurve")
  names(curves) <- mrkjson_names(markup, file)[is_curve]
  single <- type == "Fiducial"
  x <- do.call(rbind, c(list(matrix(0, 0, 3)), point[single]))
  landmark_set(x, mrkjson_labels(markup[single], mrkjson_names(markup, file)[single]), curves)
}

# A string of a JSON object, or the default where it is absent or something else.
json_string <- function(object, name, default) {
  value <- if (is.list(object)) object[[name]]
  if (is.character(value) && length(value) == 1) value else default
}

# The same where the value may be a number, as other programs write labels.
json_word <- function(object, name) {
  value <- if (is.list(object)) object[[name]]
  if (is.numeric(value) && length(value) == 1) id_text(value) else json_string(object, name, "")
}

mrkjson_points <- function(markup, i, file, options) {
  point <- markup$controlPoints
  one_number <- function(v) if (is.numeric(v) && length(v) == 1) as.numeric(v) else NA_real_
  x <- lapply(seq_along(point), function(j) {
    where <- sprintf("list %d, point %d", i, j)
    if (!is.list(point[[j]])) {
      refuse_landmark_file(file, paste0(where, ": not a control point"),
                           "Save it anew from Slicer.")
    }
    # Any state but "defined" is a point without a position (Slicer writes "" there).
    state <- json_string(point[[j]], "positionStatus", "defined")
    if (state != "defined") return(rep(NA_real_, 3))
    position <- point[[j]][["position"]]
    number <- vapply(position, one_number, 0)
    if (length(number) != 3 || !all(is.finite(number)) || !is.null(names(position))) {
      refuse_landmark_file(file, paste0(where, ": the position is not three numbers"),
                           'Give it, or "positionStatus": "undefined".')
    }
    number
  })
  said <- markup[["coordinateSystem"]]
  said <- if (is.numeric(said)) format(said) else json_string(markup, "coordinateSystem", "LPS")
  frame <- slicer_frame(said, file)
  change_frame(matrix(as.numeric(unlist(x)), ncol = 3, byrow = TRUE), frame, options$frame)
}

# The names of the lists; a list without one has the file's (as in Slicer), of several with its
# number.
mrkjson_names <- function(markup, file) {
  name <- vapply(markup, json_string, "", "name", "")
  stem <- sub("([.]mrk)?[.]json$", "", basename(file), ignore.case = TRUE)
  bare <- if (length(markup) > 1) paste(stem, seq_along(markup)) else stem
  make.unique(ifelse(nzchar(name), name, bare), " ")
}

# Labels, else ids, else numbers; where two lists have the same ones, with the name of the list
# before them.
mrkjson_labels <- function(markup, name) {
  label <- lapply(markup, function(one) {
    label <- vapply(one$controlPoints, json_word, "", "label")
    id <- vapply(one$controlPoints, json_word, "", "id")
    label <- ifelse(nzchar(label), label, id)
    ifelse(nzchar(label), label, as.character(seq_along(label)))
  })
  if (anyDuplicated(unlist(lapply(label, unique)))) {
    label <- Map(function(label, name) if (length(label)) paste(name, label), label, name)
  }
  as.character(unlist(label))
}

write_landmarks_mrkjson <- function(sets, file, options) {
  x <- sets[[1]]
  curves <- attr(x, "curves")
  type <- ifelse(vapply(curves, attr, TRUE, "closed"), "ClosedCurve", "Curve")
  list <- c(
    if (nrow(x) || !length(curves)) mrkjson_list(x, "Fiducial", "landmarks", rownames(x), options),
    unlist(Map(function(curve, type, name) {
      mrkjson_list(curve, type, name, sprintf("%s-%d", name, seq_len(nrow(curve))), options)
    }, curves, type, names(curves)))
  )
  write_mrkjson(list, attr(x, "comments"), file)
}

#' The file of some lists
#' @param list As of [mrkjson_list()], one string each.
#' @noRd
write_mrkjson <- function(list, comments, file) {
  schema <- paste0("https://raw.githubusercontent.com/slicer/slicer/master/",
                   "Modules/Loadable/Markups/",
                   "Resources/Schema/markups-schema-v1.0.3.json#")
  said <- if (length(comments)) {
    sprintf('"provenance": [%s],\n', paste(json_text(comments), collapse = ", "))
  }
  head <- paste0(sprintf('{"@schema": "%s",\n', schema), said)
  write_file_lines(paste0(head, '"markups": [\n', paste(list, collapse = ",\n"), "\n]}"), file)
}

#' A list of points; `colour` is what Slicer shows it in
#' @noRd
mrkjson_list <- function(x, type, name, label, options, colour = NULL) {
  sign <- if (options$frame == "LPS") -1 else 1
  orientation <- sprintf("[%d, 0, 0, 0, %d, 0, 0, 0, 1]", sign, sign)
  absent <- is.na(x[, 1])
  position <- ifelse(absent, '""', sprintf("[%s]", row_text(x, sep = ", ")))
  point <- sprintf(
    paste0('{"id": "%d", "label": %s, "position": %s, "orientation": %s, ',
           '"positionStatus": "%s"}'),
    seq_along(label), json_text(label), position, orientation,
    ifelse(absent, "undefined", "defined")
  )
  display <- if (is.null(colour)) "" else {
    rgb <- paste(format(round(grDevices::col2rgb(colour) / 255, 4)), collapse = ", ")
    sprintf(paste0('"display": {"visibility": true, "color": [%s], "selectedColor": [%s], ',
                   '"pointLabelsVisibility": %s}, '), rgb, rgb,
            if (type == "Fiducial") "true" else "false")
  }
  sprintf('{"type": "%s", "name": %s, "coordinateSystem": "%s", %s"controlPoints": [\n%s\n]}', type,
          json_text(name), options$frame, display, paste(if (nrow(x)) point, collapse = ",\n"))
}

json_text <- function(string) {
  vapply(string, function(one) as.character(jsonlite::toJSON(one, auto_unbox = TRUE)), "",
         USE.NAMES = FALSE)
}
