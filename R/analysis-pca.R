# Principal components of aligned shapes, and the shapes along them.

#' Principal components of shape
#'
#' Finds the principal components of aligned shapes, and the scores of the specimens on them.
#'
#' @param aligned An `aligned`, as [align()] returns it; or a `shape_sample`, a sample in files or a
#'   k x 3 x n array, which is aligned first, by `align(aligned, level)`.
#' @param weights Weights of points, as in [align()]. Default: those of the alignment. With "area"
#'   the variance does not depend on the density of points on the surface.
#' @param tolerance Components whose variance is below this share of the first component's are left
#'   out.
#' @param components Number of components to find. `NULL`: all. A few of many are found by Lanczos'
#'   method ([RSpectra::svds()]), which takes seconds in place of minutes with thousands of
#'   specimens.
#' @param sized Least correlation of scores with centroid size by which a component gets its sign:
#'   scores then increase with size. With 23 specimens 0.4 is about the least that differs from 0 at
#'   5 %. Of other components positive scores move points outward, from the centroid; points count
#'   by the square of how far they move. The sign of a component whose correlation with size is
#'   weaker than `sized` may turn when a specimen is added or left out. With 23 faces 1 of 115
#'   components did. No rule gives every component a sign that no small change of the sample turns.
#' @param level Level of a `shape_sample`, or of a sample in files that has levels, as in [align()].
#'   Default: "landmarks", with a message. Not used of an `aligned` or an array.
#' @return Object of classes `shape_pca` and `prcomp`, a list:
#'   * `x` (n x r scores), `sdev` (r), `rotation` (d k x r, rows in the order of `as.vector(mean)`),
#'     `center`, `scale` (`FALSE`). If all weights are 1, these are the values of [stats::prcomp()]
#'     for the n x d k matrix of co-ordinates, apart from signs (see `sized`). With weights the
#'     components are orthogonal in the weighted product, and `x` is still the centred matrix times
#'     `rotation`;
#'   * `share`: r shares of the variance;
#'   * `direction`: d k x r, change of the co-ordinates for one unit of a score; equal to `rotation`
#'     if all weights are 1;
#'   * `mean` (k x d), `size` (mean centroid size, in the unit of the meshes), `weights`, `level`,
#'     `triangles`;
#'   * `laid`: list of `mean`, `weights`, `scale` and `tangent` of the alignment, which
#'     [predict.shape_pca()] needs.
#'
#'   `as.data.frame()` gives a data frame with a row for each component: `component`, `sd`, `share`,
#'   `cumulative`. `data.frame(id = rownames(pca$x), pca$x)` is a table of the scores. `summary()`
#'   and `biplot()` are those of `prcomp`. For `predict()` see [predict.shape_pca()].
#' @section Errors: of class `crestline_error`: `aligned` is not an `aligned`, a sample or an array;
#'   all shapes are equal; and those of [align()], whose warnings are given too.
#' @template glossary
#' @templateVar where section 6
#' @template paper
#' @references Dryden and Mardia (2016) *Statistical Shape Analysis*, section 7.7.
#' @seealso [shape_at()], [plot.shape_pca()], [write_pca_page()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' shapes <- shapes + rnorm(120, sd = 0.05)
#' pca <- shape_pca(align(shapes))
#' pca
#' shape_at(pca, 1, 2)
#' @export
shape_pca <- function(aligned, weights = aligned$weights, tolerance = 1e-14, components = NULL,
                      sized = 0.4, level = c("landmarks", "curves", "surface", "model")) {
  check_given()
  if (!is.null(components)) components <- check_count(components, "components")
  tolerance <- check_number(tolerance, "tolerance", lower = 0)
  sized <- check_number(sized, "sized", 0, 1)
  if (is_unaligned(aligned)) {
    if (missing(level)) say_level(aligned)
    aligned <- aligned_sample(aligned, level)
  }
  check_class(aligned, "aligned", "aligned", "align()")
  weights <- point_weights(weights, as_whole(aligned, weights))
  dims <- c(dim(aligned$mean), length(aligned))
  weight <- rep(weights, dims[2])
  center <- as.vector(weighted_shape(aligned, rep(1 / dims[3], dims[3])))
  parts <- shape_svd(aligned, weights, tolerance, components)
  total <- parts$total / (dims[3] - 1)
  if (!length(parts$d)) {
    crestline_abort("all shapes are the same.", "Check that the sample is what it should be.",
                    stage = "components")
  }
  signs <- component_signs(parts$v, parts$scores, aligned$size, aligned$mean, sized)
  axis <- parts$v * rep(signs, each = length(weight))
  names <- paste0("PC", seq_along(parts$d))
  rows <- as.vector(outer(rownames(aligned$mean), colnames(aligned$mean), paste))
  rotation <- `dimnames<-`(axis * sqrt(weight), list(rows, names))
  variance <- parts$d^2 / (dims[3] - 1)
  scores <- `dimnames<-`(parts$scores * rep(signs, each = dims[3]), list(names(aligned), names))
  direction <- if (all(weight == 1)) rotation else
    followed(aligned, scores, rotation)
  structure(list(sdev = sqrt(variance), rotation = rotation, center = stats::setNames(center, rows),
                 scale = FALSE, x = scores, share = variance / total, direction = direction,
                 mean = matrix(center, dims[1], dims[2], dimnames = dimnames(aligned$mean)),
                 size = mean(aligned$size), weights = weights, level = aligned$level,
                 triangles = aligned$triangles,
                 laid = fields_of(aligned, c("mean", "weights", "scale", "tangent")),
                 provenance = with_settings(
                   aligned$provenance, "pca", list(tolerance = tolerance)
                 )),
            class = c("shape_pca", "prcomp"))
}

#' A sample aligned on the way; errors speak of the argument by its name here
#' @noRd
aligned_sample <- function(x, level) {
  tryCatch(align(x, level), crestline_error = function(e) {
    crestline_abort(gsub("`sample`", "`aligned`", e$problem, fixed = TRUE), e$remedy,
                    stage = e$stage, id = e$id)
  })
}

#' How all co-ordinates follow the scores, those of points of weight 0 too
#' @noRd
followed <- function(aligned, scores, rotation) {
  k <- nrow(aligned$mean)
  for (rows in point_chunks(aligned)) {
    each <- columns_of_points(aligned, rows)
    for (d in seq_along(each)) rotation[(d - 1) * k + rows, ] <- crossprod(each[[d]], scores)
  }
  rotation / rep(colSums(scores^2), each = nrow(rotation))
}

#' @exportS3Method
validate.shape_pca <- function(x) {
  numbers <- function(value, n) is.numeric(value) && length(value) == n
  n <- length(x$sdev)
  columns <- function(value) is.numeric(value) && is.matrix(value) && ncol(value) == n
  right <- n > 0 && is.numeric(x$sdev) && numbers(x$share, n) && columns(x$x) &&
    columns(x$direction) && columns(x$rotation) && is.matrix(x$mean) &&
    numbers(x$mean, nrow(x$direction)) && numbers(x$weights, nrow(x$mean))
  if (right) return(invisible(x))
  crestline_abort("the components are damaged: their parts do not fit together.",
                  "Work them out anew: shape_pca(aligned).", stage = "components", call = NULL)
}

#' A provenance with the arguments of one stage more
#' @noRd
with_settings <- function(provenance, stage, settings) {
  provenance$settings[[stage]] <- settings
  provenance
}

#' @rdname provenance
#' @export
summary.shape_pca <- function(object, ...) {
  validate(object)
  found <- NextMethod()
  found$provenance <- object$provenance
  class(found) <- c("summary_shape_pca", class(found))
  found
}

#' @export
print.summary_shape_pca <- function(x, ...) {
  printed(x, {
    NextMethod()
    print_provenance(x$provenance)
    invisible(x)
  })
}

#' Signs of components: by size where scores go with it, else the one with which points move outward
#'
#' Points count by the square of how far they move. The greatest entry alone, as it was before,
#' often has a rival of the other sign on the other side of a symmetric face: 16 of 115 components
#' of simpop turned when one of 23 faces was left out, and 1 by this rule (`bench/models.R signs`).
#' @param v Components, d k x r; `scores` n x r; `shape` the mean, k x d.
#' @noRd
component_signs <- function(v, scores, size, shape, sized) {
  off <- size - mean(size)
  along <- if (any(off != 0)) {
    colSums(scores * off) / sqrt(colSums(scores^2) * sum(off^2))
  } else rep(0, ncol(v))
  about <- shape - rep(colMeans(shape), each = nrow(shape))
  out <- about / pmax(sqrt(rowSums(about^2)), .Machine$double.xmin)
  outward <- apply(v, 2, function(own) {
    move <- matrix(own, nrow(shape))
    squared <- rowSums(move^2)
    sum(rowSums(move * out) * squared) / sum(squared^1.5)
  })
  greatest <- v[cbind(apply(abs(v), 2, which.max), seq_len(ncol(v)))]
  sign(ifelse(abs(along) >= sized, along, ifelse(abs(outward) > 1e-8, outward, greatest)))
}

#' Components with the signs of some turned
#' @noRd
turn_components <- function(pca, which) {
  for (part in c("x", "rotation", "direction")) pca[[part]][, which] <- -pca[[part]][, which]
  pca
}

#' The first components alone
#' @noRd
first_components <- function(pca, count) {
  own <- seq_len(count)
  for (part in c("sdev", "share")) pca[[part]] <- pca[[part]][own]
  for (part in c("x", "rotation", "direction")) pca[[part]] <- pca[[part]][, own, drop = FALSE]
  pca
}

#' Singular values, right vectors and scores of the centred co-ordinates, each point times the root
#' of its weight
#' @return List: `d`, `v` (d k x r), `scores` (n x r), `total` (sum of all squares).
#' @noRd
shape_svd <- function(aligned, weights, tolerance, most) UseMethod("shape_svd")

shape_svd.aligned <- function(aligned, weights, tolerance, most) {
  y <- shape_rows(aligned, sqrt(weights))
  parts <- thin_svd(y, tolerance, most)
  c(parts, list(scores = if (length(parts$d)) y %*% parts$v, total = sum(squares_by_row(y))))
}

#' Singular values and right vectors of a matrix by the smaller of its two cross-products, or the
#' greatest ones by Lanczos' method
#' @param most How many; `NULL`: all.
#' @param share Share of the smaller side, up to which those asked for are found by Lanczos' method.
#' @noRd
thin_svd <- function(x, tolerance, most = NULL, share = 0.1) {
  side <- min(dim(x))
  few <- !is.null(most) && most <= share * side
  wide <- ncol(x) > nrow(x)
  if (few) {
    parts <- RSpectra::svds(x, most, nu = 0, opts = list(ncv = lanczos_vectors(most, side)))
    parts <- list(values = parts$d^2, v = parts$v)
  } else {
    parts <- symmetric_parts(if (wide) tcrossprod(x) else crossprod(x))
  }
  keep <- kept_components(parts$values, tolerance, nrow(x), most)
  d <- sqrt(parts$values[keep])
  if (few) return(list(d = d, v = parts$v[, keep, drop = FALSE]))
  u <- parts$vectors[, keep, drop = FALSE]
  list(d = d, v = if (wide) crossprod(x, u) / rep(d, each = ncol(x)) else u)
}

#' Eigenvalues and eigenvectors of a matrix of inner products, the greatest alone where few are
#' asked for
#' @param tolerance Of Lanczos' method, as a share of an eigenvalue.
#' @noRd
symmetric_parts <- function(x, most = NULL, share = 0.1, tolerance = 1e-14) {
  if (is.null(most) || most > share * nrow(x)) return(eigen(x, symmetric = TRUE))
  RSpectra::eigs_sym(x, most, opts = list(ncv = lanczos_vectors(most, nrow(x)), tol = tolerance))
}

#' How many vectors Lanczos' method holds: with few of them it begins anew too often
#' @noRd
lanczos_vectors <- function(most, side, least = 30) min(side, max(least, 2 * most + 1))

#' Which components are kept: no more than were asked for, and than there can be
#' @noRd
kept_components <- function(values, tolerance, n, most) {
  utils::head(which(values > max(tolerance * values[1], 0)), min(n - 1, most))
}

#' @rdname shape_pca
#' @param x A `shape_pca`.
#' @template as-data-frame
#' @export
as.data.frame.shape_pca <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  data.frame(component = names_of_components(x), sd = x$sdev, share = x$share,
             cumulative = cumsum(x$share))
}

names_of_components <- function(pca) colnames(pca$x)

#' @export
print.shape_pca <- function(x, most = 6, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  printed(x, {
    cat("<shape_pca> ", amount(nrow(x$x), "specimen"), ", ", nrow(x$mean), " points (", x$level,
        "), ",
        amount(length(x$sdev), "component"), if (diff(range(x$weights)) > 0) ", weighted", "\n",
        sep = "")
    shown <- utils::head(as.data.frame(x), most)
    text <- sprintf("  %-5s sd %-8.3g %5.1f %% of variance, %5.1f %% so far", shown$component,
                    shown$sd, 100 * shown$share,
                    100 * shown$cumulative)
    cat(text, sep = "\n")
    invisible(x)
  })
}

#' Shapes along principal components
#'
#' Gives the shapes at chosen distances from the mean along one or several principal components.
#'
#' @param pca A `shape_pca`.
#' @param component Numbers of components.
#' @param sd Distance from the mean along each of these components, in standard deviations.
#' @param as "matrix" or "mesh".
#' @param size Factor on the aligned shape. 1: the size of the aligned shapes; `pca$size`: the mean
#'   size, in the unit of the meshes.
#' @return k x 3 matrix with the names of points, or a `mesh3d` with normals. Its vertices are the
#'   points that have triangles; attribute `row` gives their rows.
#' @section Errors: of class `crestline_error`: there is no such component, or there are no
#'   triangles for a mesh.
#' @template glossary
#' @seealso [shape_pca()]
#' @examples
#' square <- c(0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0)
#' shapes <- array(square + rnorm(120, sd = 0.05), c(4, 3, 10))
#' pca <- shape_pca(align(shapes))
#' shape_at(pca, component = 1:2, sd = c(2, -1))              # of unit size
#' shape_at(pca, component = 1, sd = 2, size = pca$size)      # of mean size
#' @export
shape_at <- function(pca, component = 1, sd = 2, as = c("matrix", "mesh"), size = 1) {
  check_given()
  check_class(pca, "shape_pca", "pca", "shape_pca()")
  as <- check_choice(as, c("matrix", "mesh"), "as")
  size <- check_number(size, "size", lower = 0, open = TRUE)
  check_component(component, pca)
  if (!is.numeric(sd) || !length(sd) %in% c(1, length(component)) || any(!is.finite(sd))) {
    crestline_abort(sprintf("`sd` is %s.", describe_value(sd)), "Give a number for each component.",
                    stage = "components")
  }
  added <- pca$direction[, component, drop = FALSE] %*% (sd * pca$sdev[component])
  shape <- size * (pca$mean + as.vector(added))
  if (as == "matrix") shape else points_mesh(shape, pca$triangles)
}

#' A mesh of the points that have triangles; those of a missing point (NA) are left out
#' @noRd
points_mesh <- function(xyz, triangles) {
  if (is.null(triangles) || !ncol(triangles) || ncol(xyz) != 3) {
    crestline_abort("these points have no triangles between them.",
                    "Use the level \"surface\" of a sample, or give align() `triangles`.",
                    stage = "components")
  }
  there <- is.finite(rowSums(xyz))
  whole <- there[triangles[1, ]] & there[triangles[2, ]] & there[triangles[3, ]]
  triangles <- triangles[, whole, drop = FALSE]
  if (!ncol(triangles)) {
    crestline_abort("every triangle has a point that is missing.",
                    "Look at the landmarks of the shape: quality() names what is missing.",
                    stage = "components")
  }
  row <- sort(unique(as.vector(triangles)))
  mesh <- rgl::mesh3d(vertices = unname(rbind(t(xyz[row, ]), 1)),
                      triangles = matrix(match(triangles, row), 3))
  structure(with_normals(mesh), row = row)
}

check_component <- function(component, pca) {
  if (!is.numeric(component) || !length(component) || !all(component %in% seq_along(pca$sdev))) {
    refuse_argument("component", component,
                    sprintf("There are components 1 to %d.", length(pca$sdev)))
  }
}
