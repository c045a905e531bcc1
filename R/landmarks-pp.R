# .pp of MeshLab: XML with one element <point x= y= z= name= active=> a picked point; an inactive
# one is missing.

read_landmarks_pp <- function(file, options) {
  text <- gsub("(?s)<!--.*?-->", "", paste(file_lines(file), collapse = "\n"), perl = TRUE)
  if (!grepl("<PickedPoints", text, fixed = TRUE)) {
    refuse_landmark_file(file, "no PickedPoints in it", "Save the picked points from MeshLab.")
  }
  if (!grepl("</PickedPoints>|<PickedPoints\\s*/>", text)) {
    refuse_landmark_file(file, "the end of PickedPoints is missing", "Put the whole file.")
  }
  whole <- gregexpr("<point(\\s+[^<>\"'=]+=\\s*(\"[^\"]*\"|'[^']*'))*\\s*/?>", text, perl = TRUE)
  point <- regmatches(text, whole)[[1]]
  if (length(point) != lengths(regmatches(text, gregexpr("<point\\b", text)))) {
    refuse_landmark_file(file, "a point cannot be read",
                         "Write <point x=\"1\" y=\"2\" z=\"3\" name=\"pn\"/>.")
  }
  x <- vapply(c("x", "y", "z"), function(key) {
    word <- xml_attribute(point, key)
    if (anyNA(word)) {
      refuse_landmark_file(file, sprintf("point %d has no %s", which(is.na(word))[1], key),
                           "Put the whole file.")
    }
    landmark_numbers(word, file, NULL)
  },
              numeric(length(point)))
  x <- matrix(x, ncol = 3)
  x[tolower(xml_attribute(point, "active")) %in% c("0", "false"), ] <- NA
  name <- xml_attribute(point, "name")
  landmark_set(x, ifelse(is.na(name) | !nzchar(name), as.character(seq_along(point)), name))
}

#' The values of an attribute of XML elements, NA where one has none
#' @noRd
xml_attribute <- function(element, key) {
  pattern <- sprintf("(?s)^.*?\\s%s\\s*=\\s*(?:\"([^\"]*)\"|'([^']*)').*$", key)
  xml_text(ifelse(grepl(pattern, element, perl = TRUE),
                  sub(pattern, "\\1\\2", element, perl = TRUE), NA_character_))
}

#' Text without XML's entities
#' @noRd
xml_text <- function(text) {
  coded <- grepl("&", text, fixed = TRUE)
  if (!all(coded)) return(replace(text, coded, if (any(coded)) xml_text(text[coded])))
  number <- gregexpr("&#(x[0-9A-Fa-f]{1,6}|[0-9]{1,7});", text)
  regmatches(text, number) <- lapply(regmatches(text, number), function(one) {
    code <- sub("^&#x", "0x", sub(";$", "", one))
    sign <- vapply(as.integer(sub("^&#", "", code)), intToUtf8, "")
    ifelse(is.na(sign), "\ufffd", sign)
  })
  for (entity in names(xml_entities)) {
    text <- gsub(entity, xml_entities[[entity]], text, fixed = TRUE)
  }
  text
}

# The ampersand last when read, first when written.
xml_entities <- c("&quot;" = "\"", "&apos;" = "'", "&lt;" = "<", "&gt;" = ">", "&amp;" = "&")

write_landmarks_pp <- function(sets, file, options) {
  x <- sets[[1]]
  name <- rownames(x)
  for (entity in rev(names(xml_entities))) {
    name <- gsub(xml_entities[[entity]], entity, name, fixed = TRUE)
  }
  text <- function(i) number_text(x[, i], missing = "0")
  row <- sprintf(" <point x=\"%s\" y=\"%s\" z=\"%s\" active=\"%d\" name=\"%s\"/>", text(1), text(2),
                 text(3), as.integer(!is.na(x[, 1])), name)
  write_file_lines(c("<!DOCTYPE PickedPoints>", "<PickedPoints>", " <DocumentData/>", row,
                     "</PickedPoints>"), file)
}
