# The mesh at the door: what is wrong with it is mended and listed, or refused with the reason.

#' Check a mesh and mend what is harmless
#'
#' @param mesh A `mesh3d`, perhaps with quads, without triangles, or damaged.
#' @param id Name of the specimen for errors.
#' @param outward "detect", "keep" or "flip", see [specimen()].
#' @param debris Pieces with less than this share of the faces are left out.
#' @return A list: `mesh` (`vb`, `it`, `normals`, perhaps `material$color`), `topology` (see
#'   mesh_topology()), `report` (data frame: `check`, `count`, `action`, a row for every check),
#'   `vertices` (for every vertex given its number in `mesh`, NA where it was left out).
#' @noRd
check_mesh <- function(mesh, id, outward = "detect", debris = 0.001) {
  outward <- check_choice(outward, c("detect", "keep", "flip"), "outward")
  debris <- check_number(debris, "debris", lower = 0, upper = 1)
  steps <- list(
    as_plain_mesh, normalise_homogeneous, split_quads, refuse_bad_indices, drop_non_finite,
    drop_far,
    merge_duplicate_vertices, triangulate_cloud, drop_degenerate_faces, drop_duplicate_faces,
    refuse_empty,
    join_near_vertices, split_edges_at_vertices, mend_winding,
    function(mesh, id) drop_debris(mesh, id, debris),
    drop_unreferenced, function(mesh, id) turn_outward(mesh, id, outward)
  )
  report <- list()
  for (step in steps) {
    done <- step(mesh, id)
    mesh <- done$mesh
    report <- c(report, list(done$row))
  }
  warn_dropped(mesh, do.call(rbind, report), id)
  topology <- with_topology(mesh)$topology
  vertices <- mesh$given
  normal <- if (is.null(mesh$face_normals)) face_normals(mesh) else mesh$face_normals
  mesh[c("topology", "given", "lost", "face_normals")] <- NULL
  area <- row_lengths(normal)
  if (!any(area > 0)) refuse_flat(id)
  mesh$normals <- vertex_normals(mesh)
  # What may cost curves and cannot be mended. Where triangles are loose all borders are seams.
  # Of equilateral triangles of the median area; `area` is twice it.
  edge <- sqrt(2 / sqrt(3) * stats::median(area))
  loose <- warn_loose(topology, id)
  report <- c(report, describe_topology(mesh, topology, area),
              list(tell_seams(mesh, topology, edge, id, silent = loose),
                   tell_second_skin(mesh, topology, edge, id)))
  list(mesh = mesh, topology = topology, report = do.call(rbind, report), vertices = vertices)
}

as_plain_mesh <- function(mesh, id) {
  if (!inherits(mesh, "mesh3d") || !is.list(mesh)) {
    refuse_mesh(sprintf("the mesh is %s, not a mesh3d.", describe_value(mesh)),
                "Give a mesh3d, as of Rvcg::vcgImport(), or a file to read_specimen().", id)
  }
  vb <- mesh$vb
  if (!is.numeric(vb) || !is.matrix(vb) || !nrow(vb) %in% 3:4 ||
      ncol(vb) < 3) refuse_no_vertices(id)
  if (nrow(vb) == 3) vb <- rbind(vb, 1)
  plain <- list(vb = unname(vb), it = face_matrix(mesh$it, 3, id), ib = face_matrix(mesh$ib, 4, id))
  colour <- vertex_colours(mesh)
  if (!is.null(colour)) plain$material <- list(color = colour)
  # What the steps keep count of: each vertex's number now, triangles that were lost.
  plain$given <- seq_len(ncol(vb))
  plain$lost <- 0
  short <- sum(mesh$short)
  list(mesh = structure(plain, class = "mesh3d"),
       row = report_row("polygons with fewer than three corners", short, "left out"))
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
  if (anyNA(mesh$it) ||
      any(mesh$it < 1 | mesh$it > ncol(mesh$vb))) refuse_indices(mesh$it, ncol(mesh$vb), id)
  mended(mesh, "faces naming missing vertices", 0, "refused")
}

# Finite to the fourth power, so that squared areas are too.
drop_non_finite <- function(mesh, id) {
  finite <- is.finite(colSums(mesh$vb[1:3, , drop = FALSE]^4))
  if (!any(finite)) {
    refuse_mesh("none of its vertices has finite co-ordinates, or all are absurdly large.",
                "Export it again.", id)
  }
  absurd <- sum(is.finite(colSums(mesh$vb[1:3, !finite, drop = FALSE] / 4)))
  if (absurd > 0) warn_far(absurd, "have absurdly large co-ordinates", id)
  mended(losing(mesh, keep_vertices(mesh, finite)), "non-finite co-ordinates", sum(!finite),
         "vertices and their faces left out")
}

# Vertices of the surface that are no part of it: more than `far` times as far from its middle as
# half of the vertices (a scan with its platform, or a whole body with most vertices on the head: up
# to 20 times). They would blind every tolerance that goes by the size.
drop_far <- function(mesh, id, far = 50) {
  check <- "vertices far from all others"
  gone <- far_vertices(mesh, seq_len(ncol(mesh$vb)), far)
  if (!length(gone)) return(mended(mesh, check, 0))
  # Those that no triangle uses are none of the surface, and may be most.
  if (ncol(mesh$it)) gone <- far_vertices(mesh, which(tabulate(mesh$it, ncol(mesh$vb)) > 0), far)
  if (length(gone)) {
    warn_far(length(gone),
             sprintf("are more than %g times as far from the middle as half of the others", far),
             id)
  }
  kept <- !seq_len(ncol(mesh$vb)) %in% gone
  mended(losing(mesh, keep_vertices(mesh, kept)), check, length(gone), "left out, with their faces")
}

warn_far <- function(count, what, id) {
  crestline_warn(sprintf("%d vertices %s: left out, with their faces.", count, what),
                 "Look at the mesh; if they belong to it, scale or crop it first.", stage = "mesh",
                 id = id,
                 class = "crestline_far_vertices")
}

far_vertices <- function(mesh, among, far) {
  xyz <- mesh$vb[1:3, among, drop = FALSE]
  away <- sqrt(colSums((xyz - apply(xyz, 1, stats::median))^2))
  usual <- stats::median(away)
  if (isTRUE(usual > 0)) among[away > far * usual] else integer()
}

# The mesh after a step by which surface is lost.
losing <- function(before, after) {
  after$lost <- before$lost + ncol(before$it) - ncol(after$it)
  after
}

# `noticeable`: share of the faces (3 square centimetres of a face scan's 300).
warn_dropped <- function(mesh, report, id, noticeable = 0.01) {
  given <- mesh$lost + ncol(mesh$it)
  if (mesh$lost <= noticeable * given) return(invisible())
  why <- report[report$check %in%
                c("non-finite co-ordinates", "vertices far from all others", "debris") &
                report$count > 0, ]
  crestline_warn(
    sprintf("%.0f %% of the triangles were left out (%s).", 100 * mesh$lost / given,
            paste(why$count, why$check, collapse = ", ")),
    "Look whether the surface has what you measure; if not, export it again.", stage = "mesh",
    id = id,
    class = "crestline_triangles_dropped"
  )
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
  mended(merge_vertices(mesh, stands_for), "duplicate vertices", sum(same), "merged")
}

triangulate_cloud <- function(mesh, id) {
  if (ncol(mesh$it) > 0) return(mended(mesh, "point cloud without triangles", 0))
  n <- ncol(mesh$vb)
  if (n >= 4) {
    # In a unit box about the origin, since Rvcg works in single precision.
    xyz <- mesh$vb[1:3, , drop = FALSE]
    middle <- rowMeans(xyz)
    cloud <- list(vb = rbind((xyz - middle) / max(abs(xyz - middle)), 1))
    pivoted <- tryCatch(Rvcg::vcgBallPivoting(structure(cloud, class = "mesh3d")),
                        error = function(e) NULL)
    mesh$it <- if (is.null(pivoted$it) || ncol(pivoted$vb) != ncol(xyz)) matrix(0L, 3, 0) else
      matrix(as.integer(pivoted$it), 3)
  }
  if (ncol(mesh$it) == 0) {
    refuse_mesh(sprintf("there are no triangles, and its %d points give none.", n),
                "Export it with its triangles, or give more points of the surface.", id)
  }
  crestline_warn(
    sprintf("there are points only; %d triangles between them were made by ball pivoting.",
            ncol(mesh$it)),
    "Export the scan with its own triangles, or look whether these are the surface.",
    stage = "mesh", id = id,
    class = "crestline_triangulated"
  )
  mended(mesh, "point cloud without triangles", n, "triangulated by ball pivoting (Rvcg)")
}

refuse_empty <- function(mesh, id) {
  if (ncol(mesh$it) == 0) refuse_flat(id)
  list(mesh = mesh, row = NULL)
}

drop_debris <- function(mesh, id, debris) {
  mesh <- with_topology(mesh)
  piece <- mesh$topology$piece
  small <- tabulate(piece) < debris * length(piece)
  if (all(small)) refuse_debris(length(small), debris, id)
  mended(losing(mesh, keep_faces(mesh, !small[piece])), "debris", sum(small),
         sprintf("pieces below %g of the faces left out", debris))
}

refuse_debris <- function(pieces, debris, id) {
  refuse_mesh(sprintf(paste0("it falls apart into %d pieces, each with less than %g (`debris`) of ",
                             "the triangles: %s."),
                      pieces, debris, "their corners do not meet"),
              paste0("Join them: in MeshLab by Merge Close Vertices. Real pieces so small are ",
                     "kept with debris = 0."),
              id)
}

drop_unreferenced <- function(mesh, id) {
  used <- tabulate(mesh$it, ncol(mesh$vb)) > 0
  mended(keep_vertices(mesh, used), "unreferenced vertices", sum(!used), "left out")
}

# Rows of the report for faults that are kept.
describe_topology <- function(mesh, topology, area) {
  # Border loops beyond the one outer loop of each piece that has a border.
  side <- border_sides(topology)
  holes <- if (!length(side)) 0L else {
    start <- mesh$it[side]
    end <- mesh$it[next_side(side)]
    # As many border sides start as end at every vertex, so sorting both pairs each with a next.
    following <- integer(length(side))
    following[order(end)] <- order(start)
    # The smallest member of each cycle of a permutation, by doubling the stride.
    loop <- seq_along(following)
    for (i in seq_len(ceiling(log2(length(following) + 1)))) {
      loop <- pmin(loop, loop[following])
      following <- following[following]
    }
    length(unique(loop)) - length(unique(topology$piece[(side - 1) %/% 3 + 1]))
  }
  # How large the largest piece besides the main one is, in words; none of one piece
  size <- sort(tabulate(topology$piece), decreasing = TRUE)
  other_piece_words <- if (length(size) < 2) "" else {
    sprintf("; the largest has %s of the triangles", per_cent(size[2] / length(topology$piece)))
  }
  list(
    report_row("faces without area", sum(area == 0), "kept, so that no slit opens"),
    report_row("non-manifold edges", topology$nonmanifold_edges, "kept; they act as borders"),
    report_row("isolated pieces", topology$pieces - 1,
               paste0("kept; no curve leaves its piece", other_piece_words)),
    report_row("holes", holes, "kept; see `bridge` of shape_settings()")
  )
}

# Whether that `share` of the triangles, and so many at `least`, have no neighbour.
warn_loose <- function(topology, id, share = 0.1, least = 10) {
  loose <- sum(colSums(topology$twin > 0) == 0)
  if (loose < max(least, share * length(topology$piece))) return(FALSE)
  crestline_warn(
    sprintf(paste0("%.0f %% of the triangles touch no other: their corners do not meet, and no ",
                   "curve leaves its piece."),
            100 * loose / length(topology$piece)),
    "Join them: in MeshLab by Merge Close Vertices.", stage = "mesh", id = id,
    class = "crestline_loose_triangles"
  )
  TRUE
}
