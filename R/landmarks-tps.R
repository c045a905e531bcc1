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
  # By ID=, else by IMAGE=, where each has its own; else numbered
  by <- lapply(c(ID = "ID", IMAGE = "IMAGE"), function(key) {
    name <- vapply(record, function(r) c(r$value[r$key == key], "")[1], "")
    if (all(nzchar(name)) && !anyDuplicated(name)) name
  })
  name <- if (!is.null(by$ID)) list(name = by$ID, numbered = FALSE, alias = by$IMAGE) else {
    if (!is.null(by$IMAGE)) list(name = by$IMAGE, numbered = FALSE) else {
      id <- unlist(lapply(record, function(r) r$value[r$key == "ID" & nzchar(r$value)][1]))
      list(name = as.character(seq_along(record)), numbered = TRUE,
           twice = stats::na.omit(id[duplicated(id)])[1])
    }
  }
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
  # A record LM= should have two co-ordinates, but has three in some files.
  first <- c(Filter(nrow, row), row)[[1]]
  width <- if (key$key[1] == "LM3") 3 else if (!nrow(first)) 2 else
    length(strsplit(trimws(first$text[1]), "[[:space:],]+")[[1]])
  if (!width %in% 2:3) {
    refuse_landmark_file(file, "not two or three numbers", "Write one point a line.", first$line[1])
  }
  key$rows <- lapply(seq_len(nrow(key)), function(i) {
    # The rows of numbers that a key announces.
    keys <- key[i, ]
    said <- if (keys$key %in% c("LM", "LM3", "POINTS")) tps_count(keys, file) else 0
    if (nrow(row[[i]]) != said) {
      refuse_landmark_file(
        file, sprintf("%s= announces %d points, %d follow", keys$key, said, nrow(row[[i]])),
        "Put the right number, or the whole file.", keys$line
      )
    }
    landmark_rows(row[[i]]$text, width, file, row[[i]]$line)
  })
  key
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
  # CURVES= are open, OUTLINES= closed; each announces how many POINTS= follow.
  head <- which(record$key %in% c("CURVES", "OUTLINES"))
  point <- which(record$key == "POINTS")
  group <- findInterval(point, head)
  for (i in seq_along(head)) {
    said <- tps_count(record[head[i], ], file)
    if (sum(group == i) != said) {
      refuse_landmark_file(
        file, sprintf("%s= announces %d, %d follow", record$key[head[i]], said, sum(group == i)),
        "Put the right number, or the whole file.", record$line[head[i]]
      )
    }
  }
  closed <- c(FALSE, record$key[head] == "OUTLINES")[group + 1]
  curves <- Map(function(rows, closed) landmark_curve(rows * scale, closed), record$rows[point],
                closed)
  name <- commented_names(comment, "curves", length(curves), file)
  names(curves) <- if (is.null(name)) sprintf("curve %d", seq_along(curves)) else name
  landmark_set(x, commented_names(comment, "landmarks", nrow(x), file), curves)
}

# Factors of the records; refused where only some have one, since units would mix.
tps_scales <- function(record, file, options) {
  if (!options$scale) return(rep(1, length(record)))
  scale <- vapply(record, function(key) {
    i <- which(key$key == "SCALE" & nzchar(key$value))
    if (length(i)) {
      # The one factor of a record, NA where it stands for none.
      key <- key[i, ]
      scales <- unique(landmark_numbers(key$value, file, key$line))
      wrong <- c(which(scales <= 0), if (length(scales) > 1) 2)
      if (length(wrong)) {
        said <- if (length(scales) > 1) "one specimen has two different SCALE=" else
          sprintf("SCALE=%s is not greater than 0", key$value[1])
        refuse_landmark_file(file, said,
                             "Put the factor, or read with scale = FALSE: all as they stand.",
                             key$line[wrong[1]])
      }
      scales
    } else NA_real_
  }, 0)
  if (all(is.na(scale))) return(rep(1, length(record)))
  if (anyNA(scale)) {
    bare <- record[[which(is.na(scale))[1]]]
    refuse_landmark_file(
      file,
      sprintf(paste0("specimens without SCALE= among others that have one (%d ",
                     "of %d): units would mix"),
              sum(is.na(scale)), length(scale)),
      "Give each its SCALE=, or read with scale = FALSE: all as they stand.", bare$line[1]
    )
  }
  scale
}

write_landmarks_tps <- function(sets, file, options) {
  write_file_lines(unlist(Map(tps_lines, sets, names(sets))), file)
}

tps_lines <- function(x, id) {
  curves <- attr(x, "curves")
  # Neighbours of one kind share a head, so that the curves keep their order.
  closed <- vapply(curves, attr, TRUE, "closed")
  run <- rle(as.vector(closed))
  first <- cumsum(c(1, run$lengths))
  head <- character(length(curves))
  head[first[seq_along(run$lengths)]] <- sprintf(
    "%s%d", ifelse(run$values, "OUTLINES=", "CURVES="), run$lengths
  )
  c(sprintf("LM3=%d", nrow(x)), if (nrow(x)) row_text(x),
    unlist(lapply(seq_along(curves), function(i) {
    c(head[i][nzchar(head[i])], sprintf("POINTS=%d", nrow(curves[[i]])), row_text(curves[[i]]))
  })),
    paste0("ID=", id),
    tps_comment(name_comment(rownames(x), "landmarks")),
    tps_comment(if (length(curves)) name_lines(names(curves), "curves")),
    tps_comment(attr(x, "comments")))
}

tps_comment <- function(text) if (!is.null(text)) paste0("COMMENT=", text)
