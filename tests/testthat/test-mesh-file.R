# A ball whose co-ordinates need all the digits of a double; far from 0, single precision loses
# them.
far_ball <- function() {
  ball <- ball_mesh(2)
  ball$vb[1:3, ] <- ball$vb[1:3, ] * pi + c(1e5, -1e-7, 1 / 3)
  ball
}
mesh_file <- function(extension) tempfile(fileext = paste0(".", extension))
rainbow_of <- function(mesh) grDevices::hcl.colors(ncol(mesh$vb), "Spectral")

test_that("co-ordinates and triangles come back to the last bit in order from PLY and OBJ", {
  ball <- far_ball()
  for (extension in c("ply", "PLY", "obj")) for (ascii in c(FALSE, TRUE)) {
    file <- mesh_file(extension)
    expect_identical(write_mesh(ball, file, ascii = ascii), file)
    mesh <- read_specimen(file)$mesh
    expect_identical(mesh$vb, ball$vb)
    expect_identical(mesh$it, ball$it)
    expect_null(mesh$material$color)
  }
})

test_that("STL keeps triangles: corners to the last bit as text, to single precision else", {
  ball <- far_ball()
  corners <- ball$vb[1:3, ball$it]
  for (ascii in c(FALSE, TRUE)) {
    file <- mesh_file("stl")
    write_mesh(ball, file, ascii = ascii)
    mesh <- read_mesh(file)
    again <- mesh$vb[1:3, mesh$it]
    if (ascii) expect_identical(again, corners) else
      expect_equal(again, corners, tolerance = tolerances$single)
    expect_equal(ncol(read_specimen(file)$mesh$vb), ncol(ball$vb))
    expect_equal(identical(rawToChar(readBin(file, "raw", 5)), "solid"), ascii)
  }
})

test_that("natural colours are kept, others are as given", {
  ball <- ball_mesh(1)
  ball$material <- list(color = rainbow_of(ball))
  own <- specimen(ball)
  for (extension in c("ply", "obj")) for (ascii in c(FALSE, TRUE)) {
    file <- mesh_file(extension)
    colours <- function(...) {
      write_mesh(..., ascii = ascii)
      read_specimen(file)$mesh$material$color
    }
    expect_equal(colours(own, file), rainbow_of(ball))
    expect_equal(colours(ball, file), rainbow_of(ball))
    expect_equal(colours(ball, file, "#010203"), rep("#010203", ncol(ball$vb)))
    expect_equal(colours(ball, file, rev(rainbow_of(ball))), rev(rainbow_of(ball)))
  }
})

# The elements of a PLY file, all their properties.
ply_table <- function(file) {
  header <- ply_header(file_bytes(file, "x"), file, "x")
  ply_elements_read(ply_stream(header, file, "x"), header$elements)$table
}

test_that("numbers become colours of the palette, and PLY keeps them", {
  ball <- ball_mesh(1)
  value <- c(NA, -3, 1, 0, rep(7.125, ncol(ball$vb) - 4))
  for (ascii in c(FALSE, TRUE)) {
    file <- mesh_file("ply")
    write_mesh(ball, file, value, palette = c("#000000", "#FFFFFF"), limits = c(0, 2),
               missing = "#0000FF", ascii = ascii)
    expect_equal(read_specimen(file)$mesh$material$color[1:5],
                 c("#0000FF", "#000000", "#7F7F7F", "#000000", "#FFFFFF"))
    vertex <- ply_table(file)$vertex
    expect_true(is.na(vertex$quality[1]))
    expect_identical(vertex$quality[-1], value[-1])
  }
  write_mesh(ball, file, ball$vb[3, ], palette = c("#000000", "#FFFFFF"))
  expect_setequal(range(read_mesh(file)$material$color), c("#000000", "#FFFFFF"))
})

test_that("the surface of a shape is written with the rows of its points", {
  shape <- quad_shape()
  file <- mesh_file("ply")
  row_of <- function(file) ply_table(file)$vertex$row
  write_mesh(shape, file)
  mesh <- read_mesh(file)
  expect_identical(t(mesh$vb[1:3, ]), unname(coords(shape, "surface")[row_of(file), ]))
  expect_equal(mesh$it, shape_mesh(shape)$it)
  dense <- shape_mesh(shape, specimen = quad_specimen(), dense = 2)
  write_mesh(dense, file, "patch", ascii = TRUE)
  expect_identical(read_mesh(file)$vb, dense$vb)
  expect_equal(row_of(file), ifelse(is.na(attr(dense, "row")), 0, attr(dense, "row")))
})

test_that("patches have a colour each; numbers for surface points are taken by their rows", {
  shape <- two_patch_shape()
  file <- mesh_file("ply")
  colours <- function(...) {
    write_mesh(shape, file, ...)
    read_mesh(file)$material$color
  }
  part <- shape$points$part[shape$points$level == "surface"][attr(shape_mesh(shape), "row")]
  expect_equal(nrow(unique(data.frame(part, colours("patch")))), 2)
  expect_length(unique(colours("patch")), 2)
  n <- nrow(coords(shape, "surface"))
  by_row <- colours(as.numeric(seq_len(n)), palette = c("#000000", "#FFFFFF"), limits = c(1, n))
  expect_equal(by_row,
               grDevices::grey(floor(255 * (attr(shape_mesh(shape), "row") - 1) / (n - 1)) / 255))
  expect_equal(colours("se"), rep("#BEBEBE", length(part)))
  shape$points$se[which(shape$points$level == "surface")[3]] <- 0.5
  expect_equal(sum(colours("se") != "#BEBEBE"), 1)
})

test_that("quads are cut in two, and a mesh of another scale is brought to its own", {
  quads <- structure(list(vb = rbind(c(0, 2, 2, 0), c(0, 0, 2, 2), 0, 2), ib = cbind(1:4)),
                     class = "mesh3d")
  file <- mesh_file("obj")
  write_mesh(quads, file)
  expect_equal(read_mesh(file)$it, cbind(1:3, c(1, 3, 4)))
  expect_equal(read_mesh(file)$vb[1:3, 3], c(1, 1, 0))
})

test_that("other readers agree", {
  ball <- ball_mesh(2)
  for (extension in c("ply", "obj", "stl")) {
    file <- mesh_file(extension)
    write_mesh(ball, file)
    mesh <- Rvcg::vcgImport(file, readcolor = FALSE, clean = FALSE, silent = TRUE)
    expect_equal(ncol(mesh$it), ncol(ball$it))
    expect_equal(unname(mesh$vb[1:3, mesh$it]), unname(ball$vb[1:3, ball$it]),
                 tolerance = tolerances$single)
  }
  write_mesh(ball, file <- mesh_file("ply"), rainbow_of(ball))
  coloured <- Rvcg::vcgImport(file, readcolor = TRUE, clean = FALSE, silent = TRUE)
  expect_equal(as.vector(coloured$material$color), rainbow_of(ball))
})

test_that("what cannot be written is refused with the remedy, what a format lacks is told", {
  ball <- ball_mesh(1)
  expect_crestline_error(write_mesh(ball, "ball.off"), c("ball.off", "Known: .ply, .obj, .stl"))
  expect_crestline_error(write_mesh(ball, 5), "path of one file")
  expect_crestline_error(write_mesh(ball, "/none/at/all.ply"),
                         c("all.ply", "There is no folder /none/at"))
  expect_crestline_error(write_mesh("ball", "ball.ply"), "mesh3d")
  expect_crestline_error(write_mesh(structure(list(vb = ball$vb), class = "mesh3d"), "a.ply"),
                         "no triangles")
  expect_crestline_error(write_mesh(ball, "ball.ply", 1:5), "5 numbers")
  expect_crestline_error(write_mesh(ball, "ball.ply", c("red", "blue")), "2 values")
  expect_crestline_error(write_mesh(ball, "ball.ply", "patch"), "no patches")
  expect_crestline_error(write_mesh(ball, "ball.ply", "se"), "no shape")
  file <- mesh_file("stl")
  expect_warning(write_mesh(ball, file, "red"), "no colours", class = "crestline_format_warning")
  expect_true(file.exists(file))
})
