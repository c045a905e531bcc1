# The bending energy of the thin-plate spline from a template to a configuration of the same points.

#' Bending energy of the deformation of a template
#'
#' The 3-D thin-plate spline (kernel `-|r|`) from the template to a configuration X has the bending
#' energy E(X) = tr X' B X, with B = Z (Z' (K + N) Z)^-1 Z'. K has -|r| between the template's
#' points. Z spans the complement of the affine functions on them. N is the diagonal matrix of the
#' nugget. B depends on the template only; it is computed once for all specimens. E is 0 for every
#' affine image of the template. It does not change if X is moved or rotated.
#'
#' Affine functions are counted by rank: points on a plane have three, points on a line two. A flat
#' template therefore has the energy of its own plane. With a nugget the spline smooths in place of
#' interpolating. The larger the nugget of a point, the less the spline follows that point.
#'
#' @param template k x 3 matrix, or a `shape`, whose points of `level` are used. Of coinciding
#'   points of a shape the first counts. Rows of NA are left out.
#' @param nugget One number, or one for each row of the template: in the unit of the template, 0 or
#'   more. It must not be 0 if points of a matrix coincide.
#' @param level Kind of points if `template` is a shape: "landmarks", "curves" or "surface".
#' @param tolerance Singular values below this share of the largest count as 0 when affine functions
#'   are counted.
#' @return A function of class `bending_energy`. `energy(x)` is the energy of a configuration, one
#'   number in the unit of the mesh. `x` is a k x 3 matrix (rows as in the template) or a shape of
#'   the same scheme. Points that are NA in `x` are left out of both template and energy.
#'   Attributes: `matrix` (B, k x k, 0 in rows that are left out, 1 / unit), `affine` (number of
#'   affine functions).
#' @section Errors: of class `crestline_error`: the template is not a matrix of numbers, or two of
#'   its points coincide without a nugget; the configuration has other points.
#' @template glossary
#' @templateVar where section 4 (the same integral up to a constant factor)
#' @template paper
#' @references Bookstein (1989)
#'   Principal warps, *IEEE Transactions on Pattern Analysis and Machine Intelligence* 11, 567-585;
#'   Gunz, Mitteroecker and Bookstein (2005) Semilandmarks in three dimensions.
#' @seealso [slide()]
#' @examples
#' corners <- as.matrix(expand.grid(x = 0:1, y = 0:1, z = 0:1))
#' energy <- bending_energy(corners)
#' energy(corners %*% matrix(rnorm(9), 3)) # affine: no energy
#' bent <- corners
#' bent[1, ] <- bent[1, ] + 0.1
#' energy(bent)
#' @export
bending_energy <- function(template, nugget = 0, level = "curves", tolerance = 1e-6) {
  check_given()
  nugget <- check_numbers(nugget, "nugget", lower = 0)
  tolerance <- check_number(tolerance, "tolerance", lower = 0)
  xyz <- energy_points(template, level)
  if (!is.numeric(nugget) || !length(nugget) %in% c(1, nrow(xyz)) || anyNA(nugget) ||
      any(nugget < 0)) {
    crestline_abort(sprintf("`nugget` is %s.", describe_value(nugget)),
                    sprintf("Give one number of at least 0, or %d of them.", nrow(xyz)),
                    stage = "arguments")
  }
  nugget <- rep_len(as.numeric(nugget), nrow(xyz))
  tolerance <- check_number(tolerance, "tolerance", 0, 1)
  full <- energy_matrix(xyz, nugget, tolerance)
  energy <- function(x) {
    x <- energy_points(x, level)
    if (nrow(x) != nrow(xyz)) {
      crestline_abort(sprintf("the configuration has %d points, the template %d.", nrow(x),
                              nrow(xyz)),
                      "Give the same points in the same order.", stage = "energy")
    }
    absent <- is.na(x[, 1]) & !is.na(xyz[, 1])
    b <- if (any(absent)) energy_matrix(replace(xyz, absent, NA), nugget, tolerance) else full
    quadratic_form(b, replace(x, is.na(xyz) | is.na(x), 0))
  }
  structure(energy, matrix = structure(full, affine = NULL), affine = attr(full, "affine"),
            class = c("bending_energy", "function"))
}

#' The points that an energy is taken of, k x 3
#'
#' Repeats of a place that a scheme defines more than once are NA.
#' @noRd
energy_points <- function(x, level, name = "template") {
  if (inherits(x, "shape")) {
    check_class(x, "shape", name, "fit_shape()")
    level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
    place <- x$scheme$points$place[x$scheme$points$level == level]
    return(replace(unname(coords(x, level)), duplicated(place), NA))
  }
  if (!is.matrix(x) || !is.numeric(x) || ncol(x) != 3) {
    refuse_argument(name, x, "Give a k x 3 matrix, or a shape.")
  }
  unname(x)
}

quadratic_form <- function(b, x) sum(x * (b %*% x))

#' The matrix B of the energy, k x k, 0 in the rows of points that are NA; attribute `affine`
#'
#' @param xyz k x 3.
#' @param nugget k.
#' @param kernel Function of distances, conditionally positive definite.
#' @noRd
energy_matrix <- function(xyz, nugget, tolerance, kernel = function(r) -r) {
  b <- matrix(0, nrow(xyz), nrow(xyz))
  there <- which(!is.na(xyz[, 1]))
  if (!length(there)) return(structure(b, affine = 0L))
  at <- xyz[there, , drop = FALSE]
  centred <- sweep(at, 2, colMeans(at))
  functions <- svd(cbind(1, centred / max(sqrt(mean(rowSums(centred^2))), .Machine$double.xmin)))
  affine <- sum(functions$d > tolerance * functions$d[1])
  if (length(there) > affine) {
    b[there, there] <- bending_matrix(
      at, nugget[there], functions$u[, seq_len(affine), drop = FALSE], kernel
    )
  }
  structure(b, affine = affine)
}

#' B where there is something to bend
#'
#' In the frame of a Householder basis whose first columns span the affine functions, K + N loses
#' its first rows and columns.
#' @noRd
bending_matrix <- function(xyz, nugget, functions, kernel) {
  frame <- qr(functions)
  affine <- seq_len(ncol(functions))
  full <- kernel(as.matrix(stats::dist(xyz))) + diag(nugget, nrow(xyz))
  inner <- qr.qty(frame, t(qr.qty(frame, full)))[-affine, -affine, drop = FALSE]
  root <- tryCatch(chol((inner + t(inner)) / 2), error = function(e) {
    crestline_abort("points of the template coincide.", "Leave one of them out, or give a nugget.",
                    stage = "energy",
                    call = NULL)
  })
  b <- matrix(0, nrow(xyz), nrow(xyz))
  b[-affine, -affine] <- chol2inv(root)
  b <- qr.qy(frame, t(qr.qy(frame, b)))
  (b + t(b)) / 2
}

#' @export
print.bending_energy <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    b <- attr(x, "matrix")
    cat(sprintf("<bending_energy> %d points, %d affine functions\n", sum(diag(b) != 0),
                attr(x, "affine")))
    invisible(x)
  })
}
