# Arrays of configurations, as they are given: checked and named.

check_array <- function(x, name = "sample") {
  if (!is.numeric(x) || length(dim(x)) != 3 || !dim(x)[2] %in% 2:3 || dim(x)[1] < dim(x)[2]) {
    size <- if (length(dim(x)) == 3) paste0("an array of ", paste(dim(x), collapse = " x ")) else
      describe_value(x)
    one <- if (inherits(x, "shape")) " The points of one shape are coords(shape, level)." else ""
    crestline_abort(sprintf("`%s` is %s.", name, size),
                    paste0("Give a shape_sample, as homologise() returns it, or a k x 3 x n ",
                           "array of numbers.", one), stage = "align")
  }
  if (any(is.infinite(x))) {
    crestline_abort(sprintf("`%s` has infinite values.", name), "Mark what is missing as NA.",
                    stage = "align")
  }
  ids <- dimnames(x)[[3]]
  if (anyDuplicated(ids)) {
    crestline_abort(sprintf("two specimens have the name \"%s\".", ids[anyDuplicated(ids)]),
                    "Name each of its own; scans of one person share a `block` in a comparison.",
                    stage = "align")
  }
  x
}

named_array <- function(x) {
  names <- if (is.null(dimnames(x))) list(NULL, NULL, NULL) else dimnames(x)
  fill <- list(seq_len(dim(x)[1]), c("x", "y", "z")[seq_len(dim(x)[2])], seq_len(dim(x)[3]))
  dimnames(x) <- Map(function(own, other) if (is.null(own)) as.character(other) else own,
                     unname(names), fill)
  x
}

check_triangles <- function(triangles, k) {
  if (is.null(triangles)) return(NULL)
  ok <- is.matrix(triangles) && nrow(triangles) == 3 && is.numeric(triangles) &&
    all(triangles %in% seq_len(k))
  if (!ok) {
    crestline_abort("`triangles` is no matrix of three rows with numbers of points.",
                    "Give the `it` of a mesh whose vertices are the points.", stage = "align")
  }
  matrix(as.integer(triangles), 3)
}
