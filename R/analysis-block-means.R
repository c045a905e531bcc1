# The units of a design where the alignment is in files: specimens less the mean of their block, or
# the means of whole blocks, in files of their own.

#' As [in_design()], of an `aligned_files`
#' @return An `aligned_files`, whose folder is for the caller to delete.
#' @noRd
units_in_files <- function(aligned, design, block = 500) {
  files <- attr(aligned, "files")
  code <- as.integer(design$block)
  count <- tabulate(code)
  check_memory(length(aligned$mean) * as.numeric(length(count)), length(count), "block")
  sums <- matrix(0, length(aligned$mean), length(count))
  for (i in seq_len(n_blocks(files))) {
    own <- rowsum(t(flat_block(files, i)), code[block_rows(files, i)])
    at <- as.integer(rownames(own))
    sums[, at] <- sums[, at] + t(own)
  }
  means <- sums / rep(count, each = nrow(sums))
  size <- drop(rowsum(unname(aligned$size), code)) / count
  if (design$kind == "whole") {
    ids <- levels(design$block)
    at <- (seq_along(ids) - 1L) %/% as.integer(block) + 1L
    read <- function(rows, i) means[, rows, drop = FALSE]
    return(with_files(aligned, ids, at, read, stats::setNames(size, ids)))
  }
  middle <- as.vector(attr(aligned, "center"))
  read <- function(rows, i) flat_block(files, i) - means[, code[rows], drop = FALSE] + middle
  own <- aligned$size - size[code] + mean(aligned$size)
  with_files(aligned, names(aligned), files$block, read, stats::setNames(own, names(aligned)))
}

#' Deletes the folder of units in files that are not the alignment itself
#' @noRd
forget_units <- function(units, aligned) {
  unlink(setdiff(attr(units, "files")$dir, attr(aligned, "files")$dir), recursive = TRUE)
}

flat_block <- function(files, i) {
  matrix(read_block(files, i), nrow(files$points) * length(files$axes))
}

#' An alignment in files with others in their place
#' @param at Number of the file of each unit.
#' @param read Function of units and of the number of their file: dk x m.
#' @noRd
with_files <- function(aligned, ids, at, read, size) {
  files <- attr(aligned, "files")
  folder <- empty_sample_folder(tempfile("units-"))
  total <- 0
  for (i in unique(at)) {
    rows <- which(at == i)
    flat <- read(rows, i)
    total <- total + rowSums(flat)
    names <- list(files$points$point, files$axes, ids[rows])
    write_block(array(flat, lengths(names), names), files$points, folder, i)
  }
  write_sample_head(list(ids = ids, block = at, points = files$points, axes = files$axes,
                         provenance = files$provenance), folder)
  center <- attr(aligned, "center")
  center[] <- total / length(ids)
  own <- attributes(aligned)
  own[c("files", "center", "size", "distance", "kept")] <- list(
    open_sample(folder), center, size, rep(NA_real_, length(ids)), new.env(parent = emptyenv())
  )
  own$missing <- no_missing_points()
  attributes(aligned) <- own
  aligned
}
