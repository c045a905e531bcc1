# Results in files: a name that any disk takes, a first line that tells what is in it, and a
# checksum that is compared before anything is unserialised.

# Raised when the same input gives other answers than before: what was kept by the former version is
# then measured again.
answers_version <- 2L

kept_layout <- "crestline-result 3"

# Layouts that are read: in the second, a shape was stored as it is in memory.
known_layouts <- c(kept_layout, "crestline-result 2")

#' The folder for results, made where it is not there
#' @noRd
results_folder <- function(dir) {
  if (!is_path(dir)) {
    crestline_abort(sprintf("`dir` is %s.", describe_value(dir)), "Give the path of one folder.",
                    stage = "arguments")
  }
  dir.create(dir, recursive = TRUE, showWarnings = FALSE)
  if (!dir.exists(dir)) {
    crestline_abort(sprintf("the folder %s cannot be made.", dir),
                    "Choose another, or check who may write there.",
                    stage = "arguments")
  }
  normalizePath(dir)
}

#' Why nothing can be written into a folder, as a condition; NULL where it can
#' @param room Bytes that a result needs.
#' @noRd
unwritable <- function(dir, room = 1e5) {
  probe <- tempfile(part_prefix(), dir, ".tmp")
  on.exit(unlink(probe))
  reason <- if (!suppressWarnings(file.create(probe))) "nothing may be written there" else
    tryCatch({
      write_whole(raw(room), probe)
      NULL
    }, error = conditionMessage, warning = conditionMessage)
  if (is.null(reason)) return(NULL)
  tryCatch(refuse_keeping(dir, reason), crestline_keeping_error = identity)
}

#' What names of unfinished files begin with: the host and the process that write them
#' @noRd
part_prefix <- function() {
  host <- gsub("[^[:alnum:]]", "", substr(Sys.info()[["nodename"]], 1, 20))
  sprintf("part-%s-%d-", host, Sys.getpid())
}

#' Names of files for ids, which any disk takes
#'
#' Bytes other than letters, digits, "_", "-", inner dots and blanks are "%" and two hexadecimal
#' digits, as in addresses: `utils::URLdecode()` gives the id. So is the first letter of a name that
#' Windows keeps for devices, and so are capitals where two ids differ in nothing else. A name that
#' is too long ends in "~" and a hash; its file has the id too.
#'
#' @param longest Number of characters, of the 255 bytes that a disk allows.
#' @noRd
file_stems <- function(ids, longest = 160) {
  stems <- vapply(ids, file_stem, "", FALSE, longest, USE.NAMES = FALSE)
  twins <- tolower(stems) %in% tolower(stems[duplicated(tolower(stems))])
  stems[twins] <- vapply(ids[twins], file_stem, "", TRUE, longest, USE.NAMES = FALSE)
  stems
}

file_stem <- function(id, capitals, longest) {
  bytes <- charToRaw(enc2utf8(id))
  letters <- rawToChar(bytes, multiple = TRUE)
  n <- length(letters)
  odd <- !letters %in% c(base::letters, if (!capitals) LETTERS, 0:9, " ", ".", "_", "-")
  odd[c(1, n)] <- odd[c(1, n)] | letters[c(1, n)] %in% c(" ", ".")
  device <- grepl("^(con|prn|aux|nul|com[0-9]|lpt[0-9]) *([.].*)?$", tolower(enc2utf8(id)),
                  useBytes = TRUE)
  odd[1] <- odd[1] || device
  stem <- paste(ifelse(odd, sprintf("%%%02X", as.integer(bytes)), letters), collapse = "")
  if (nchar(stem) <= longest) return(stem)
  hash <- bytes_hash(bytes)
  paste0(substr(stem, 1, longest - nchar(hash) - 1), "~", hash)
}

#' Write a value with what it is of; under another name until all of it is there
#'
#' @param about List: `key`, `mesh` and, perhaps, `setting`, strings without a blank, and what else
#'   is to be known without reading the value.
#' @param compression Of gzip, 1 to 9: a scan is hardly smaller with 6 than with 1, and takes five
#'   times as long. "xz": for what is packed, a third smaller.
#' @param new Whether the file must not be there yet: of two processes only one writes it.
#' @return Whether it was written; an error of class `crestline_keeping_error` where it cannot be.
#' @noRd
keep <- function(value, about, file, compression = 1, new = FALSE) {
  part <- tempfile(part_prefix(), dirname(file), ".tmp")
  on.exit(unlink(part))
  refuse <- function(e) refuse_keeping(file, conditionMessage(e))
  tryCatch({
    write_whole(kept_bytes(value, about, compression), part)
    if (new) return(named_first(part, file))
    if (!file.rename(part, file)) stop("it cannot be given its name")
    TRUE
  }, error = refuse, warning = refuse)
}

#' Give a whole file its name where no other has it
#'
#' By a second name for it, which a disk gives once; where it has no second names (some shares), by
#' looking first.
#' @noRd
named_first <- function(part, file) {
  if (suppressWarnings(file.link(part, file))) return(TRUE)
  if (file.exists(file)) return(FALSE)
  if (!file.rename(part, file)) stop("it cannot be given its name")
  TRUE
}

refuse_keeping <- function(file, reason) {
  reason <- sub("[.]$", "", iconv(reason, "", "UTF-8", sub = "byte"))
  crestline_abort(sprintf("its result cannot be written to %s: %s.", file, reason),
                  "Make room or check who may write there; then run it again: what is kept stays.",
                  stage = "keeping", class = "crestline_keeping_error", call = NULL)
}

write_whole <- function(bytes, file) {
  to <- suppressWarnings(file(file, "wb"))
  tryCatch(writeBin(bytes, to), finally = close(to))
  if (!identical(as.numeric(file.size(file)), as.numeric(length(bytes)))) stop("the disk is full")
}

#' A value's file: two lines of text, a line of JSON, and the value, serialised and compressed
#' @noRd
kept_bytes <- function(value, about, compression) {
  first <- charToRaw(paste(c(kept_layout, about$key, about$mesh, about$setting), collapse = " "))
  about <- charToRaw(enc2utf8(jsonlite::toJSON(
    about, auto_unbox = TRUE, null = "null", na = "null"
  )))
  packed <- packed_bytes(value, compression)
  line <- as.raw(10L)
  c(first, line, charToRaw(checksum(first, about, packed)), line, about, line, packed)
}

checksum <- function(first, about, packed) {
  line <- as.raw(10L)
  bytes_hash(c(first, line, about, line, packed))
}

#' That of the second layout, which another version of rlang works out otherwise
#' @noRd
former_checksum <- function(first, about, packed) rlang::hash(list(first, about, packed))

#' By way of a file, since R compresses at a chosen level only there; its last bytes are the length
#' of what went in
#' @noRd
packed_bytes <- function(value, compression) {
  bytes <- serialize(value, NULL)
  if (identical(compression, "xz")) return(memCompress(bytes, "xz"))
  file <- tempfile("packed-")
  on.exit(unlink(file))
  to <- suppressWarnings(gzfile(file, "wb", compression = compression))
  tryCatch(writeBin(bytes, to), finally = close(to))
  packed <- readBin(file, "raw", file.size(file))
  length <- sum(as.integer(utils::tail(packed, 4)) * 256^(0:3))
  if (length(packed) < 18 || length != length(bytes) %% 2^32) {
    stop("the folder for temporary files is full")
  }
  packed
}

#' The first bytes of a file, NULL where it cannot be read. R loses a connection for good where a
#' warning of its opening is caught outside, and it has 128
#' @noRd
read_raw <- function(file, most = file.size(file)) {
  if (!file.exists(file) || dir.exists(file)) return(NULL)
  tryCatch(suppressWarnings(readBin(file, "raw", most)), error = function(e) NULL)
}

#' What a result's file says of itself in its first line, unproven
#' @return List: `key`, `mesh`, `setting`, NA where it has none; `own`: whether the file is one of
#'   ours, perhaps cut short.
#' @noRd
peek_kept <- function(file, most = 200) {
  none <- list(key = NA_character_, mesh = NA_character_, setting = NA_character_, own = FALSE)
  start <- read_raw(file, most)
  if (is.null(start)) return(none)
  known <- min(length(start), nchar(kept_layout))
  own <- vapply(known_layouts, function(layout) {
    identical(start[seq_len(known)], charToRaw(layout)[seq_len(known)])
  }, NA)
  none$own <- any(own) || is_former(start)
  end <- match(as.raw(10L), start)
  if (known < nchar(kept_layout) || !none$own || is_former(start) || is.na(end)) return(none)
  line <- start[seq_len(end - 1)]
  if (!all(line >= as.raw(0x20) & line < as.raw(0x7f))) return(none)
  words <- strsplit(rawToChar(line), " ", fixed = TRUE)[[1]]
  list(key = words[3], mesh = words[4], setting = words[5], own = TRUE)
}

#' The former layout: two values, serialised and compressed
#' @noRd
is_former <- function(bytes) identical(bytes[1:2], as.raw(c(0x1f, 0x8b)))

#' A result's file, its checksum compared
#'
#' A file of the former layout is not read: nothing in it tells whether it is whole, and R may end
#' over one that is not.
#'
#' @return List: `state`, "whole", "absent", "damaged" or "former" (of the former layout); of a
#'   whole one `about`, `packed` (raw) and `layout`.
#' @noRd
open_kept <- function(file) {
  if (!file.exists(file)) return(list(state = "absent"))
  damaged <- function(e) list(state = "damaged")
  tryCatch({
    bytes <- read_raw(file)
    if (is_former(bytes)) return(list(state = "former"))
    end <- integer(3)
    for (i in 1:3) end[i] <- grepRaw(as.raw(10L), bytes, c(0, end)[i] + 1, fixed = TRUE)
    line <- function(i) bytes[(c(0, end)[i] + 1):(end[i] - 1)]
    packed <- bytes[(end[3] + 1):length(bytes)]
    layout <- substr(rawToChar(line(1)), 1, nchar(kept_layout))
    sum <- if (layout == kept_layout) checksum else former_checksum
    sound <- identical(rawToChar(line(2)), sum(line(1), line(3), packed))
    if (!sound || !layout %in% known_layouts) return(damaged())
    about <- rawToChar(line(3))
    Encoding(about) <- "UTF-8"
    list(state = "whole", about = jsonlite::fromJSON(about), packed = packed, layout = layout)
  }, error = damaged, warning = damaged)
}

#' The value of a whole file that was opened
#' @noRd
kept_value <- function(opened) {
  gzip <- identical(opened$packed[1:2], as.raw(c(0x1f, 0x8b)))
  unserialize(memDecompress(opened$packed, if (gzip) "gzip" else "xz"))
}
