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
#' @param points Greatest number of vertices that are compared; the closest to `near` are taken.
#' @param trim Distances beyond this many median absolute deviations are left out, such as those at
#'   holes and hair.
#' @param lags Largest distance at which correlation is measured, in mean edge lengths.
#' @param rounds,tolerance Greatest number of rounds of the registration. It has converged when no
#'   point moves by more than `tolerance` times the extent.
#' @return Object of class `scan_noise`, a list:
#'   * `independent`, `smooth`: standard deviations of the two parts, in the unit of the mesh;
#'   * `range`: range of the correlation, in the unit of the mesh (0: no smooth part);
#'   * `sd`: standard deviation of both parts together, in the unit of the mesh;
#'   * `df`: degrees of freedom of the variances of both parts (no unit). Those of the smooth part
#'     count the patches of smooth noise that the compared vertices hold. Standard errors under this
#'     noise are widened for few of them, see [ridge_curve()];
#'   * `covariance`: data frame by `lag` (unit of the mesh): covariance of the distances between the
#'     scans, and the `fitted` covariance;
#'   * `points`: number of vertices compared;
#'   * `converged`, `rounds`: of the registration.
#'
#'   Distances are measured along the normals of local fits. A registration takes part of smooth
#'   noise away; the fit accounts for that. On pairs of simulated scans, 40 spacings wide and nearly
#'   level, the median of `sd` is 0.9 to 1 times the true value, for independent noise and for noise
#'   correlated over one to three spacings. The median of `range` is 1 to 1.2 times. Of smooth noise
#'   so small a scan holds few patches: single values of `sd` are 0.7 to 2.3 times the truth. Where
#'   the noise is in one direction, as in depth, less of it is seen on slopes. Give places `near`
#'   the curves, and a small `reach`.
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
scan_noise <- function(first, second, near = NULL, reach = 0.5, points = 4000, trim = 5, lags = 12,
                       rounds = 50, tolerance = 1e-6) {
  check_given()
  check_surface(first, "first")
  check_surface(second, "second")
  check_number(reach, "reach", lower = 0, open = TRUE)
  points <- check_count(points, "points", lower = 100)
  check_number(trim, "trim", lower = 0, open = TRUE)
  check_number(lags, "lags", lower = 3)
  rounds <- check_count(rounds, "rounds")
  check_number(tolerance, "tolerance", lower = 0, open = TRUE)
  marks <- list(first$landmarks, second$landmarks)
  near <- if (!is.null(near)) point_matrix(near, "near") else marks[[1]]
  scans <- list(walkable(first), walkable(second))
  compared <- compared_vertices(scans[[1]], near, reach, points)
  if (nrow(compared$xyz) < 100) abort_few_compared(nrow(compared$xyz), scans[[1]]$id)
  shared <- intersect(rownames(marks[[1]]), rownames(marks[[2]]))
  both <- if (length(shared) >= 3) lapply(marks, function(x) x[shared, , drop = FALSE])
  laid <- laid_on(scans[[2]], compared, both, trim, rounds, tolerance)
  if (sum(laid$kept) < 100) abort_few_compared(sum(laid$kept), scans[[1]]$id)
  lagged <- lagged_covariance(
    compared$xyz[laid$kept, ], laid$distance[laid$kept], compared$edge, lags
  )
  left <- left_by_registration(compared$xyz[laid$kept, ], compared$normal[laid$kept, ], lagged,
                               compared$edge)
  fitted <- fitted_noise(lagged, laid$weight, compared$edge, left)
  if (sqrt(lagged$covariance[1]) > compared$edge) {
    crestline_abort(sprintf("the scans lie %.3g apart, more than an edge: they are not registered.",
                            sqrt(lagged$covariance[1])),
                    "Give specimens with three landmarks in common, or lay one scan on the other.",
                    stage = "scan noise", id = scans[[1]]$id)
  }
  structure(c(fitted$noise, list(
              sd = sqrt(fitted$noise$independent^2 + fitted$noise$smooth^2),
              df = noise_df(fitted$noise, left, sum(laid$kept)),
              covariance = cbind(lagged, fitted = fitted$values), points = sum(laid$kept),
              converged = laid$converged, rounds = laid$rounds
            )),
            class = "scan_noise")
}

#' Degrees of freedom of the variances of both parts
#'
#' @param left As of [left_by_registration()].
#' @param points Number of distances.
#' @noRd
noise_df <- function(noise, left, points) {
  c(independent = points * attr(left, "share"),
    smooth = if (noise$smooth > 0) attr(left, "df")(noise$range) else Inf)
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
  normal <- curvature_at(mesh_graph(scan), kept, kernel_settings(fits * edge, "quadratic"), 1L)$normal
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
laid_on <- function(scan, compared, both, trim, rounds, tolerance) {
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
    kept <- not_astray(distance, trim, compared$extent)
    if (converged || round == rounds) break
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
    converged <- max(abs(xyz - before)) <= tolerance * compared$extent
  }
  at <- along_normals(scan, xyz, normal)
  distance <- rowSums((at - xyz) * normal)
  kept <- not_astray(distance, trim, compared$extent)
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
#' @param most Number of vertices that stand for all.
#' @return Function of a range: for each lag the mean of what is left of the correlation
#'   exp(-d^2 / (2 range^2)), with the lag 0 first. Attributes: `share`, what is left of independent
#'   noise; `df`, function of a range: with C what is left, tr(C)^2 / tr(C^2), the degrees of
#'   freedom of a mean square of such noise (Satterthwaite 1946).
#' @noRd
left_by_registration <- function(xyz, normal, lagged, edge, most = 400) {
  about <- sweep(xyz, 2, colMeans(xyz))
  design <- cbind(cross_rows(about, normal) / sqrt(mean(rowSums(about^2))), normal)
  rows <- order(xyz[, 1], xyz[, 2], xyz[, 3])
  rows <- rows[unique(round(seq(1, length(rows), length.out = most)))]
  parts <- svd(design[rows, ], nv = 0)
  rank <- sum(parts$d > 1e-8 * parts$d[1])
  moves <- parts$u[, seq_len(rank), drop = FALSE]
  apart <- as.matrix(stats::dist(xyz[rows, ]))
  bin <- match(floor(apart / (edge / 2)), floor(lagged$lag[-1] / (edge / 2))) + 1
  bin[diag(nrow(apart)) == 1] <- 1
  used <- which(!is.na(bin))
  count <- tabulate(bin[used], nrow(lagged))
  left_of <- function(range) {
    whole <- exp(-apart^2 / (2 * range^2))
    moved <- whole %*% moves
    part <- tcrossprod(moves, moved)
    whole - part - t(part) + moves %*% tcrossprod(crossprod(moves, moved), moves)
  }
  left <- function(range) {
    sums <- rowsum(left_of(range)[used], bin[used])
    replace(rep(NA_real_, nrow(lagged)), as.integer(rownames(sums)), sums) / count
  }
  df <- function(range) {
    rest <- left_of(range)
    sum(diag(rest))^2 / sum(rest^2)
  }
  structure(left, share = 1 - rank / nrow(xyz), df = df)
}

#' Independent and smooth part of the noise of each scan
#'
#' The covariance of the differences of two scans is 2 smooth^2 exp(-lag^2 / (2 range^2)) less what
#' registration takes away, and at lag 0 (1 + weight) independent^2 besides: a closest place is a
#' mean of three vertices. Lags below `shortest` edges are left out, since closest places that near
#' share vertices; a range below one edge cannot be distinguished from independent noise.
#' @param left As of [left_by_registration()].
#' @return List: `noise` (`independent`, `smooth`, `range`), `values` (fitted by lag).
#' @noRd
fitted_noise <- function(lagged, weight, edge, left, shortest = 2) {
  zero <- lagged$lag == 0
  single <- zero * (1 + weight) * attr(left, "share")
  fit_at <- function(log_range) {
    shape <- left(exp(log_range))
    far <- lagged$lag >= shortest * edge & !is.na(shape)
    level <- function(used) {
      max(0, sum(shape[used] * lagged$covariance[used]) / sum(shape[used]^2)) / 2
    }
    smooth <- level(far)
    rest <- lagged$covariance[zero] - 2 * smooth * shape[zero]
    if (rest < 0) smooth <- level(far | zero)
    independent <- max(0, rest) / single[zero]
    values <- 2 * smooth * shape + single * independent
    list(independent = sqrt(independent), smooth = sqrt(smooth), values = values,
         off = sum((lagged$covariance - values)[far | zero]^2))
  }
  span <- log(c(edge, max(lagged$lag)))
  grid <- seq(span[1], span[2], length.out = 25)
  off <- vapply(grid, function(x) fit_at(x)$off, 0)
  about <- grid[pmin(pmax(which.min(off) + c(-1, 1), 1), length(grid))]
  best <- stats::optimize(function(x) fit_at(x)$off, about, tol = 1e-3)$minimum
  fit <- fit_at(best)
  range <- if (fit$smooth > 0) exp(best) else 0
  list(noise = list(independent = fit$independent, smooth = fit$smooth, range = range),
       values = fit$values)
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
#' What [scan_noise()] measured has its degrees of freedom as an attribute, `df`.
#' @noRd
noise_setting <- function(noise) {
  df <- attr(noise, "df")
  if (inherits(noise, "scan_noise")) {
    df <- noise$df
    noise <- unlist(noise[c("independent", "smooth", "range")])
  }
  if (length(noise) == 1 && is.na(noise)) return(NA)
  known <- is.numeric(noise) && length(noise) == 3 && all(is.finite(noise)) && all(noise >= 0)
  if (known) {
    return(structure(as.numeric(noise), names = c("independent", "smooth", "range"), df = df))
  }
  crestline_abort(sprintf("`noise` is %s.", describe_value(noise)),
                  "Give what scan_noise() returns, or NA.", stage = "arguments")
}
