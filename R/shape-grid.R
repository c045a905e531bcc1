# One patch of a shape by itself, cut anew with any number of columns and rows.

#' A patch of a shape with any number of columns and rows
#'
#' Makes a grid over one patch, from one bounding curve to the other. The bounding curves get new
#' points at equal chords. Matching points are joined by the shortest plane cut, as in
#' [fit_shape()], and every cut gets points at equal chords. Columns and rows that the scheme leaves
#' to neighbouring patches are included. See [shape_mesh()] for denser patches that fit together.
#'
#' @template shape
#' @template measured-on
#' @param patch Name of a patch of the scheme.
#' @param columns Number of points on each bounding curve. NULL: as in the scheme.
#' @param rows Number of points in each column, both ends included. NULL: as in the scheme.
#' @param block Number of the block, if the patch has several with columns.
#' @inheritParams shape_mesh
#' @return A `mesh3d` with outward normals. It has a vertex for every point, by column, then by row
#'   from the first bounding curve. Triangles with a missing point are left out. Attribute `points`:
#'   data frame `column`, `row`, `x`, `y`, `z`, `face`, `w1`, `w2`, `w3` of all points on the
#'   specimen's mesh. Points of a missing column are NA and have no vertex.
#' @section Errors: of class `crestline_error`: the scheme has no such patch or block, the patch is
#'   a single row of points, a bounding curve is missing, or no column is left. Of class
#'   `crestline_wrong_mesh`: the specimen has another mesh.
#' @template glossary
#' @seealso [shape_mesh()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' shape <- fit_shape(face, face_scheme(), ridge_settings(error = FALSE))
#' nose <- patch_mesh(shape, face, "nose left", columns = 25, rows = 40)
#' draw_surface(nose, view = "left", engine = "picture")
#' }
#' @export
patch_mesh <- function(x, specimen, patch, columns = NULL, rows = NULL, block = NULL,
                       measuring = shape_settings(), ...) {
  check_given()
  measuring <- measuring_with_former(measuring, ...)
  patch <- check_text(patch, "patch")
  if (!is.null(block) && !is.atomic(block)) {
    refuse_argument("block", block, "Give a block's name.")
  }
  check_class(x, "shape", "x", "fit_shape()")
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  check_shape_on(x, specimen)
  block <- block_of(x, patch, block)
  columns <- check_count(if (is.null(columns)) block$a$n else columns, "columns", 2, upper = 10000)
  rows <- check_count(if (is.null(rows)) block$rows else rows, "rows", 2, upper = 10000)
  scan <- c(walkable(specimen), list(column = column_settings(measuring)))
  points <- block_grid(x, scan, block, columns, rows)
  place <- ifelse(is.na(points$x), NA, paste(points$x, points$y, points$z))
  vertex <- match(place, unique(place[!is.na(place)]))
  outward <- if (is.na(block$outward)) "columns" else block$outward
  triangles <- quad_triangles(matrix(vertex, columns, byrow = TRUE), outward, "model", patch)
  it <- t(as.matrix(triangles[stats::complete.cases(triangles), c("v1", "v2", "v3")]))
  if (!length(it)) {
    refuse_patch(x, "no two columns side by side were found", "See `status` for what is missing.")
  }
  first <- match(seq_len(max(vertex, na.rm = TRUE)), vertex)
  mesh <- rgl::mesh3d(vertices = unname(rbind(t(as.matrix(points[first, c("x", "y", "z")])), 1)),
                      triangles = unname(it))
  structure(with_normals(mesh), points = cbind(points, vertex = vertex))
}

#' One block of a patch, which must have columns, as of [scheme_plan()]
#' @noRd
block_of <- function(x, patch, block) {
  patches <- x$scheme$patches
  known <- unique(patches$patch)
  if (!is.character(patch) || length(patch) != 1 || !patch %in% known) {
    refuse_patch(x, sprintf("there is no patch %s", describe_value(patch)),
                 near_names(patch, known))
  }
  blocks <- patches[patches$patch == patch & !is.na(patches$curve_b), ]
  if (!is.null(block)) blocks <- blocks[blocks$block %in% block, ]
  if (nrow(blocks) == 0) {
    refuse_patch(x, sprintf("%s has no such block with columns", patch),
                 "Choose another patch or block.")
  }
  if (nrow(blocks) > 1) {
    refuse_patch(x, sprintf("%s has several blocks", patch),
                 sprintf("Choose one: block = %s.", paste(blocks$block, collapse = " or ")))
  }
  row <- match(rownames(blocks), rownames(patches))
  scheme_plan(x$scheme)$blocks[[row]]
}

refuse_patch <- function(x, problem, remedy) {
  crestline_abort(paste0(problem, "."), remedy, stage = "shape", id = x$id, call = NULL)
}

#' All points of a block, by column, then by row
#' @noRd
block_grid <- function(x, scan, block, columns, rows) {
  fits <- shape_fits(x, scan)
  store <- as.matrix(
    x$points[match(unique(x$scheme$points$place), x$scheme$points$place), mesh_columns]
  )
  rownames(store) <- unique(x$scheme$points$place)
  ground <- list(scan = scan, fits = fits, store = store)
  side <- function(side, n) side_points_on(side, n, ground)
  a <- side(block$a, columns)
  b <- side(block$b, columns)
  if (!is.null(c(a$problem, b$problem))) {
    refuse_patch(x, c(a$problem, b$problem)[1], "See `status` for the reason.")
  }
  outside <- vapply(seq_len(columns),
                    function(k) column_outside(a$points, b$points, k, block$outward), numeric(3))
  grid <- column_points(a$points, b$points, outside, rows, scan)
  if (!is.null(block$first)) grid[[1]] <- side(block$first, rows)$points
  data.frame(column = rep(seq_len(columns), each = rows), row = rep(seq_len(rows), columns),
             do.call(rbind, grid),
             row.names = NULL)
}

#' Columns as of [fit_columns()]: where the ends are the same point, that point; where there is no
#' cut, the ends alone
#' @return List of rows x 7 matrices.
#' @noRd
column_points <- function(from, to, outside, rows, scan) {
  found <- fit_columns(from, to, outside, rows, scan)
  for (k in which(!is.na(found$problem))) {
    same <- all(from[k, 1:3] == to[k, 1:3])
    between <- matrix(if (same) from[k, ] else NA_real_, rows - 2, length(mesh_columns),
                      byrow = TRUE)
    found$points[[k]] <- rbind(from[k, ], between, to[k, ])
  }
  found$points
}

#' The curves of a shape as [fit_scheme_curves()] gives them, as far as bounding curves need them
#'
#' @param tolerance Points farther from their curve's path (in shares of the mesh's diagonal) have
#'   no place on it.
#' @noRd
shape_fits <- function(x, scan, tolerance = 1e-6) {
  lapply(stats::setNames(nm = names(Filter(Negate(is.null), x$paths))), function(name) {
    own <- x$points[x$points$level == "curves" & x$points$part == name, ]
    s <- arc_lengths_on(x$paths[[name]], as.matrix(own[c("x", "y", "z")]),
                        tolerance * scan$diagonal)
    list(points = data.frame(s = s), path = x$paths[[name]])
  })
}

#' Arc lengths of the points that lie on a path, NA for the others
#' @noRd
arc_lengths_on <- function(path, xyz, tolerance) {
  track <- as.matrix(path[c("x", "y", "z")])
  low <- apply(track, 2, min) - tolerance
  high <- apply(track, 2, max) + tolerance
  near <- which(colSums(t(xyz) < low | t(xyz) > high) == 0)
  s <- rep(NA_real_, nrow(xyz))
  a <- track[-nrow(track), , drop = FALSE]
  b <- track[-1, , drop = FALSE]
  for (i in near) {
    p <- matrix(xyz[i, ], nrow(a), 3, byrow = TRUE)
    # Row by row: the share of the way along a segment at which it is closest to a point
    along <- row_products(p - a, b - a) / row_products(b - a, b - a)
    along[!is.finite(along)] <- 0
    share <- pmin(pmax(along, 0), 1)
    away <- row_lengths(p - a - share * (b - a))
    best <- which.min(away)
    if (away[best] <= tolerance) {
      s[i] <- path$s[best] + share[best] * (path$s[best + 1] - path$s[best])
    }
  }
  s
}
