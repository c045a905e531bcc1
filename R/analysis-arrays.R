# Arrays of configurations: checked, named, and aligned by the kernel.

check_array <- function(x, call, name = "sample") {
  if (!is.numeric(x) || length(dim(x)) != 3 || !dim(x)[2] %in% 2:3 || dim(x)[1] < dim(x)[2]) {
    size <- if (length(dim(x)) == 3) paste0("an array of ", paste(dim(x), collapse = " x ")) else
      describe_value(x)
    crestline_abort(sprintf("`%s` is %s.", name, size),
                    paste("Give a shape_sample, as homologise() returns it, or a k x 3 x n",
                          "array of numbers."), stage = "align",
                    call = call)
  }
  if (any(is.infinite(x))) {
    crestline_abort(sprintf("`%s` has infinite values.", name), "Mark what is missing as NA.",
                    stage = "align", call = call)
  }
  ids <- dimnames(x)[[3]]
  if (anyDuplicated(ids)) {
    crestline_abort(sprintf("two specimens have the name \"%s\".", ids[anyDuplicated(ids)]),
                    "Name each of its own.",
                    stage = "align", call = call)
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

check_triangles <- function(triangles, k, call) {
  if (is.null(triangles)) return(NULL)
  ok <- is.matrix(triangles) && nrow(triangles) == 3 && is.numeric(triangles) &&
    all(triangles %in% seq_len(k))
  if (!ok) {
    crestline_abort("`triangles` is no matrix of three rows with numbers of points.",
                    "Give the `it` of a mesh whose vertices are the points.", stage = "align",
                    call = call)
  }
  matrix(as.integer(triangles), 3)
}

#' The kernel with names put back
#' @return List: `coords`, `mean`, `size`, `moved`, `converged`.
#' @noRd
fit_alignment <- function(whole, weight, scaling, tolerance, rounds) {
  x <- whole$coords
  fit <- cpp_align(x, dim(x), weight, whole$reference, scaling, tolerance, rounds)
  fit$coords <- array(fit$coords, dim(x), dimnames(x))
  fit$mean <- matrix(fit$mean, dim(x)[1], dim(x)[2], dimnames = dimnames(x)[1:2])
  names(fit$size) <- dimnames(x)[[3]]
  fit
}

#' k weights of mean 1
#' @noRd
point_weights <- function(weights, whole, call = rlang::caller_env()) {
  k <- dim(whole$coords)[1]
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "align", call = call)
  if (is.null(weights)) return(rep(1, k))
  if (identical(weights, "places")) {
    weights <- 1 / as.vector(table(whole$places)[whole$places])
  } else if (identical(weights, "area")) {
    if (is.null(whole$triangles)) {
      fail("there are no triangles to take areas of.", "Give `triangles`, or another `weights`.")
    }
    weights <- point_areas(mean_of_sizes(whole), whole$triangles)
  } else if (!is.numeric(weights) || length(weights) != whole$given || any(!is.finite(weights)) ||
             any(weights < 0)) {
    fail(sprintf("`weights` is %s.", describe_value(weights)),
         sprintf("Give \"area\", \"places\" or %d numbers, none of them negative.", whole$given))
  } else {
    weights <- weights[whole$kept]
  }
  if (sum(weights > 0) < 3) fail("fewer than three points have a weight.", "Give weights above 0.")
  weights * k / sum(weights)
}

as_whole <- function(aligned) {
  k <- nrow(aligned$mean)
  list(coords = aligned$coords, reference = aligned$mean, triangles = aligned$triangles,
       places = aligned$places, given = k,
       kept = seq_len(k))
}
