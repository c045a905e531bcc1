# OBJ: vertices, texture co-ordinates, polygons, and images named in a material file.
# Own code: Rvcg crashes on damaged and on textured files.

read_obj <- function(file, id) {
  text <- cpp_read_obj(text_bytes(file_bytes(file, id)))
  if (nzchar(text$bad)) refuse_word(file, text$bad, text$bad_line, id)
  if (text$bad_line > 0) {
    refuse_file(file, sprintf("line %d has fewer than three co-ordinates", text$bad_line), id)
  }
  if (!length(text$vertex)) refuse_file(file, "it has no vertices", id)
  vertex <- matrix(text$vertex, ncol = 3, byrow = TRUE)
  colour <- if (text$coloured) colour_hex(matrix(text$colour, ncol = 3, byrow = TRUE))
  if (is.null(colour) && length(text$libraries) && !all(is.na(text$texture))) {
    colour <- obj_texture(file, text, nrow(vertex), id)
  }
  mesh_of_polygons(vertex, text$corner, text$sides, colour)
}

# Colour of each vertex from the images of the materials (its first corner that has one), or NULL.
obj_texture <- function(file, text, n, id) {
  uv <- matrix(text$uv, ncol = 2, byrow = TRUE)
  placed <- which(is.finite(rowSums(uv)))
  material <- rep(c("", valid_names(text$materials))[text$material + 1], text$sides)
  images <- obj_images(file.path(dirname(file), valid_names(text$libraries)))
  colour <- rep(NA_character_, n)
  for (name in intersect(unique(material), names(images))) {
    image <- read_image(images[[name]], id)
    at <- which(material == name & text$texture %in% placed & text$corner %in% which(is.na(colour)))
    at <- at[!duplicated(text$corner[at])]
    if (is.null(image) || !length(at)) next
    colour[text$corner[at]] <- sample_image(image, uv[text$texture[at], , drop = FALSE])
  }
  if (all(is.na(colour))) NULL else ifelse(is.na(colour), "#BFBFBF", colour)
}

obj_argument <- function(line) trim_bytes(sub("^[^ \t]+", "", line, useBytes = TRUE))

# Names in a file, which Windows writes in Latin 1.
valid_names <- function(name) {
  latin <- !validUTF8(name)
  name[latin] <- iconv(name[latin], "latin1", "UTF-8")
  `Encoding<-`(name, "UTF-8")
}

# Named paths of the colour images (map_Kd) of the materials in mtl files that are there. Pipes and
# devices have no size.
obj_images <- function(files) {
  images <- character()
  for (file in files[file.exists(files) & !dir.exists(files) & !file.size(files) %in% 0]) {
    line <- valid_names(text_lines(text_bytes(readBin(file, "raw", file.size(file)))))
    material <- ""
    for (text in line) {
      if (grepl("^newmtl[ \t]", text, useBytes = TRUE)) material <- obj_argument(text)
      if (grepl("^map_Kd[ \t]", text,
                useBytes = TRUE)) {
        # The rest of the line where that is a file, else its last word (options may stand before).
        folder <- dirname(file)
        whole <- file.path(folder, gsub("\\\\", "/", obj_argument(text)))
        images[material] <- if (file.exists(whole)) whole else
          file.path(folder, basename(sub(".*[ \t]", "", gsub("\\\\", "/", text))))
      }
    }
  }
  images
}

write_obj <- function(mesh, file, ascii) {
  vertex <- paste("v", row_text(mesh$xyz, missing = "nan"))
  if (!is.null(mesh$rgb)) vertex <- paste(vertex, row_text(mesh$rgb / 255))
  write_content(c(paste("#", mesh$comments), vertex, paste("f", row_text(mesh$it))), file)
}
