# Paths of files: what is there, and its extension.

file_extension <- function(file) tolower(sub("^.*[.]|^[^.]*$", "", basename(file)))

check_file <- function(file, stage, name = "file") {
  if (!is_path(file)) refuse_no_path(file, stage)
  if (dir.exists(file)) {
    crestline_abort(sprintf("`%s`: %s is a folder.", name, file),
                    sprintf("Give a file of it: see list.files(\"%s\").", file), stage = stage,
                    call = NULL)
  }
  if (!file.exists(file)) {
    crestline_abort(sprintf("`%s`: there is no file %s.", name, file),
                    sprintf("Check the path; the working directory is %s.", getwd()),
                    stage = stage, call = NULL)
  }
}

refuse_no_path <- function(file, stage) {
  crestline_abort(sprintf("`file` is %s.", describe_value(file)), "Give the path of one file.",
                  stage = stage, call = NULL)
}

refuse_file <- function(file, reason, id,
                        remedy = "The file is damaged or cut short: export or copy it again.") {
  crestline_abort(sprintf("%s cannot be read: %s.", basename(file), reason), remedy,
                  stage = "reading", id = id, class = "crestline_mesh_error", call = NULL)
}

#' Whether a value can be a path. R's own functions stop at longer ones, in some of its front ends
#' only
#'
#' @param longest Greatest number of bytes: Linux's.
#' @noRd
is_path <- function(x, longest = 4095) {
  is.character(x) && length(x) == 1 && !is.na(x) && nzchar(x) && nchar(x, "bytes") <= longest
}

#' The program that a file's first bytes are of, NA for none
#' @noRd
packed_by <- function(bytes) {
  start <- list(gzip = c(0x1f, 0x8b, 0x08), zip = c(0x50, 0x4b, 0x03, 0x04),
                bzip2 = c(0x42, 0x5a, 0x68, NA, 0x31, 0x41, 0x59, 0x26, 0x53, 0x59),
                xz = c(0xfd, 0x37, 0x7a, 0x58, 0x5a, 0x00))
  is_of <- vapply(start, function(mark) {
    length(bytes) >= length(mark) &&
      all(as.integer(bytes)[seq_along(mark)] == mark, na.rm = TRUE)
  }, NA)
  c(names(start)[is_of], NA)[1]
}

#' That a file can be read, and is what its name says: to be called before it is opened. Pipes and
#' devices, which might keep R waiting for ever, have no size
#'
#' @param id Name of the specimen, where there is one.
#' @param unpacks Kinds of packed files that the caller reads.
#' @noRd
check_stored <- function(file, stage, id = NULL, unpacks = character()) {
  refuse <- function(problem, remedy) {
    crestline_abort(paste0(file, " cannot be read", problem, "."), remedy, stage = stage, id = id,
                    call = NULL)
  }
  if (!file.exists(file)) {
    refuse(": there is no such file",
           sprintf("Check the path; the working directory is %s.", getwd()))
  }
  if (!isTRUE(file.size(file) > 0)) {
    refuse(": it is empty, or no file on disk but a pipe or device",
           "If it is empty, export or copy it again; save what comes through a pipe first.")
  }
  if (file.access(file, 4) != 0) refuse("", "Check the right to read it.")
  packed <- packed_by(readBin(file, "raw", 10))
  if (!is.na(packed) && !packed %in% unpacks) {
    refuse(sprintf(": it is compressed by %s, whatever its name", packed),
           "Unpack it first; of a spreadsheet save the sheet as CSV.")
  }
}

#' Whether a path is a pipe, which would keep R waiting for a reader. R cannot tell, the shell can
#' @noRd
is_pipe <- function(file) {
  if (.Platform$OS.type != "unix" || !isTRUE(file.size(file) == 0)) return(FALSE)
  system2("test", c("-p", shQuote(path.expand(file)))) == 0
}

# The name of a file without folder and without ".gz".
unpacked_name <- function(file) sub("[.]gz$", "", basename(file), ignore.case = TRUE)

# Bytes, or lines of text.
write_content <- function(content, file) {
  if (is_pipe(file)) refuse_writing(file, "it is a pipe, no file on disk", "Write to a file.")
  connection <- tryCatch(suppressWarnings(file(file, "wb")), error = function(e) {
    refuse_writing(file, "it cannot be opened", writing_words(file))
  })
  on.exit(close(connection))
  if (is.raw(content)) writeBin(content, connection) else
    writeLines(content, connection, useBytes = TRUE)
}

# The rows of a matrix (or elements of a vector) as columns of little-endian bytes, each number of
# `size`.
bytes_of <- function(x, size) {
  x <- t(as.matrix(x))
  if (size == 1L) storage.mode(x) <- "integer"
  matrix(writeBin(as.vector(x), raw(), size = size, endian = "little"), size * nrow(x))
}

# What to do about a file that cannot be written.
writing_words <- function(file) {
  if (dir.exists(dirname(file))) return("Check the right to write in its folder.")
  sprintf("There is no folder %s: create it first.", dirname(file))
}

refuse_writing <- function(file, reason, remedy) {
  crestline_abort(sprintf("`file`: %s cannot be written: %s.", basename(file), reason), remedy,
                  stage = "writing",
                  class = "crestline_mesh_error", call = NULL)
}

# Where a value came from: one question to specimens, shapes and meshes, answered by each class in
# its own file.

#' What a value says of where it came from, NULL where it says nothing
#' @noRd
provenance_of <- function(x) UseMethod("provenance_of")

#' @exportS3Method
provenance_of.default <- function(x) NULL

#' Lines of comment for a file that is written
#' @noRd
comment_lines <- function(x) UseMethod("comment_lines")

#' @exportS3Method
comment_lines.default <- function(x) NULL

#' Hash of a value's content
#'
#' Of its serialisation in version 2, which has no compact forms: `1:3` and `c(1L, 2L, 3L)` are the
#' same. The first 14 bytes name the version of R.
#' @noRd
content_hash <- function(x) bytes_hash(serialize(x, NULL, version = 2)[-(1:14)])

#' XXH128 of bytes, by way of a file: `rlang::hash()` of a value changes with rlang's version, so
#' that nothing that is in a file may depend on it
#' @noRd
bytes_hash <- function(bytes) {
  file <- tempfile("hash-")
  on.exit(unlink(file))
  writeBin(bytes, file)
  if (!identical(as.numeric(file.size(file)), as.numeric(length(bytes)))) {
    crestline_abort("the folder for temporary files is full.", "Make room, then run it again.",
                    stage = "files", call = NULL)
  }
  rlang::hash_file(file)
}

#' A name as a file's name, of its own for each
#'
#' It is the name itself, by which [fit_shapes()] finds the table of a scan, but for signs that a
#' disk does not take or that lead out of the folder: these are as in addresses.
#' @noRd
file_word <- function(name) {
  letters <- strsplit(enc2utf8(name), "")[[1]]
  odd <- grepl("[%<>:\"/\\\\|?*\001-\037]", letters)
  ends <- unique(c(1, length(letters)))
  odd[ends] <- odd[ends] | letters[ends] %in% c(".", " ")
  letters[which(odd)] <- sprintf("%%%02X", vapply(letters[which(odd)], utf8ToInt, 0L))
  paste(letters, collapse = "")
}

#' Names as names of files of one folder, which no two share on a disk that does not tell capitals
#' from small letters: where two names differ in nothing else, capitals are as in addresses
#' @noRd
file_words <- function(names) {
  words <- vapply(names, file_word, "", USE.NAMES = FALSE)
  plain <- tolower(words)
  twins <- plain %in% plain[duplicated(plain)]
  words[twins] <- vapply(words[twins], function(word) {
    letters <- strsplit(word, "")[[1]]
    # Not those of codes that are there already
    code <- gregexpr("%[0-9A-F]{2}", word)[[1]]
    coded <- if (code[1] > 0) outer(0:2, code, `+`)
    capital <- setdiff(which(letters != tolower(letters)), coded)
    letters[capital] <- vapply(letters[capital], function(one) {
      paste0(sprintf("%%%02X", as.integer(charToRaw(enc2utf8(one)))), collapse = "")
    }, "")
    paste(letters, collapse = "")
  }, "", USE.NAMES = FALSE)
  words
}
