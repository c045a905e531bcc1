# Binary glTF files, read back by their own description.

# JSON and numbers of a file: `read(i)` gives the rows of accessor i, from 0.
glb <- function(file) {
  bytes <- readBin(file, "raw", file.size(file))
  whole <- function(at) readBin(bytes[at + 0:3], "integer", 1, 4, endian = "little")
  expect_identical(rawToChar(bytes[1:4]), "glTF")
  expect_identical(c(whole(5), whole(9)), c(2L, length(bytes)))
  size <- whole(13)
  expect_identical(rawToChar(bytes[17:20]), "JSON")
  json <- jsonlite::fromJSON(rawToChar(bytes[20 + seq_len(size)]), simplifyDataFrame = FALSE)
  expect_identical(whole(21 + size), length(bytes) - 28L - size)
  expect_identical(json$buffers[[1]]$byteLength, whole(21 + size))
  binary <- bytes[-seq_len(28 + size)]
  json$read <- function(i) {
    accessor <- json$accessors[[i + 1]]
    view <- json$bufferViews[[accessor$bufferView + 1]]
    own <- binary[view$byteOffset + seq_len(view$byteLength)]
    k <- if (accessor$type == "VEC3") 3 else 1
    type <- if (accessor$componentType == 5125) "integer" else "double"
    values <- matrix(readBin(own, type, accessor$count * k, 4, endian = "little"), k)
    if (!is.null(accessor$min)) {
      expect_equal(cbind(accessor$min, accessor$max), t(apply(values, 1, range)), tolerance = 1e-14)
    }
    t(values)
  }
  json
}

test_that("positions, triangles, normals and colours of a mesh come back in single precision", {
  ball <- ball_mesh(2)
  file <- tempfile(fileext = ".glb")
  expect_identical(write_glb(ball, file, colour = "#FF8000", unit = 1), file)
  scene <- glb(file)
  own <- scene$meshes[[1]]$primitives[[1]]
  expect_equal(t(scene$read(own$attributes$POSITION)), ball$vb[1:3, ],
               tolerance = tolerances$single)
  expect_identical(matrix(scene$read(own$indices)[, 1] + 1L, 3), matrix(as.integer(ball$it), 3))
  normals <- scene$read(own$attributes$NORMAL)
  expect_equal(rowSums(normals^2), rep(1, ncol(ball$vb)), tolerance = 1e-5)
  # Linear light of 128 of 255, IEC 61966-2-1
  expect_equal(unique(round(scene$read(own$attributes$COLOR_0), 4)), cbind(1, 0.2159, 0))
  expect_identical(scene$nodes[[1]]$scale, c(1L, 1L, 1L))
})

test_that("a shape has its curves as tubes of the given radius, by name", {
  shape <- quad_shape()
  file <- tempfile(fileext = ".glb")
  write_glb(shape, file, tube = 0.01)
  scene <- glb(file)
  names <- vapply(scene$meshes, `[[`, "", "name")
  there <- names(Filter(Negate(is.null), shape$paths))
  expect_identical(names, c(shape$id, there))
  path <- as.matrix(as.data.frame(shape$paths[[there[1]]])[c("x", "y", "z")])
  corners <- scene$read(scene$meshes[[2]]$primitives[[1]]$attributes$POSITION)
  far <- apply(corners, 1, function(p) sqrt(min(colSums((t(path) - p)^2))))
  expect_equal(far, rep(0.01, nrow(corners)), tolerance = 1e-3)
  write_glb(shape, file, tube = 0)
  expect_length(glb(file)$meshes, 1)
})

test_that("components are morph targets: their ends are those of shape_at()", {
  ball <- ball_mesh(2)
  stretch <- list(c(1, 1.1, 0.9), c(1.1, 1, 1), c(0.95, 1, 1.2), c(1, 0.9, 1), c(1.2, 1.1, 1))
  balls <- simplify2array(lapply(stretch, function(by) t(ball$vb[1:3, ] * by)))
  pca <- shape_pca(align(balls, "ball", triangles = ball$it))
  file <- tempfile(fileext = ".glb")
  write_glb(pca, file, component = 2:1, sd = 2)
  scene <- glb(file)
  own <- scene$meshes[[1]]
  expect_identical(own$extras$targetNames, c("PC2, 2 sd", "PC1, 2 sd"))
  moved <- scene$read(own$primitives[[1]]$attributes$POSITION) +
    scene$read(own$primitives[[1]]$targets[[2]]$POSITION)
  expect_equal(t(moved), shape_at(pca, 1, 2, "mesh")$vb[1:3, ], tolerance = tolerances$single)
  expect_crestline_error(write_glb(pca, file, component = 9), "component")
  expect_crestline_error(write_glb(ball, "x.ply"), ".glb")
})
