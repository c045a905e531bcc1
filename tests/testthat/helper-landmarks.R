# A file of the given lines, with the extension of its format.
landmark_file <- function(extension, ..., eol = "\n") {
  file <- tempfile(fileext = paste0(".", extension))
  writeBin(charToRaw(enc2utf8(paste0(c(...), eol, collapse = ""))), file)
  file
}

xyz <- function(..., name = NULL) {
  matrix(c(...), ncol = 3, byrow = TRUE, dimnames = list(name, c("x", "y", "z")))
}

# Numbers, names and gaps that formats like to lose.
hard_landmarks <- function() {
  x <- xyz(1 / 3, -2, 3e-5, NA, NA, NA, pi * 1e6, -1e-300, 99991.5, 0.1 + 0.2, -1, 9999, 1 + 2^-52,
           2^60, 1e22, 0, 0, 0, name = c("pn", "sn, left", "ch L", "say \"a\"", "n\u00e9z #1", "9"))
  rbind(x, with_seed(7, xyz(rnorm(300) * 10^runif(300, -8, 8), name = sprintf("p%03d", 1:100))))
}

hard_curves <- function() {
  list("upper lip, left" = structure(xyz(1 / 3, 2, -3, NA, NA, NA, 0.1, 1e-9, 5), closed = FALSE),
       "rim \"R\"" = structure(xyz(1, 2, 3, 1 / 7, 5, 6, NA, NA, NA, 7, 8, 9), closed = TRUE),
       single = structure(xyz(-9, 1, 1e5), closed = FALSE))
}

expect_round_trip <- function(x, extension, ...) {
  file <- tempfile(fileext = paste0(".", extension))
  testthat::expect_identical(write_landmarks(x, file), file)
  testthat::expect_identical(read_landmarks(file, ...), x)
  invisible(file)
}

# Refused with the name of the file, the line (where there is one) and the words.
expect_refused <- function(file, words, line = NULL, ...) {
  where <- paste0(basename(file), if (!is.null(line)) paste0(", line ", line, ":"))
  error <- expect_crestline_error(read_landmarks(file, ...), c(where, words))
  testthat::expect_s3_class(error, "crestline_landmark_error")
}
