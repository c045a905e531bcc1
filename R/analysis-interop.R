# To geomorph, RRPP and Morpho, and back.

#' Hand a sample to geomorph, RRPP or Morpho
#'
#' Converts a sample for analyses of other packages, such as nested designs, pairwise comparisons,
#' allometry, phylogenies and modularity. None of these packages is needed for the conversion.
#'
#' * `as_geomorph()` makes the object of `geomorph::geomorph.data.frame()`, for `procD.lm(coords ~
#' size * sex, data = )`;
#' * `as_rrpp()` makes the object of `RRPP::rrpp.data.frame()`, with the co-ordinates as a matrix,
#'   for `lm.rrpp(coords ~ size * sex, data = )`;
#' * `as_morpho()` makes an object of the class of `Morpho::procSym()`, with the fields that
#'   Morpho's functions use;
#' * `as_aligned()` converts in the other direction.
#'
#' @param sample A `shape_sample`, an `aligned`, or a k x 3 x n array.
#' @param level Level of a `shape_sample`, as in [align()]. If it is not given, the landmarks are
#'   taken, with a message. In "curves" an end that several curves share is there once for each of
#'   them; `weights = "places"` counts it once, and "model" has each point once.
#' @param data Data frame of covariates with a row for each specimen, or `NULL`. Rows are matched to
#'   the specimens by a column of names (`id`, `specimen`, `subject`, `name`, `file`, `sample`,
#'   `scan` and the like, in upper or lower case) or by row names. Case, blanks and a file's
#'   extension are ignored. If neither the specimens nor the table have names, rows are taken in
#'   order, with a message.
#' @param ... Arguments of [align()]: `scale`, `weights`, `missing`.
#' @return `as_geomorph()`: list of class `geomorph.data.frame`: `coords` (k x 3 x n, aligned),
#'   `size` (n centroid sizes, in the unit of the meshes), and the columns of `data`.
#'
#'   `as_rrpp()`: list of class `rrpp.data.frame`: `coords`, `size`, and the columns of `data`.
#'   `coords` is an n x 3k matrix with a row for each specimen. Its columns are x, y, z of the first
#'   point, then of the second, as in `geomorph::two.d.array()`.
#'
#'   `as_morpho()`: list of class `nosymproc`: `size`, `rotated` (before the projection), `orpdata`
#'   (after it), `mshape`, `PCs`, `PCscores`, `eigenvalues`, `Variance`, `rho`.
#' @section Errors: of class `crestline_error`: `data` lacks a specimen, has two different rows for
#'   one, has no column of the specimens' names, or has a column `coords` or `size`.
#' @section Warnings: of class `crestline_alike_groups`: values of a column differ by blanks or case
#'   only.
#' @template glossary
#' @seealso [compare_groups()]; `vignette("interop")`
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 10), c(4, 3, 10))
#' shapes <- shapes + rnorm(120, sd = 0.05)
#' frame <- as_geomorph(shapes, data = data.frame(sex = rep(c("F", "M"), 5)))
#' str(frame)
#' as_aligned(frame)
#' @export
as_geomorph <- function(sample, level = c("landmarks", "curves", "surface", "model"), data = NULL,
                        ...) {
  check_given()
  check_dots(..., known = names(formals(align))[-(1:2)])
  if (inherits(sample, "aligned")) validate(sample)
  if (missing(level)) say_level(sample)
  aligned <- if (inherits(sample, "aligned")) sample else align(sample, level, ...)
  columns <- covariates(data, dimnames(aligned$coords)[[3]])
  structure(c(list(coords = aligned$coords, size = aligned$size), columns),
            class = "geomorph.data.frame")
}

#' @rdname as_geomorph
#' @export
as_rrpp <- function(sample, level = c("landmarks", "curves", "surface", "model"), data = NULL,
                    ...) {
  check_given()
  check_dots(..., known = names(formals(align))[-(1:2)])
  if (missing(level)) say_level(sample)
  frame <- as_geomorph(sample, level, data, ...)
  coords <- frame$coords
  flat <- matrix(aperm(coords, c(3, 2, 1)), dim(coords)[3])
  dimnames(flat) <- list(dimnames(coords)[[3]], as.vector(t(outer(
    dimnames(coords)[[1]], dimnames(coords)[[2]], paste
  ))))
  frame$coords <- flat
  structure(frame, class = "rrpp.data.frame")
}

#' @rdname as_geomorph
#' @export
as_morpho <- function(sample, level = c("landmarks", "curves", "surface", "model"), ...) {
  check_given()
  check_dots(..., known = names(formals(align))[-(1:2)])
  if (inherits(sample, "aligned")) validate(sample)
  if (missing(level)) say_level(sample)
  aligned <- if (inherits(sample, "aligned")) sample else align(sample, level, ...)
  pca <- shape_pca(aligned, weights = rep(1, nrow(aligned$mean)))
  variance <- cbind(eigenvalues = pca$sdev^2, "% Variance" = 100 * pca$share,
                    "Cumulative %" = 100 * cumsum(pca$share))
  rotated <- before_projection(aligned)
  cosine <- apply(rotated, 3,
                  function(one) sum(one * aligned$mean) / sqrt(sum(one^2) * sum(aligned$mean^2)))
  rho <- stats::setNames(acos(pmin(1, cosine)), names(aligned$size))
  structure(list(size = aligned$size, rotated = rotated, mshape = aligned$mean,
                 PCs = unname(pca$rotation),
                 PCscores = pca$x, eigenvalues = pca$sdev^2, Variance = variance,
                 orpdata = aligned$coords, rho = rho),
            class = "nosymproc", CSinit = !isFALSE(aligned$scale),
            scale = identical(aligned$scale, "full"),
            orp = aligned$tangent, sizeshape = FALSE)
}

#' @rdname as_geomorph
#' @param x A `geomorph.data.frame` (with `coords`), a value of `geomorph::gpagen()` or
#'   `Morpho::procSym()`, or a k x 3 x n array of aligned configurations.
#' @param size n centroid sizes; values with names are matched by name. `NULL`: the sizes in `x`
#'   (`size`, `Csize`), else the centroid sizes of the co-ordinates.
#' @param triangles As in [align()].
#' @return `as_aligned()`: an `aligned`, as of [align()]. The co-ordinates are neither rotated nor
#'   scaled.
#' @export
as_aligned <- function(x, size = NULL, level = "points", triangles = NULL) {
  check_given()
  level <- check_text(level, "level")
  coords <- if (inherits(x, "nosymproc")) x$orpdata else if (is.list(x)) x$coords else x
  coords <- named_array(check_array(coords, "x"))
  n <- dim(coords)[3]
  if (is.null(size) && is.list(x)) size <- if (is.null(x$size)) x$Csize else x$size
  own <- apply(coords, 3, function(one) sqrt(sum(sweep(one, 2, colMeans(one))^2)))
  if (is.null(size)) size <- own
  fits <- length(size) == n || !is.null(names(size))
  if (!is.numeric(size) || !fits || !all(is.finite(size) & size > 0)) {
    crestline_abort(sprintf("`size`, or that of `x`, is %s.", describe_value(size)),
                    sprintf("Give %d centroid sizes above 0.", n), stage = "align")
  }
  ids <- dimnames(coords)[[3]]
  if (!is.null(names(size)) && has_ids(ids)) size <- sizes_by_specimen(size, ids)
  spread <- function(s) diff(range(log(s)))
  scaled <- spread(own) < spread(size) / 2
  validate_aligned(new_aligned(
    provenance = made_with(), coords, apply(coords, 1:2, mean),
    stats::setNames(as.vector(size), dimnames(coords)[[3]]), rep(1, dim(coords)[1]),
    dimnames(coords)[[1]], scale = scaled, tangent = FALSE, level = level,
    triangles = check_triangles(triangles, dim(coords)[1])
  ))
}

sizes_by_specimen <- function(size, ids) {
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "align")
  by_specimen(size, ids, "size", fail)
}

#' Columns of covariates in the order of the specimens
#' @noRd
covariates <- function(data, ids) {
  if (is.null(data)) return(list())
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "arguments"
  )
  if (!is.data.frame(data)) {
    fail(sprintf("`data` is %s.", describe_value(data)), "Give a data frame.")
  }
  clash <- intersect(names(data), c("coords", "size"))
  if (length(clash)) {
    fail(sprintf("`data` has a column `%s`.", clash[1]),
         "Rename it: the sample's own has that name.")
  }
  data <- data[rows_of_specimens(data, ids, "data", fail), , drop = FALSE]
  for (name in names(data)) warn_alike_levels(data[[name]], name)
  as.list(data)
}

#' Values of a covariate that differ by blanks or case only make two groups of one
#' @noRd
warn_alike_levels <- function(x, name) {
  value <- if (is.factor(x)) levels(droplevels(x)) else if (is.character(x)) unique(x[!is.na(x)])
  if (length(value) >= length(x)) return(invisible())
  alike <- alike_levels(value)
  if (length(alike)) {
    crestline_warn(sprintf("`%s` has %s, which differ by blanks or case only.", name,
                           paste0("\"", alike, "\"", collapse = " and ")),
                   "Give them one name.", stage = "arguments", class = "crestline_alike_groups")
  }
}
