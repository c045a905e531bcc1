write_tables <- function(tables, encoding = "UTF-8") {
  dir <- new_folder()
  for (table in names(tables)) {
    utils::write.csv(tables[[table]], file.path(dir, paste0(table, ".csv")), row.names = FALSE,
                     na = "", fileEncoding = encoding)
  }
  dir
}
new_folder <- function() {
  dir <- tempfile("leaf")
  dir.create(dir)
  dir
}

test_that("a folder of tables gives the scheme of the tables", {
  dir <- write_tables(leaf_tables())
  read <- read_scheme(dir)
  expect_equal(read$name, basename(dir))
  expect_equal(read[-1], unclass(leaf_scheme())[-1])
  expect_equal(read_scheme(dir, name = "leaf")$name, "leaf")
})

test_that("only landmarks and curves need a file", {
  dir <- write_tables(leaf_tables()[1:2])
  expect_equal(nrow(read_scheme(dir)$patches), 0)
  unlink(file.path(dir, "curves.csv"))
  expect_crestline_error(read_scheme(dir), "curves.csv")
})

test_that("mistakes name the file, and folders that are none are refused", {
  x <- leaf_tables()
  x$curves$n[2] <- 1
  expect_crestline_error(read_scheme(write_tables(x)),
                         c("table curves.csv", "row 2 (edge left), column n: 1 is not"))
  expect_crestline_error(read_scheme(file.path(tempdir(), "no such folder")), "no folder")
  expect_crestline_error(read_scheme(3), "no folder 3")
})

test_that("lines of different length are explained", {
  dir <- write_tables(leaf_tables())
  file <- file.path(dir, "landmarks.csv")
  writeLines(c("landmark,where", "base,a,b,c,d", "tip,a"), file)
  expect_crestline_error(read_scheme(dir), "landmarks.csv")
  writeLines(character(), file)
  expect_crestline_error(read_scheme(dir), "landmarks.csv")
})

test_that("a mark of the encoding and Windows' line ends do no harm", {
  dir <- write_tables(leaf_tables())
  file <- file.path(dir, "landmarks.csv")
  writeBin(charToRaw(paste0("\xef\xbb\xbf", paste(readLines(file), collapse = "\r\n"), "\r\n")),
           file)
  expect_equal(read_scheme(dir)$landmarks$landmark, leaf_tables()$landmarks$landmark)
})

test_that("tables are read as spreadsheets save them", {
  dir <- write_tables(leaf_tables())
  expected <- read_scheme(dir, "leaf")
  for (name in c("landmarks", "curves")) {
    file <- file.path(dir, paste0(name, ".csv"))
    writeLines(paste0(readLines(file), ","), file)
  }
  expect_equal(read_scheme(dir, "leaf"), expected)
  for (name in names(leaf_tables())) {
    file <- file.path(dir, paste0(name, ".csv"))
    table <- utils::read.csv(file, colClasses = "character", check.names = FALSE)
    table <- table[nzchar(names(table)) & colSums(!is.na(table)) > 0]
    numeric <- names(table) %in% c("radius", "width", "cut_share")
    table[numeric] <- lapply(table[numeric], sub, pattern = ".", replacement = ",", fixed = TRUE)
    utils::write.table(table, file, sep = ";", row.names = FALSE, na = "")
  }
  expect_equal(read_scheme(dir, "leaf"), expected)
})

test_that("a row with another number of cells, or no header, is refused by table and line", {
  dir <- write_tables(leaf_tables())
  file <- file.path(dir, "curves.csv")
  line <- readLines(file)
  writeLines(replace(line, 3, paste0(line[3], ",x")), file)
  expect_crestline_error(read_scheme(dir), c("curves.csv, line 3", "fields where the header has"))
  writeLines(line[-1], file)
  error <- expect_crestline_error(read_scheme(dir), "curves.csv")
  expect_s3_class(error, "crestline_scheme_error")
})

test_that("tables are found in any case of their names; a name that is nearly a table's is said", {
  dir <- write_tables(leaf_tables())
  expected <- read_scheme(dir, "leaf")
  file <- list.files(dir, full.names = TRUE)
  file.rename(file, file.path(dir, toupper(basename(file))))
  expect_equal(read_scheme(dir, "leaf"), expected)
  file.copy(file.path(dir, "CURVES.CSV"), file.path(dir, "curves.csv"))
  skip_if(length(list.files(dir)) == length(file), "a file system without case")
  expect_crestline_error(read_scheme(dir), c("several files of the table curves", "CURVES.CSV"))
  file.remove(file.path(dir, "curves.csv"))
  file.rename(file.path(dir, "PAIRS.CSV"), file.path(dir, "pair.csv"))
  expect_warning(read_scheme(dir), "pair.csv .* is no table", class = "crestline_unread_table")
})
