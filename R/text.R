# Words and numbers as text.

# 15 digits where they give the number back, else the 17 that always do.
number_text <- function(x, missing = "NA") {
  text <- rep(missing, length(x))
  given <- which(!is.na(x))
  text[given] <- sprintf("%.15g", x[given])
  longer <- given[as.numeric(text[given]) != x[given]]
  text[longer] <- sprintf("%.17g", x[longer])
  text
}

# One string a row.
row_text <- function(x, missing = "NA", sep = " ") {
  text <- matrix(number_text(x, missing), nrow(x))
  do.call(paste, c(lapply(seq_len(ncol(text)), function(i) text[, i]), sep = sep))
}

shorten <- function(x, most = 5) {
  more <- if (length(x) > most) sprintf(" and %d more", length(x) - most)
  paste0(paste(utils::head(x, most), collapse = ", "), more)
}

describe_shape <- function(x) {
  if (is.null(dim(x))) describe_value(x) else
    sprintf("%s %s", paste(dim(x), collapse = " x "), typeof(x))
}

amount <- function(n, one, many = paste0(one, "s")) {
  paste(format(n, big.mark = ",", trim = TRUE), if (n == 1) one else many)
}

per_cent <- function(share, least = 0.1) {
  ifelse(100 * share < least, sprintf("under %g %%", least), sprintf("%.1f %%", 100 * share))
}

near_names <- function(name, known) {
  if (!length(known)) {
    return(paste0("The specimen has no landmarks: give them to specimen() or ", "read_specimen()."))
  }
  near <- if (is.character(name) && length(name) == 1 && !is.na(name)) {
    known[order(utils::adist(name, known, ignore.case = TRUE))]
  } else {
    known
  }
  sprintf("Near names: %s.", shorten(near))
}

describe_value <- function(x, most = 60) {
  if (is.null(x)) return("NULL")
  if (!is.atomic(x)) return(paste0("of class ", class(x)[1]))
  if (is.array(x)) {
    return(sprintf("%s of %s", if (is.matrix(x)) "a matrix" else "an array",
                   paste(dim(x), collapse = " x ")))
  }
  # format() would fill up text with blanks
  first <- utils::head(if (is.character(x)) paste(x) else format(x), 3)
  long <- nchar(first) > most
  first[long] <- paste0(substr(first[long], 1, most - 3), "...")
  shown <- paste(first, collapse = ", ")
  if (length(x) > 3) return(paste0(shown, ", ... (", length(x), " values)"))
  if (!length(x)) "empty" else if (identical(shown, "")) "an empty string" else shown
}

describe_range <- function(lower, upper, open) {
  words <- if (open) c("above", "below") else c("of at least", "of at most")
  bounds <- c(lower, upper)
  paste(paste(words, bounds)[is.finite(bounds)], collapse = " and ")
}

comment_text <- function(text) {
  gsub("\\", "/", iconv(enc2utf8(text), "UTF-8", "ASCII", sub = "?"), fixed = TRUE)
}
