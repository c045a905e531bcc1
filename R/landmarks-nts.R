# .nts of NTSYS and .dta of IDAV Landmark: comments, then 1 nL p*k 1 9999 DIM=k, n labels, n blocks
# of p x k numbers. Names of landmarks, which the format has not, stand in a comment; of one
# specimen also p x k with labelled rows is read.

read_landmarks_nts <- function(file, options) {
  line <- file_lines(file)
  is_comment <- grepl("^\\s*['\"]", line)
  comment <- sub("^\\s*['\"]+\\s*", "", line[is_comment])
  row <- which(!is_comment & grepl("\\S", line))
  if (!length(row)) refuse_landmark_file(file, "no line of parameters", nts_remedy())
  text <- line[row[1]]
  refuse <- function(problem) refuse_landmark_file(file, problem, nts_remedy(), row[1])
  part <- regmatches(text, regexec(
    paste0("^\\s*([0-9]+)\\s+([0-9]{1,7})([A-Za-z]?)\\s+([0-9]{1,7})([A-Za-z]?)\\s+([01])",
           "(\\s+\\S+)?\\s+DIM\\s*=\\s*([0-9])\\s*$"),
    text, ignore.case = TRUE))[[1]]
  if (!length(part)) refuse("the line of parameters cannot be read")
  label <- toupper(part[c(4, 6)])
  if (part[2] != "1") refuse("not a rectangular matrix (1)")
  if (!all(label %in% c("", "L"))) refuse("labels within the rows (B, E) are not read")
  head <- list(rows = as.integer(part[3]), columns = as.integer(part[5]), labels = label == "L",
               flag = part[7] == "1", code = landmark_numbers(trimws(part[8]), file, row[1]),
               dim = as.integer(part[9]))
  if (!head$dim %in% 2:3 || head$columns %%
      head$dim) refuse("columns that are not points of two or three dimensions")
  body <- nts_body(line[row[-1]], row[-1], head, file)
  swapped <- head$columns == head$dim && !any(grepl('^landmarks: "', comment))
  if (swapped) return(landmark_set(nts_missing(body$x, head), body$label))
  name <- commented_names(comment, "landmarks", head$columns / head$dim, file)
  sets <- lapply(seq_len(head$rows), function(i) {
    landmark_set(nts_missing(matrix(body$x[i, ], ncol = head$dim, byrow = TRUE), head), name)
  })
  structure(stats::setNames(sets, if (is.null(body$label)) seq_along(sets) else body$label),
            numbered = is.null(body$label))
}

nts_remedy <- function() {
  paste0("Write a line such as 1 23L 69 1 9999 DIM=3: matrix, rows (L: labelled), columns, ",
         "missing, code, dimension.")
}

# Labels, one a line (with blanks in them) or, where that does not fit, one a word; then the
# numbers.
nts_body <- function(text, line, head, file) {
  labels <- sum(c(head$rows, head$columns)[head$labels])
  wanted <- as.numeric(head$rows) * head$columns
  word <- strsplit(trimws(text), "[[:space:],]+")
  by_line <- sum(lengths(word)[seq_along(word) > labels])
  if (length(text) >= labels && by_line == wanted) {
    label <- trimws(text[seq_len(labels)])
    word <- word[seq_along(word) > labels]
    line <- line[seq_along(line) > labels]
    check_separators(text[seq_along(text) > labels], file, line)
    number <- landmark_numbers(unlist(word), file, rep(line, lengths(word)))
  } else if (sum(lengths(word)) == labels + wanted) {
    flat <- unlist(word)
    label <- flat[seq_len(labels)]
    after <- seq_along(flat) > labels
    number <- landmark_numbers(flat[after], file, rep(line, lengths(word))[after])
  } else {
    said <- sprintf("%d labels and %.0f numbers are announced, %d words follow", labels, wanted,
                    sum(lengths(word)))
    refuse_landmark_file(file, said,
                         "Put the right numbers in the line of parameters, or the whole file.")
  }
  list(label = if (head$labels[1]) label[seq_len(head$rows)],
       x = matrix(as.numeric(number), head$rows, head$columns, byrow = TRUE))
}

# The code, exactly: in one co-ordinate where the header declares it, else only in all of a point.
nts_missing <- function(x, head) {
  coded <- rowSums(x == head$code, na.rm = TRUE)
  x[coded > 0 & (head$flag | coded == head$dim), ] <- NA
  x
}

write_landmarks_nts <- function(sets, file, options) {
  check_nts_sets(sets, file)
  x <- sets[[1]]
  # The first of 9999, 99999 ... that no co-ordinate is.
  code <- as.integer(10^(4:9) - 1)
  code <- code[!code %in% unlist(sets)][1]
  comment <- name_comment(rownames(x), "landmarks")
  if (nrow(x) == 1) comment <- sprintf("landmarks: %s", quote_names(rownames(x)))
  write_file_lines(c(
    "'Landmarks, written by crestline", if (!is.null(comment)) paste0("'", comment),
    unlist(Map(nts_comment, sets, names(sets), MoreArgs = list(alone = length(sets) == 1))),
    sprintf("1 %dL %d 1 %d DIM=3", length(sets), 3L * nrow(x), code), "", names(sets), "",
    unlist(lapply(sets, function(x) if (nrow(x)) c(row_text(x, missing = code), "")))
  ), file)
}

nts_comment <- function(x, id, alone) {
  lines <- attr(x, "comments")
  if (length(lines)) paste0("'", if (!alone) paste0(comment_text(id), ", "), lines)
}

check_nts_sets <- function(sets, file) {
  differs <- which(!vapply(sets, function(x) identical(rownames(x), rownames(sets[[1]])), TRUE))
  if (length(differs)) {
    refuse_landmark_file(
      file,
      sprintf("specimen %s has other landmarks than %s", names(sets)[differs[1]], names(sets)[1]),
      "Give all the same landmarks in the same order, missing ones as NA."
    )
  }
  wrong <- grepl("^['\"]", names(sets))
  if (any(wrong)) {
    refuse_landmark_file(file, sprintf("%s cannot be a label", names(sets)[wrong][1]),
                         "Name specimens without a quote in front.")
  }
}
