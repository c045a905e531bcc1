# The units of a design where the alignment is in files: the means of whole blocks, in memory; or
# specimens less the mean of their block, in files of their own.

#' As [in_design()], of an `aligned_files`
#'
#' The means of blocks are in memory already: as an `aligned` in memory they are saved with what is
#' made of them, and need no files.
#' @return An `aligned` of the blocks' means; or an `aligned_files`, whose folder is for the caller
#'   to delete.
#' @noRd
units_in_files <- function(aligned, design) {
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
    return(block_means(aligned, means, stats::setNames(size, levels(design$block))))
  }
  middle <- as.vector(attr(aligned, "center"))
  read <- function(rows, i) flat_block(files, i) - means[, code[rows], drop = FALSE] + middle
  own <- aligned$size - size[code] + mean(aligned$size)
  with_files(aligned, read, stats::setNames(own, names(aligned)))
}

#' An alignment in memory of the means of blocks
#' @param means dk x the number of blocks; `size` named by block.
#' @noRd
block_means <- function(aligned, means, size) {
  names <- c(dimnames(aligned$mean), list(names(size)))
  validate_aligned(new_aligned(
    array(means, lengths(names), names), aligned$mean, size, aligned$weights, aligned$places,
    aligned$scale, aligned$tangent, aligned$level, moved = aligned$moved,
    triangles = aligned$triangles, settings = aligned$settings, reference = aligned$reference,
    provenance = aligned$provenance
  ))
}

#' Deletes the folder of units in files that are not the alignment itself
#' @noRd
forget_units <- function(units, aligned) {
  unlink(setdiff(attr(units, "files")$dir, attr(aligned, "files")$dir), recursive = TRUE)
}

flat_block <- function(files, i) {
  matrix(read_block(files, i), nrow(files$points) * length(files$axes))
}

#' An alignment in files with other co-ordinates in new files
#' @param read Function of the specimens and of the number of their file: dk x m.
#' @noRd
with_files <- function(aligned, read, size) {
  files <- attr(aligned, "files")
  folder <- empty_sample_folder(tempfile("units-"))
  whole <- FALSE
  on.exit(if (!whole) unlink(folder, recursive = TRUE))
  total <- 0
  for (i in unique(files$block)) {
    rows <- which(files$block == i)
    flat <- read(rows, i)
    total <- total + rowSums(flat)
    names <- list(files$points$point, files$axes, names(aligned)[rows])
    write_block(array(flat, lengths(names), names), files$points, folder, i)
  }
  write_sample_head(list(ids = names(aligned), block = files$block, points = files$points,
                         axes = files$axes, provenance = files$provenance), folder)
  center <- attr(aligned, "center")
  center[] <- total / length(aligned)
  own <- attributes(aligned)
  own[c("files", "center", "size", "distance", "kept")] <- list(
    open_sample(folder), center, size, rep(NA_real_, length(aligned)), new.env(parent = emptyenv())
  )
  own$missing <- no_missing_points()
  attributes(aligned) <- own
  whole <- TRUE
  aligned
}
