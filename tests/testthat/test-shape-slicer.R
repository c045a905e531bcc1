slicer_folder <- function(...) {
  dir <- tempfile("slicer")
  write_slicer(quad_shape(), dir, ...)
  dir
}

# Elements of a scene: list by tag of named character vectors.
scene_nodes <- function(file) {
  lines <- readLines(file, encoding = "UTF-8")
  expect_identical(lines[c(1:2, length(lines))],
                   c("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", "<MRML>", "</MRML>"))
  lines <- lines[-c(1:2, length(lines))]
  tag <- sub("^<([A-Za-z]+) .*", "\\1", lines)
  expect_true(all(endsWith(lines, paste0("></", tag, ">"))))
  stats::setNames(lapply(lines, function(line) {
    part <- regmatches(line, gregexpr("[A-Za-z]+=\"[^\"<>]*\"", line))[[1]]
    stats::setNames(sub("^[A-Za-z]+=\"(.*)\"$", "\\1", part), sub("=.*", "", part))
  }), tag)
}

test_that("the scene names every file, and what it has reads back as it is", {
  dir <- slicer_folder(specimen = quad_specimen())
  on.exit(unlink(dir, recursive = TRUE))
  shape <- quad_shape()
  own <- written_landmarks(shape)$curves
  expect_setequal(list.files(dir, recursive = TRUE), c(
    "scene.mrml", "model.vtk", "scan.vtk", "landmarks.mrk.json",
    file.path("curves", paste0(names(own), ".mrk.json"))
  ))
  expect_equal(read_landmarks(file.path(dir, "landmarks.mrk.json")), coords(shape, "landmarks"),
               ignore_attr = TRUE)
  grade <- quality(shape)
  for (name in names(own)) {
    file <- file.path(dir, "curves", paste0(name, ".mrk.json"))
    expect_equal(unclass(read_curves(file)[[name]]), unclass(own[[name]]), ignore_attr = TRUE)
    markup <- jsonlite::fromJSON(file, simplifyVector = FALSE)$markups[[1]]
    expect_equal(grDevices::rgb(t(unlist(markup$display$color))),
                 grade_colours[[as.character(grade$grade[match(name, grade$part)])]])
  }
})

test_that("a scene's nodes refer to their display and file, as Slicer reads them", {
  dir <- slicer_folder(specimen = quad_specimen())
  on.exit(unlink(dir, recursive = TRUE))
  nodes <- scene_nodes(file.path(dir, "scene.mrml"))
  storage <- nodes[grepl("Storage$", names(nodes))]
  display <- nodes[grepl("Display$", names(nodes))]
  data <- nodes[!grepl("(Storage|Display)$", names(nodes))]
  curves <- names(written_landmarks(quad_shape())$curves)
  expect_identical(unname(names(data)), c("Model", "Model", "MarkupsFiducial",
                                          rep("MarkupsCurve", length(curves))))
  at <- function(nodes, name) unname(vapply(nodes, `[[`, "", name))
  expect_identical(at(data, "storageNodeRef"), at(storage, "id"))
  expect_identical(at(data, "displayNodeRef"), at(display, "id"))
  expect_identical(unique(at(storage, "coordinateSystem")), "LPS")
  ids <- at(nodes, "id")
  expect_identical(sub("[0-9]+$", "", ids), paste0("vtkMRML", names(nodes), "Node"))
  expect_identical(anyDuplicated(ids), 0L)
  file <- gsub("%25", "%", gsub("%20", " ", at(storage, "fileName")))
  expect_setequal(file, setdiff(list.files(dir, recursive = TRUE), "scene.mrml"))
  expect_identical(utils::tail(at(data, "name"), length(curves)), curves)
  expect_identical(display[[1]][["activeScalarName"]], "se")
  # Names with every sign that XML or an address takes for its own
  odd <- scene_xml(list(markups_node("curves/a%2F 'b' & c.json", "a/ 'b' & \"c\" <d>", "Curve",
                                     "#FF0000")))
  expect_match(odd, "fileName=\"curves/a%252F%20%27b%27%20&amp;%20c.json\"", fixed = TRUE)
  expect_match(odd, "name=\"a/ 'b' &amp; &quot;c&quot; &lt;d&gt;\"", fixed = TRUE)
})

test_that("a folder that is written again keeps nothing of the former scene, and all else", {
  dir <- slicer_folder(specimen = quad_specimen())
  on.exit(unlink(dir, recursive = TRUE))
  writeLines("mine", file.path(dir, "notes.txt"))
  writeLines("{}", file.path(dir, "curves", "gone.mrk.json"))
  write_slicer(quad_shape(), dir)
  expect_true(file.exists(file.path(dir, "notes.txt")))
  expect_false(any(file.exists(file.path(dir, c("scan.vtk", "curves/gone.mrk.json")))))
  nodes <- scene_nodes(file.path(dir, "scene.mrml"))
  expect_false(any(grepl("scan", vapply(nodes, `[[`, "", "name"))))
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
  display <- scene_nodes(file.path(dir, "scene.mrml"))$ModelDisplay
  expect_identical(display[["activeScalarName"]], "rank")
  expect_equal(as.numeric(strsplit(display[["scalarRange"]], " ")[[1]]),
               range(0, as.numeric(lines[at + seq_len(k)])))
  faces <- grep("^3 ", lines, value = TRUE)[seq_len(ncol(model$it))]
  expect_equal(faces[1], paste("3", paste(model$it[, 1] - 1, collapse = " ")))
  expect_crestline_error(slicer_folder(values = list(rank = 1)), "`values`")
  expect_crestline_error(slicer_folder(values = list("a b" = seq_len(n))), "`values`")
  expect_crestline_error(write_slicer(shape, file.path(dir, "model.vtk")), "`dir`")
})
