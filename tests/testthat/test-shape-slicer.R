slicer_folder <- function(...) {
  dir <- tempfile("slicer")
  write_slicer(quad_shape(), dir, ...)
  dir
}

test_that("the folder has model, scan, landmarks and curves, which read back as they are", {
  dir <- slicer_folder(specimen = quad_specimen())
  on.exit(unlink(dir, recursive = TRUE))
  expect_setequal(list.files(dir), c("model.vtk", "scan.vtk", "landmarks.mrk.json",
                                     "curves.mrk.json"))
  shape <- quad_shape()
  expect_equal(read_landmarks(file.path(dir, "landmarks.mrk.json")), coords(shape, "landmarks"),
               ignore_attr = TRUE)
  curves <- read_curves(file.path(dir, "curves.mrk.json"))
  own <- written_landmarks(shape)$curves
  expect_named(curves, names(own))
  for (name in names(own)) expect_equal(unclass(curves[[name]]), unclass(own[[name]]),
                                        ignore_attr = TRUE)
  markup <- jsonlite::fromJSON(file.path(dir, "curves.mrk.json"), simplifyVector = FALSE)$markups
  grade <- quality(shape)
  grade <- grade$grade[match(vapply(markup, `[[`, "", "name"), grade$part)]
  colour <- vapply(markup, function(one) {
    grDevices::rgb(t(unlist(one$display$color)))
  }, "")
  expect_equal(colour, unname(grade_colours[as.character(grade)]))
})

test_that("the model has its triangles and scalars, in the frame that Slicer takes them for", {
  shape <- quad_shape()
  n <- sum(shape$points$level == "surface")
  dir <- slicer_folder(values = list(rank = seq_len(n)))
  on.exit(unlink(dir, recursive = TRUE))
  lines <- readLines(file.path(dir, "model.vtk"))
  expect_match(lines[2], "SPACE=LPS")
  model <- shape_mesh(shape)
  k <- ncol(model$vb)
  start <- match(sprintf("POINTS %d double", k), lines)
  xyz <- t(vapply(strsplit(lines[start + seq_len(k)], " "), as.numeric, numeric(3)))
  expect_equal(xyz, t(model$vb[1:3, ]), tolerance = 1e-7, ignore_attr = TRUE)
  at <- match("SCALARS rank double 1", lines) + 1
  row <- attr(model, "row")
  expect_equal(as.numeric(lines[at + seq_len(k)])[row > 0], as.numeric(row[row > 0]))
  faces <- grep("^3 ", lines, value = TRUE)[seq_len(ncol(model$it))]
  expect_equal(faces[1], paste("3", paste(model$it[, 1] - 1, collapse = " ")))
  expect_crestline_error(slicer_folder(values = list(rank = 1)), "`values`")
  expect_crestline_error(slicer_folder(values = list("a b" = seq_len(n))), "`values`")
  expect_crestline_error(write_slicer(shape, file.path(dir, "model.vtk")), "`dir`")
})
