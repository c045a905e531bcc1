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
