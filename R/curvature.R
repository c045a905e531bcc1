#' Principal curvatures by local polynomial fits
#'
#' At every vertex a polynomial surface is fitted to the vertices within `radius`. Only vertices
#' that are connected to it by edges inside that ball count. A first fit refines the normal, whose
#' frame the second fit uses. The principal curvatures and directions are those of the fitted
#' surface (its Weingarten map) at the foot of the vertex.
#'
#' Constant and linear terms are kept: the surface need not pass through the noisy vertex. With
#' `order = "adaptive"` nested fits of order 2, 3 and 4 are combined. The Hessian of the higher
#' order counts as far as it differs from the lower one by more than noise does: \eqn{H = H_{lo} + w
#' (H_{hi} - H_{lo})}{H = H_lo + w (H_hi - H_lo)} with \eqn{w = \max(0, 1 - c \sigma^2 tr(V_{hi} -
#' V_{lo}) / |H_{hi} - H_{lo}|^2)}{w = max(0, 1 - c sigma^2 tr(V_hi - V_lo) / |H_hi - H_lo|^2)}.
#' \eqn{\sigma^2 V} is the covariance of a fit's Hessian.
#'
#' @param mesh A `mesh3d` with n vertices, normals outward, or a `specimen`.
#' @param radius Radius of the ball, in the unit of the mesh. On faces, 10 mm for broad
#'   features (the paper: 10 mm) and 5 mm for lips, nose and eyes (our choice).
#' @param order Order of the polynomial. `"adaptive"`: nested fits up to order 4, the most accurate.
#'   `"adaptive cubic"`: nested fits up to order 3, which are smoother; the default of
#'   [ridge_curve()]. `"quadratic"`, `"cubic"`, `"quartic"`: one plain polynomial. `"forced"`: the
#'   paper's \eqn{z = (a x^2 + 2 b x y + c y^2) / 2} through the vertex, in the frame of the average
#'   of the triangles' normals.
#' @param threads Number of threads, at least 1.
#' @param vertices Vertices at which curvature is estimated (indices, or n logical values). NULL:
#'   all.
#' @param shrinkage The factor c above, without unit; chosen on seven closed-form
#'   surfaces with 0.1 mm of noise. For values from 3 to 6 the error of k1 is 1.94 to 1.99 % of the
#'   root mean square curvedness; on clean surfaces it is 0.023 to 0.025 %.
#' @param points_per_term Least number of neighbours for each coefficient of a fit. With fewer
#'   neighbours the order is reduced.
#' @param one_sided Limit on the distance between the vertex and the centroid of its neighbourhood,
#'   as a share of the radius. Beyond it, as on a border, the order is 3 at most.
#' @param widen If there are too few points even for a quadratic, the ball grows by half at each
#'   step, to at most this multiple of `radius`.
#'
#' @return An object of class `curvature`, a list with
#'   * `k1`, `k2`: numeric n, principal curvatures, `k1 >= k2`, in 1 / unit;
#'     positive where the surface bends towards its normal (a valley has `k1 > 0`,
#'     a ridge `k2 < 0`);
#'   * `direction1`, `direction2`, `normal`: n x 3, unit vectors;
#'   * `order`: integer n, the highest order that has weight in the fit;
#'   * `sigma`: numeric n, residual standard deviation of the fit, in the unit;
#'   * `neighbours`: integer n, vertices in the ball;
#'   * `reason`: character n, the reason if a vertex could not be fitted, else `NA`.
#'
#'   At vertices that are not in `vertices` all values are `NA`, with that `reason`. Attributes are
#'   `radius`, `order`, and the `key` and `id` of the mesh. Functions that take a curvature refuse
#'   the curvature of another mesh.
#' @section Errors: of class `crestline_error`: `radius` is not a positive number, is larger than
#'   half the diagonal of the mesh, or is so small that no vertex can be fitted.
#' @section Warnings: of class `crestline_wide_radius`: `radius` exceeds 0.2 of the size of the
#'   mesh. It is most likely in another unit.
#' @template glossary
#' @templateVar where section 2
#' @template paper
#' @examples
#' data(humface, package = "Rvcg")
#' curved <- curvature(humface, radius = 10, vertices = 1:100)
#' curved
#' @export
curvature <- function(mesh, radius, order = "adaptive",
                      threads = getOption("crestline.threads", 1L), vertices = NULL,
                      shrinkage = 6, points_per_term = 1.5, one_sided = 0.2, widen = 2.25) {
  check_given()
  check_surface(mesh, "mesh")
  of <- mesh_of(mesh)
  whole <- mesh
  mesh <- as_mesh(mesh)
  settings <- fit_settings(radius, order, shrinkage, points_per_term, one_sided, widen)
  threads <- check_threads(threads)
  check_radius(radius, whole)
  warn_wide_radius(radius, whole)
  n <- ncol(mesh$vb)
  targets <- vertex_indices(vertices, n)
  out <- curvature_at(mesh_graph(passed_mesh(mesh, NULL)), targets, settings, threads)
  if (length(targets) > 0 && all(is.na(out$k1))) abort_radius(out$neighbours, radius)
  if (!is.null(vertices)) out <- fill_curvature(empty_curvature(n, "not asked for"), out, targets)
  new_curvature(out, radius, order, of)
}

#' @param fields List as [curvature()] says.
#' @param mesh As of [mesh_of()].
#' @noRd
new_curvature <- function(fields, radius, order, mesh) {
  structure(fields, radius = radius, order = order, key = mesh$key, id = mesh$id,
            class = "curvature")
}

#' Refuse a curvature whose parts do not belong together
#' @noRd
validate_curvature <- function(x) {
  n <- if (is.list(x)) length(unclass(x)$k1)
  rows <- function(name) is.numeric(x[[name]]) && identical(dim(x[[name]]), c(n, 3L))
  values <- function(name) is.numeric(x[[name]]) && length(x[[name]]) == n
  right <- !is.null(n) && all(vapply(c("k1", "k2", "sigma"), values, NA)) &&
    all(vapply(c("direction1", "direction2", "normal"), rows, NA))
  if (right) return(invisible(x))
  crestline_abort("the curvature lacks values or directions of some of its vertices.",
                  "Give what curvature() returns, whole.", stage = "curvature", id = attr(x, "id"),
                  call = NULL)
}

#' Refuse the curvature of another mesh
#'
#' @param mesh The specimen or mesh that it is to be used with.
#' @noRd
check_curvature_on <- function(curvature, mesh) {
  check_class(curvature, "curvature", "curvature", "curvature()")
  check_same_mesh(curvature, mesh, "`curvature`")
  n <- ncol(as_mesh(mesh)$vb)
  if (length(curvature$k1) == n) return(invisible(curvature))
  crestline_abort(sprintf("`curvature` has %d values for %d vertices.", length(curvature$k1), n),
                  "Give what curvature() returns, whole.", stage = "curvature",
                  id = mesh_of(mesh)$id,
                  class = "crestline_wrong_mesh", call = NULL)
}

#' @exportS3Method
validate.curvature <- function(x) validate_curvature(x)

#' Curvature at some vertices, in wider balls where the radius holds too few points
#'
#' @param graph As of [mesh_graph()].
#' @param vertices Indices.
#' @param settings As of [fit_settings()].
#' @return List as [curvature()]'s with entries for these vertices only.
#' @noRd
curvature_at <- function(graph, vertices, settings, threads) {
  out <- empty_curvature(length(vertices))
  radius <- settings$radius
  todo <- seq_along(vertices)
  while (length(todo) > 0 && settings$radius <= settings$widen * radius) {
    found <- cpp_curvature(graph, vertices[todo], settings, threads)
    fitted <- !is.na(found$k1)
    found$order[!fitted] <- NA_integer_
    out <- fill_curvature(out, found, todo)
    todo <- todo[!fitted]
    settings$radius <- settings$radius * settings$growth
  }
  out$reason[todo] <- ifelse(
    out$neighbours[todo] < settings$points_per_term * 6,
    "too few connected points within the radius", "points nearly in a line, or no normal"
  )
  out
}

#' Curvature at vertices, estimated when it is first asked for and then kept
#'
#' @param settings As of [fit_settings()].
#' @return Function of vertices (indices): list of `k1`, `k2`, `direction1`, `direction2`, `normal`,
#'   `sigma`, with an entry for each of them; NA for vertices that the mesh does not have (those of
#'   bridges).
#' @noRd
curvature_source <- function(mesh, settings, threads) {
  force(threads)
  passed <- passed_mesh(mesh, NULL)
  row <- integer(ncol(mesh$vb))
  # All numbers of a vertex in a row, with room for more, so that little is copied when some come.
  known <- matrix(NA_real_, 0, 12)
  kept <- 0
  function(vertices) {
    new <- unique(vertices[which(row[vertices] == 0)])
    if (length(new)) {
      found <- curvature_at(mesh_graph(passed), new, settings, threads)
      if (all(is.na(found$k1)) && all(is.na(known[, 1]))) {
        abort_radius(found$neighbours, settings$radius)
      }
      at <- kept + seq_along(new)
      kept <<- kept + length(new)
      if (kept > nrow(known)) {
        known <<- rbind(known, matrix(NA_real_, max(length(new), nrow(known)), 12))
      }
      known[at, ] <<- do.call(cbind, curvature_rows(found, seq_along(new)))
      row[new] <<- at
    }
    at <- row[vertices]
    vectors <- function(first) known[at, first + 0:2, drop = FALSE]
    list(k1 = known[at, 1], k2 = known[at, 2], direction1 = vectors(3), direction2 = vectors(6),
         normal = vectors(9), sigma = known[at, 12])
  }
}

#' The rows of a curvature that a curve needs
#' @noRd
curvature_rows <- function(curvature, at) {
  lapply(curvature[c("k1", "k2", "direction1", "direction2", "normal", "sigma")],
         function(x) if (is.matrix(x)) x[at, , drop = FALSE] else x[at])
}

empty_curvature <- function(n, reason = NA_character_) {
  blank <- rep(NA_real_, n)
  vectors <- matrix(NA_real_, n, 3)
  list(k1 = blank, k2 = blank, direction1 = vectors, direction2 = vectors, normal = vectors,
       order = rep(NA_integer_, n), sigma = blank, neighbours = rep(NA_integer_, n),
       reason = rep(reason, n))
}

fill_curvature <- function(out, found, at) {
  for (name in names(found)) {
    if (is.matrix(found[[name]])) out[[name]][at, ] <- found[[name]] else
      out[[name]][at] <- found[[name]]
  }
  out
}

# The lowest and the highest order of the nested fits.
fit_orders <- list(adaptive = c(2L, 4L), "adaptive cubic" = c(2L, 3L), quadratic = c(2L, 2L),
                   cubic = c(3L, 3L),
                   quartic = c(4L, 4L), forced = c(2L, 2L))

check_order <- function(order) check_choice(
  order, names(fit_orders), "order"
)

#' Settings of the local fit, checked
#' @noRd
fit_settings <- function(radius, order = "adaptive", shrinkage = 6, points_per_term = 1.5,
                         one_sided = 0.2, widen = 2.25) {
  kernel_settings(
    check_number(radius, "radius", lower = 0, open = TRUE), check_order(order),
    check_number(shrinkage, "shrinkage", lower = 0),
    check_number(points_per_term, "points_per_term", lower = 1, upper = 1000),
    check_number(one_sided, "one_sided", lower = 0), check_number(widen, "widen", lower = 1)
  )
}

#' Settings of the local fit in the form of the kernel
#' @noRd
kernel_settings <- function(radius, order, shrinkage = 6, points_per_term = 1.5, one_sided = 0.2,
                            widen = 2.25, growth = 1.5) {
  orders <- fit_orders[[order]]
  list(radius = radius, lowest = orders[1], highest = orders[2], forced = order == "forced",
       shrinkage = shrinkage, points_per_term = points_per_term, one_sided = one_sided,
       widen = widen, growth = growth)
}

vertex_indices <- function(vertices, n) {
  if (is.null(vertices)) return(seq_len(n))
  if (is.logical(vertices) && length(vertices) == n && !anyNA(vertices)) vertices <- which(vertices)
  if (!is.numeric(vertices) || !is.null(dim(vertices)) || anyNA(vertices) ||
      any(vertices < 1 | vertices > n)) {
    crestline_abort(sprintf("`vertices` is %s.", describe_value(vertices)),
                    sprintf("Give indices from 1 to %d, or %d logical values.", n, n),
                    stage = "curvature")
  }
  as.integer(vertices)
}

#' A ball as large as the object holds no local shape: most likely another unit
#' @noRd
check_radius <- function(radius, mesh) {
  size <- if (inherits(mesh, "specimen")) specimen_size(mesh) else mesh_diagonal(mesh)
  if (radius > size / 2) {
    crestline_abort(sprintf("a ball of radius %.4g is as large as the mesh, whose size is %.4g.",
                            radius, size),
                    paste("Give `radius` in the unit of the mesh (is the mesh in metres or",
                          "centimetres?)."),
                    stage = "curvature")
  }
}

#' Warn of a radius, or a reach, that is a great part of the mesh: most likely of another unit
#'
#' @param share Greatest radius, as a share of the object's size: on whole faces 10 mm are 0.03 to
#'   0.04 of it, and in a mesh in cm ten times that.
#' @noRd
warn_wide_radius <- function(radius, mesh, name = "radius", share = 0.2) {
  size <- if (inherits(mesh, "specimen")) specimen_size(mesh) else mesh_diagonal(mesh)
  if (radius <= share * size) return(invisible())
  crestline_warn(sprintf("`%s` is %.4g, which is %.2g times the size of the mesh, %.4g.", name,
                         radius, radius / size, size),
                 "Is it in the unit of the mesh? Read the specimen with `rescale` (10: cm to mm).",
                 stage = "curvature", id = mesh_of(mesh)$id, class = "crestline_wide_radius")
}

abort_radius <- function(neighbours, radius) {
  crestline_abort(
    sprintf(paste("no vertex could be fitted within %.3g of it: the balls hold %.0f vertices in",
                  "the median."),
            radius, stats::median(neighbours)),
    "Give a larger `radius`, in the unit of the mesh: several times the spacing of its vertices.",
    stage = "curvature"
  )
}

#' @export
print.curvature <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    fitted <- !is.na(x$k1)
    cat(sprintf("<curvature> %s, at %d of %d vertices, radius %g\n", attr(x, "order"), sum(fitted),
                length(fitted), attr(x, "radius")))
    if (any(fitted)) {
      shares <- stats::quantile(x$neighbours[fitted], c(0, 0.5, 1), names = FALSE)
      cat(sprintf("  k1 %s\n  k2 %s\n", spread(x$k1), spread(x$k2)))
      cat(sprintf("  neighbours %.0f to %.0f, median %.0f; residual sd %.3g in the median\n",
                  shares[1], shares[3], shares[2], stats::median(x$sigma, na.rm = TRUE)))
    }
    missed <- table(x$reason[!fitted])
    for (why in names(missed)) cat(sprintf("  %d without: %s\n", missed[[why]], why))
    invisible(x)
  })
}

spread <- function(x) {
  q <- stats::quantile(x, c(0.05, 0.5, 0.95), na.rm = TRUE, names = FALSE)
  sprintf("%.3g [%.3g, %.3g] (median, 5 and 95 %%)", q[2], q[1], q[3])
}

#' @export
as.data.frame.curvature <- function(x, ...) {
  check_method_dots(...)
  vectors <- c("direction1", "direction2", "normal")
  wide <- lapply(vectors, function(name) {
    stats::setNames(as.data.frame(x[[name]]), paste0(name, c("_x", "_y", "_z")))
  })
  data.frame(vertex = seq_along(x$k1), k1 = x$k1, k2 = x$k2, wide, order = x$order,
             sigma = x$sigma, neighbours = x$neighbours, reason = x$reason)
}
