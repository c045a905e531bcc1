two_arcs <- function() {
  array(round(with_seed(1, rnorm(36)), 6), c(4, 3, 3),
        list(paste(rep(c("left arc", "bow"), each = 2), 1:2), c("x", "y", "z"), c("a", "b c", "d")))
}

test_that("Morphologika's blocks have names, groups, points and the lines of curves", {
  x <- two_arcs()
  file <- tempfile(fileext = ".txt")
  on.exit(unlink(file))
  expect_identical(write_morphologika(x, file, "curves", c("u", "v", "u")), file)
  lines <- readLines(file)
  block <- function(name) {
    from <- match(sprintf("[%s]", name), lines)
    to <- c(grep("^\\[", lines), length(lines) + 1)
    lines[(from + 1):(min(to[to > from]) - 1)]
  }
  expect_equal(block("individuals"), "3")
  expect_equal(block("landmarks"), "4")
  expect_equal(block("dimensions"), "3")
  expect_equal(block("names"), c("a", "b c", "d"))
  expect_equal(block("labelvalues"), c("u", "v", "u"))
  expect_equal(block("wireframe"), c("1 2", "3 4"))
  points <- block("rawpoints")
  expect_equal(points[6], "'b c")
  expect_equal(as.numeric(strsplit(points[8], " ")[[1]]), unname(x[2, , 2]))
  skip_if_not_installed("geomorph")
  expect_equal(unname(geomorph::read.morphologika(file)$coords), unname(x), ignore_attr = TRUE)
})

test_that("only curves have lines: landmarks that are named by numbers have none", {
  x <- two_arcs()
  rownames(x) <- paste("LM", 1:4)
  file <- tempfile(fileext = ".txt")
  on.exit(unlink(file))
  for (one in list(x, suppressWarnings(align(x, "landmarks")))) {
    expect_false("[wireframe]" %in% readLines(write_morphologika(one, file)))
  }
  expect_true("[wireframe]" %in% readLines(write_morphologika(x, file, "curves")))
})

test_that("MorphoJ's table has a row a specimen, and groups a table of their own", {
  x <- two_arcs()
  file <- tempfile(fileext = ".txt")
  files <- write_morphoj(x, file, group = c(d = "u", a = "v", "b c" = "w"))
  on.exit(unlink(files))
  table <- utils::read.delim(files[1], check.names = FALSE)
  expect_equal(names(table)[1:5], c("ID", "x1", "y1", "z1", "x2"))
  expect_equal(unname(unlist(table[2, -1])), as.vector(t(x[, , 2])))
  expect_equal(utils::read.delim(files[2])$group, c("v", "w", "u"))
  expect_length(write_morphoj(x, file), 1)
  x[2, 1, 2] <- NA
  expect_crestline_error(write_morphoj(x, file), c("point 2", "b c", "missing"))
  expect_crestline_error(write_morphologika(two_arcs(), "x.csv"), "ends in .txt")
})

test_that("an alignment and a sample are written too", {
  x <- align(two_arcs(), "curves")
  file <- tempfile(fileext = ".txt")
  on.exit(unlink(file))
  write_morphologika(x, file)
  expect_true("'b c" %in% readLines(file))
})
