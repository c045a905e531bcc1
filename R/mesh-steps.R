# What the steps at the door share: rows of the report, refusals, faces and vertices taken out.

# What a step hands on: the mesh and its row of the report ("none" where nothing was found).
mended <- function(mesh, check, count, action) list(
  mesh = mesh, row = report_row(check, count, action)
)

report_row <- function(check, count, action) {
  data.frame(check = check, count = as.integer(count), action = if (count > 0) action else "none")
}

refuse_mesh <- function(problem, remedy, id) {
  crestline_abort(problem, remedy, stage = "mesh", id = id, class = "crestline_mesh_error",
                  call = NULL)
}

refuse_flat <- function(id) {
  refuse_mesh("no triangle with an area is left.",
              "Look at the mesh: it may be a line, a single point, or damaged.", id)
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
  if (!is.null(mesh$given)) mesh$given <- number[mesh$given]
  mesh$topology <- NULL
  if (!is.null(mesh$material$color)) mesh$material$color <- mesh$material$color[keep]
  mesh
}

merge_vertices <- function(mesh, stands_for) {
  mesh$it[] <- stands_for[mesh$it]
  mesh$given <- stands_for[mesh$given]
  mesh$topology <- NULL
  keep_vertices(mesh, stands_for == seq_along(stands_for))
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
