table_of <- function(...) {
  stop_at <- function(problem, line) stop(sprintf("line %s: %s", c(line, "none")[1], problem))
  text_table(c(...), stop_at)
}
plain <- function(table) `attributes<-`(as.matrix(table), list(dim = dim(table)))
two_rows <- rbind(c("n", "1", "2"), c("pn", "4", "5"))

test_that("a row longer or shorter than the header is refused with its line, never recycled", {
  expect_error(table_of("name,x,y", "n,1,2", "pn,4,5,6"), "line 3: 4 fields where the header has 3")
  expect_error(table_of("name,x,y", "n,1,2", "", "pn,4"), "line 4: 2 fields")
  expect_error(table_of("name,x,y", "n,1,2,", "pn,4,5"), "line 2: 4 fields")
  expect_error(table_of("x,y", "n,1,2", "pn,4,5"), "line 2: 3 fields where the header has 2")
  # With decimal commas, what would be the third co-ordinate stands in a column of no name
  expect_error(table_of("name,x,y,", "n,1,5,2"), "line 2: column 4 holds something and has no name")
})

test_that("what spreadsheets leave is taken off", {
  for (lines in list(
    c("name,x,y,", "n,1,2,", "pn,4,5,"), c("name,x,y", "n,1,2,,", "pn,4,5,,"),
    c("name,x,y,,", "n,1,2", "pn,4,5"), c("name,x,y", "n,1,2", ",,", "", "pn,4,5", ",,,,", "  "),
    c("name,x,,y", "n,1,,2", "pn,4,,5"), c("sep=,", "name,x,y", "n,1,2", "pn,4,5"),
    c('"sep=;"', "name;x;y", "n;1;2",
      "pn;4;5"), c("sep=|", "name|x|y", "n|1|2",
                   "pn|4|5"),
    c("# mm", "", "#", "name,x,y", "n,1,2", "pn,4,5"), c("name\tx\ty", "n\t1\t2", "pn\t4\t5"),
    c(' name ,"x", y', ' n , "1" ,2', "pn,4,5")
  )) {
    table <- table_of(lines)
    expect_equal(names(table), c("name", "x", "y"))
    expect_equal(plain(table), two_rows)
  }
  expect_equal(attr(table_of("sep=;", "# a", "a", "1", "", "2"), "line"), c(4, 6))
})

test_that("quoted cells hold separators, quotes, blanks and line breaks", {
  table <- table_of("name,note", '" a, b ","say ""yes"""', '"two', "", 'lines",c', "d,x 5\" y")
  expect_equal(table$name, c(" a, b ", "two\nlines", "d"))
  expect_equal(table$note, c("say \"yes\"", "c", "x 5\" y"))
  expect_equal(attr(table, "line"), c(2, 3, 6))
  expect_error(table_of("a,b", '"n,1', "pn,2"), "line 2: a quotation mark is not closed")
  expect_error(table_of("a,b", '"n"x,1'), "line 2: .*text stands behind")
})

test_that("a header that is missing, or names two columns alike, is refused", {
  expect_error(table_of("n,1,2", "pn,4,5"), "line 1: there is no header line")
  expect_error(table_of("", "# nothing"), "line none: there is no header line")
  expect_error(table_of("a,b,A", "1,2,3"), "line 1: two columns are called \"a\"")
  expect_equal(dim(table_of("a,b")), c(0L, 2L))
})

test_that("a first column without a name is that of row names", {
  expect_equal(names(table_of('"","x"', '"n",1')), c("row names", "x"))
})

test_that("decimal commas become points where the separator is another; a mixture is refused", {
  points <- function(...) decimal_points(table_of(...), "x",
                                         function(problem,
                                                  line) stop(sprintf("line %d: %s", line, problem)))
  expect_equal(points("a;x", "n;1,5", "pn;2")$x, c("1.5", "2"))
  expect_equal(points("a\tx", "n\t1,5")$x, "1.5")
  expect_error(points("a;x", "n;2.25", "pn;1,500"),
               "line 3: \"1,500\" has a decimal comma, \"2.25\" a point")
  expect_equal(points("a,x", 'n,"1,5"')$x, "1,5")
})

test_that("lines are read in UTF-8 and UTF-16, with a mark or without, ended as on any system", {
  text <- "name,x\r\nn\u00e9z,1\rpn,2\n"
  file <- tempfile()
  for (mark in list(as.raw(c(0xff, 0xfe)), raw())) {
    writeBin(c(mark, iconv(text, "UTF-8", "UTF-16LE", toRaw = TRUE)[[1]]), file)
    expect_equal(file_lines(file), c("name,x", "n\u00e9z,1", "pn,2"))
  }
  writeBin(c(as.raw(c(0xfe, 0xff)), iconv(text, "UTF-8", "UTF-16BE", toRaw = TRUE)[[1]]), file)
  expect_equal(file_lines(file), c("name,x", "n\u00e9z,1", "pn,2"))
  writeBin(c(as.raw(c(0xef, 0xbb, 0xbf)), charToRaw(enc2utf8(text))), file)
  expect_equal(file_lines(file)[1:2], c("name,x", "n\u00e9z,1"))
})
