# Parts of a mesh that should be connected. Corners and edges that differ by rounding are joined;
# wider seams and second skins get a warning.

# Comparisons a vertex or edge after which a search gives up: a mesh of which so many lie together
# has another fault.
join_effort <- 2000L

# Vertices that differ by rounding, as those of single triangles that went through text, of both
# sides of a texture seam, or of a skin that is there twice. `near`: distance, as a share of the
# mesh's size. Joined are ends of borders that no edge joins, and, of several pieces, vertices whose
# triangles then are others' duplicates; the first stands for all.
join_near_vertices <- function(mesh, id, near = 1e-6) {
  check <- "vertices apart by rounding"
  mesh <- with_topology(mesh)
  border <- sort(border_vertices(mesh$it, mesh$topology$twin))
  several <- mesh$topology$pieces > 1
  at <- if (several) seq_len(ncol(mesh$vb)) else border
  pair <- matrix(at[cpp_near_pairs(
                   mesh$vb[, at, drop = FALSE], near * surface_diagonal(mesh), join_effort
                 )],
                 2)
  if (ncol(pair)) pair <- pair[, !joined_by_edge(mesh, pair), drop = FALSE]
  if (ncol(pair) && several) {
    both <- pair[1, ] %in% border & pair[2, ] %in% border
    # Pairs in triangles of which two or more become one.
    twins <- cpp_pair_groups(pair, ncol(mesh$vb))
    it <- matrix(twins[mesh$it], 3)
    key <- paste(pmin(it[1, ], it[2, ], it[3, ]), pmax(it[1, ], it[2, ], it[3, ]), colSums(it))
    twice <- duplicated(key) | duplicated(key, fromLast = TRUE)
    double <- logical(ncol(mesh$vb))
    double[mesh$it[, twice]] <- TRUE
    pair <- pair[, both | (double[pair[1, ]] & double[pair[2, ]]), drop = FALSE]
  }
  if (!ncol(pair)) return(mended(mesh, check, 0))
  stands_for <- cpp_pair_groups(pair, ncol(mesh$vb))
  kept <- stands_for == seq_along(stands_for)
  mesh <- drop_degenerate_faces(merge_vertices(mesh, stands_for), id)$mesh
  mesh <- drop_duplicate_faces(mesh, id)$mesh
  if (ncol(mesh$it) == 0) refuse_flat(id)
  mended(mesh, check, sum(!kept), sprintf("joined (nearer than %g of the size)", near))
}

# Diagonal of the box of the vertices that triangles use.
surface_diagonal <- function(mesh) {
  used <- tabulate(mesh$it, ncol(mesh$vb)) > 0
  box_diagonal(if (all(used)) mesh$vb else mesh$vb[1:3, used, drop = FALSE])
}

joined_by_edge <- function(mesh, pair) {
  key <- function(a, b) pmin(a, b) * (ncol(mesh$vb) + 1) + pmax(a, b)
  it <- mesh$it[, colSums(matrix(mesh$it %in% pair, 3)) > 1, drop = FALSE]
  key(pair[1, ], pair[2, ]) %in% c(
    key(it[1, ], it[2, ]), key(it[2, ], it[3, ]), key(it[3, ], it[1, ])
  )
}

# Vertices in the middle of another triangle's edge (T-junctions): the edge is divided there, which
# moves nothing, if one of its parts is an edge of the other side. Each round divides one edge of a
# triangle.
split_edges_at_vertices <- function(mesh, id, near = 1e-6, rounds = 3) {
  reach <- near * surface_diagonal(mesh)
  count <- 0
  for (round in seq_len(rounds)) {
    mesh <- with_topology(mesh)
    found <- border_contacts(mesh, reach)
    # Sides of which a part between two of their vertices is a border side too.
    part <- side_parts(mesh, found)
    side <- border_sides(mesh$topology)
    key <- function(a, b) pmin(a, b) * (ncol(mesh$vb) + 1) + pmax(a, b)
    found <- found[found$side %in%
                   part$side[key(part$from, part$to) %in%
                             key(mesh$it[side], mesh$it[next_side(side)])], ]
    if (!nrow(found)) break
    first <- found$side[!duplicated((found$side - 1) %/% 3)]
    found <- found[found$side %in% first, ]
    mesh <- split_sides(mesh, found)
    count <- count + nrow(found)
  }
  mended(mesh, "vertices on edges of other triangles", count, "joined: these edges divided there")
}

# Ends of borders on the inner part of another border side: data frame `side`, `vertex`, `along`, in
# the order along sides.
border_contacts <- function(mesh, reach) {
  side <- border_sides(mesh$topology)
  found <- as.data.frame(cpp_vertices_on_edges(
    mesh$vb, mesh$it, mesh$topology$twin, side, reach, join_effort
  ))
  found <- found[order(found$side, found$along), ]
  found[!duplicated(found[c("side", "along")]), ]
}

# The parts of divided sides: data frame `side`, `from`, `to`.
side_parts <- function(mesh, found) {
  first <- !duplicated(found$side)
  last <- !duplicated(found$side, fromLast = TRUE)
  following <- ifelse(last, mesh$it[next_side(found$side)],
                      c(found$vertex[-1], NA)[seq_along(last)])
  data.frame(side = c(found$side[first], found$side),
             from = c(mesh$it[found$side[first]], found$vertex),
             to = c(found$vertex[first], following))
}

# Divides sides at vertices, one side a triangle: the first part keeps the triangle's number.
split_sides <- function(mesh, found) {
  part <- side_parts(mesh, found)
  it <- rbind(part$from, part$to, mesh$it[next_side(next_side(part$side))], deparse.level = 0)
  first <- seq_len(length(unique(found$side)))
  mesh$it[, (part$side[first] - 1) %/% 3 + 1] <- it[, first]
  mesh$it <- cbind(mesh$it, it[, -first, drop = FALSE])
  mesh$topology <- NULL
  mesh
}

# Borders beside one another: a row of the report and a warning, where so many vertices make a seam.
# `gap`: as a share of the usual length of an edge; `least`: vertices.
tell_seams <- function(mesh, topology, edge, id, gap = 0.1, least = 10, silent = FALSE) {
  mesh$topology <- topology
  border <- sort(border_vertices(mesh$it, topology$twin))
  pair <- matrix(border[cpp_near_pairs(mesh$vb[, border, drop = FALSE], gap * edge, join_effort)],
                 2)
  if (ncol(pair)) pair <- pair[, !joined_by_edge(mesh, pair), drop = FALSE]
  beside <- length(unique(c(pair, border_contacts(mesh, gap * edge)$vertex)))
  if (beside < least) beside <- 0
  if (beside > 0 && !silent) {
    crestline_warn(
      sprintf(paste0("%d vertices of the border lie beside another border, less than %.2g apart: ",
                     "no curve crosses such a seam."),
              beside, gap * edge),
      "Join them: in MeshLab by Merge Close Vertices, with that distance.", stage = "mesh", id = id,
      class = "crestline_seam"
    )
  }
  report_row("vertices on a border beside another", beside, "kept; no curve crosses a seam")
}

# A second sheet of the surface a hair from the first, as of scans that were laid together and not
# fused. `gap`: as a share of the usual length of an edge; `sample`: triangles that are looked at;
# `share` of them that makes a skin; `parallel`: least cosine between the normals; `hollow`: share
# of `gap` within which a sheet of the same piece that faces the other way counts too, as no wall of
# a hollow thing is so thin.
tell_second_skin <- function(mesh, topology, edge, id, gap = 1, sample = 100, share = 0.1,
                             parallel = 0.7,
                             hollow = 0.25) {
  m <- ncol(mesh$it)
  face <- unique(round(seq(1, m, length.out = min(sample, m))))
  away <- cpp_other_sheets(
    mesh$vb, mesh$it, topology$twin, topology$piece, face, gap * edge, parallel, hollow
  )
  double <- mean(is.finite(away))
  if (double >= share) {
    crestline_warn(
      sprintf(paste0("%.0f %% of the surface is there twice, two skins about %.2g apart: ",
                     "landmarks of one curve may lie on different skins."),
              100 * double, stats::median(away[is.finite(away)])),
      "Fuse the scans, or take one of the skins out, before you measure.", stage = "mesh", id = id,
      class = "crestline_double_skin"
    )
  }
  report_row("per cent of the surface with a second skin",
             if (double >= share) round(100 * double) else 0, "kept; see the warning")
}
