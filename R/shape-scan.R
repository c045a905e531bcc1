# A specimen made ready for a fit: what every step of it needs, looked up once.

#' A scan as the steps of a fit take it
#'
#' @param specimen As of [with_located()].
#' @param scheme In the unit of the specimen.
#' @param settings [ridge_settings()].
#' @param passes As in [ridge_curve()].
#' @param column List of `angle`, `angles`, `reach` as the arguments of [fit_shape()], and `bridge`.
#' @return List: the fields of [walkable()] of the mesh with its holes bridged; `faces`, how many of
#'   its triangles are no bridges; `landmarks`, k x 3, as the specimen has them; `settings`,
#'   `passes`, `column`; `sources`, curvature by radius, as of [curvature_source()]; and of the
#'   scheme's landmarks those of [scan_landmarks()].
#' @noRd
prepare_scan <- function(specimen, scheme, settings, passes, column, threads) {
  bridged <- bridge_holes(specimen, column$bridge)
  curves <- scheme$curves
  radius <- unique(curves$radius[curves$kind != "plane"])
  sources <- lapply(radius, function(r) {
    curvature_source(specimen$mesh, kernel_settings(r, settings$order), threads)
  })
  c(walkable(bridged),
    list(faces = ncol(specimen$mesh$it), settings = settings, passes = passes, column = column,
         sources = stats::setNames(sources, radius)),
    scan_landmarks(specimen, bridged, scheme))
}

#' The landmarks of a scheme on a scan
#'
#' @param bridged The specimen with its holes bridged.
#' @return List: `landmarks`, k x 3, of the specimen; `points`, a row a landmark of the scheme with
#'   columns as `mesh_columns`, NA where it is not on the mesh; `reason`, why not, NA where it is;
#'   `ends`, as `points`, but on bridges too; `lost`, failures by name of those that are not there.
#' @noRd
scan_landmarks <- function(specimen, bridged, scheme) {
  names <- scheme$landmarks$landmark
  points <- matrix(NA_real_, length(names), length(mesh_columns),
                   dimnames = list(names, mesh_columns))
  reason <- stats::setNames(rep(NA_character_, length(names)), names)
  ends <- points
  lost <- list()
  for (name in names) {
    found <- as_value(found_landmark(specimen, name))
    if (!failed(found)) {
      points[name, ] <- ends[name, ] <- unlist(found[mesh_columns])
      next
    }
    reason[name] <- c(left_out_reason(specimen, name), sub("\\.$", "", found$problem))[1]
    on_bridge <- as_value(found_landmark(bridged, name))
    if (failed(on_bridge)) lost[[name]] <- on_bridge else
      ends[name, ] <- unlist(on_bridge[mesh_columns])
  }
  near <- attr(unused_names(specimen$landmarks, scheme), "near")
  reason[near] <- sprintf("%s; near: %s", reason[near], names(near))
  list(landmarks = specimen$landmarks, points = points, reason = reason, ends = ends, lost = lost)
}

#' The place of a landmark of the scheme: its row of `ends`, or a failure
#' @noRd
scan_place <- function(scan, name) {
  if (is.null(scan$lost[[name]])) scan$ends[name, ] else scan$lost[[name]]
}
