#' @param id Name of the specimen, one string, if `mesh` is not a specimen.
