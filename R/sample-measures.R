# What quality() grades by, in files beside the index of a folder: so it opens no result. A copy of
# what lies in the results, made anew where it is lost or out of date.

# Raised when part_measures() gives other columns or values.
measures_version <- 1L

# `packed` are the measures, compressed with a checksum, as letters.
measures_columns <- c("file", "size", "time", "key", "scheme", "version", "packed", "end")

#' What grading takes of each shape of a batch: of those in files from the measures beside them; a
#' result is opened only where these do not know it
#' @noRd
#' @exportS3Method
measures_of.shape_batch <- function(x, name) {
  x <- renewed_batch(x)
  if (!length(x)) return(each_shape(x, to_grade, name))
  elements <- plain_list(x)
  kept <- which(vapply(elements, inherits, NA, "kept_shape"))
  measures <- vector("list", length(elements))
  measures[kept] <- known_measures(elements[kept])
  lost <- which(!vapply(elements, is.null, NA) & vapply(measures, is.null, NA))
  measures[lost] <- lapply(lost, function(i) {
    shape <- x[[i]]
    if (is.null(shape)) return(NULL)
    own <- elements[[i]]
    if (i %in% kept) note_measures(shape, kept_row(own), dirname(attr(own, "file")))
    to_grade(shape, names(x)[i])
  })
  stats::setNames(measures, names(x))
}

#' The file of a kept shape as it is now
#' @noRd
kept_row <- function(kept) {
  info <- file.info(attr(kept, "file"), extra_cols = FALSE)
  list(file = basename(attr(kept, "file")), size = size_text(info), time = time_text(info),
       key = attr(kept, "key"))
}

#' Measures of kept shapes from their folders' files of measures
#' @return List: as of [to_grade()], with `parts` packed; NULL where there is nothing that fits.
#' @noRd
known_measures <- function(kept) {
  file <- vapply(kept, attr, "", "file")
  key <- vapply(kept, function(one) c(attr(one, "key"), NA)[1], "")
  info <- file.info(file, extra_cols = FALSE)
  measures <- vector("list", length(kept))
  for (dir in unique(dirname(file))) {
    at <- which(dirname(file) == dir)
    rows <- read_index(dir, "quality", measures_columns)
    row <- match(basename(file[at]), rows$file)
    fresh <- rows$size[row] == size_text(info[at, ]) & rows$time[row] == time_text(info[at, ]) &
      rows$key[row] == key[at] & rows$version[row] == measures_version
    found <- which(fresh)
    measures[at[found]] <- lapply(row[found], function(i) {
      measures_in(rows$packed[i], rows$scheme[i], dir)
    })
  }
  measures
}

#' Measures in a line; NULL where they are damaged, or their scheme is not there
#' @noRd
measures_in <- function(letters, scheme, dir) {
  tryCatch({
    packed <- jsonlite::base64_dec(letters)
    one <- unpack_measures(packed)
    scheme <- shared_value(scheme, dir)
    list(parts = packed, scheme = scheme, said = one$said,
         lengths = scored_lengths(one$parts, scheme), found = one$found)
  }, error = function(e) NULL)
}

#' Write down what quality() takes of a shape; nothing where that cannot be
#'
#' @param row `file`, `size`, `time`, `key` of its result, as the index has them.
#' @noRd
note_measures <- function(shape, row, dir) {
  if (is.null(shape$checks) || is.null(row$key) || is.na(row$key)) return(invisible())
  tryCatch({
    packed <- pack_measures(to_grade(shape, shape$id))
    letters <- gsub("\n", "", jsonlite::base64_enc(packed), fixed = TRUE)
    append_index(data.frame(row[c("file", "size", "time", "key")],
                            scheme = share_value(shape$scheme, dir), version = measures_version,
                            packed = letters, end = "."), dir, "quality")
  }, crestline_error = function(e) NULL)
  invisible()
}
