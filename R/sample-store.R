# A shape as a folder of results keeps it: numbers packed, scheme and settings once for the folder,
# the scan by path and hash.

#' The way in which a shape is stored, for later versions
#' @noRd
stored_version <- 1L

#' A shape as it is written
#'
#' What does not come back alike from being packed is stored as it is.
#'
#' @param dir Folder where values that many shapes have lie once.
#' @param source Of its scan, see [stored_specimen()]; NULL: the scan is stored with it.
#' @return A `stored_shape`: a list.
#' @noRd
stored_shape <- function(shape, dir, source = NULL) {
  fields <- unclass(shape)
  scheme <- fields$scheme
  fields$scheme <- share_value(scheme, dir)
  fields$provenance["settings"] <- list(share_value(shape$provenance$settings, dir))
  points <- if_packed(pack_points(shape$points, scheme))
  packed <- !is.null(points) && read_alike(shape$points, unpack_points(points, scheme))
  if (packed) fields$points <- points
  paths <- c(lapply(shape$tracks, `[[`, "path"), shape$paths)
  pool <- if_packed(pack_paths(paths))
  pooled <- !is.null(pool) && read_alike(paths, unpack_paths(pool))
  if (pooled) {
    fields$tracks <- lapply(shape$tracks, function(track) replace(track, "path", list(NULL)))
    fields$paths <- pool
  }
  if (!is.null(source) && inherits(fields$specimen, "specimen")) {
    fields["specimen"] <- list(stored_specimen(fields$specimen, source))
  }
  structure(list(version = stored_version, packed = packed, pooled = pooled, fields = fields),
            class = "stored_shape")
}

#' What is packed; NULL of what cannot be, such as a path with a missing place
#' @noRd
if_packed <- function(code) tryCatch(code, error = function(e) NULL)

#' The shape again
#' @param dir Folder of its file.
#' @noRd
from_stored <- function(stored, dir) {
  if (stored$version > stored_version) {
    refuse_stored("its file is of a later version of crestline.", "Install that version.")
  }
  fields <- stored$fields
  fields$scheme <- shared_value(fields$scheme, dir)
  if (!is.null(fields$provenance)) {
    fields$provenance["settings"] <- list(shared_value(fields$provenance$settings, dir))
  }
  if (stored$packed) fields$points <- unpack_points(fields$points, fields$scheme)
  if (stored$pooled) fields <- with_unpacked_paths(fields)
  if (inherits(fields$specimen, "stored_specimen")) {
    specimen <- unclass(fields$specimen)
    specimen$source$beside <- beside_results(specimen$source, dir)
    fields$specimen <- structure(specimen, class = c("stored_specimen", "specimen"))
  }
  structure(fields, class = "shape")
}

with_unpacked_paths <- function(fields) {
  paths <- unpack_paths(fields$paths)
  n <- length(fields$tracks)
  fields$tracks <- Map(function(track, path) replace(track, "path", list(path)), fields$tracks,
                       paths[seq_len(n)])
  if (!n) fields["tracks"] <- list(fields$tracks)
  fields$paths <- paths[seq_len(length(paths) - n) + n]
  fields
}

refuse_stored <- function(problem, remedy) {
  crestline_abort(problem, remedy, stage = "keeping", class = "crestline_keeping_error",
                  call = NULL)
}

#' Where a scan comes from, as it is stored
#' @param mesh Path of the mesh.
#' @param hash Of its bytes.
#' @param reading Arguments of reading.
#' @noRd
scan_source <- function(mesh, hash, reading, dir) {
  file <- normalizePath(mesh, winslash = "/")
  above <- paste0(dirname(normalizePath(dir, winslash = "/")), "/")
  list(file = file, hash = hash, reading = reading,
       within = if (startsWith(file, above)) substring(file, nchar(above) + 1))
}

#' Where a scan would be if it was moved together with the folder of results
#' @noRd
beside_results <- function(source, dir) {
  if (!is.null(source$within)) file.path(dirname(normalizePath(dir, winslash = "/")), source$within)
}

#' A value that many results have: written once, known by the hash of its content
#' @return The hash.
#' @noRd
share_value <- function(value, dir) {
  hash <- content_hash(value)
  file <- shared_file(hash, dir)
  if (!file.exists(file)) keep(value, list(key = hash, mesh = "none"), file)
  hash
}

shared_file <- function(hash, dir) file.path(dir, sprintf("common-%s.value", hash))

#' @noRd
shared_value <- function(hash, dir) {
  known <- shared_values[[hash]]
  if (!is.null(known)) return(known$value)
  file <- shared_file(hash, dir)
  opened <- open_kept(file)
  value <- if (opened$state == "whole") kept_value(opened)
  if (opened$state != "whole" || !identical(content_hash(value), hash)) {
    refuse_stored(sprintf("its scheme or settings cannot be read from %s.", file), paste(
      "Keep the common-*.value files of a folder with its results. They are written again by",
      "fit_shapes() with the same scheme and settings."
    ))
  }
  assign(hash, list(value = value), shared_values)
  value
}

shared_values <- new.env(parent = emptyenv())

#' A result of the former layout, which has its scan with it, written anew: the scan by its path
#' where that file gives the same mesh, the rest packed
#'
#' Where nothing can be written, the old file stays.
#' @noRd
renew_file <- function(shape, about, file) {
  dir <- dirname(file)
  source <- former_source(shape, about, dir)
  about$scan <- if (is.null(source)) "embedded" else source$file
  opened <- list(state = "whole", about = about)
  tryCatch({
    stored <- stored_shape(shape, dir, source)
    keep(stored, about, file, if (is.null(source)) 1 else "xz")
    append_index(index_row(file, opened), dir)
  }, crestline_error = function(e) NULL)
  invisible()
}

#' Where the scan of a former result lies: the file that it was read from, if that still gives the
#' same mesh
#' @noRd
former_source <- function(shape, about, dir) {
  mesh <- shape$provenance$mesh$file
  if (!inherits(shape$specimen, "specimen") || !is_path(mesh) || !file.exists(mesh)) return(NULL)
  hash <- rlang::hash_file(mesh)
  source <- scan_source(mesh, hash, list(), dir)
  same <- tryCatch({
    scan_from(mesh, list(id = shape$id, key = specimen_key(shape$specimen), source = source))
    identical(hash, about$mesh)
  }, error = function(e) FALSE)
  if (same) source
}
