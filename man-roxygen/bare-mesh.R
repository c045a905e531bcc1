#' @param mesh A `mesh3d`, or a [specimen()] whose own landmarks are ignored.
