# A sample in files is the sample.

blocks_folder <- function() tempfile("blocks-")

test_that("an array comes back to the last bit, whatever the size of the blocks", {
  skip_if_not_installed("nanoparquet")
  x <- named_array(posed_sample(n = 15))
  x[2, , 4] <- NA
  for (block in c(1, 7, 15, 100)) {
    stored <- write_blocks(x, blocks_folder(), block)
    expect_identical(names(open_sample(stored$dir)), dimnames(x)[[3]])
    each <- lapply(seq_len(n_blocks(stored)), function(i) read_block(stored, i))
    expect_identical(as.vector(unlist(each)), as.vector(x))
    expect_identical(dimnames(each[[1]])[1:2], dimnames(x)[1:2])
    expect_identical(unlist(lapply(each, function(one) dimnames(one)[[3]])), dimnames(x)[[3]])
    rows <- read_block(stored, 1, c(5, 2))
    expect_identical(rows, x[c(5, 2), , seq_len(dim(rows)[3]), drop = FALSE])
    unlink(stored$dir, recursive = TRUE)
  }
})

test_that("points of one name are refused before anything is written", {
  skip_if_not_installed("nanoparquet")
  x <- named_array(posed_sample(k = 4, n = 3))
  rownames(x)[2:3] <- "tip"
  folder <- blocks_folder()
  expect_crestline_error(write_blocks(x, folder), "two points have the name \"tip\"")
  expect_false(dir.exists(folder))
})

test_that("another reader finds a row a specimen and a column a co-ordinate", {
  skip_if_not_installed("nanoparquet")
  x <- named_array(posed_sample(k = 4, n = 3))
  stored <- write_blocks(x, blocks_folder())
  table <- nanoparquet::read_parquet(file.path(stored$dir, "block-0001.parquet"))
  expect_identical(names(table)[1:4], c("id", "points 1.x", "points 1.y", "points 1.z"))
  expect_identical(table[["points 3.z"]], unname(x[3, 3, ]))
  expect_match(printed_lines(stored), "3 specimens in 1 file", all = FALSE)
  unlink(stored$dir, recursive = TRUE)
})

test_that("a folder that is not whole is refused by name", {
  skip_if_not_installed("nanoparquet")
  stored <- write_blocks(posed_sample(n = 15), blocks_folder(), 7)
  expect_crestline_error(write_blocks(posed_sample(n = 3), stored$dir), "has a sample already")
  file <- function(i) file.path(stored$dir, block_name(i))
  file.copy(file(1), file(2), overwrite = TRUE)
  expect_crestline_error(read_block(stored, 2), "block-0002.parquet is damaged")
  # Another sample of the same specimens.
  other <- write_blocks(posed_sample(n = 15) + 1, blocks_folder(), 7)
  file.copy(file.path(other$dir, block_name(2)), file(2), overwrite = TRUE)
  expect_crestline_error(read_block(stored, 2), c("block-0002.parquet", "not of this sample"))
  writeBin(as.raw(1:9), file(2))
  expect_crestline_error(read_block(stored, 2), "block-0002.parquet is damaged")
  unlink(file(2))
  expect_crestline_error(open_sample(stored$dir), "lacks block-0002.parquet")
  unlink(stored$dir, recursive = TRUE)
  expect_crestline_error(open_sample(stored$dir), c("no whole sample", "sample.head is absent"))
})
