# Tables that a wrong program wrote, with checksums that fit.

# A norm's folder after a change of one file: lines to lines, or of norms.json header to header.
forged <- function(file, change, norms = small_norms()) {
  dir <- tempfile("norms")
  write_norms(norms, dir)
  json <- file.path(dir, "norms.json")
  header <- jsonlite::fromJSON(json, simplifyVector = FALSE)
  if (file != "norms.json") {
    path <- file.path(dir, file)
    writeLines(change(readLines(path)), path)
    header$tables[[file]] <- cli::hash_file_sha256(path)
  } else {
    header <- change(header)
  }
  header$checksum <- header_checksum(header)
  writeLines(header_text(header), json)
  dir
}

# A change of the cells of a table, as text.
cells <- function(change) {
  function(lines) {
    table <- utils::read.csv(text = lines, colClasses = "character", check.names = FALSE)
    table <- change(table)
    c(paste(names(table), collapse = ","),
      do.call(paste, c(unname(lapply(table, function(x) sprintf("\"%s\"", x))), sep = ",")))
  }
}

refused <- function(file, change, patterns = NULL, named = file, ...) {
  expect_crestline_error(read_norms(forged(file, change, ...)), c(named, patterns))
}

test_that("a folder whose checksums were made anew is read if nothing else was changed", {
  same <- read_norms(forged("mean-surface.csv", identity))
  expect_equal(same$surface$columns$groups$male$mean,
               small_norms()$surface$columns$groups$male$mean, tolerance = 1e-12)
  quoted <- read_norms(forged("mean-surface.csv", cells(identity)))
  expect_identical(quoted$surface$columns, same$surface$columns)
})

test_that("columns, rows and cells that are not those of a norm are refused", {
  refused("mean-surface.csv", function(x) paste0(x, c(",b11", rep(",7", length(x) - 1))), "b11")
  refused("mean-surface.csv", cells(function(x) x[c(2, 1, 3:ncol(x))]), "another order")
  refused("mean-surface.csv", function(x) x[-2], "105 rows for each of 2 sexes")
  refused("mean-surface.csv", function(x) x[c(1, 107:211, 2:106)], "in this order")
  refused("mean-surface.csv", function(x) replace(x, 5, paste0(x[5], ",1")), "numbers of cells")
  refused("mean-surface.csv", function(x) x[1])
  refused("mean-surface.csv", function(x) character(), "empty")
  comma <- function(x) c(x[1], gsub("-?[0-9]+[.]([0-9]+)", "1,\\1", x[-1]))
  refused("scan-surface.csv", comma, "numbers of cells")
  refused("reference.csv", cells(function(x) replace(x, "x", sub(".", ",", x$x, fixed = TRUE))),
          "decimal point")
  refused("mean-values.csv", cells(function(x) replace(x, "b1", sub("$", ".5", x$b1))), "not whole")
  refused("reference.csv", cells(function(x) replace(x, "side", "maybe")), "side")
  refused("components-surface.csv", function(x) x[-7], "104 rows, not 105")
  refused("ages.csv", function(x) x[1:2], "1 row, not 2")
  refused("norms.json", function(x) within(x, tables$healing.csv <- NULL), "healing.csv")
})

test_that("points that are not those of the norm are refused", {
  refused("reference.csv", function(x) x[-4], named = "mean-surface.csv")
  refused("reference.csv", function(x) x[c(1, 3, 2, 4:length(x))])
  refused("reference.csv", cells(function(x) replace(x, "point", x$point[c(2, 1, 3:35)])),
          "`part` and `index`")
  refused("reference.csv", cells(function(x) replace(x, "partner", c(2, x$partner[-1]))), "pairs")
  refused("reference.csv", cells(function(x) replace(x, c("x", "y"), x[c("y", "x")])), "normals")
  refused("reference.csv", cells(function(x) replace(x, "nx", as.numeric(x$ny) * 0.9)), "normals")
  refused("triangles.csv", function(x) replace(x, 2, "1,2,99"), "reference.csv")
})

test_that("sexes, counts, names and radii must agree", {
  refused("ages.csv", function(x) x[c(1, 3, 2)], "sexes")
  refused("ages.csv", cells(function(x) replace(x, "to", 40)), "ages")
  refused("norms.json", function(x) within(x, sexes <- rev(sexes)), named = "ages.csv")
  refused("counts.csv", function(x) x[-2], "sum")
  exchanged <- cells(function(x) {
    replace(x, "sex", ifelse(x$sex == "male", "female", "male"))
  })
  refused("counts.csv", exchanged, named = "basis-values.csv", "64 faces of counts.csv")
  refused("table.csv", function(x) x[c(1, 3, 2, 4:length(x))], "measurements.csv")
  refused("table.csv", cells(function(x) replace(x, "transform", "root")), "no norm has")
  refused("measurements.csv", function(x) x[c(1, 3, 2, 4:length(x))], named = "table.csv")
  double <- function(field) lapply(field, function(radius) 2 * radius)
  refused("norms.json", function(x) within(x, surface$radii <- double(surface$radii)),
          named = "scan-surface.csv")
  refused("healing.csv", cells(function(x) replace(x, "radius", 2 * as.numeric(x$radius))), "radii")
  refused("norms.json", function(x) within(x, settings$radii <- double(settings$radii)),
          named = "healing.csv")
  refused("norms.json", function(x) within(x, limits$map <- rev(limits$map)), "limits")
  refused("norms.json", function(x) within(x, levels[[4]] <- 0.94), "limits")
})

test_that("a basis is checked to the last rows", {
  digit <- function(column) {
    cells(function(x) replace(x, column, c(as.numeric(x[[column]][1]) * 1.01, x[[column]][-1])))
  }
  for (column in c("t1", "s")) refused("basis-surface.csv", digit(column), "no basis")
  refused("basis-surface-along.csv", function(x) x[c(1, 3, 2, 4:length(x))], "no basis")
})

test_that("means, spreads and components that do not agree are refused", {
  refused("mean-surface.csv", cells(function(x) {
    replace(x, "b5", c(as.numeric(x$b5[1]) + 90000, x$b5[-1]))
  }), "mean-surface-along.csv")
  refused("mean-values.csv", cells(function(x) {
    replace(x, paste0("b", 1:10), lapply(x[paste0("b", 1:10)], function(b) as.numeric(b) - 3e6))
  }), "size")
  refused("components-surface.csv", cells(function(x) {
    replace(x, "sd", 10 * as.numeric(x$sd))
  }), "spread-surface.csv")
  refused("components-surface.csv", cells(function(x) {
    replace(x, "v1", 2 * as.numeric(x$v1))
  }), "right angles")
})

test_that("a norm without pairs is read", {
  norms <- small_norms()
  norms$asymmetry <- NULL
  norms["asymmetry"] <- list(NULL)
  norms$points$partner <- NA_integer_
  norms$points$side <- FALSE
  one <- !norms$surface$scan$both
  norms$surface["partner"] <- list(NULL)
  norms$surface$mirrored[] <- 0
  norms$surface$scan$radii <- norms$surface$scan$radii[one]
  norms$surface$scan$both <- one[one]
  norms$surface$scan$s <- norms$surface$scan$s[, one]
  norms$surface$scan$by_age <- lapply(norms$surface$scan$by_age, function(x) x[, one])
  norms$cache <- new.env(parent = emptyenv())
  dir <- tempfile()
  write_norms(norms, dir)
  expect_false(any(grepl("asymmetry", list.files(dir))))
  read <- read_norms(dir)
  look <- function(x) suppressWarnings(assess(small_patient(), x, 10, "female"))
  expect_equal(look(read)$points, look(norms)$points, tolerance = 1e-10)
  expect_identical(look(read)$verdicts$verdict[6], "not assessable")
  # Tables of a former norm are not left beside those of another.
  whole <- tempfile()
  write_norms(small_norms(), whole)
  expect_crestline_error(write_norms(norms, whole), c("other files", "basis-asymmetry"))
})

test_that("norms of one sex, without pairs or measurements, and of infants are read", {
  same <- function(cohort, sex, ...) {
    norms <- suppressWarnings(fit_norms(cohort$sample, ..., data = cohort$data,
                                        settings = small_settings(), progress = FALSE))
    dir <- tempfile("norms of K\u00f6ln ")
    write_norms(norms, dir)
    read <- read_norms(dir)
    look <- function(x) suppressWarnings(assess(cohort$sample[[3]], x, 10, sex))
    expect_equal(look(read)[c("values", "points", "verdicts")],
                 look(norms)[c("values", "points", "verdicts")], tolerance = 1e-10)
    read
  }
  cohort <- small_cohort(60)
  read <- same(cohort, NULL, ~ s(age))
  expect_identical(read$ages$sex, "all")
  expect_null(read$measurements)
  # Names of sexes that look like other things
  cohort$data$sex <- ifelse(cohort$data$sex == "female", "F", "T")
  expect_identical(same(cohort, "T", ~ s(age, by = sex))$ages$sex, c("F", "T"))
  cohort$data$sex <- ifelse(cohort$data$sex == "F", 1, 2)
  expect_identical(same(cohort, "2", ~ s(age, by = sex))$ages$sex, c("1", "2"))
  cohort$data$age <- cohort$data$age - 4.9
  dir <- tempfile()
  infants <- fit_norms(cohort$sample, ~ s(age), cohort$data, table = ball_measurements()[1, ],
                       settings = small_settings(), progress = FALSE)
  write_norms(infants, dir)
  expect_identical(min(read_norms(dir)$counts$from), 0L)
  expect_identical(sum(read_norms(dir)$counts$n), 60L)
})
