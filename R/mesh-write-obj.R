# OBJ as write_mesh() makes it: vertices with their colours, triangles.

write_obj <- function(mesh, file, ascii) {
  vertex <- paste("v", row_text(mesh$xyz, missing = "nan"))
  if (!is.null(mesh$rgb)) vertex <- paste(vertex, row_text(mesh$rgb / 255))
  write_content(c(paste("#", mesh$comments), vertex, paste("f", row_text(mesh$it))), file)
}
