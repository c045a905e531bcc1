# What the text formats of landmarks share: lines, numbers to the last bit, quoted names, sets,
# errors.

# The lines of a text file, ended as on any system. UTF-8 or UTF-16, with or without a mark of it;
# else taken for Latin 1, as Windows writes names with accents.
file_lines <- function(file) {
  bytes <- readBin(file, "raw", file.size(file))
  bytes <- if (is.na(wide <- wide_encoding(bytes))) bytes[bytes != 0] else {
    charToRaw(c(iconv(list(bytes), wide, "UTF-8", sub = "byte"), "")[1])
  }
  text <- gsub("\r\n?", "\n", rawToChar(bytes), useBytes = TRUE)
  line <- strsplit(text, "\n", fixed = TRUE, useBytes = TRUE)[[1]]
  line <- if (all(validUTF8(line))) enc2utf8(`Encoding<-`(line, "UTF-8")) else
    iconv(line, "latin1", "UTF-8")
  if (length(line)) line[1] <- sub("^\ufeff", "", line[1])
  line
}

# The UTF-16 of a text: by its mark, else where every second byte is 0, as in names and numbers; NA
# for none.
wide_encoding <- function(bytes) {
  if (length(bytes) < 2) return(NA_character_)
  mark <- paste(bytes[1:2], collapse = "")
  if (mark %in% c("fffe", "feff")) return(if (mark == "fffe") "UTF-16LE" else "UTF-16BE")
  zero <- c(mean(bytes[c(TRUE, FALSE)] == 0), mean(bytes[c(FALSE, TRUE)] == 0))
  if (zero[2] > 0.5 && zero[1] == 0) "UTF-16LE" else
    if (zero[1] > 0.5 && zero[2] == 0) "UTF-16BE" else NA_character_
}

write_file_lines <- function(line, file) {
  if (is_pipe(file)) {
    refuse_landmark_file(file, "is a pipe, no file on disk", "Write to a file.")
  }
  connection <- tryCatch(suppressWarnings(file(file, "wb")), error = function(e) {
    refuse_landmarks(sprintf("%s cannot be written.", file), writing_words(file), id = NULL)
  })
  line <- enc2utf8(line)
  tryCatch(writeLines(line, connection, useBytes = TRUE),
           finally = suppressWarnings(close(connection)))
  if (!identical(file.size(file), sum(nchar(line, "bytes") + 1))) {
    refuse_landmark_file(file, "was not written whole",
                         "Is the disk full, or the file a device? Write to another place.")
  }
}

# NA and NaN as R, C and the compilers of Windows write them (-nan(ind), -1.#IND, 1.#QNAN0).
missing_word <- "^(|na|[-+]?(s|q)?nan(\\([a-z]*\\))?|[-+]?1\\.#(ind|[sq]?nan)0*)$"

# Words to numbers, the words for a missing one to NA; `line`: the line of each word.
landmark_numbers <- function(word, file, line) {
  number <- suppressWarnings(as.numeric(word))
  odd <- which(!is.finite(number))
  missing <- grepl(missing_word, word[odd], ignore.case = TRUE)
  number[odd[missing]] <- NA
  wrong <- odd[!missing]
  if (length(wrong)) {
    refuse_landmark_file(
      file, sprintf('"%s" is not a %snumber', word[wrong[1]],
                    if (is.na(number[wrong[1]])) "" else "finite "),
      "Write numbers with a decimal point, NA for a missing one.",
      if (!is.null(line)) rep_len(line, length(word))[wrong[1]]
    )
  }
  number
}

# The rows of numbers in the given lines, each of `width` words.
landmark_rows <- function(text, width, file, line) {
  word <- strsplit(trimws(text), "[[:space:],]+")
  wrong <- which(lengths(word) != width)
  if (length(wrong)) {
    refuse_landmark_file(
      file, sprintf("%d words where %d numbers should be", lengths(word)[wrong[1]], width),
      "Give every point its own line, blanks between the numbers.", line[wrong[1]]
    )
  }
  check_separators(text, file, line)
  matrix(landmark_numbers(unlist(word), file, rep(line, each = width)), ncol = width, byrow = TRUE)
}

# Commas in some places and blanks in others: the commas may be decimal ones, and every number
# another.
check_separators <- function(text, file, line) {
  mixed <- grepl("[^[:space:]],[^[:space:]]",
                 text) & grepl("[^[:space:],][[:space:]]+[^[:space:],]", trimws(text))
  if (any(mixed)) {
    refuse_landmark_file(
      file, sprintf("\"%s\" has both commas and blanks between numbers", trimws(text[mixed][1])),
      "Write decimal points, and blanks between the numbers.", line[mixed][1]
    )
  }
}

# Names between double quotes, a quote in a name doubled, commas between; and back.
quote_names <- function(name) paste(quote_name(name), collapse = ",")
quote_name <- function(name) paste0('"', gsub('"', '""', name, fixed = TRUE), '"')

# The names in the comments `key: "a","b"`, one after the other, or NULL where there is none;
# refused where their number is another.
commented_names <- function(comment, key, n, file) {
  start <- paste0("^", key, ': "')
  found <- comment[grepl(start, comment)]
  if (!length(found)) return(NULL)
  name <- suppressWarnings(scan(
    text = paste(sub(paste0("^", key, ": "), "", found), collapse = ","),
    what = "", sep = ",", quote = '"',
    quiet = TRUE, strip.white = FALSE, na.strings = character(), encoding = "UTF-8"
  ))
  if (length(name) != n) {
    refuse_landmark_file(file,
                         sprintf("the comment of %s has %d names for %d", key, length(name), n),
                         "Change the comment, or delete it: then they are numbered.")
  }
  name
}

name_comment <- function(name, key) {
  if (length(name) && !identical(name, as.character(seq_along(name)))) name_lines(name, key)
}

# Names as comments of about `width` characters each: other programs have short buffers.
name_lines <- function(name, key, width = 200) {
  line <- cumsum(nchar(name, "bytes") + 3) %/% (width - nchar(key) - 2)
  unname(vapply(split(name, line), function(own) sprintf("%s: %s", key, quote_names(own)), ""))
}

# The landmarks of one specimen, with the curves where there are any. A point without one of its
# co-ordinates is missing.
landmark_set <- function(x, name = NULL, curves = list()) {
  x <- complete_rows(x)
  rownames(x) <- if (is.null(name)) as.character(seq_len(nrow(x))) else name
  if (length(curves)) attr(x, "curves") <- curves
  x
}

landmark_curve <- function(x, closed = FALSE) structure(complete_rows(x), closed = closed)

# Three columns (points of the plane get z = 0); NA in all where NA in one.
complete_rows <- function(x) {
  if (ncol(x) == 2) x <- cbind(x, rep(0, nrow(x)))
  x[rowSums(is.na(x)) > 0, ] <- NA
  matrix(as.numeric(x), ncol = 3, dimnames = list(NULL, c("x", "y", "z")))
}

refuse_landmark_file <- function(file, problem, remedy, line = NULL) {
  where <- paste0(basename(file), if (!is.null(line)) sprintf(", line %d", as.integer(line)))
  refuse_landmarks(sprintf("%s: %s.", where, problem), remedy, id = NULL)
}

# The two co-ordinate frames of 3D Slicer: x to the left and y to the back (LPS), or to the right
# and the front (RAS).

# What a file says of its frame: the words, or the 0 and 1 of old files.
slicer_frame <- function(said, file) {
  frame <- c(LPS = "LPS", "1" = "LPS", RAS = "RAS", "0" = "RAS")[toupper(said)]
  if (is.na(frame)) {
    refuse_landmark_file(file, sprintf('the co-ordinate system is "%s"', said),
                         "Save it as LPS or RAS.")
  }
  unname(frame)
}

change_frame <- function(x, from, to) {
  if (to %in% c(from, "file")) x else x * rep(c(-1, -1, 1), each = nrow(x))
}
