# The mesh at the door: what is wrong with it is mended and listed, or refused with the reason.

#' Check a mesh and mend what is harmless
#'
#' @param mesh A `mesh3d`, perhaps with quads, without triangles, or damaged.
#' @param id Name of the specimen for errors.
#' @param outward "detect", "keep" or "flip", see [specimen()].
#' @param debris Pieces with less than this share of the faces are left out.
#' @return A list: `mesh` (`vb`, `it`, `normals`, perhaps `material$color`), `topology` (see
#'   mesh_topology()), `report` (data frame: `check`, `count`, `action`, a row for every check).
#' @noRd
check_mesh <- function(mesh, id, outward = "detect", debris = 0.001) {
  outward <- check_choice(outward, c("detect", "keep", "flip"), "outward")
  debris <- check_number(debris, "debris", lower = 0, upper = 1)
  steps <- list(
    as_plain_mesh, normalise_homogeneous, split_quads, refuse_bad_indices, drop_non_finite,
    merge_duplicate_vertices, triangulate_cloud, drop_degenerate_faces, drop_duplicate_faces,
    refuse_empty, mend_winding, function(mesh, id) drop_debris(mesh, id, debris),
    drop_unreferenced, function(mesh, id) turn_outward(mesh, id, outward)
  )
  report <- list()
  for (step in steps) {
    done <- step(mesh, id)
    mesh <- done$mesh
    report <- c(report, list(done$row))
  }
  topology <- with_topology(mesh)$topology
  mesh$topology <- NULL
  normal <- face_normals(mesh)
  area <- row_lengths(normal)
  if (!any(area > 0)) refuse_flat(id)
  mesh$normals <- vertex_normals(mesh, normal)
  report <- c(report, describe_topology(mesh, topology, area))
  list(mesh = mesh, topology = topology, report = do.call(rbind, report))
}

# What a step hands on: the mesh and its row of the report ("none" where nothing was found).
mended <- function(mesh, check, count, action) list(mesh = mesh, row = report_row(check, count, action))

report_row <- function(check, count, action) {
  data.frame(check = check, count = as.integer(count), action = if (count > 0) action else "none")
}

refuse_mesh <- function(problem, remedy, id) {
  crestline_abort(problem, remedy, stage = "mesh", id = id, class = "crestline_mesh_error",
                  call = NULL)
}

as_plain_mesh <- function(mesh, id) {
  if (!inherits(mesh, "mesh3d")) {
    refuse_mesh(sprintf("the mesh is %s, not a mesh3d.", describe_value(mesh)),
                "Give a mesh3d, as of Rvcg::vcgImport(), or a file to read_specimen().", id)
  }
  vb <- mesh$vb
  if (!is.numeric(vb) || !is.matrix(vb) || !nrow(vb) %in% 3:4 || ncol(vb) < 3) {
    refuse_mesh("the mesh has no vertices (`vb` must be 4 x n, n at least 3).",
                "Read or export it again.", id)
  }
  if (nrow(vb) == 3) vb <- rbind(vb, 1)
  plain <- list(vb = unname(vb), it = index_matrix(mesh$it, 3, id), ib = index_matrix(mesh$ib, 4, id))
  colour <- vertex_colours(mesh)
  if (!is.null(colour)) plain$material <- list(color = colour)
  list(mesh = structure(plain, class = "mesh3d"), row = NULL)
}

index_matrix <- function(x, corners, id) {
  if (is.null(x) || length(x) == 0) return(matrix(0L, corners, 0))
  if (!is.numeric(x) || length(x) %% corners != 0) {
    refuse_mesh(sprintf("the faces are not a numeric matrix of %d rows.", corners),
                "Give `it` as 3 x m vertex numbers.", id)
  }
  matrix(suppressWarnings(as.integer(x)), corners)
}

normalise_homogeneous <- function(mesh, id) {
  wrong <- which(is.na(mesh$vb[4, ]) | mesh$vb[4, ] != 1)
  mesh$vb[1:3, wrong] <- mesh$vb[1:3, wrong] / rep(mesh$vb[4, wrong], each = 3)
  mesh$vb[4, ] <- 1
  mended(mesh, "homogeneous co-ordinates", length(wrong), "divided by the fourth")
}

split_quads <- function(mesh, id) {
  quads <- mesh$ib
  mesh$it <- cbind(mesh$it, quads[1:3, , drop = FALSE], quads[c(1, 3, 4), , drop = FALSE])
  mesh$ib <- NULL
  mended(mesh, "quads", ncol(quads), "cut into two triangles each")
}

refuse_bad_indices <- function(mesh, id) {
  bad <- sum(colSums(is.na(mesh$it) | mesh$it < 1 | mesh$it > ncol(mesh$vb)) > 0)
  if (bad > 0) {
    refuse_mesh(sprintf("%d of %d faces name vertices that do not exist.", bad, ncol(mesh$it)),
                "The mesh is damaged: export or download it again.", id)
  }
  mended(mesh, "faces naming missing vertices", 0, "refused")
}

# Finite to the fourth power, so that squared areas are too.
drop_non_finite <- function(mesh, id) {
  finite <- is.finite(colSums(mesh$vb[1:3, , drop = FALSE]^4))
  mended(keep_vertices(mesh, finite), "non-finite co-ordinates", sum(!finite),
         "vertices and their faces left out")
}

# The first of equal vertices stands for all; colours are the first's.
merge_duplicate_vertices <- function(mesh, id) {
  x <- mesh$vb[1, ]
  y <- mesh$vb[2, ]
  z <- mesh$vb[3, ]
  sorted <- order(x, y, z, method = "radix")
  same <- x[sorted[-1]] == x[sorted[-length(x)]] & y[sorted[-1]] == y[sorted[-length(x)]] &
    z[sorted[-1]] == z[sorted[-length(x)]]
  if (!any(same)) return(mended(mesh, "duplicate vertices", 0))
  group <- cumsum(c(TRUE, !same))
  stands_for <- integer(length(x))
  stands_for[sorted] <- sorted[!duplicated(group)][group]
  mesh$it[] <- stands_for[mesh$it]
  mended(keep_vertices(mesh, stands_for == seq_along(x)), "duplicate vertices", sum(same), "merged")
}

triangulate_cloud <- function(mesh, id) {
  if (ncol(mesh$it) > 0) return(mended(mesh, "point cloud without triangles", 0))
  n <- ncol(mesh$vb)
  if (n >= 4) mesh$it <- ball_pivoting(mesh)
  if (ncol(mesh$it) == 0) {
    refuse_mesh(sprintf("there are no triangles, and its %d points give none.", n),
                "Export it with its triangles, or give more points of the surface.", id)
  }
  mended(mesh, "point cloud without triangles", n, "triangulated by ball pivoting (Rvcg)")
}

# In a unit box about the origin, since Rvcg works in single precision.
ball_pivoting <- function(mesh) {
  xyz <- mesh$vb[1:3, , drop = FALSE]
  middle <- rowMeans(xyz)
  cloud <- list(vb = rbind((xyz - middle) / max(abs(xyz - middle)), 1))
  pivoted <- tryCatch(Rvcg::vcgBallPivoting(structure(cloud, class = "mesh3d")),
                      error = function(e) NULL)
  if (is.null(pivoted$it) || ncol(pivoted$vb) != ncol(xyz)) return(matrix(0L, 3, 0))
  matrix(as.integer(pivoted$it), 3)
}

drop_degenerate_faces <- function(mesh, id) {
  it <- mesh$it
  bad <- it[1, ] == it[2, ] | it[2, ] == it[3, ] | it[3, ] == it[1, ]
  mended(keep_faces(mesh, !bad), "degenerate faces", sum(bad), "left out")
}

drop_duplicate_faces <- function(mesh, id) {
  it <- mesh$it
  low <- pmin(it[1, ], it[2, ], it[3, ])
  high <- pmax(it[1, ], it[2, ], it[3, ])
  mid <- as.integer(colSums(it) - low - high)
  sorted <- order(low, mid, high, method = "radix")
  before <- sorted[-length(sorted)]
  after <- sorted[-1]
  bad <- after[low[before] == low[after] & mid[before] == mid[after] & high[before] == high[after]]
  mended(keep_faces(mesh, !seq_along(low) %in% bad), "duplicate faces", length(bad), "left out")
}

refuse_empty <- function(mesh, id) {
  if (ncol(mesh$it) == 0) refuse_flat(id)
  list(mesh = mesh, row = NULL)
}

refuse_flat <- function(id) {
  refuse_mesh("no triangle with an area is left.",
              "Look at the mesh: it may be a line, a single point, or damaged.", id)
}

drop_debris <- function(mesh, id, debris) {
  mesh <- with_topology(mesh)
  piece <- mesh$topology$piece
  small <- tabulate(piece) < debris * length(piece)
  if (all(small)) refuse_debris(length(small), debris, id)
  mended(keep_faces(mesh, !small[piece]), "debris", sum(small),
         sprintf("pieces below %g of the faces left out", debris))
}

refuse_debris <- function(pieces, debris, id) {
  refuse_mesh(sprintf("the mesh is in %d pieces, each below %g (`debris`) of its triangles.", pieces, debris),
              "Merge its vertices where they should coincide, or give a smaller `debris`.", id)
}

drop_unreferenced <- function(mesh, id) {
  used <- tabulate(mesh$it, ncol(mesh$vb)) > 0
  mended(keep_vertices(mesh, used), "unreferenced vertices", sum(!used), "left out")
}

# What stays as it is and is only told.
describe_topology <- function(mesh, topology, area) {
  list(
    report_row("faces without area", sum(area == 0), "kept, so that no slit opens"),
    report_row("non-manifold edges", topology$nonmanifold_edges, "kept; they act as borders"),
    report_row("isolated pieces", topology$pieces - 1, "kept; no curve leaves its piece"),
    report_row("holes", count_holes(mesh, topology), "kept; no curve crosses them")
  )
}

# Border loops beyond the one outer loop of each piece that has a border.
count_holes <- function(mesh, topology) {
  side <- which(topology$twin == 0)
  if (!length(side)) return(0L)
  start <- mesh$it[side]
  end <- mesh$it[next_side(side)]
  # As many border sides start as end at every vertex, so sorting both pairs each with a next.
  following <- integer(length(side))
  following[order(end)] <- order(start)
  loop <- cycle_labels(following)
  length(unique(loop)) - length(unique(topology$piece[(side - 1) %/% 3 + 1]))
}

# Half edge h runs from corner h of `it` to the next corner of the same face.
next_side <- function(h) ifelse(h %% 3 == 0, h - 2, h + 1)

# The smallest member of each cycle of a permutation, by doubling the stride.
cycle_labels <- function(following) {
  label <- seq_along(following)
  for (i in seq_len(ceiling(log2(length(following) + 1)))) {
    label <- pmin(label, label[following])
    following <- following[following]
  }
  label
}

# The topology is kept with the mesh as long as the faces stay as they are.
with_topology <- function(mesh) {
  if (is.null(mesh$topology)) mesh$topology <- mesh_topology(mesh)
  mesh
}

keep_faces <- function(mesh, keep) {
  if (all(keep)) return(mesh)
  mesh$it <- mesh$it[, keep, drop = FALSE]
  mesh$topology <- NULL
  mesh
}

# Faces with a vertex that goes, go too.
keep_vertices <- function(mesh, keep) {
  if (all(keep)) return(mesh)
  number <- cumsum(keep)
  number[!keep] <- NA
  it <- mesh$it
  it[] <- number[it]
  mesh$it <- it[, !is.na(colSums(it)), drop = FALSE]
  mesh$vb <- mesh$vb[, keep, drop = FALSE]
  mesh$topology <- NULL
  if (!is.null(mesh$material$color)) mesh$material$color <- mesh$material$color[keep]
  mesh
}
