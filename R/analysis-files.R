# Alignment of a sample in files, and what statistics read of it: a block of specimens, or some
# points of all.

#' The points of a level in files, as [configurations()] gives those in memory
#'
#' @return List: `files`, `rows` (of the files' points), `names`, `reference`, `triangles`,
#'   `places`, `level`, `given` (number of points), `kept` (which of them are used).
#' @noRd
configurations_in_files <- function(sample, level, triangles) {
  points <- sample$points
  template <- sample$template
  reference <- NULL
  if (is.null(template)) {
    level <- if (is.character(level) && length(level) == 1) level else "points"
    rows <- seq_len(nrow(points))
    names <- places <- points$point
    if (is.null(triangles)) triangles <- sample$triangles
  } else {
    level <- check_choice(level, sample_levels, "level")
    whole <- level == "model"
    rows <- which(if (whole) !duplicated(points$place) else points$level == level)
    places <- points$place[rows]
    names <- if (whole) places else points$point[rows]
    if (level %in% c("surface", "model") && is.null(triangles)) {
      triangles <- model_triangles(template$scheme, whole)
    }
    reference <- level_places(template, level)
  }
  list(files = sample, rows = rows, names = names, reference = reference,
       triangles = check_triangles(triangles, length(rows)), places = places, level = level,
       given = length(rows), kept = seq_along(rows))
}

#' The configurations of a block, what they lack put where the spline from the mean takes it
#' @noRd
level_block <- function(given, i) {
  coords <- read_block(given$files, i, given$rows[given$kept])
  dimnames(coords)[[1]] <- given$names[given$kept]
  if (is.null(given$filled_from)) return(coords)
  with_spline_places(coords, given$filled_from, gaps(coords))
}

over_blocks <- function(files, f) lapply(seq_len(n_blocks(files)), f)

#' The same without points that are missing, or with what they are put in from, and with a reference
#' @return `given` with `missing` (data frame `id`, `point`, `action`), and perhaps `filled_from`
#'   (k x d: the mean from which missing points are put in).
#' @noRd
complete_in_files <- function(given, missing) {
  dim <- length(given$files$axes)
  gone <- do.call(rbind, over_blocks(given$files, function(i) {
    gap <- gaps(level_block(given, i))
    at <- which(gap, arr.ind = TRUE)
    data.frame(id = colnames(gap)[at[, 2]], point = rownames(gap)[at[, 1]])
  }))
  gone$action <- rep(c(estimate = "estimated", drop = "dropped", stop = "")[[missing]], nrow(gone))
  if (nrow(gone) && missing == "stop") abort_missing(gone)
  lacking <- tabulate(match(gone$point, given$names), length(given$names))
  lacking <- stats::setNames(lacking, given$names)
  nowhere <- lacking == length(given$files)
  if (missing == "estimate" && any(nowhere) && sum(!nowhere) > dim + 1) {
    tell_nowhere(given$names[nowhere])
    gone$action[gone$point %in% given$names[nowhere]] <- "dropped"
    given <- without_points(given, nowhere)
    lacking <- lacking[!nowhere]
  }
  if (any(lacking > 0)) {
    own <- gone$id[gone$point %in% names(lacking)]
    there <- length(lacking) - tabulate(match(own, given$files$ids), length(given$files))
    check_enough(lacking, stats::setNames(there, given$files$ids), dim, missing)
    given <- if (missing == "drop") without_points(given, lacking > 0) else
      filled_in_files(given, there)
  }
  given$missing <- gone
  if (is.null(given$reference) || anyNA(given$reference)) {
    given$reference <- unnamed_slice(level_block(given, 1), 1)
  }
  given
}

#' The mean from which missing points are put in: as [estimated()], a pass over the files a round
#' @param there Number of points of each specimen.
#' @noRd
filled_in_files <- function(given, there, tolerance = 1e-6, rounds = 50) {
  start <- given$reference
  if (is.null(start) || anyNA(start)) {
    whole <- which(there == length(given$kept))[1]
    if (is.na(whole)) {
      crestline_abort("no specimen has all points: there is nothing to put them in from.",
                      "Give missing = \"drop\", or leave out the worst specimens.",
                      stage = "align")
    }
    i <- given$files$block[whole]
    start <- unnamed_slice(level_block(given, i), match(whole, block_rows(given$files, i)))
  }
  known <- given$reference
  given$reference <- given$filled_from <- start
  fit <- mean_of_files(given, rep(1, length(given$kept)), 1L, tolerance, rounds, TRUE)
  if (!fit$converged) warn_alignment(rounds, utils::tail(fit$moved, 1))
  given$filled_from <- fit$mean
  given$reference <- if (is.null(known) || anyNA(known)) fit$mean else known
  given
}

#' Each configuration laid onto a mean
#' @param mean k x d, centred; of unit size where scaled.
#' @return List: `coords`, `size`.
#' @noRd
laid_block <- function(coords, mean, weight, scaling) {
  fit <- cpp_lay_onto(coords, dim(coords), weight, mean, scaling)
  list(coords = array(fit$coords, dim(coords), dimnames(coords)),
       size = stats::setNames(fit$size, dimnames(coords)[[3]]))
}

one_laid <- function(x, mean, weight, scaling) {
  laid_block(array(x, c(dim(x), 1)), mean, weight, scaling)$coords[, , 1]
}

#' The Procrustes mean, a pass over the files a round; as [fit_alignment()]
#' @param refilled Whether missing points are put in from each round's mean.
#' @return List: `mean` (k x d, in the pose of the reference), `moved`, `converged`.
#' @noRd
mean_of_files <- function(given, weight, scaling, tolerance, rounds, refilled = FALSE) {
  norm <- function(x) sqrt(sum(weight * x^2))
  mean <- start <- one_laid(given$reference, given$reference, weight, scaling)
  if (scaling > 0) mean <- start <- start / norm(start)
  moved <- numeric()
  for (round in seq_len(rounds)) {
    total <- 0 * mean
    for (i in seq_len(n_blocks(given$files))) {
      laid <- laid_block(level_block(given, i), mean, weight, scaling)
      check_extent(laid$size)
      total <- total + rowSums(laid$coords, dims = 2)
    }
    after <- if (scaling > 0) total / norm(total) else total / length(given$files)
    moved[round] <- max(abs(after - mean)) / norm(after)
    mean <- unname(after)
    if (!is.null(given$filled_from) && refilled) given$filled_from <- mean
    if (moved[round] <= tolerance) break
  }
  mean <- one_laid(mean, start, weight, 0L)
  list(mean = mean, moved = moved, converged = moved[length(moved)] <= tolerance)
}

#' Weights of the points; areas on the mean of equal weights
#' @noRd
weights_in_files <- function(weights, given, tolerance = 1e-6, rounds = 100) {
  if (!identical(weights, "area") || is.null(given$triangles)) {
    return(point_weights(weights, given))
  }
  points <- seq_along(given$kept)
  mean <- mean_of_files(given, rep(1, length(points)), 1L, tolerance, rounds)$mean
  point_weights(point_areas(mean, given$triangles), list(given = length(points), kept = points))
}

aligned_of.sample_files <- function(sample, level, triangles, settings, limits, folder) {
  need_parquet()
  if (length(sample) < 2) {
    crestline_abort("there is one specimen only.", "Give two or more.", stage = "align")
  }
  scaling <- check_scaling(settings$scale)
  given <- configurations_in_files(sample, level, triangles)
  given <- complete_in_files(given, settings$missing)
  weight <- weights_in_files(settings$weights, given)
  if (is.numeric(settings$weights)) settings$weights <- settings$weights[given$kept]
  fit <- mean_of_files(given, weight, scaling, settings$tolerance, settings$rounds)
  if (!fit$converged) warn_alignment(settings$rounds, utils::tail(fit$moved, 1))
  dimnames(fit$mean) <- list(given$names[given$kept], sample$axes)
  folder <- empty_sample_folder(if (is.null(folder)) tempfile("aligned-") else folder)
  tangent <- settings$tangent && scaling > 0
  made <- write_aligned(given, fit$mean, weight, scaling, tangent, folder)
  aligned <- structure(
    list(), files = made$files, center = made$center, mean = fit$mean, size = made$size,
    weights = weight, places = given$places, scale = settings$scale, tangent = tangent,
    level = given$level, missing = given$missing, moved = fit$moved, triangles = given$triangles,
    settings = settings, reference = given$reference,
    provenance = with_settings(sample$provenance, "align", settings), distance = made$distance,
    kept = new.env(parent = emptyenv()),
    class = c("aligned_files", "aligned")
  )
  warn_of_files(aligned, made$hash, limits)
}

#' Aligned points, a file for each of the sample's
#' @return List: `files` (of class `sample_files`), `center` (k x d, mean of all), `size`,
#'   `distance` (n, from the mean), `hash` (n, alike where two are the same).
#' @param alike As in [said_of_twins()].
#' @noRd
write_aligned <- function(given, mean, weight, scaling, tangent, folder, alike = 1e-9) {
  points <- data.frame(level = given$level, point = rownames(mean), place = given$places)
  digits <- alike * sqrt(sum(mean^2))
  each <- over_blocks(given$files, function(i) {
    laid <- laid_block(level_block(given, i), unname(mean), weight, scaling)
    coords <- if (tangent) tangent_projection(laid$coords, mean, weight) else laid$coords
    write_block(coords, points, folder, i)
    off <- matrix(coords - as.vector(mean), length(mean))
    list(size = laid$size, total = rowSums(coords, dims = 2),
         distance = sqrt(colSums(off^2 * weight)),
         hash = apply(round(off / digits) + 0, 2, rlang::hash))
  })
  joined <- function(what) unlist(lapply(each, `[[`, what))
  head <- list(ids = given$files$ids, block = given$files$block, points = points,
               axes = given$files$axes, provenance = given$files$provenance)
  write_sample_head(head, folder)
  list(files = open_sample(folder), size = joined("size"), distance = joined("distance"),
       center = Reduce(`+`, lapply(each, `[[`, "total")) / length(given$files),
       hash = joined("hash"))
}

#' An alignment in files, after a warning of each doubt about it
#' @noRd
warn_of_files <- function(aligned, hash, limits, floor = 0.15) {
  distance <- attr(aligned, "distance")
  ids <- names(aligned)
  twins <- Filter(function(same) length(same) > 1, split(ids, hash))
  middle <- stats::median(distance)
  score <- (distance - middle) / max(stats::mad(distance), floor * middle)
  far <- if (length(ids) >= limits$fewest) which(score > limits$far)
  said <- c(
    if (length(twins) && length(unique(hash)) > 1) {
      list(twin = sprintf("the same shape under two names: %s.",
                          shorten(vapply(twins, paste, "", collapse = " and "), 5)))
    },
    said_of_sizes(aligned, limits), said_of_gaps(aligned, limits),
    if (length(far)) {
      named <- sprintf("%s (%.3g times as far)", ids[far], distance[far] / middle)
      list(far = sprintf("far from the others: %s.", shorten(named)))
    }
  )
  warn_of_said(said, aligned)
}

refuse_in_files <- function(what, remedy) {
  crestline_abort(sprintf("the alignment is in files: %s.", what), remedy, stage = "align")
}

#' @export
names.aligned_files <- function(x) names(attr(x, "size"))

#' @export
length.aligned_files <- function(x) length(attr(x, "size"))

#' @export
as.list.aligned_files <- function(x, ...) {
  refuse_in_files("its co-ordinates are not read all at once",
                  "Align some of the specimens as an array for that.")
}

#' @export
`[.aligned_files` <- function(x, i, ...) {
  refuse_in_files("it has no parts", "Write the files of these specimens, and align them.")
}

#' @export
`$<-.aligned_files` <- function(x, name, value) {
  refuse_in_files("its fields cannot be set", "Align the sample anew.")
}

#' @export
`names<-.aligned_files` <- function(x, value) {
  refuse_in_files("its names cannot be set", "Write the files with other names.")
}

#' @export
c.aligned_files <- function(...) {
  refuse_in_files("it cannot be joined", "Write the files of all specimens, and align them.")
}

#' @export
as.data.frame.aligned_files <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  ids <- names(x)
  data.frame(id = ids, size = unname(x$size), distance = unname(attr(x, "distance")),
             missing = tabulate(match(x$missing$id, ids), length(ids)))
}

#' @exportS3Method
validate.aligned_files <- function(x) {
  files <- attr(x, "files")
  right <- inherits(files, "sample_files") && identical(names(files), names(x)) &&
    nrow(files$points) == nrow(attr(x, "mean")) && all(file.exists(block_files(files)))
  if (right) return(invisible(x))
  crestline_abort("the files of the alignment are not there any more.",
                  "Align the sample anew; `dir` of align_settings() keeps the files.",
                  stage = "align", call = NULL)
}

columns_of_points.aligned_files <- function(aligned, rows, factor = 1) {
  files <- attr(aligned, "files")
  center <- attr(aligned, "center")
  by <- rep_len(as.double(factor), length(rows))
  each <- lapply(files$axes, function(axis) matrix(0, length(aligned), length(rows)))
  for (i in seq_len(n_blocks(files))) {
    own <- block_rows(files, i)
    coords <- read_block(files, i, rows)
    for (d in seq_along(each)) {
      off <- (matrix(coords[, d, ], length(rows)) - center[rows, d]) * by
      each[[d]][own, ] <- t(off)
    }
  }
  each
}

weighted_shape.aligned_files <- function(aligned, weight) {
  files <- attr(aligned, "files")
  sums <- over_blocks(files, function(i) {
    matrix(read_block(files, i), length(aligned$mean)) %*% weight[block_rows(files, i)]
  })
  array(Reduce(`+`, sums), dim(aligned$mean), dimnames(aligned$mean))
}

#' A block's centred rows, each point times a factor
#' @noRd
centred_block <- function(aligned, i, factor) {
  flat <- matrix(read_block(attr(aligned, "files"), i), length(aligned$mean))
  t((flat - as.vector(attr(aligned, "center"))) * rep(factor, ncol(aligned$mean)))
}

#' Inner products of the specimens, or products of the co-ordinates
#' @noRd
shape_products <- function(aligned, weights, wide) {
  if (wide) return(over_points(aligned, tcrossprod, weights))
  products <- 0
  for (i in seq_len(n_blocks(attr(aligned, "files")))) {
    products <- products + crossprod(centred_block(aligned, i, sqrt(weights)))
  }
  products
}

shape_svd.aligned_files <- function(aligned, weights, tolerance, most) {
  files <- attr(aligned, "files")
  root <- sqrt(weights)
  wide <- length(aligned) <= length(aligned$mean)
  # Components and tests of one alignment need the same products, which take a pass each.
  products <- kept(list(kept = attr(aligned, "kept")), weights, function() {
    shape_products(aligned, weights, wide)
  })
  parts <- symmetric_parts(products, most)
  keep <- kept_components(parts$values, tolerance, length(aligned), most)
  d <- sqrt(parts$values[keep])
  u <- parts$vectors[, keep, drop = FALSE]
  if (wide) {
    scores <- u * rep(d, each = nrow(u))
    v <- 0 * tcrossprod(rep(0, length(aligned$mean)), d)
    for (rows in point_chunks(aligned)) {
      each <- columns_of_points(aligned, rows, root[rows])
      for (axis in seq_along(each)) {
        v[(axis - 1) * nrow(aligned$mean) + rows, ] <- crossprod(each[[axis]], u)
      }
    }
    v <- v / rep(d, each = nrow(v))
  } else {
    v <- u
    scores <- do.call(rbind, over_blocks(files, function(i) centred_block(aligned, i, root) %*% v))
  }
  list(d = d, v = v, scores = scores, total = sum(diag(products)))
}
