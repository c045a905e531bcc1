# A scene as a binary glTF file, for Blender, PowerPoint and phones.

#' Write a surface, its curves or its components as a .glb file
#'
#' Writes binary glTF 2.0, which Blender, PowerPoint, phones and most viewers of 3-D models open. A
#' shape has its surface and each curve as a tube of its own, by name. A `shape_pca` has the mean
#' surface with a morph target for each component. A morph target of weight 1 is the mean moved by
#' `sd` standard deviations, and weight -1 is the other end.
#'
#' Positions are those of the mesh, in single precision. The scene's first node scales them to
#' metres, as the format asks. Colours are converted to the linear values that the format has.
#'
#' @param x A `shape`, a [specimen()], a `mesh3d`, or a `shape_pca` of a level with triangles.
#' @param file Path of the file, ending in `.glb`.
#' @param colour Colours of the vertices, as in [write_mesh()]. NULL: the natural colours of a
#'   specimen, else `plain`.
#' @param plain Colour of a surface without colours.
#' @param tube Radius of the tubes, in the unit of the mesh. NULL: a 400th of the mesh's diagonal.
#'   0: no curves.
#' @param sides Number of sides of a tube.
#' @param component Numbers of the components. NULL: the first three.
#' @param sd Standard deviations that a morph target of weight 1 stands for.
#' @param unit Metres in a unit of the mesh: 0.001 for mm. Shapes of a sample that was aligned with
#'   `scale = TRUE` have centroid size 1: `0.001 * mean(aligned$size)` for scans in mm.
#' @return The path of the file, invisibly.
#' @section Errors: of class `crestline_error`: the file has another ending, its folder does not
#'   exist, there is no surface or no such component.
#' @template glossary
#' @seealso [write_mesh()] for PLY, OBJ and STL, [write_page()] for the browser
#' @examples
#' ball <- Rvcg::vcgSphere(2)
#' file <- tempfile(fileext = ".glb")
#' write_glb(ball, file, colour = ball$vb[3, ])
#' file.size(file)
#' unlink(file)
#' @export
write_glb <- function(x, file, colour = NULL, plain = "#E3CDB8", tube = NULL, sides = 8,
                      component = NULL, sd = 3, unit = 0.001) {
  check_given()
  plain <- check_colour(plain, "plain")
  if (!is.null(tube)) tube <- check_number(tube, "tube", lower = 0)
  sides <- check_count(sides, "sides", lower = 3)
  sd <- check_number(sd, "sd", lower = 0, open = TRUE)
  unit <- check_number(unit, "unit", lower = 0, open = TRUE)
  file <- check_path_to_write(file, "file", "glb", "writing")
  ends <- if (inherits(x, "shape_pca")) component_ends(x, component, sd)
  surface <- if (is.null(ends)) written_mesh(x, "model") else ends$mean
  shape <- if (inherits(x, "shape")) x
  painted <- painted_mesh(surface, colour, shape, grDevices::hcl.colors(11, "Viridis"), NULL,
                          "#BEBEBE")
  if (is.null(painted$rgb)) painted$rgb <- t(grDevices::col2rgb(rep(plain, nrow(painted$xyz))))
  painted$normals <- t(with_normals(surface)$normals[1:3, , drop = FALSE])
  if (is.null(tube)) tube <- mesh_diagonal(surface) / 400
  tubes <- if (!is.null(shape) && tube > 0) {
    # The curves of a shape as tubes: `xyz`, `it`, `normals`, `rgb` of each
    paths <- Filter(function(path) NROW(path) > 1, shape$paths)
    kind <- shape$scheme$curves$kind[match(names(paths), shape$scheme$curves$curve)]
    Map(function(path, kind) {
      xyz <- as.matrix(as.data.frame(path)[c("x", "y", "z")])
      one <- tube_around(xyz[c(TRUE, rowSums(diff(xyz)^2) > 0), , drop = FALSE], tube, sides)
      one$rgb <- t(grDevices::col2rgb(rep(kind_colours[[kind]], nrow(one$xyz))))
      one
    }, paths, kind)
  }
  title <- if (is.null(shape)) "surface" else shape$id
  write_content(glb_bytes(title, painted, tubes, ends$morphs, unit), file)
  invisible(file)
}

#' The mean surface of components, and how far each moves its vertices and normals
#' @noRd
component_ends <- function(x, component, sd) {
  validate(x)
  if (is.null(component)) component <- seq_len(min(3, length(x$sdev)))
  check_component(component, x)
  mean <- shape_at(x, 1, 0, "mesh")
  morphs <- lapply(stats::setNames(component, sprintf("PC%d, %g sd", component, sd)), function(i) {
    end <- shape_at(x, i, sd, "mesh")
    list(xyz = t(end$vb[1:3, ] - mean$vb[1:3, ]), normals = t((end$normals - mean$normals)[1:3, ]))
  })
  list(mean = mean, morphs = morphs)
}

#' A tube about a polyline: rings of corners, each turned as little as can be from the one before
#' @noRd
tube_around <- function(xyz, radius, sides) {
  n <- nrow(xyz)
  ahead <- unit_rows(rbind(diff(xyz), xyz[n, ] - xyz[n - 1, ]))
  along <- unit_rows(rbind(ahead[1, ], ahead[-1, , drop = FALSE] + ahead[-n, , drop = FALSE]))
  up <- matrix(0, n, 3)
  start <- diag(3)[which.min(abs(along[1, ])), ]
  for (i in seq_len(n)) {
    up[i, ] <- start - sum(start * along[i, ]) * along[i, ]
    up[i, ] <- up[i, ] / sqrt(sum(up[i, ]^2))
    start <- up[i, ]
  }
  side <- cross_rows(along, up)
  turn <- 2 * pi * (seq_len(sides) - 1) / sides
  of <- rep(seq_len(n), each = sides)
  normals <- up[of, ] * cos(turn) + side[of, ] * sin(turn)
  ring <- seq_len(sides)
  following <- c(ring[-1], 1L)
  first <- rep((seq_len(n - 1) - 1L) * sides, each = sides)
  it <- rbind(cbind(first + ring, first + following, first + sides + ring),
              cbind(first + following, first + sides + following, first + sides + ring))
  list(xyz = xyz[of, ] + radius * normals, it = it, normals = normals)
}

unit_rows <- function(x) x / sqrt(rowSums(x^2))

#' The bytes of a .glb file
#' @noRd
glb_bytes <- function(title, surface, tubes, morphs, unit) {
  buffer <- glb_buffer()
  parts <- c(stats::setNames(list(surface), title), tubes)
  meshes <- Map(glb_mesh, unname(parts), names(parts), MoreArgs = list(buffer = buffer))
  if (length(morphs)) {
    meshes[[1]]$primitives[[1]]$targets <- lapply(unname(morphs), function(morph) {
      list(POSITION = buffer$add(morph$xyz, bounds = TRUE), NORMAL = buffer$add(morph$normals))
    })
    meshes[[1]]$weights <- I(rep(0, length(morphs)))
    meshes[[1]]$extras <- list(targetNames = I(names(morphs)))
  }
  nodes <- Map(function(name, i) list(name = name, mesh = i), names(parts), seq_along(parts) - 1L)
  root <- list(name = "crestline", scale = rep(unit, 3), children = I(seq_along(parts)))
  material <- list(name = "surface", doubleSided = TRUE,
                   pbrMetallicRoughness = list(metallicFactor = 0, roughnessFactor = 0.8))
  made <- paste("crestline", utils::packageVersion("crestline"))
  bytes <- buffer$bytes()
  json <- jsonlite::toJSON(list(
    asset = list(version = "2.0", generator = made), scene = 0L,
    scenes = list(list(nodes = I(0L))), nodes = unname(c(list(root), nodes)), meshes = meshes,
    materials = list(material), accessors = buffer$accessors(), bufferViews = buffer$views(),
    buffers = list(list(byteLength = length(bytes)))
  ), auto_unbox = TRUE, digits = NA)
  chunks <- c(glb_chunk(charToRaw(enc2utf8(json)), "JSON", as.raw(0x20)),
              glb_chunk(bytes, c("BIN", ""), as.raw(0)))
  c(charToRaw("glTF"), as.vector(bytes_of(c(2L, 12L + length(chunks)), 4L)), chunks)
}

#' A chunk of a .glb file: its length, its kind, and what is in it, filled up to a multiple of four
#' @noRd
glb_chunk <- function(bytes, kind, filler) {
  bytes <- c(bytes, rep(filler, -length(bytes) %% 4))
  kind <- charToRaw(paste(kind, collapse = ""))
  c(as.vector(bytes_of(length(bytes), 4L)), c(kind, raw(4 - length(kind))), bytes)
}

#' A mesh of the format: one primitive with positions, normals and colours
#' @noRd
glb_mesh <- function(part, name, buffer) {
  list(name = name, primitives = list(list(
    attributes = list(POSITION = buffer$add(part$xyz, bounds = TRUE),
                      NORMAL = buffer$add(part$normals), COLOR_0 = buffer$add(linear(part$rgb))),
    indices = buffer$add(matrix(as.integer(t(part$it)) - 1L, ncol = 1)), material = 0L
  )))
}

#' Colours from 0 to 255 as linear values from 0 to 1 (IEC 61966-2-1)
#' @noRd
linear <- function(rgb) {
  share <- rgb / 255
  ifelse(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055)^2.4)
}

#' What gathers the numbers of a .glb file, and their descriptions
#' @noRd
glb_buffer <- function() {
  stored <- list()
  accessors <- list()
  views <- list()
  at <- 0
  single <- function(x) readBin(writeBin(as.vector(x), raw(), 4, "little"), "double",
                                length(x), 4, endian = "little")
  add <- function(values, bounds = FALSE) {
    index <- is.integer(values)
    bytes <- as.vector(bytes_of(values, 4L))
    number <- length(accessors)
    views[[number + 1]] <<- list(buffer = 0L, byteOffset = at, byteLength = length(bytes),
                                 target = if (index) 34963L else 34962L)
    one <- list(bufferView = number, componentType = if (index) 5125L else 5126L,
                count = nrow(values), type = if (index) "SCALAR" else "VEC3")
    if (bounds) {
      one$min <- single(apply(values, 2, min))
      one$max <- single(apply(values, 2, max))
    }
    accessors[[number + 1]] <<- one
    stored[[number + 1]] <<- bytes
    at <<- at + length(bytes)
    number
  }
  list(add = add, bytes = function() unlist(stored), views = function() views,
       accessors = function() accessors)
}
