# Numbers of a shape in few bytes: places on a scan as a face and what its weights do not give by
# themselves, each value checked as it is read back before it is written.

from_planes <- function(bytes, size) as.vector(t(matrix(bytes, ncol = size)))

#' Doubles as they are
#' @noRd
pack_exact <- function(x) {
  none <- is.na(x)
  list(n = length(x), none = if (any(none)) pack_flags(none),
       bytes = as.vector(t(matrix(writeBin(x[!none], raw(), endian = "little"), 8))))
}

unpack_exact <- function(packed) {
  x <- rep(NA_real_, packed$n)
  none <- if (is.null(packed$none)) rep(FALSE, packed$n) else unpack_flags(packed$none, packed$n)
  x[!none] <- readBin(from_planes(packed$bytes, 8), "double", sum(!none), endian = "little")
  x
}

pack_flags <- function(x) packBits(c(x, rep(FALSE, -length(x) %% 8)), "raw")

unpack_flags <- function(packed, n) as.logical(rawToBits(packed))[seq_len(n)]

#' Doubles in five bytes each, to 2^-40 of their range: less than a nanometre on a face. Differences
#' of neighbours are stored
#' @param bits Bytes a value.
#' @noRd
pack_fixed <- function(x, bits = 5) {
  if (!length(x)) return(list(n = 0L))
  low <- min(x)
  span <- max(x) - low
  steps <- 256^bits - 1
  at <- if (span > 0) round((x - low) / span * steps) else x * 0
  step <- c(at[1], diff(at)) %% (steps + 1)
  bytes <- vapply(seq_len(bits) - 1, function(k) step %/% 256^k %% 256, x * 0)
  list(n = length(x), bits = bits, low = low, span = span, bytes = as.raw(bytes))
}

unpack_fixed <- function(packed) {
  if (!packed$n) return(numeric())
  whole <- 256^packed$bits
  bytes <- matrix(as.numeric(packed$bytes), packed$n)
  step <- drop(bytes %*% 256^(seq_len(packed$bits) - 1))
  # A step down is near the whole: with its sign, sums stay small enough to be exact.
  step <- ifelse(step > whole / 2, step - whole, step)
  packed$low + cumsum(step) %% whole / (whole - 1) * packed$span
}

#' Whole numbers, NA among them, as differences of neighbours
#' @noRd
pack_whole <- function(x) {
  none <- is.na(x)
  list(none = if (any(none)) pack_flags(none), n = length(x), x = diff(c(0L, x[!none])))
}

unpack_whole <- function(packed) {
  x <- rep(NA_integer_, packed$n)
  none <- if (is.null(packed$none)) rep(FALSE, packed$n) else unpack_flags(packed$none, packed$n)
  x[!none] <- as.integer(cumsum(packed$x))
  x
}

#' Weights of points on faces: of a point on an edge one, of one inside two, and which is zero
#' @param w Matrix of three columns.
#' @noRd
pack_weights <- function(w) {
  none <- is.na(w[, 1])
  w <- w[!none, , drop = FALSE]
  zero <- max.col(cbind(w == 0, 0.5), "first") %% 4
  inside <- zero == 0
  first <- w[cbind(seq_len(nrow(w)), ifelse(zero == 1, 2, 1))]
  list(none = if (any(none)) pack_flags(none), n = length(none), zero = as.raw(zero),
       first = pack_fixed(first), second = pack_fixed(w[inside, 2]))
}

unpack_weights <- function(packed) {
  zero <- as.integer(packed$zero)
  first <- unpack_fixed(packed$first)
  w <- matrix(0, length(zero), 3)
  w[cbind(seq_along(zero), ifelse(zero == 1, 2, 1))] <- first
  inside <- which(zero == 0)
  w[inside, 2] <- unpack_fixed(packed$second)
  w[inside, 3] <- 1 - w[inside, 1] - w[inside, 2]
  edge <- which(zero > 0)
  w[cbind(edge, ifelse(zero[edge] == 3, 2, 3))] <- 1 - first[edge]
  whole <- matrix(NA_real_, packed$n, 3)
  whole[if (is.null(packed$none)) TRUE else !unpack_flags(packed$none, packed$n), ] <- w
  whole
}

#' Places on a mesh
#' @param at Matrix with [mesh_columns].
#' @param exact Whether co-ordinates keep every bit.
#' @noRd
pack_places <- function(at, exact) {
  pack <- if (exact) pack_exact else pack_fixed
  list(exact = exact, xyz = lapply(1:3, function(k) pack(at[, k])),
       face = pack_whole(as.integer(at[, "face"])),
       weights = pack_weights(at[, c("w1", "w2", "w3"), drop = FALSE]))
}

unpack_places <- function(packed) {
  unpack <- if (packed$exact) unpack_exact else unpack_fixed
  at <- cbind(vapply(packed$xyz, unpack, numeric(packed$face$n)), unpack_whole(packed$face),
              unpack_weights(packed$weights))
  at <- matrix(at, ncol = 7)
  colnames(at) <- mesh_columns
  at
}

#' Points of a shape: those of a place once; level, part and point are the scheme's; further
#' numbers, such as standard errors, as they are
#' @noRd
pack_points <- function(points, scheme) {
  first <- !duplicated(scheme$points$place)
  at <- columns_of(points)[first, , drop = FALSE]
  more <- setdiff(names(points), c("level", "part", "point", mesh_columns))
  list(places = pack_places(at, exact = TRUE),
       more = lapply(points[more], function(x) pack_exact(as.numeric(x))))
}

unpack_points <- function(packed, scheme) {
  place <- scheme$points$place
  at <- unpack_places(packed$places)[match(place, unique(place)), , drop = FALSE]
  at <- as.data.frame(at, row.names = FALSE)
  at$face <- as.integer(at$face)
  cbind(scheme$points[c("level", "part", "point")], at,
        as.data.frame(lapply(packed$more, unpack_exact)))
}

#' Paths, in one pool of places: a path and its track share most of theirs
#' @param paths List of `mesh_path`s, some NULL.
#' @noRd
pack_paths <- function(paths) {
  there <- !vapply(paths, is.null, NA)
  at <- do.call(rbind, lapply(paths[there], columns_of))
  if (is.null(at)) return(list(n = length(paths), names = names(paths)))
  known <- paste(at[, "x"], at[, "y"], at[, "z"], at[, "face"])
  rows <- split(match(known, unique(known)), rep(seq_len(sum(there)), lengths_of(paths[there])))
  list(n = length(paths), names = names(paths), there = which(there),
       pool = pack_places(at[!duplicated(known), , drop = FALSE], exact = FALSE),
       rows = lapply(unname(rows), function(i) diff(c(0L, i))),
       about = lapply(paths[there], function(path) {
         # What a path is besides its places; the lengths along it only where they are not from
         # point
         # to point
         own <- attributes(path)
         xyz <- columns_of(path, c("x", "y", "z"))
         even <- c(0, cumsum(row_lengths(diff(xyz))))
         list(attributes = own[setdiff(names(own), "row.names")],
              s = if (max(abs(path$s - even)) > 1e-12 * max(even)) path$s)
       }))
}

lengths_of <- function(paths) vapply(paths, NROW, 0L)

unpack_paths <- function(packed) {
  paths <- stats::setNames(vector("list", packed$n), packed$names)
  if (is.null(packed$pool)) return(paths)
  pool <- unpack_places(packed$pool)
  paths[packed$there] <- Map(function(rows, about) {
    at <- pool[cumsum(rows), , drop = FALSE]
    s <- about$s
    if (is.null(s)) s <- c(0, cumsum(row_lengths(diff(at[, 1:3, drop = FALSE]))))
    path <- c(list(s = s), lapply(stats::setNames(nm = mesh_columns), function(k) at[, k]))
    path$face <- as.integer(path$face)
    attributes(path) <- c(about$attributes, list(row.names = seq_along(s)))
    path
  }, packed$rows, packed$about)
  paths
}

#' Whether what is read back is what was packed: all that is no number alike, numbers to a share of
#' the greatest of their kind
#' @noRd
read_alike <- function(a, b, rounding = 1e-9) {
  if (is.double(a) && is.double(b)) {
    return(length(a) == length(b) && identical(is.na(a), is.na(b)) &&
             identical(attributes(a), attributes(b)) &&
             all(abs(a - b) <= rounding * max(abs(a), 1e-300, na.rm = TRUE), na.rm = TRUE))
  }
  if (!is.list(a) || !is.list(b)) return(identical(a, b))
  own <- attributes(a)
  other <- attributes(b)
  setequal(names(own), names(other)) && identical(own[sort(names(own))], other[sort(names(own))]) &&
    length(a) == length(b) && all(unlist(Map(read_alike, unclass(a), unclass(b), rounding)))
}
