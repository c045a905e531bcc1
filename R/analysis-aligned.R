# An alignment as a container of its specimens: parts of it, and several of them joined, are aligned
# again.

#' An alignment from its parts
#'
#' It is the list of its configurations, so that loops run over specimens; what they have in common
#' are attributes, which `$` gives as fields, `coords` as one array.
#'
#' @param coords k x d x n, with names.
#' @param mean,size,weights,scale,tangent,level,missing,moved,triangles As [align()] gives them.
#' @param places k: points that coincide share one.
#' @param settings The arguments that [align()] was called with, for the rest of the specimens; NULL
#'   of [as_aligned()].
#' @param reference k x d: where the mean is laid.
#' @param provenance List: what came from where.
#' @noRd
new_aligned <- function(coords, mean, size, weights, places, scale, tangent, level,
                        missing = no_missing_points(), moved = numeric(), triangles = NULL,
                        settings = NULL, reference = mean, provenance = list()) {
  each <- lapply(seq_len(dim(coords)[3]), function(i) {
    matrix(coords[, , i], dim(coords)[1], dimnames = dimnames(coords)[1:2])
  })
  structure(stats::setNames(each, dimnames(coords)[[3]]), mean = mean, size = size,
            weights = weights, places = places, scale = scale, tangent = tangent, level = level,
            missing = missing, moved = moved, triangles = triangles, settings = settings,
            reference = reference, provenance = provenance, class = "aligned")
}

aligned_fields <- c("coords", "mean", "size", "weights", "places", "scale", "tangent", "level",
                    "missing", "moved", "triangles", "settings", "reference", "provenance")

no_missing_points <- function() {
  data.frame(id = character(), point = character(), action = character())
}

#' The rules of an alignment
#' @noRd
validate_aligned <- function(x) {
  refuse <- function(wrong, problem) {
    remedy <- "Make an alignment with align()."
    if (wrong) crestline_abort(problem, remedy, stage = "align")
  }
  mean <- x$mean
  k <- nrow(mean)
  like_mean <- function(one) {
    identical(dim(one), dim(mean)) && identical(dimnames(one), dimnames(mean))
  }
  ids <- names(x)
  refuse(!all(vapply(as.list(x), like_mean, NA)),
         "its configurations have not the points of its mean.")
  refuse(anyDuplicated(ids) > 0,
         sprintf("two specimens have the name \"%s\".", ids[anyDuplicated(ids)]))
  refuse(!identical(names(x$size), ids), "its sizes are not those of its specimens.")
  refuse(length(x$weights) != k || length(x$places) != k,
         "its weights or places are not those of its points.")
  refuse(!all(x$missing$id %in% ids), "its missing points are of other specimens.")
  refuse(!all(x$triangles %in% seq_len(k)), "its triangles name points that are not there.")
  x
}

# Of an alignment whose fields may have been set one by one since it was made.
#' @exportS3Method
validate.aligned <- function(x) {
  mean <- attr(x, "mean")
  like_mean <- function(one) is.numeric(one) && identical(dim(one), dim(mean))
  numbers <- function(value, n) is.numeric(value) && length(value) == n
  alike <- is.matrix(mean) && is.numeric(mean) && all(vapply(as.list(x), like_mean, NA))
  if (alike && numbers(x$weights, nrow(mean)) && numbers(x$size, length(x)) && is_described(x)) {
    return(invisible(x))
  }
  crestline_abort("the fields of the alignment do not fit together.",
                  "Set `coords`, `mean`, `size`, `weights` alike, or align() the changed sample.",
                  stage = "align", call = NULL)
}

#' Whether what an alignment says of itself is of the right kinds
#' @noRd
is_described <- function(x) {
  flag <- function(value) isTRUE(value) || isFALSE(value)
  one <- function(value, is) is(value) && length(value) == 1 && !is.na(value)
  texts <- function(value) is.character(value) || is.factor(value)
  settings <- x$settings
  known <- is.null(settings) || is.list(settings) && flag(settings$tangent) &&
    one(settings$tolerance, is.numeric) && one(settings$rounds, is.numeric) &&
    one(settings$missing, is.character) && settings$missing %in% c("estimate", "drop", "stop")
  missing <- is.data.frame(x$missing) && texts(x$missing$id) && texts(x$missing$point) &&
    texts(x$missing$action)
  known && missing && flag(x$tangent) && (flag(x$scale) || identical(x$scale, "full")) &&
    one(x$level, is.character) && is.matrix(x$reference) && is.numeric(x$reference) &&
    is.list(x$provenance) &&
    (is.null(x$provenance$settings) || is.list(x$provenance$settings))
}

#' The specimens of an alignment
#'
#' An `aligned` is a list of its configurations. `length()` is the number of specimens, `names()`
#' are their names. `aligned[["id"]]` is one k x 3 matrix. `for`, `lapply()`, `split()` and
#' `as.list()` go through the configurations.
#'
#' The Procrustes mean, the space tangent to it and estimated points depend on all specimens. So
#' `aligned[ids]`, `aligned[-3]` and `aligned[logical]` align these specimens again, with the same
#' settings. The result is that of [align()] for a sample without the others. `c()` aligns the
#' specimens of both together. Three things do not change: the size of each specimen, the pose of
#' the mean, and the set of points. Points that some specimen lacked (`missing = "drop"`) are not
#' brought back. If only the order changes, co-ordinates stay the same to the last bit. A value of
#' [as_aligned()] has no record of its alignment. Its co-ordinates do not change, its mean is taken
#' of them, and `c()` does not join it.
#'
#' @param x,... An `aligned`, as [align()] returns it. `c()` takes several with the same points and
#'   settings.
#' @param i Names, numbers (negative: all but these), or a logical value for each specimen. Logical
#'   values with names are matched by name. For `[[`: one name or number.
#' @param name A field, see [align()].
#' @param value For `names<-`: new names. For `$<-`: the new value of the field.
#' @return An `aligned`. `[[` gives a k x 3 matrix, `as.list()` a named list of matrices,
#'   `as.array()` the array `coords` (k x 3 x n). `$<-` changes one field only; the fields that
#'   depend on it do not follow.
#' @section Errors: of class `crestline_error`: an unknown specimen, or one specimen twice (the
#'   error lists the names); fewer than two specimens. For `c()`: other points, templates or
#'   settings, or names that both have.
#' @template glossary
#' @seealso [align()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' shapes <- shapes + rnorm(120, sd = 0.05)
#' dimnames(shapes) <- list(letters[1:4], c("x", "y", "z"), paste0("s", 1:10))
#' aligned <- align(shapes)
#' aligned[-3]
#' aligned[["s2"]]
#' vapply(aligned, function(one) one["a", "x"], 0)
#' @name aligned
NULL

#' @rdname aligned
#' @export
`[.aligned` <- function(x, i, ...) {
  if (...length()) refuse_dimensions("the alignment", "Or use the array: aligned$coords[, , i].")
  validate(x)
  if (missing(i)) return(x)
  at <- chosen_members(i, names(x), "the alignment")
  if (length(at) == length(x)) return(reordered(x, at))
  if (length(at) < 2) {
    crestline_abort(sprintf("%s of an alignment %s no alignment.", amount(length(at), "specimen"),
                            if (length(at) == 1) "is" else "are"),
                    "Choose two or more; aligned[[i]] is one configuration.", stage = "align")
  }
  if (is.null(x$settings)) return(kept_as_they_are(x, at))
  given <- c(list(coords = raw_configurations(x)[, , at, drop = FALSE]), given_of(x))
  part <- with_dropped(align_configurations(given, x$settings), x)
  attr(part, "provenance") <- provenance_part(x$provenance, names(part))
  part
}

#' @rdname aligned
#' @export
`[[.aligned` <- function(x, i, ...) {
  if (...length()) refuse_dimensions("the alignment", "Or use the array: aligned$coords[, , i].")
  as.list(x)[[one_member(i, names(x), "the alignment")]]
}

#' @rdname aligned
#' @export
`$.aligned` <- function(x, name) {
  if (!name %in% aligned_fields) {
    refuse_member(sprintf("an alignment has no field `%s`.", name),
                  sprintf("Fields are %s.", paste(aligned_fields, collapse = ", ")))
  }
  aligned_field(x, name)
}

aligned_field <- function(x, name) {
  if (name == "coords") as.array(x) else attr(x, name, exact = TRUE)
}

fields_of <- function(x, names = aligned_fields) {
  lapply(stats::setNames(nm = names), function(name) aligned_field(x, name))
}

#' @rdname aligned
#' @export
`$<-.aligned` <- function(x, name, value) {
  if (!name %in% aligned_fields) {
    refuse_member(sprintf("an alignment has no field `%s`.", name), "Make one with align().")
  }
  if (name == "coords") value <- named_array(check_array(value))
  fields <- fields_of(x)
  fields[name] <- list(value)
  do.call(new_aligned, fields)
}

#' @rdname aligned
#' @export
`[<-.aligned` <- function(x, i, ..., value) {
  refuse_member("specimens of an alignment cannot be replaced.", "Align the changed sample again.")
}

#' @rdname aligned
#' @export
`[[<-.aligned` <- `[<-.aligned`

#' @rdname aligned
#' @export
`names<-.aligned` <- function(x, value) {
  validate(x)
  value <- check_member_names(value, length(x))
  renamed <- fields_of(x)
  dimnames(renamed$coords)[[3]] <- value
  names(renamed$size) <- value
  own <- match(renamed$missing$id, names(x))
  renamed$missing$id <- ifelse(is.na(own), renamed$missing$id, value[own])
  if (!is.null(renamed$provenance$specimens)) renamed$provenance$specimens$id <- value
  validate_aligned(do.call(new_aligned, renamed))
}

#' @rdname aligned
#' @export
as.list.aligned <- function(x, ...) {
  attributes(x) <- list(names = names(x))
  x
}

#' @rdname aligned
#' @exportS3Method
as.array.aligned <- function(x, ...) {
  each <- as.list(x)
  like <- if (length(each)) each[[1]] else attr(x, "mean")
  array(as.numeric(unlist(each, use.names = FALSE)), c(dim(like), length(each)),
        c(dimnames(like), list(names(each))))
}

#' @rdname aligned
#' @export
c.aligned <- function(...) {
  each <- Filter(Negate(is.null), list(...))
  for (one in each) check_class(one, "aligned", "...", "align()")
  if (length(each) == 1) return(each[[1]])
  first <- each[[1]]
  for (one in each[-1]) check_alike_aligned(first, one)
  twice <- unlist(lapply(each, names))
  twice <- unique(twice[duplicated(twice)])
  if (length(twice)) {
    refuse_member(sprintf("more than one of the alignments has %s.", shorten(twice)),
                  "Drop it from one, aligned[-i], or rename: names(aligned) <- ...")
  }
  raw <- lapply(each, raw_configurations)
  coords <- array(unlist(raw), c(dim(first$mean), length(unlist(lapply(each, names)))),
                  c(dimnames(first$mean), list(unlist(lapply(each, names)))))
  joined <- align_configurations(c(list(coords = coords), given_of(first)), first$settings)
  joined <- do.call(with_dropped, c(list(joined), each))
  attr(joined, "provenance") <- first$provenance
  specimens <- lapply(each, function(one) one$provenance$specimens)
  attr(joined, "provenance")$specimens <- do.call(rbind, specimens)
  joined
}

#' Where an alignment came from
#'
#' @param settings Arguments of [align()].
#' @noRd
aligned_provenance <- function(sample, settings) {
  known <- if (inherits(sample, "shape_sample")) whole_provenance(sample) else made_with()
  known$settings$align <- settings
  known
}

#' The same for some of its specimens
#' @noRd
provenance_part <- function(provenance, ids) {
  if (!is.null(provenance$specimens)) {
    provenance$specimens <- provenance$specimens[match(ids, provenance$specimens$id), ]
    rownames(provenance$specimens) <- NULL
  }
  provenance
}

#' @rdname provenance
#' @export
summary.aligned <- function(object, ...) new_summary(printed_lines(object), object$provenance)

#' The rest of what [configurations()] gives
#' @noRd
given_of <- function(x) fields_of(x, c("reference", "triangles", "places", "level"))

#' All specimens in another order
#' @noRd
reordered <- function(x, at) {
  fields <- fields_of(x)
  fields$coords <- fields$coords[, , at, drop = FALSE]
  fields$size <- fields$size[at]
  fields$provenance <- provenance_part(fields$provenance, names(fields$size))
  do.call(new_aligned, fields)
}

#' Some of the specimens of a foreign alignment
#' @noRd
kept_as_they_are <- function(x, at) {
  fields <- fields_of(x)
  fields$coords <- fields$coords[, , at, drop = FALSE]
  fields$size <- fields$size[at]
  fields$mean[] <- rowMeans(fields$coords, dims = 2)
  fields$reference <- fields$mean
  fields$missing <- fields$missing[fields$missing$id %in% names(fields$size), ]
  fields$provenance <- provenance_part(fields$provenance, names(fields$size))
  validate_aligned(do.call(new_aligned, fields))
}

#' The configurations before they were scaled and projected, in their own sizes; points that were
#' estimated are NA
#' @noRd
raw_configurations <- function(x) {
  coords <- before_projection(x)
  if (!isFALSE(x$scale)) {
    weight <- x$weights / sum(x$weights)
    own <- apply(coords, 3, function(one) {
      sqrt(sum(x$weights * sweep(one, 2, colSums(one * weight))^2))
    })
    coords <- coords * rep(x$size / own, each = length(x$mean))
  }
  estimated <- x$missing[x$missing$action == "estimated", ]
  at <- cbind(match(estimated$point, rownames(x$mean)), match(estimated$id, names(x)))
  for (d in seq_len(ncol(x$mean))) coords[cbind(at[, 1], rep(d, nrow(at)), at[, 2])] <- NA
  coords
}

#' The record of points that were dropped before, for the specimens that are left
#' @noRd
with_dropped <- function(x, ...) {
  dropped <- function(one) one$missing[one$missing$action == "dropped", ]
  before <- do.call(rbind, lapply(list(...), dropped))
  if (nrow(before)) x$missing <- rbind(before[before$id %in% names(x), ], x$missing)
  x
}

#' Whether specimens of two alignments can be aligned together
#' @noRd
check_alike_aligned <- function(a, b) {
  fail <- function(problem) {
    crestline_abort(problem, "Join the samples or arrays instead, and align() them together.",
                    stage = "align")
  }
  if (is.null(a$settings) || is.null(b$settings)) {
    fail("how one of them was aligned is not known (as_aligned()).")
  }
  if (!identical(dimnames(a$mean), dimnames(b$mean))) fail("the alignments have different points.")
  same <- c(a$level == b$level, identical(a$triangles, b$triangles),
            identical(a$settings, b$settings))
  differ <- c("level", "triangles", "settings")[!same]
  if (length(differ)) fail(sprintf("the alignments differ in %s.", paste(differ, collapse = ", ")))
  if (!identical(a$provenance$template, b$provenance$template)) {
    fail("the alignments are of samples with different templates: their points are not homologous.")
  }
}

#' The configurations that were projected onto the tangent space: a unit shape's own part along the
#' mean is the cosine of the angle between them, or its square with full scaling
#' @noRd
before_projection <- function(aligned) {
  if (!aligned$tangent) return(aligned$coords)
  off <- sqrt(colSums(matrix(
    sweep(aligned$coords, 1:2, aligned$mean)^2 * aligned$weights, length(aligned$mean)
  )))
  full <- identical(aligned$scale, "full")
  along <- if (full) (1 + sqrt(pmax(1 - 4 * off^2, 0))) / 2 else sqrt(pmax(1 - off^2, 0))
  aligned$coords + array(outer(as.vector(aligned$mean), along - 1), dim(aligned$coords))
}
