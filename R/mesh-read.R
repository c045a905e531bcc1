# Meshes from files: the format by the extension.

# A mesh3d as the file has it, unchecked.
read_mesh <- function(file, id) {
  reader <- mesh_readers()[[file_extension(unpacked_name(file))]]
  if (is.null(reader)) {
    refuse_file(file, "the format is not known by its extension",
                id, paste0("Known: ", paste0(".", names(mesh_readers()), collapse = ", "), "."))
  }
  check_stored(file, "reading", id, unpacks = "gzip")
  mesh <- tryCatch(reader(file, id), error = function(e) {
    if (inherits(e, "crestline_error")) stop(e)
    refuse_file(file, iconv(conditionMessage(e), "", "UTF-8", sub = "byte"), id)
  })
  if (!is.null(mesh$short)) {
    warn_file(file, sprintf("has %d polygons with fewer than three corners", mesh$short),
              paste("Look whether the surface is whole: the header's numbers may be wrong, or",
                    "export it again."), id)
  }
  mesh
}

mesh_readers <- function() list(ply = read_ply, obj = read_obj, stl = read_stl)
