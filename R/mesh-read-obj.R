# OBJ: vertices, texture co-ordinates, polygons, and images named in a material file.
# Own code: Rvcg crashes on damaged and on textured files.

read_obj <- function(file, id) {
  line <- text_lines(file)
  is <- lapply(c(v = "v ", vt = "vt ", f = "f "), function(key) startsWith(line, key))
  vertex <- obj_vertices(line[is$v])
  if (!nrow(vertex)) refuse_file(file, "it has no vertices", id)
  corner <- obj_corners(line[is$f], cumsum(is$v)[is$f], cumsum(is$vt)[is$f])
  colour <- if (ncol(vertex) == 6) colour_hex(vertex[, 4:6, drop = FALSE])
  if (is.null(colour)) colour <- obj_texture(file, line, is, corner, nrow(vertex), id)
  mesh_of_polygons(vertex[, 1:3, drop = FALSE], corner$vertex, corner$sides, colour)
}

# x, y, z and, where all vertices have them, three colours.
obj_vertices <- function(line) {
  if (!length(line)) return(matrix(0, 0, 3))
  coloured <- length(strsplit(line[1], " +", useBytes = TRUE)[[1]]) >= 7
  vertex <- if (coloured) tryCatch(number_rows(line, 6), error = function(e) NULL)
  if (is.null(vertex)) number_rows(line, 3) else vertex
}

# All corners in turn: `vertex` and `texture` numbers (1-based; texture NA where none), and the
# `sides` of each polygon. A negative number counts back from the last read before the face.
obj_corners <- function(line, vertices_before, textures_before) {
  triangles <- tryCatch(scan_rows(line, rep(list(""), 3)), error = function(e) NULL)
  token <- if (is.null(triangles)) strsplit(sub("^f +", "", line, useBytes = TRUE), " +", useBytes = TRUE)
  sides <- if (is.null(triangles)) lengths(token) else rep(3L, length(line))
  token <- if (is.null(triangles)) unlist(token) else as.vector(do.call(rbind, triangles))
  slash <- grepl("/", token, fixed = TRUE, useBytes = TRUE)
  texture <- rep(NA_integer_, length(token))
  if (any(slash)) {
    text <- sub("^[^/]*/([^/]*).*$", "\\1", token[slash], useBytes = TRUE)
    texture[slash] <- obj_index(text, rep(textures_before, sides)[slash])
  }
  token[slash] <- sub("/.*", "", token[slash], useBytes = TRUE)
  list(vertex = obj_index(token, rep(vertices_before, sides)), texture = texture, sides = sides)
}

obj_index <- function(text, before) {
  number <- suppressWarnings(as.integer(text))
  back <- which(number < 0)
  number[back] <- number[back] + before[back] + 1L
  number
}

# Colour of each vertex from the images of the materials (its first corner that has one), or NULL.
obj_texture <- function(file, line, is, corner, n, id) {
  library <- line[startsWith(line, "mtllib ")]
  if (!length(library) || all(is.na(corner$texture))) return(NULL)
  uv <- number_rows(line[is$vt], 2)
  use <- which(startsWith(line, "usemtl "))
  material <- c("", obj_argument(line[use]))[findInterval(which(is$f), use) + 1]
  material <- rep(material, corner$sides)
  images <- obj_images(file.path(dirname(file), obj_argument(library)))
  colour <- rep(NA_character_, n)
  for (name in intersect(unique(material), names(images))) {
    image <- read_image(images[[name]], id)
    at <- which(material == name & corner$texture %in% seq_len(nrow(uv)) & corner$vertex %in% which(is.na(colour)))
    at <- at[!duplicated(corner$vertex[at])]
    if (is.null(image) || !length(at)) next
    colour[corner$vertex[at]] <- sample_image(image, uv[corner$texture[at], , drop = FALSE])
  }
  if (all(is.na(colour))) NULL else ifelse(is.na(colour), "#BFBFBF", colour)
}

obj_argument <- function(line) trimws(sub("^[^ ]+", "", line, useBytes = TRUE))

# Named paths of the colour images (map_Kd) of the materials in mtl files that are there.
obj_images <- function(files) {
  images <- character()
  for (file in files[file.exists(files)]) {
    line <- text_lines(file)
    material <- ""
    for (text in line) {
      if (grepl("^newmtl ", text, useBytes = TRUE)) material <- obj_argument(text)
      if (grepl("^map_Kd ", text, useBytes = TRUE)) images[material] <- mtl_image(text, dirname(file))
    }
  }
  images
}

# The rest of the line where that is a file, else its last word (options may stand before).
mtl_image <- function(text, folder) {
  whole <- file.path(folder, gsub("\\\\", "/", obj_argument(text)))
  if (file.exists(whole)) whole else file.path(folder, basename(sub(".* ", "", gsub("\\\\", "/", text))))
}
