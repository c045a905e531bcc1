# Meshes of one topology, such as MeshMonk's registered templates: in with their vertices as they
# are, and our points on them.

#' Meshes that were registered by another program
#'
#' MeshMonk and similar programs lay a template on every scan, so that a vertex of a number is the
#' same place of all (7,160 vertices for MeshMonk's face). `read_registered()` reads such meshes. No
#' vertex is dropped, merged or moved, so that a table of values by vertex still fits. [align()]
#' takes the result. `carry_points()` takes points that lie on one of these meshes to the same
#' places of the others: the curves and landmarks of one face, measured by [fit_shape()], on all
#' faces.
#'
#' @param files Paths of `.obj`, `.ply` or `.stl` files. All have the same triangles; `.stl` files
#'   have no vertices of their own, and are refused.
#' @param x Points: a `shape`, or a k x 3 matrix with row names, in the unit of `from`.
#' @param from The mesh on which `x` lies: a `mesh3d` of the same vertices and triangles.
#' @param to A k x 3 x n array of the vertices of other meshes, as `coords` of `read_registered()`.
#' @param most Greatest distance of a point from `from`, as a share of the diagonal of its box.
#' @return `read_registered()`: a list with `coords`, an array of vertices x 3 x meshes with the
#'   names of the files, and `triangles`, a 3 x m matrix. `carry_points()`: an array k x 3 x n with
#'   the names of the points; a point that is missing in `x` is NA.
#' @section Errors: of class `crestline_error`: the meshes differ in their triangles, or a point
#'   lies farther from the mesh than `most`.
#' @template glossary
#' @references White et al. (2019) MeshMonk: open-source large-scale intensive 3D phenotyping,
#'   *Scientific Reports* 9, 6085.
#' @seealso [align()], with `triangles`
#' @examples
#' ball <- Rvcg::vcgSphere(2)
#' files <- file.path(tempdir(), c("a.obj", "b.obj"))
#' write_mesh(ball, files[1])
#' ball$vb[1, ] <- 2 * ball$vb[1, ]
#' write_mesh(ball, files[2])
#' faces <- read_registered(files)
#' dim(faces$coords)
#' carry_points(rbind(tip = c(2, 0, 0)), ball, faces$coords)
#' unlink(files)
#' @export
read_registered <- function(files) {
  check_given()
  check_names(files, "files")
  if (!length(files)) refuse_argument("files", files, "Give paths of meshes.")
  for (file in files) check_file(file, "reading", "files")
  stl <- grepl("[.]stl([.]gz)?$", files, ignore.case = TRUE)
  if (any(stl)) {
    crestline_abort(sprintf("%s: a .stl file does not keep the numbers of vertices.",
                            basename(files[stl][1])),
                    "Save it as .obj or .ply.", stage = "reading", call = NULL)
  }
  id <- file_ids(sub("[.]gz$", "", files, ignore.case = TRUE))
  meshes <- Map(read_mesh, unname(files), id)
  for (i in seq_along(meshes)) {
    same <- identical(dim(meshes[[i]]$it), dim(meshes[[1]]$it)) &&
      all(meshes[[i]]$it == meshes[[1]]$it) && ncol(meshes[[i]]$vb) == ncol(meshes[[1]]$vb)
    if (!same) {
      crestline_abort(sprintf("%s and %s have other triangles.", id[1], id[i]),
                      "Give meshes that were registered with one template.", stage = "reading",
                      id = id[i], call = NULL)
    }
  }
  coords <- vapply(meshes, function(mesh) t(mesh$vb[1:3, ]),
                   matrix(0, ncol(meshes[[1]]$vb), 3))
  dimnames(coords) <- list(NULL, c("x", "y", "z"), id)
  list(coords = coords, triangles = meshes[[1]]$it)
}

#' @rdname read_registered
#' @export
carry_points <- function(x, from, to, most = 0.01) {
  check_given()
  check_surface(from, "from")
  from <- as_mesh(from)
  most <- check_number(most, "most", lower = 0)
  check_array(to, "to")
  xyz <- if (inherits(x, "shape")) {
    check_class(x, "shape", "x", "fit_shape()")
    do.call(rbind, lapply(c("landmarks", "curves", "surface"), function(level) coords(x, level)))
  } else {
    point_matrix(x)
  }
  if (dim(to)[1] != ncol(from$vb) || dim(to)[2] != 3) {
    crestline_abort(sprintf("`to` has %d points of %d co-ordinates, `from` %d vertices.",
                            dim(to)[1], dim(to)[2], ncol(from$vb)),
                    "Give meshes of the same topology.", stage = "reading", call = NULL)
  }
  located <- located_points(from, xyz)
  far <- which(located$distance > most * mesh_diagonal(from))
  if (length(far)) {
    name <- if (is.null(rownames(xyz))) far else rownames(xyz)[far]
    crestline_abort(sprintf("%s lies %.3g off the mesh.", shorten(as.character(name)),
                            max(located$distance[far])),
                    "Give the mesh that the points were measured on, or a greater `most`.",
                    stage = "reading", call = NULL)
  }
  at <- frame_of(located$columns[mesh_columns])
  weight <- as.matrix(at[c("w1", "w2", "w3")])
  corners <- matrix(from$it[, at$face], 3)
  out <- vapply(seq_len(dim(to)[3]), function(i) {
    vertex <- to[, , i]
    corner <- function(k) vertex[corners[k, ], , drop = FALSE]
    weight[, 1] * corner(1) + weight[, 2] * corner(2) + weight[, 3] * corner(3)
  }, matrix(0, nrow(xyz), 3))
  dim(out) <- c(nrow(xyz), 3, dim(to)[3])
  dimnames(out) <- list(rownames(xyz), c("x", "y", "z"), dimnames(to)[[3]])
  out
}
