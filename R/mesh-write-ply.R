# PLY as write_mesh() makes it: double precision, colours as bytes, `quality` and `row` of the
# vertices.

write_ply <- function(mesh, file, ascii) {
  if (ascii) {
    fields <- list(row_text(mesh$xyz, missing = "nan"), if (!is.null(mesh$rgb)) row_text(mesh$rgb),
                   if (!is.null(mesh$value)) number_text(mesh$value, missing = "nan"),
                   if (!is.null(mesh$row)) ply_rows_of(mesh))
    vertex <- do.call(paste, Filter(Negate(is.null), fields))
    return(write_content(c(ply_head(mesh, "ascii"), vertex, paste("3", row_text(mesh$it - 1))),
                         file))
  }
  head <- charToRaw(paste0(ply_head(mesh, "binary_little_endian"), "\n", collapse = ""))
  vertex <- rbind(bytes_of(mesh$xyz, 8L), if (!is.null(mesh$rgb)) bytes_of(mesh$rgb, 1L),
                  if (!is.null(mesh$value)) bytes_of(as.double(mesh$value), 8L),
                  if (!is.null(mesh$row)) bytes_of(ply_rows_of(mesh), 4L))
  face <- rbind(as.raw(3), bytes_of(mesh$it - 1L, 4L))
  write_content(c(head, as.vector(vertex), as.vector(face)), file)
}

# 0 for the points between those of a shape.
ply_rows_of <- function(mesh) as.integer(ifelse(is.na(mesh$row), 0, mesh$row))

ply_head <- function(mesh, format) {
  c("ply", paste("format", format, "1.0"), paste("comment", mesh$comments),
    paste("element vertex", nrow(mesh$xyz)),
    "property double x", "property double y", "property double z",
    if (!is.null(mesh$rgb)) c("property uchar red", "property uchar green", "property uchar blue"),
    if (!is.null(mesh$value)) "property double quality", if (!is.null(mesh$row)) "property int row",
    paste("element face", nrow(mesh$it)), "property list uchar int vertex_indices", "end_header")
}
