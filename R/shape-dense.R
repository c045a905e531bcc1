# The surface of a shape with more points than its scheme has: its quads divided, the new points on
# the scan.

#' Quads of a shape's surface divided into factor^2 each, with their new points on the specimen's
#' mesh
#'
#' Every side gets factor - 1 points, at equal chords: along the curve that it is part of, unless
#' that turns a triangle over, else along the shortest plane cut between its ends. A side is divided
#' once, whatever quads share it, so that no crack can open. Inside a quad cuts join matching points
#' of two opposite sides, those that are bowed more, since lines between the other two might cross
#' them.
#'
#' @param x A `shape`.
#' @param specimen The `specimen` it was measured on.
#' @param quads Of [scheme_quads()]; all corners there; a triangle has one corner twice.
#' @param factor Whole number, at least 2.
#' @param column As the arguments of [fit_shape()]: list of `angle`, `angles`, `reach`.
#' @return List: `points` (data frame of mesh_columns and `row`: of the surface points, NA of new
#'   ones; the given ones first; those to which no cut leads are NA), `it` (3 x m), `quad` (the row
#'   of the quad each triangle is from).
#' @noRd
divide_quads <- function(x, specimen, quads, factor, column) {
  corners <- as.matrix(quads[c("a", "b", "c", "d")])
  row <- sort(unique(as.vector(corners)))
  at <- as.matrix(x$points[x$points$level == "surface", mesh_columns][row, ])
  corners[] <- match(corners, row)
  # The sides of quads, each once
  from <- corners[, c("a", "d", "a", "b"), drop = FALSE]
  to <- corners[, c("b", "c", "d", "c"), drop = FALSE]
  ends <- cbind(pmin(as.vector(from), as.vector(to)), pmax(as.vector(from), as.vector(to)))
  key <- ifelse(ends[, 1] == ends[, 2], NA, paste(ends[, 1], ends[, 2]))
  first <- !duplicated(key) & !is.na(key)
  sides <- list(ends = ends[first, , drop = FALSE], side = matrix(match(key, key[first]), ncol = 4),
                forward = from < to)
  lattice <- quad_lattice(corners, sides, factor, length(row))
  triangles <- lattice_triangles(lattice, quads$outward == "columns", factor)
  cutter <- list(scan = c(walkable(specimen), list(column = column)), factor = factor)
  points <- matrix(NA_real_, max(lattice), length(mesh_columns),
                   dimnames = list(NULL, mesh_columns))
  points[seq_along(row), ] <- at
  along <- divide_sides(x$paths, at, sides$ends, cutter)
  points[length(row) + seq_len(nrow(along$points)), ] <- along$points
  points <- fill_quads(points, lattice, cutter)
  # Cuts in place of curves about quads in which a triangle is turned over. So it is where a curve
  # swings aside between two points of the model, or where two curves all but meet.
  normals <- t(path_normals(cutter$scan, as.data.frame(points)))
  folded <- unique(triangles$quad[flipped_triangles(points[, 1:3], triangles$it, normals)])
  straight <- intersect(sides$side[folded, ], which(along$curved))
  points <- if (!length(straight)) points else {
    inner <- cutter$factor - 1
    rows <- as.vector(outer(seq_len(inner), (straight - 1) * inner, "+"))
    points[max(sides$ends) + rows, ] <- along$cuts[rows, ]
    beside <- rowSums(matrix(sides$side %in% straight, ncol = 4)) > 0
    fill_quads(points, lattice[beside, , , drop = FALSE], cutter)
  }
  new <- nrow(points) - length(row)
  list(points = data.frame(points, row = c(row, rep(NA_integer_, new)), row.names = NULL),
       it = triangles$it,
       quad = triangles$quad)
}

#' Numbers of the points of divided quads: corners, then points of sides, then those inside
#'
#' @param count Number of corners.
#' @return m x (factor + 1) x (factor + 1) array: steps from a to b, from a to d.
#' @noRd
quad_lattice <- function(corners, sides, factor, count) {
  inner <- seq_len(factor - 1)
  on_side <- function(which, k, corner) {
    step <- ifelse(sides$forward[, which], k, factor - k)
    ifelse(is.na(sides$side[, which]), corners[, corner],
           count + (sides$side[, which] - 1) * (factor - 1) + step)
  }
  m <- nrow(corners)
  lattice <- array(0, c(m, factor + 1, factor + 1))
  lattice[, 1, 1] <- corners[, "a"]
  lattice[, factor + 1, 1] <- corners[, "b"]
  lattice[, factor + 1, factor + 1] <- corners[, "c"]
  lattice[, 1, factor + 1] <- corners[, "d"]
  for (k in inner) {
    lattice[, k + 1, 1] <- on_side(1, k, "a")
    lattice[, k + 1, factor + 1] <- on_side(2, k, "c")
    lattice[, 1, k + 1] <- on_side(3, k, "a")
    lattice[, factor + 1, k + 1] <- on_side(4, k, "b")
  }
  count <- count + nrow(sides$ends) * (factor - 1)
  lattice[, inner + 1, inner + 1] <- count + seq_len(m * (factor - 1)^2)
  lattice
}

#' The points of all sides, by side, from its smaller end to its greater
#'
#' @param cutter List of `scan` (of [walkable()], with `column`) and `factor`.
#' @param tolerance A point is on a curve that is no farther away, as a share of the mesh's
#'   diagonal.
#' @return List: `points`; `cuts`, those that cuts alone would give; `curved`, by side, whether it
#'   follows a curve.
#' @noRd
divide_sides <- function(paths, at, ends, cutter, tolerance = 1e-6) {
  scan <- cutter$scan
  tolerance <- tolerance * scan$diagonal
  # Which edges are part of a curve: their ends follow each other on its path among all points
  found <- data.frame(curve = rep(NA_character_, nrow(ends)), from = NA_real_, to = NA_real_)
  key <- paste(ends[, 1], ends[, 2])
  for (name in names(Filter(Negate(is.null), paths))) {
    s <- arc_lengths_on(paths[[name]], at[, c("x", "y", "z")], tolerance)
    along <- order(s, na.last = NA)
    if (length(along) < 2) next
    before <- along[-length(along)]
    after <- along[-1]
    edge <- match(paste(pmin(before, after), pmax(before, after)), key)
    new <- which(!is.na(edge) & is.na(found$curve[edge]))
    edge <- edge[new]
    found$curve[edge] <- name
    found$from[edge] <- s[ends[edge, 1]]
    found$to[edge] <- s[ends[edge, 2]]
  }
  curves <- found
  cuts <- cut_points(at, ends, cutter)
  points <- cuts
  inner <- seq_len(cutter$factor - 1)
  for (e in which(!is.na(curves$curve))) {
    part <- part_of_path(scan, paths[[curves$curve[e]]], curves$from[e], curves$to[e])
    placed <- resample_path(scan, part, cutter$factor + 1)
    # Over a hole a path is straight, and off the mesh.
    if (any(row_lengths(columns_of(placed)[, 1:3] - points_along(part, placed$s)) > tolerance)) {
      curves$curve[e] <- NA
    } else {
      points[(e - 1) * length(inner) + inner, ] <- columns_of(placed)[inner + 1, ]
    }
  }
  list(points = points, cuts = cuts, curved = !is.na(curves$curve))
}

#' The points that divide the shortest cuts between points at equal chords
#'
#' @param ends Two columns of rows of `points`.
#' @return Matrix, factor - 1 rows a cut: NA where there is none.
#' @noRd
cut_points <- function(points, ends, cutter) {
  inner <- seq_len(cutter$factor - 1)
  found <- matrix(NA_real_, nrow(ends) * length(inner), length(mesh_columns),
                  dimnames = list(NULL, mesh_columns))
  there <- which(!is.na(points[ends[, 1], "x"]) & !is.na(points[ends[, 2], "x"]))
  if (!length(there)) return(found)
  outside <- matrix(NA_real_, 3, length(there))
  cuts <- column_points(points[ends[there, 1], , drop = FALSE],
                        points[ends[there, 2], , drop = FALSE], outside,
                        cutter$factor + 1, cutter$scan)
  rows <- outer(inner, (there - 1) * length(inner), "+")
  found[rows, ] <- do.call(rbind, lapply(cuts, function(cut) cut[inner + 1, , drop = FALSE]))
  found
}

#' The points inside quads, on cuts between those opposite sides that are bowed more
#' @return `points`, filled.
#' @noRd
fill_quads <- function(points, lattice, cutter) {
  lines <- inner_lines(lattice, points, cutter$factor)
  inner <- seq_len(cutter$factor - 1) + 1
  points[t(lines[, inner]), ] <- cut_points(
    points, lines[, c(1, cutter$factor + 1), drop = FALSE], cutter
  )
  points
}

#' The cuts inside quads, from the side a b to d c or from a d to b c
#'
#' @return Matrix of the numbers of points, a row a cut, factor + 1 columns.
#' @noRd
inner_lines <- function(lattice, points, factor) {
  steps <- seq_len(factor + 1)
  side <- function(i, j) matrix(lattice[, i, j], nrow(lattice))
  xyz <- points[, c("x", "y", "z")]
  last <- factor + 1
  normal <- cross_rows(xyz[lattice[, last, last], , drop = FALSE] -
                       xyz[lattice[, 1, 1], , drop = FALSE],
                       xyz[lattice[, 1, last], , drop = FALSE] -
                       xyz[lattice[, last, 1], , drop = FALSE])
  normal <- normal / pmax(row_lengths(normal), .Machine$double.xmin)
  bow <- function(i, j) side_bow(side(i, j), points, normal)
  bowed <- pmax(bow(steps, 1),
                bow(steps, factor + 1)) >= pmax(bow(1, steps), bow(factor + 1, steps))
  inner <- steps[-c(1, factor + 1)]
  down <- lapply(inner, function(k) side(k, steps)[bowed, , drop = FALSE])
  across <- lapply(inner, function(k) side(steps, k)[!bowed, , drop = FALSE])
  do.call(rbind, c(down, across))
}

#' Greatest distance of a side's points from the straight line, as seen along the normal of the
#' quad; 0 where unknown
#' @noRd
side_bow <- function(side, points, normal) {
  xyz <- points[, c("x", "y", "z")]
  last <- ncol(side)
  bow <- numeric(nrow(side))
  for (k in seq_len(last)[-c(1, last)]) {
    share <- (k - 1) / (last - 1)
    at <- function(j) xyz[side[, j], , drop = FALSE]
    gap <- at(k) - (1 - share) * at(1) - share * at(last)
    bow <- pmax(bow, row_lengths(gap - row_products(gap, normal) * normal), na.rm = TRUE)
  }
  bow
}

#' Two triangles for each small quad, outward; those with a repeated corner are left out
#' @noRd
lattice_triangles <- function(lattice, columns, factor) {
  low <- seq_len(factor)
  corner <- function(i, j) as.vector(lattice[, i, j])
  a <- corner(low, low)
  b <- corner(low + 1, low)
  c <- corner(low + 1, low + 1)
  d <- corner(low, low + 1)
  columns <- rep(columns, factor^2)
  it <- cbind(rbind(a, ifelse(columns, b, c), ifelse(columns, c, b)),
              rbind(a, ifelse(columns, c, d), ifelse(columns, d, c)))
  quad <- rep(seq_len(nrow(lattice)), length.out = ncol(it))
  proper <- it[1, ] != it[2, ] & it[2, ] != it[3, ] & it[3, ] != it[1, ]
  list(it = unname(it[, proper, drop = FALSE]), quad = quad[proper])
}
