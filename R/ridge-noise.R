# The noise of a scanner, known from two scans of one subject.

#' Noise of a scanner, from two scans of one subject
#'
#' Noise and fine relief cannot be separated in one scan. Two scans of the same subject separate
#' them. The second scan is registered on the first by iterated closest points (point to plane). The
#' distances between the two surfaces along the normals give the standard deviation of the noise and
#' its correlation along the mesh. With [ridge_settings()]`(noise = )` standard errors follow that
#' noise through the local fits.
#'
#' The model of the noise has two parts: an independent error of each vertex, and an error that is
#' smooth in space. The smooth error has correlation \eqn{\exp(-d^2 / (2 range^2))}{exp(-d^2 / (2
#' range^2))} at distance d. Both scans are assumed to have the same noise. Expression and posture
#' are assumed equal: a change of the face counts as noise.
#'
#' @param first,second [specimen()]s or `mesh3d`s of one subject in one unit. If both are specimens
#'   with three or more landmarks in common, registration starts from these. Otherwise it starts
#'   from the scans as they lie.
#' @param near Places of `first` near which the scans are compared: k x 3 matrix, or data frame `x`,
#'   `y`, `z`, in the unit of the mesh. An example is `coords(fit_shape(first, scheme), "curves")`.
#'   `NULL`: the landmarks of `first`, or the whole mesh if it has none.
#' @param reach Vertices within this distance of `near` are compared, as a share of the largest
#'   extent of `near`.
#' @param direction Direction of the scanner's errors in the frame of `first`, three numbers, such
#'   as its line of sight. On a slope such an error moves the surface by less along its normal, and
#'   is correlated over a longer way. `NULL`: errors are along the normals.
#' @param settings Which vertices are compared, and when the registration ends, as of
#'   [noise_settings()].
#' @param ... Fields of [noise_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return Object of class `scan_noise`, a list:
#'   * `independent`, `smooth`: standard deviations of the two parts, in the unit of the mesh;
#'   * `range`: range of the correlation, in the unit of the mesh (0: no smooth part);
#'   * `sd`: standard deviation of both parts together, in the unit of the mesh;
#'   * `spread`: sampling covariance of the estimates of `independent`^2, `smooth`^2 (unit of the
#'     mesh to the fourth) and log(`range`), 3 x 3. It is large where the compared vertices hold few
#'     patches of smooth noise. Standard errors under this noise are widened for it, see
#'     [ridge_curve()];
#'   * `direction`: as given, of length 1, or NULL;
#'   * `covariance`: data frame by `lag` (unit of the mesh): covariance of the distances between the
#'     scans, and the `fitted` covariance;
#'   * `points`: number of vertices compared;
#'   * `converged`, `rounds`: of the registration.
#'
#'   Distances are measured along the normals of local fits. A registration takes part of smooth
#'   noise away; the fit accounts for that. On 216 pairs of simulated scans, noise along z and
#'   `direction` known, the mean of `sd` is 0.93 to 0.99 times the true value, for noise correlated
#'   over one to three spacings. The mean of `range` is 1.03 to 1.25 times. So small a scan has few
#'   patches of smooth noise; `spread` says how sure the values are. Without a `direction`, noise
#'   in depth comes out smaller on slopes, and with a longer range. Give places `near` the curves.
#'   A flat surface does not say how the scans lie along it, and the registration may slide.
#' @section Errors: of class `crestline_error`: fewer than 100 vertices can be compared, or the
#'   scans lie more than a mean edge length apart.
#' @seealso [ridge_settings()], [ridge_curve()]
#' @template glossary
#' @examples
#' scans <- lapply(1:2, function(seed) {
#'   simulate_ridge(a = 0.25, b = 1, noise = 0.01, correlation = 2, seed = seed)
#' })
#' noise <- scan_noise(scans[[1]], scans[[2]])
#' noise
#' curve <- ridge_curve(scans[[1]], "from", "to", "ridge", radius = 0.25, width = 0.4, n = 21,
#'                      settings = ridge_settings(noise = noise))
#' curve$se
#' @export
scan_noise <- function(first, second, near = NULL, reach = 0.5, direction = NULL,
                       settings = noise_settings(), ...) {
  check_given()
  check_surface(first, "first")
  check_surface(second, "second")
  check_number(reach, "reach", lower = 0, open = TRUE)
  direction <- check_direction(direction)
  check_class(settings, "noise_settings", "settings", "noise_settings()")
  settings <- settings_with_former(settings, "noise_settings", ...)
  marks <- list(first$landmarks, second$landmarks)
  near <- if (!is.null(near)) point_matrix(near, "near") else marks[[1]]
  scans <- list(walkable(first), walkable(second))
  compared <- compared_vertices(scans[[1]], near, reach, settings$points)
  if (nrow(compared$xyz) < 100) abort_few_compared(nrow(compared$xyz), scans[[1]]$id)
  shared <- intersect(rownames(marks[[1]]), rownames(marks[[2]]))
  both <- if (length(shared) >= 3) lapply(marks, function(x) x[shared, , drop = FALSE])
  laid <- laid_on(scans[[2]], compared, both, settings)
  if (sum(laid$kept) < 100) abort_few_compared(sum(laid$kept), scans[[1]]$id)
  xyz <- compared$xyz[laid$kept, ]
  flat <- flattened(xyz, direction)
  lagged <- lagged_covariance(flat, laid$distance[laid$kept], compared$edge,
                              settings$lags)
  left <- left_by_registration(xyz, compared$normal[laid$kept, ], lagged, compared$edge, direction)
  fitted <- fitted_noise(lagged, laid$weight, compared$edge, left)
  if (sqrt(lagged$covariance[1]) > compared$edge) {
    crestline_abort(sprintf("the scans lie %.3g apart, more than an edge: they are not registered.",
                            sqrt(lagged$covariance[1])),
                    "Give specimens with three landmarks in common, or lay one scan on the other.",
                    stage = "scan noise", id = scans[[1]]$id)
  }
  structure(c(fitted$noise, list(
              sd = sqrt(fitted$noise$independent^2 + fitted$noise$smooth^2),
              spread = fitted$spread, direction = direction,
              covariance = cbind(lagged, fitted = fitted$values), points = sum(laid$kept),
              converged = laid$converged, rounds = laid$rounds
            )),
            class = "scan_noise")
}

#' Settings of `scan_noise()`
#'
#' @param ... Settings by name; the others keep their defaults.
#' @param points Greatest number of vertices that are compared; the closest to `near` are taken.
#' @param trim Distances beyond this many median absolute deviations are left out, such as those at
#'   holes and hair.
#' @param lags Largest distance at which correlation is measured, in mean edge lengths.
#' @param rounds,tolerance Greatest number of rounds of the registration. It has converged when no
#'   point moves by more than `tolerance` times the extent.
#' @return List of class `noise_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @seealso [scan_noise()]
#' @template glossary
#' @examples
#' noise_settings(lags = 8)
#' @export
noise_settings <- function(..., points = 4000, trim = 5, lags = 12, rounds = 50,
                           tolerance = 1e-6) {
  new_settings("noise_settings", check_noise_settings, list(...))
}

check_noise_settings <- function(settings) {
  settings$points <- check_count(settings$points, "points", lower = 100)
  check_number(settings$trim, "trim", lower = 0, open = TRUE)
  check_number(settings$lags, "lags", lower = 3)
  settings$rounds <- check_count(settings$rounds, "rounds")
  check_number(settings$tolerance, "tolerance", lower = 0, open = TRUE)
  settings
}

#' @export
print.noise_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<noise_settings> of scan_noise()")
}

#' A unit vector, or NULL
#' @noRd
check_direction <- function(direction) {
  if (is.null(direction)) return(NULL)
  given <- is.numeric(direction) && length(direction) == 3 && all(is.finite(direction)) &&
    any(direction != 0)
  if (given) return(unit_vector(as.numeric(direction) / max(abs(direction))))
  crestline_abort(sprintf("`direction` is %s.", describe_value(direction)),
                  "Give the direction of the scanner's errors, three finite numbers, not all 0.",
                  stage = "arguments")
}

#' Places seen along a direction: n x 3, as they are without one
#' @noRd
flattened <- function(xyz, direction) {
  if (is.null(direction)) return(xyz)
  xyz - tcrossprod(xyz %*% direction, direction)
}

abort_few_compared <- function(count, id) {
  crestline_abort(sprintf("only %s of the first scan can be compared with the second.",
                          amount(count, "vertex", "vertices")),
                  paste("Give a larger `reach`, places `near` that both scans hold, or landmarks",
                        "on both."),
                  stage = "scan noise", id = id, call = NULL)
}

#' The vertices of a scan near some places: `xyz` and `normal` (n x 3), `edge` (their mean spacing),
#' `extent`
#'
#' The normals are those of local fits. Those of the triangles about a vertex lean with its own
#' error, and what is measured along them comes out too short.
#'
#' @param fits Radius of the local fits, in mean edges.
#' @noRd
compared_vertices <- function(scan, near, reach, points, fits = 5) {
  xyz <- t(scan$vb[1:3, , drop = FALSE])
  span <- function(x) max(apply(x, 2, function(column) diff(range(column, na.rm = TRUE))))
  extent <- span(if (is.null(near)) xyz else near)
  off <- if (is.null(near)) rep(0, nrow(xyz)) else
    sqrt(do.call(pmin, lapply(which(stats::complete.cases(near)), function(i) {
      rowSums(sweep(xyz, 2, near[i, ])^2)
    })))
  kept <- which(off <= reach * extent & seq_along(off) %in% scan$it)
  if (length(kept) > points) kept <- kept[order(off[kept])[seq_len(points)]]
  own <- matrix(scan$it %in% kept, 3)
  inside <- scan$it[, colSums(own) == 3, drop = FALSE]
  edge <- mean(row_lengths(xyz[inside[1, ], , drop = FALSE] - xyz[inside[2, ], , drop = FALSE]))
  if (length(kept) < 100) return(list(xyz = xyz[kept, , drop = FALSE]))
  settings <- kernel_settings(fits * edge, "quadratic")
  normal <- curvature_at(mesh_graph(scan$passed), kept, settings, 1L)$normal
  fitted <- !is.na(normal[, 1])
  list(xyz = xyz[kept[fitted], , drop = FALSE], normal = normal[fitted, , drop = FALSE],
       edge = edge, extent = extent)
}

#' The vertices of one scan laid on another by iterated closest points, point to plane
#'
#' @param both Landmarks of both, or NULL.
#' @return List: `distance` along the normals; `weight`, mean sum of squares of the closest places'
#'   weights in their triangles; `kept`, `converged`, `rounds`.
#' @noRd
laid_on <- function(scan, compared, both, settings) {
  xyz <- compared$xyz
  normal <- compared$normal
  move <- function(rotation, shift) {
    xyz <<- sweep(xyz %*% t(rotation), 2, shift, `+`)
    normal <<- normal %*% t(rotation)
  }
  if (!is.null(both)) {
    centre <- lapply(both, colMeans)
    rotation <- nearest_rotation(sweep(both[[1]], 2, centre[[1]]),
                                 sweep(both[[2]], 2, centre[[2]]))$rotation
    move(t(rotation), centre[[2]] - as.vector(t(rotation) %*% centre[[1]]))
  }
  converged <- FALSE
  round <- 0
  repeat {
    at <- surface_points(scan, xyz)
    distance <- rowSums((as.matrix(at[c("x", "y", "z")]) - xyz) * normal)
    kept <- not_astray(distance, settings$trim, compared$extent)
    if (converged || round == settings$rounds) break
    round <- round + 1
    middle <- colMeans(xyz)
    about <- sweep(xyz, 2, middle)
    design <- cbind(cross_rows(about, normal), normal)[kept, , drop = FALSE] /
      rep(c(rep(compared$extent, 3), rep(1, 3)), each = sum(kept))
    step <- MASS::ginv(crossprod(design)) %*% crossprod(design, distance[kept])
    turn <- step[1:3] / compared$extent
    rotation <- rotation_about(turn)
    before <- xyz
    move(rotation, middle + step[4:6] - as.vector(rotation %*% middle))
    converged <- max(abs(xyz - before)) <= settings$tolerance * compared$extent
  }
  at <- along_normals(scan, xyz, normal)
  distance <- rowSums((at - xyz) * normal)
  kept <- not_astray(distance, settings$trim, compared$extent)
  met <- surface_points(scan, at[kept, , drop = FALSE])
  list(distance = distance, weight = mean(met$w1^2 + met$w2^2 + met$w3^2), kept = kept,
       converged = converged, rounds = round)
}

#' Which distances are within `trim` median absolute deviations of their median
#' @noRd
not_astray <- function(distance, trim, extent) {
  centred <- abs(distance - stats::median(distance, na.rm = TRUE))
  !is.na(centred) & centred <= trim * stats::mad(distance, na.rm = TRUE) + 1e-12 * extent
}

#' Where the lines through places along their normals meet a scan, NA where they do not: n x 3
#'
#' The closest place of a rough surface is on a bump of it: distances to closest places are too
#' short.
#' @noRd
along_normals <- function(scan, xyz, normal) {
  rays <- structure(list(vb = rbind(t(xyz), 1), normals = rbind(t(normal), 1)), class = "mesh3d")
  surface <- structure(list(vb = rbind(scan$vb[1:3, ], 1), it = scan$it), class = "mesh3d")
  met <- Rvcg::vcgRaySearch(rays, surface, mindist = TRUE, threads = 1)
  at <- t(met$vb[1:3, ])
  at[met$quality != 1, ] <- NA
  at
}

#' Mean product of the distances of two vertices, by the vertices' lag
#'
#' @return Data frame: `lag` (mean within each bin of half an edge; 0: of one vertex), `covariance`,
#'   `pairs`.
#' @noRd
lagged_covariance <- function(xyz, distance, edge, lags, block = 500) {
  width <- edge / 2
  most <- ceiling(lags * edge / width)
  sums <- matrix(0, most, 3)
  for (rows in split(seq_along(distance), ceiling(seq_along(distance) / block))) {
    apart <- sqrt(pmax(outer(rowSums(xyz[rows, , drop = FALSE]^2), rowSums(xyz^2), `+`) -
                         2 * tcrossprod(xyz[rows, , drop = FALSE], xyz), 0))
    bin <- floor(apart / width) + 1
    bin[cbind(seq_along(rows), rows)] <- NA
    used <- which(bin <= most)
    product <- outer(distance[rows], distance)[used]
    found <- rowsum(cbind(1, product, apart[used]), bin[used])
    at <- as.integer(rownames(found))
    sums[at, ] <- sums[at, ] + found
  }
  sums <- sums[sums[, 1] > 0, , drop = FALSE]
  data.frame(lag = c(0, sums[, 3] / sums[, 1]),
             covariance = c(mean(distance^2), sums[, 2] / sums[, 1]),
             pairs = c(length(distance), sums[, 1]))
}

#' What registration leaves of the covariance of noise, by lag
#'
#' A rigid registration takes the part of the differences away that a rotation and a shift explain:
#' of smooth noise a large one. With P the projection on those six movements, a covariance C becomes
#' (I - P) C (I - P).
#'
#' @param xyz,normal n x 3, the vertices that were compared.
#' @param lagged As of [lagged_covariance()].
#' @param direction Of the errors, or NULL: along the normals. Errors in one direction count by its
#'   cosine with the normal, and are correlated by their distance seen along it.
#' @param most Number of vertices that stand for all.
#' @return List: `whole`, function of a range: the correlation exp(-d^2 / (2 range^2)) of these
#'   vertices, less what registration takes; `by_lag`, function of such a matrix: its mean at each
#'   lag, the lag 0 first, NA where no pair has it; `pairs`, the places of each lag's pairs in it;
#'   `single`, what is left of independent noise, as `whole`; `share`, its mean variance.
#' @noRd
left_by_registration <- function(xyz, normal, lagged, edge, direction = NULL, most = 400) {
  about <- sweep(xyz, 2, colMeans(xyz))
  design <- cbind(cross_rows(about, normal) / sqrt(mean(rowSums(about^2))), normal)
  rows <- order(xyz[, 1], xyz[, 2], xyz[, 3])
  rows <- rows[unique(round(seq(1, length(rows), length.out = most)))]
  parts <- svd(design[rows, ], nv = 0)
  rank <- sum(parts$d > 1e-8 * parts$d[1])
  moves <- parts$u[, seq_len(rank), drop = FALSE]
  apart <- as.matrix(stats::dist(flattened(xyz[rows, ], direction)))
  cosine <- if (is.null(direction)) rep(1, length(rows)) else drop(normal[rows, ] %*% direction)
  bin <- match(floor(apart / (edge / 2)), floor(lagged$lag[-1] / (edge / 2))) + 1
  bin[diag(nrow(apart)) == 1] <- 1
  pairs <- split(seq_along(bin), factor(bin, seq_len(nrow(lagged))))
  count <- lengths(pairs)
  used <- unlist(pairs, use.names = FALSE)
  rest <- function(whole) {
    moved <- whole %*% moves
    part <- tcrossprod(moves, moved)
    whole - part - t(part) + moves %*% tcrossprod(crossprod(moves, moved), moves)
  }
  by_lag <- function(matrix) {
    sums <- diff(c(0, cumsum(matrix[used])[cumsum(count)]))
    ifelse(count > 0, sums / count, NA_real_)
  }
  list(whole = function(range) rest(tcrossprod(cosine) * exp(-apart^2 / (2 * range^2))),
       by_lag = by_lag, pairs = pairs, single = rest(diag(cosine^2)),
       share = mean(cosine^2) * (1 - rank / nrow(xyz)))
}

#' Independent and smooth part of the noise of each scan
#'
#' The covariance of the differences of two scans is 2 smooth^2 exp(-lag^2 / (2 range^2)) less what
#' registration takes away, and at lag 0 (1 + weight) independent^2 besides: a closest place is a
#' mean of three vertices. Lags below `shortest` edges are left out, since closest places that near
#' share vertices; a range below one edge cannot be distinguished from independent noise.
#'
#' Least squares, then generalized least squares by the covariance of the lagged covariances under
#' that first fit (Genton 1998, Math. Geology 30, 323-345). Covariances of one scan go up and down
#' together, but their differences, which tell the range, are known well.
#'
#' @param weight As of [laid_on()].
#' @param left As of [left_by_registration()].
#' @param slack Added to the diagonal, as a share of its mean: the model is not exact.
#' @param ranges Number of ranges that are tried first.
#' @return List: `noise` (`independent`, `smooth`, `range`), `values` (fitted by lag), `spread` (as
#'   [scan_noise()] says).
#' @noRd
fitted_noise <- function(lagged, weight, edge, left, shortest = 2, slack = 0.01, ranges = 25) {
  zero <- lagged$lag == 0
  used <- which((zero | lagged$lag >= shortest * edge) & lengths(left$pairs) > 0)
  design <- function(log_range) {
    cbind(zero * (1 + weight) * left$share, 2 * left$by_lag(left$whole(exp(log_range))))
  }
  span <- log(c(edge, max(lagged$lag)))
  grid <- seq(span[1], span[2], length.out = ranges)
  designs <- lapply(grid, design)
  best <- function(factor) {
    fit <- function(design) {
      white <- function(x) backsolve(factor, x, transpose = TRUE)
      nonnegative_pair(white(design[used, ]), drop(white(lagged$covariance[used])))
    }
    off <- vapply(designs, function(design) fit(design)$off, 0)
    about <- grid[pmin(pmax(which.min(off) + c(-1, 1), 1), length(grid))]
    at <- stats::optimize(function(x) fit(design(x))$off, about, tol = 1e-3)$minimum
    levels <- sqrt(fit(design(at))$levels)
    list(independent = levels[1], smooth = levels[2], range = if (levels[2] > 0) exp(at) else 0)
  }
  forms <- function(noise) lag_forms(noise, weight, left)[used, used]
  noise <- best(diag(length(used)))
  factor <- forms(noise)
  factor <- if (any(factor != 0)) chol(factor + slack * mean(diag(factor)) * diag(length(used)))
  if (is.null(factor)) return(list(noise = noise, values = 0 * zero, spread = matrix(0, 3, 3)))
  noise <- best(factor)
  inner <- abs(log(noise$range) - mean(span)) < 0.499 * diff(span)
  slope <- noise_slope(noise, design, inner)
  values <- drop(slope$design %*% c(noise$independent, noise$smooth)^2)
  white <- backsolve(factor, slope$by[used, , drop = FALSE], transpose = TRUE)
  back <- MASS::ginv(white) %*% backsolve(factor, diag(length(used)), transpose = TRUE)
  spread <- back %*% forms(noise) %*% t(back)
  list(noise = noise, values = values, spread = spread)
}

#' Two factors, neither below 0, of the least sum of squares
#' @return List: `levels`, `off` (the sum of squares).
#' @noRd
nonnegative_pair <- function(design, values) {
  off <- function(levels) sum((values - design %*% levels)^2)
  both <- qr.coef(qr(design), values)
  if (!anyNA(both) && all(both >= 0)) return(list(levels = both, off = off(both)))
  alone <- pmax(0, colSums(design * values) / pmax(colSums(design^2), .Machine$double.xmin))
  single <- list(c(alone[1], 0), c(0, alone[2]))
  offs <- vapply(single, off, 0)
  list(levels = single[[which.min(offs)]], off = min(offs))
}

#' Derivative of the lagged covariances by independent^2, smooth^2 and log(range)
#'
#' @param design Function of log(range), lags x 2.
#' @param inner Whether the range is free, and not at its limit.
#' @return List: `design`, `by` (lags x 3; 0 for what is not there).
#' @noRd
noise_slope <- function(noise, design, inner, step = 0.01) {
  if (noise$smooth == 0) {
    at <- cbind(design(0)[, 1], 0)
    return(list(design = at, by = cbind(at, 0)))
  }
  at <- design(log(noise$range))
  wider <- design(log(noise$range) + step)[, 2] - design(log(noise$range) - step)[, 2]
  by <- cbind(at * rep(c(noise$independent > 0, TRUE), each = nrow(at)),
              inner * noise$smooth^2 * wider / (2 * step))
  list(design = at, by = by)
}

#' Covariance of the lagged covariances of two scans
#'
#' They are quadratic forms d' W d of normal distances d. With K the covariance of d, two of them
#' have the covariance 2 tr(W_k K W_l K) (Pardo-Iguzquiza and Dowd 2001, Math. Geology 33, 397-419).
#'
#' @param noise List: `independent`, `smooth`, `range`.
#' @return Lags x lags.
#' @noRd
lag_forms <- function(noise, weight, left) {
  covariance <- (1 + weight) * noise$independent^2 * left$single
  if (noise$smooth > 0) covariance <- covariance + 2 * noise$smooth^2 * left$whole(noise$range)
  n <- nrow(covariance)
  products <- vapply(left$pairs, function(pairs) {
    means <- Matrix::sparseMatrix((pairs - 1) %% n + 1, (pairs - 1) %/% n + 1,
                                  x = 1 / max(1, length(pairs)), dims = c(n, n))
    as.vector(means %*% covariance)
  }, numeric(n^2))
  turned <- as.vector(t(matrix(seq_len(n^2), n)))
  forms <- 2 * crossprod(products, products[turned, ])
  (forms + t(forms)) / 2
}

#' @export
print.scan_noise <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<scan_noise> from %d vertices of two scans: standard deviation %.3g\n",
                x$points, x$sd))
    cat(sprintf("  independent %.3g; smooth %.3g, correlated over %.3g\n", x$independent, x$smooth,
                x$range))
    cat(sprintf("  registration %s after %s\n", if (x$converged) "converged" else "NOT converged",
                amount(x$rounds, "round")))
    invisible(x)
  })
}

#' The setting `noise`: NA, or standard deviations and correlation length
#'
#' What [scan_noise()] measured has its sampling covariance as an attribute, `spread`.
#' @noRd
noise_setting <- function(noise) {
  spread <- attr(noise, "spread")
  direction <- attr(noise, "direction")
  if (inherits(noise, "scan_noise")) {
    spread <- noise$spread
    # Without it the noise would count as known exactly.
    if (is.null(spread)) {
      crestline_abort("`noise` has no `spread`: scan_noise() of a former version made it.",
                      "Measure it again with scan_noise().", stage = "arguments")
    }
    direction <- noise$direction
    noise <- unlist(noise[c("independent", "smooth", "range")])
  }
  if (length(noise) == 1 && is.na(noise)) return(NA)
  known <- is.numeric(noise) && length(noise) == 3 && all(is.finite(noise)) && all(noise >= 0)
  if (known) {
    return(structure(as.numeric(noise), names = c("independent", "smooth", "range"),
                     spread = spread, direction = direction))
  }
  crestline_abort(sprintf("`noise` is %s.", describe_value(noise)),
                  "Give what scan_noise() returns, or NA.", stage = "arguments")
}
