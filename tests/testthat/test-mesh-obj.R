obj_file <- function(..., folder = tempfile("obj")) {
  dir.create(folder, showWarnings = FALSE)
  file <- file.path(folder, "square.obj")
  writeLines(c(...), file)
  file
}
corners <- c("v 0 0 0", "v 1 0 0", "v 1 1 0.123456789012", "v 0 1 0")
two <- cbind(1:3, c(1, 3, 4))

test_that("faces are read in all their spellings", {
  texture <- c("vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1")
  normal <- "vn 0 0 1"
  spelled <- list(
    c(corners, "f 1 2 3", "f 1 3 4"), c(corners, "f 1 2 3 4"), c(corners, "f -4 -3 -2 -1"),
    c("# a comment", "o thing", corners, normal, "g one", "f 1//1 2//1 3//1", "s off",
      "f 1//1 3//1 4//1"),
    c(corners, texture, "f 1/1 2/2 3/3", "f 1/1 3/3 4/4"),
    c(corners, texture, normal, "f 1/1/1 2/2/1 3/3/1 4/4/1"),
    c(corners, texture, "f -4/-4 -3/-3 -2/-2 -1/-1"),
    c(corners[1:3], "f 1 2 3", corners[4], "f -4 -2 -1"),
    c(paste0("  ", corners), "f\t1  2\t3 ", "f 1 3 4\r")
  )
  for (lines in spelled) {
    mesh <- read_mesh(obj_file(lines), "square")
    expect_equal(mesh$it, two)
    expect_equal(mesh$vb[, 3], c(1, 1, 0.123456789012, 1), tolerance = 1e-15)
  }
})

test_that("triangles and larger polygons may stand together", {
  mesh <- read_mesh(obj_file(corners, "f 1 2 3", "f 1 2 3 4", "f 4 3 2 1 2"), "square")
  expect_equal(mesh$it, cbind(1:3, 1:3, c(1, 3, 4), c(4, 3, 2), c(4, 2, 1), c(4, 1, 2)))
})

test_that("colours behind the co-ordinates are kept", {
  lines <- paste(corners, c("1 0 0", "0 1 0", "0 0 1", "1 1 1"))
  s <- read_specimen(obj_file(lines, "f 1 2 3 4"))
  expect_equal(s$mesh$material$color, c("#FF0000", "#00FF00", "#0000FF", "#FFFFFF"))
  bytes <- paste(corners, c("255 0 0", "0 255 0", "0 0 255", "255 255 255"))
  expect_equal(read_specimen(obj_file(bytes, "f 1 2 3 4"))$mesh$material$color,
               s$mesh$material$color)
})

# A picture of 2 x 2 blocks of 4 pixels: red green above, blue white below.
block_picture <- function() {
  block <- function(a, b, c, d) {
    rbind(cbind(matrix(a, 4, 4), matrix(b, 4, 4)), cbind(matrix(c, 4, 4), matrix(d, 4, 4)))
  }
  array(c(block(1, 0, 0, 1), block(0, 1, 0, 1), block(0, 0, 1, 1)), c(8, 8, 3))
}
textured <- function(picture, material = c("newmtl skin", "Kd 1 1 1", paste("map_Kd", picture)),
                     library = "a b.mtl") {
  file <- obj_file(paste("mtllib", library), corners, "vt 0.1 0.1", "vt 0.9 0.1", "vt 0.9 0.9",
                   "vt 0.1 0.9", "usemtl skin", "f 1/1 2/2 3/3 4/4")
  writeLines(material, file.path(dirname(file), "a b.mtl"))
  file
}
expected <- c("#0000FF", "#FFFFFF", "#00FF00", "#FF0000")

test_that("a png texture is sampled at the vertices, its first row on top", {
  skip_if_not_installed("png")
  file <- textured("my skin.png")
  png::writePNG(block_picture(), file.path(dirname(file), "my skin.png"))
  expect_equal(read_specimen(file)$mesh$material$color, expected)
  file <- textured("-s 1 1 1 skin.png")
  png::writePNG(block_picture(), file.path(dirname(file), "skin.png"))
  expect_equal(read_specimen(file)$mesh$material$color, expected)
})

test_that("a jpg texture is sampled at the vertices", {
  skip_if_not_installed("jpeg")
  file <- textured("skin.jpg")
  jpeg::writeJPEG(block_picture(), file.path(dirname(file), "skin.jpg"), quality = 1)
  got <- grDevices::col2rgb(read_specimen(file)$mesh$material$color)
  expect_lt(max(abs(got - grDevices::col2rgb(expected))), 60)
})

test_that("several materials each colour their own faces, seams do not split vertices", {
  skip_if_not_installed("png")
  file <- obj_file("mtllib two.mtl", corners, "vt 0.1 0.9", "vt 0.9 0.9", "usemtl a",
                   "f 1/1 2/1 3/1", "usemtl b", "f 1/2 3/2 4/2")
  writeLines(c("newmtl a", "map_Kd p.png", "newmtl b", "map_Kd p.png"),
             file.path(dirname(file), "two.mtl"))
  png::writePNG(block_picture(), file.path(dirname(file), "p.png"))
  s <- read_specimen(file)
  expect_equal(ncol(s$mesh$vb), 4)
  expect_equal(s$mesh$material$color, c("#FF0000", "#FF0000", "#FF0000", "#00FF00"))
})

test_that("a missing, unreadable or unknown texture is a warning, not an error", {
  expect_warning(s <- read_specimen(textured("gone.png"), id = "s9"), "s9.*gone.png is not there",
                 class = "crestline_warning")
  expect_null(s$mesh$material$color)
  file <- textured("skin.tga")
  writeLines("x", file.path(dirname(file), "skin.tga"))
  expect_warning(read_specimen(file), "neither jpg nor png")
  skip_if_not_installed("png")
  file <- textured("skin.png")
  writeLines("x", file.path(dirname(file), "skin.png"))
  expect_warning(read_specimen(file), "cannot be read")
  expect_null(
    expect_no_warning(read_specimen(textured("gone.png",
                                             library = "none.mtl")))$mesh$material$color)
})

test_that("damaged files are refused", {
  expect_crestline_error(read_specimen(obj_file("hello")), c("square", "no vertices"),
                         id = "square")
  expect_crestline_error(read_specimen(obj_file(corners, "f 1 2 9")), "do not exist")
  expect_crestline_error(read_specimen(obj_file(corners, "f 0 1 2")), "do not exist")
  expect_crestline_error(read_specimen(obj_file(corners, "f a b c")), "do not exist")
  expect_crestline_error(read_specimen(obj_file(corners, "f -9 1 2")), "do not exist")
  expect_crestline_error(read_specimen(obj_file("v 1 2", corners, "f 1 2 3")), "cannot be read")
  expect_crestline_error(read_specimen(obj_file("v 1 2 x", corners, "f 1 2 3")), "cannot be read")
})

test_that("lines go on behind a backslash, comments end them, weights are no colours", {
  long <- c("# C:\\scans\\", sub(" ([^ ]+)$", " \\\\\n \\1", corners), "f 1 2 \\", " 3 4")
  expect_equal(read_mesh(obj_file(long), "square")$it, two)
  expect_equal(read_mesh(obj_file(long), "square")$vb[, 3], c(1, 1, 0.123456789012, 1))
  noted <- c(paste(corners, "# a 1 2"), "f 1 2 3#4", "f 1 3 4 # 2")
  expect_equal(read_mesh(obj_file(noted), "square")$it, two)
  weighed <- read_mesh(obj_file(paste(corners, "1.0"), "f 1 2 3 4"), "square")
  expect_equal(weighed$it, two)
  expect_null(weighed$material)
  expect_null(read_mesh(obj_file(paste(corners[1], "1 0 0"), corners[-1], "f 1 2 3 4"),
                        "square")$material)
  others <- c("mtllib none.mtl", "o a", "g b c", "s 1", corners, "vn 0 0 1", "vp 0.1", "l 1 2 3",
              "p 1 2", "f 1 2 3 4", "g")
  expect_equal(read_mesh(obj_file(others), "square")$it, two)
})

test_that("corners that are no whole numbers, or beyond all vertices, are refused", {
  for (face in c("f 1 2 3.9", "f 1 2 0", "f -1 -2 -5", "f 1 2 99999999999", "f 1 2 1e400",
                 "f 1 2 nan")) {
    expect_crestline_error(read_specimen(obj_file(corners, "f 1 2 3", face), id = "o"),
                           c("o, mesh", "1 of 2 faces", "do not exist"))
  }
  expect_equal(read_mesh(obj_file(corners, "f 1 2 3.0"), "o")$it, cbind(1:3))
})

test_that("a material file of another encoding, a pipe or a device keeps no mesh from reading", {
  folder <- tempfile("obj")
  dir.create(folder)
  body <- c("v 0 0 0", "v 1 0 0", "v 0 1 0", "vt 0 0", "usemtl a", "f 1/1 2/1 3/1", "")
  read <- function(library) {
    file <- file.path(folder, "a.obj")
    writeBin(c(charToRaw("mtllib "), library,
               charToRaw(paste0("\n", paste(body, collapse = "\n")))), file)
    ncol(read_mesh(file, "a")$it)
  }
  expect_equal(read(c(charToRaw("Gr"), as.raw(0xfc), charToRaw("n.mtl"))), 1)
  skip_on_os("windows")
  system2("mkfifo", file.path(folder, c("p.mtl", "p.png")))
  writeLines(c("newmtl a", "map_Kd p.png"), file.path(folder, "q.mtl"))
  expect_equal(read(charToRaw("p.mtl")), 1)
  expect_warning(expect_equal(read(charToRaw("q.mtl")), 1), "p.png cannot be read")
})
