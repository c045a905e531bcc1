# .tps of F. J. Rohlf's programs: records LM= or LM3=, CURVES= and OUTLINES= with POINTS=, IMAGE=,
# ID=, SCALE=. Names of landmarks and curves, which the format has not, stand in COMMENT= lines.

read_landmarks_tps <- function(file, options) {
  line <- file_lines(file)
  start <- which(grepl("^\\s*LM3?\\s*=", line, ignore.case = TRUE))
  if (!length(start)) {
    refuse_landmark_file(file, "no line LM= or LM3=",
                         "Begin every specimen with LM3= and the number of its landmarks.")
  }
  end <- c(start[-1] - 1, length(line))
  record <- Map(function(from, to) tps_record(line[from:to], from:to, file), start, end)
  scale <- tps_scales(record, file, options)
  sets <- Map(tps_set, record, scale, MoreArgs = list(file = file))
  name <- tps_names(record)
  structure(stats::setNames(sets, name$name), numbered = name$numbered, alias = name$alias,
            twice = name$twice)
}

# One record as its keys: data frame key, value, line, and the rows of numbers after each.
tps_record <- function(text, line, file) {
  full <- grepl("\\S", text)
  text <- text[full]
  line <- line[full]
  is_key <- grepl("^\\s*[[:alnum:]]+\\s*=", text)
  key <- data.frame(key = toupper(trimws(sub("=.*", "", text[is_key]))),
                    value = trimws(sub("^[^=]*=", "", text[is_key])), line = line[is_key])
  group <- cumsum(is_key)[!is_key]
  row <- split(data.frame(text = text, line = line)[!is_key, ], factor(group, seq_len(nrow(key))))
  width <- if (key$key[1] == "LM3") 3 else tps_width(c(Filter(nrow, row), row)[[1]], file)
  key$rows <- lapply(seq_len(nrow(key)), function(i) tps_block(key[i, ], row[[i]], width, file))
  key
}

# Of a record LM=, which should have two co-ordinates but has three in some files.
tps_width <- function(row, file) {
  if (!nrow(row)) return(2)
  width <- length(strsplit(trimws(row$text[1]), "[[:space:],]+")[[1]])
  if (!width %in% 2:3) refuse_landmark_file(file, "not two or three numbers",
                                            "Write one point a line.", row$line[1])
  width
}

# The rows of numbers that a key announces.
tps_block <- function(key, row, width, file) {
  said <- if (key$key %in% c("LM", "LM3", "POINTS")) tps_count(key, file) else 0
  if (nrow(row) != said) {
    refuse_landmark_file(file,
                         sprintf("%s= announces %d points, %d follow", key$key, said, nrow(row)),
                         "Put the right number, or the whole file.", key$line)
  }
  landmark_rows(row$text, width, file, row$line)
}

tps_count <- function(key, file) {
  if (!grepl("^[0-9]{1,9}$", key$value)) {
    refuse_landmark_file(file, sprintf("%s=%s has no whole number", key$key, key$value),
                         "Put the number of points.",
                         key$line)
  }
  as.integer(key$value)
}

tps_set <- function(record, scale, file) {
  comment <- record$value[record$key == "COMMENT"]
  x <- record$rows[[1]] * scale
  curves <- tps_curves(record, scale, file)
  name <- commented_names(comment, "curves", length(curves), file)
  names(curves) <- if (is.null(name)) sprintf("curve %d", seq_along(curves)) else name
  landmark_set(x, commented_names(comment, "landmarks", nrow(x), file), curves)
}

# CURVES= are open, OUTLINES= closed; each announces how many POINTS= follow.
tps_curves <- function(record, scale, file) {
  head <- which(record$key %in% c("CURVES", "OUTLINES"))
  point <- which(record$key == "POINTS")
  group <- findInterval(point, head)
  for (i in seq_along(head)) {
    said <- tps_count(record[head[i], ], file)
    if (sum(group == i) != said) {
      refuse_landmark_file(file,
                           sprintf("%s= announces %d, %d follow", record$key[head[i]], said,
                                   sum(group == i)),
                           "Put the right number, or the whole file.", record$line[head[i]])
    }
  }
  closed <- c(FALSE, record$key[head] == "OUTLINES")[group + 1]
  Map(function(rows, closed) landmark_curve(rows * scale, closed), record$rows[point], closed)
}

# Factors of the records; refused where only some have one, since units would mix.
tps_scales <- function(record, file, options) {
  if (!options$scale) return(rep(1, length(record)))
  scale <- vapply(record, function(key) {
    i <- which(key$key == "SCALE" & nzchar(key$value))
    if (length(i)) tps_scale(key[i, ], file) else NA_real_
  }, 0)
  if (all(is.na(scale))) return(rep(1, length(record)))
  if (anyNA(scale)) {
    bare <- record[[which(is.na(scale))[1]]]
    refuse_landmark_file(file,
                         sprintf(paste("specimens without SCALE= among others that have one (%d",
                                       "of %d): units would mix"),
                                       sum(is.na(scale)), length(scale)),
                         "Give each its SCALE=, or read with scale = FALSE: all as they stand.",
                         bare$line[1])
  }
  scale
}

# The one factor of a record, NA where it stands for none.
tps_scale <- function(key, file) {
  scale <- unique(landmark_numbers(key$value, file, key$line))
  wrong <- c(which(scale <= 0), if (length(scale) > 1) 2)
  if (length(wrong)) {
    refuse_landmark_file(file, if (length(scale) > 1) "one specimen has two different SCALE=" else
      sprintf("SCALE=%s is not greater than 0", key$value[1]),
                         "Put the factor, or read with scale = FALSE: all as they stand.",
                         key$line[wrong[1]])
  }
  scale
}

#' By ID=, else by IMAGE=, where each has its own; else numbered
#' @return List: `name`; `numbered`; `alias`, those by IMAGE= where the names are by ID=; `twice`,
#'   an ID= that keeps these from being names.
#' @noRd
tps_names <- function(record) {
  by <- lapply(c(ID = "ID", IMAGE = "IMAGE"), function(key) {
    name <- vapply(record, function(r) c(r$value[r$key == key], "")[1], "")
    if (all(nzchar(name)) && !anyDuplicated(name)) name
  })
  if (!is.null(by$ID)) return(list(name = by$ID, numbered = FALSE, alias = by$IMAGE))
  if (!is.null(by$IMAGE)) return(list(name = by$IMAGE, numbered = FALSE))
  id <- unlist(lapply(record, function(r) r$value[r$key == "ID" & nzchar(r$value)][1]))
  list(name = as.character(seq_along(record)), numbered = TRUE,
       twice = stats::na.omit(id[duplicated(id)])[1])
}

write_landmarks_tps <- function(sets, file, options) {
  write_file_lines(unlist(Map(tps_lines, sets, names(sets))), file)
}

tps_lines <- function(x, id) {
  curves <- attr(x, "curves")
  c(sprintf("LM3=%d", nrow(x)), if (nrow(x)) row_text(x), tps_curve_lines(curves),
    paste0("ID=", id),
    tps_comment(name_comment(rownames(x), "landmarks")),
    tps_comment(if (length(curves)) sprintf("curves: %s", quote_names(names(curves)))),
    tps_comment(attr(x, "comments")))
}

tps_comment <- function(text) if (!is.null(text)) paste0("COMMENT=", text)

# Neighbours of one kind share a head, so that the curves keep their order.
tps_curve_lines <- function(curves) {
  closed <- vapply(curves, attr, TRUE, "closed")
  run <- rle(as.vector(closed))
  first <- cumsum(c(1, run$lengths))
  head <- character(length(curves))
  head[first[seq_along(run$lengths)]] <- sprintf("%s%d", ifelse(run$values, "OUTLINES=", "CURVES="),
                                                 run$lengths)
  unlist(lapply(seq_along(curves), function(i) {
    c(head[i][nzchar(head[i])], sprintf("POINTS=%d", nrow(curves[[i]])), row_text(curves[[i]]))
  }))
}
