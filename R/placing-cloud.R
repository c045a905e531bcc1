# A scan as a cloud of representative vertices with normals and curvature, and its anchors: the
# strongest caps and cups.

#' One vertex for each cell of a grid in the cloud's own principal axes
#'
#' Cells are laid about the centroid, so that neither pose nor the axes' signs matter.
#'
#' @param vertex n x 3.
#' @return Indices of the vertices nearest to the middles of their cells.
#' @noRd
cell_vertices <- function(vertex, cell) {
  centred <- sweep(vertex, 2, colMeans(vertex))
  turned <- centred %*% eigen(crossprod(centred), symmetric = TRUE)$vectors
  at <- round(turned / cell)
  off <- row_lengths(turned - cell * at)
  at <- sweep(at, 2, apply(at, 2, min))
  span <- apply(at, 2, max) + 1
  key <- at[, 1] + span[1] * (at[, 2] + span[2] * at[, 3])
  group <- match(key, unique(key))
  sorted <- order(group, off)
  sorted[!duplicated(group[sorted])]
}

#' The cloud that a scan is matched by
#'
#' Where its vertices lie farther apart than the cells, the centres of its triangles are points too.
#'
#' @param specimen A specimen.
#' @param scale Factor on its lengths: to the template's unit.
#' @param settings Of [find_settings()], in the template's unit.
#' @return List: `xyz`, `normal` (3 x n), `k1`, `k2` (n, in balls of `feature`), `border` (n,
#'   logical), `coarse` (indices among n of a thinner cloud), `spacing` (lengths, of the cloud and
#'   of the thinner one), `anchors` (see [cloud_anchors()]).
#' @noRd
scan_cloud <- function(specimen, scale, settings, threads) {
  mesh <- specimen$mesh
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] * scale
  vertex <- cell_vertices(t(mesh$vb[1:3, ]), settings$cluster)
  fine <- curvature(mesh, settings$feature, "adaptive cubic", threads, vertex)
  broad <- curvature(mesh, settings$bend, "quadratic", threads, vertex)
  # The strongest caps and cups of a cloud, apart from each other
  xyz <- mesh$vb[1:3, vertex, drop = FALSE]
  broad <- lapply(unclass(broad), rows_at, vertex)
  found <- rbind(strongest_points(xyz, -broad$k1, "cap", settings),
                 strongest_points(xyz, broad$k2, "cup", settings))
  frames <- lapply(found$point, function(i) {
    normal <- broad$normal[i, ]
    first <- broad$direction1[i, ]
    cbind(first, cross_product(normal, first), normal)
  })
  anchors <- structure(found, frames = frames, places = xyz[, found$point, drop = FALSE])
  points <- list(xyz = mesh$vb[1:3, ], normal = mesh$normals[1:3, ], k1 = fine$k1, k2 = fine$k2,
                 border = seq_len(ncol(mesh$vb)) %in%
                   border_vertices(mesh$it, specimen$geometry$twin))
  sparse <- sum(row_lengths(face_normals(mesh))) / 2 > ncol(mesh$vb) * settings$cluster^2
  points <- if (sparse) {
    of_centre <- function(x) {
      corner <- function(i) if (is.matrix(x)) x[, mesh$it[i, ]] else x[mesh$it[i, ]]
      (corner(1) + corner(2) + corner(3)) / 3
    }
    centre <- lapply(points, of_centre)
    centre$normal <- centre$normal / rep(
      pmax(sqrt(colSums(centre$normal^2)), .Machine$double.xmin), each = 3
    )
    centre$border <- centre$border >= 2 / 3
    all <- Map(function(a, b) if (is.matrix(a)) cbind(a, b) else c(a, b), points, centre)
    at_points(all, cell_vertices(t(all$xyz), settings$cluster))
  } else at_points(points, vertex)
  points[c("k1", "k2")] <- lapply(points[c("k1", "k2")], function(k) ifelse(is.na(k), 0, k))
  coarse <- cell_vertices(t(points$xyz), settings$coarse)
  c(points, list(coarse = coarse, spacing = c(settings$cluster, settings$coarse),
                 anchors = anchors))
}

at_points <- function(points, at) {
  lapply(points, function(x) if (is.matrix(x)) x[, at, drop = FALSE] else x[at])
}

rows_at <- function(x, i) if (is.matrix(x)) x[i, , drop = FALSE] else x[i]

strongest_points <- function(xyz, size, kind, settings) {
  left <- which(!is.na(size) & size > settings$cap)
  left <- left[order(-size[left])]
  chosen <- integer()
  while (length(left) && length(chosen) < settings$anchors) {
    chosen <- c(chosen, left[1])
    gap <- sqrt(colSums((xyz[, left, drop = FALSE] - xyz[, left[1]])^2))
    left <- left[gap > settings$apart]
  }
  data.frame(point = chosen, kind = rep(kind, length(chosen)), size = size[chosen])
}

#' A cloud turned inside out
#' @noRd
inverted_cloud <- function(cloud) {
  cloud$normal <- -cloud$normal
  k1 <- cloud$k1
  cloud$k1 <- -cloud$k2
  cloud$k2 <- -k1
  cloud$anchors$kind <- ifelse(cloud$anchors$kind == "cap", "cup", "cap")
  attr(cloud$anchors, "frames") <- lapply(
    attr(cloud$anchors, "frames"), function(f) cbind(f[, 2], f[, 1], -f[, 3])
  )
  cloud
}
