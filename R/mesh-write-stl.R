# STL as write_mesh() makes it: a normal and three corners a triangle.

write_stl <- function(mesh, file, ascii) {
  corner <- lapply(1:3, function(i) mesh$xyz[mesh$it[, i], , drop = FALSE])
  normal <- cross_rows(corner[[2]] - corner[[1]], corner[[3]] - corner[[1]])
  normal <- normal / pmax(row_lengths(normal), .Machine$double.xmin)
  if (ascii) {
    vertex <- lapply(corner, function(xyz) paste("vertex", row_text(xyz, missing = "nan")))
    lines <- rbind(paste("facet normal", row_text(normal, missing = "nan")), "outer loop",
                   do.call(rbind, vertex), "endloop",
                   "endfacet")
    return(write_content(c("solid crestline", as.vector(lines), "endsolid crestline"), file))
  }
  # A binary header must not begin with "solid".
  head <- c(charToRaw(formatC("written by crestline", width = -80)),
            writeBin(nrow(mesh$it), raw(), endian = "little"))
  facet <- rbind(bytes_of(cbind(normal, do.call(cbind, corner)), 4L), as.raw(0), as.raw(0))
  write_content(c(head, as.vector(facet)), file)
}
