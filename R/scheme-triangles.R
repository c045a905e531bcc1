# The triangles of a scheme's surface: the quads of its patches, and the strips that join them.

#' Triangles of a scheme's surface points
#'
#' @param patches,strips Tables of the scheme.
#' @param points [scheme_points()] of the scheme.
#' @return Data frame `part` ("model", or an optional part), `group` (the patch, or "strip" and its
#'   name), `v1`, `v2`, `v3`: rows of the surface points in outward order; points of one place are
#'   named by the first of them.
#' @noRd
scheme_triangles <- function(patches, strips, points) {
  each <- lapply(scheme_grids(patches, strips, points), function(one) {
    quad_triangles(one$grid, one$outward, one$part, one$group)
  })
  none <- data.frame(part = character(), group = character(), v1 = integer(), v2 = integer(),
                     v3 = integer())
  do.call(rbind, c(list(none), each))
}

#' The quads that [scheme_triangles()] cuts in two
#'
#' @return Data frame `part`, `group`, `outward`, `a`, `b`, `c`, `d`: the corners (c, r), (c + 1,
#'   r), (c + 1, r + 1), (c, r + 1).
#' @noRd
scheme_quads <- function(patches, strips, points) {
  each <- lapply(scheme_grids(patches, strips, points), function(one) {
    quads <- grid_quads(one$grid)
    times <- nrow(quads)
    data.frame(part = rep(one$part, times), group = rep(one$group, times),
               outward = rep(one$outward, times), quads)
  })
  do.call(rbind, each)
}

#' The blocks with triangles and the strips as grids of vertices
#' @return List of lists `grid` (columns x rows), `outward`, `part`, `group`.
#' @noRd
scheme_grids <- function(patches, strips, points) {
  points <- points[points$level == "surface", ]
  vertex <- match(points$place, points$place)
  first <- cumsum(patches$n) - patches$n
  blocks <- lapply(which(!is.na(patches$outward)), function(i) {
    rows <- length(number_list(patches$rows_kept[i]))
    grid <- t(matrix(vertex[first[i] + seq_len(patches$n[i])], nrow = rows))
    list(grid = grid, outward = patches$outward[i], part = "model", group = patches$patch[i])
  })
  name <- paste(points$part, points$point, sep = "|")
  ladders <- lapply(split(strips, factor(strips$strip, unique(strips$strip))), function(strip) {
    grid <- t(matrix(vertex[match(c(strip$a, strip$b), name)], ncol = 2))
    list(grid = grid, outward = strip$outward[1], part = strip$part[1],
         group = paste("strip", strip$strip[1]))
  })
  c(blocks, unname(ladders))
}

#' Two triangles a quad of a grid, split from (c, r) to (c + 1, r + 1); those with a repeated corner
#' are left out
#'
#' @param grid Vertices, columns x rows.
#' @param outward "columns": (c, r), (c + 1, r), (c + 1, r + 1) is the outward order; "rows": (c,
#'   r), (c, r + 1), (c + 1, r + 1).
#' @noRd
quad_triangles <- function(grid, outward, part, group) {
  quads <- grid_quads(grid)
  a <- quads[, "a"]
  b <- quads[, "b"]
  c <- quads[, "c"]
  d <- quads[, "d"]
  v <- if (outward == "columns") cbind(c(a, a), c(b, c), c(c, d)) else
    cbind(c(a, a), c(c, d), c(b, c))
  v <- v[v[, 1] != v[, 2] & v[, 2] != v[, 3] & v[, 3] != v[, 1], , drop = FALSE]
  data.frame(part = rep(part, nrow(v)), group = rep(group, nrow(v)), v1 = v[, 1], v2 = v[, 2],
             v3 = v[, 3])
}

grid_quads <- function(grid) {
  nc <- nrow(grid)
  nr <- ncol(grid)
  if (nc < 2 || nr < 2) {
    return(matrix(integer(), 0, 4, dimnames = list(NULL, c("a", "b", "c", "d"))))
  }
  corner <- function(columns, rows) as.vector(grid[columns, rows])
  cbind(a = corner(-nc, -nr), b = corner(-1, -nr), c = corner(-1, -1), d = corner(-nc, -1))
}
