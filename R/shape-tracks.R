# Where the points of a shape's curves can slide: the whole curve as it was found, before it was cut
# off.

#' Tracks of curves
#'
#' @param fits As of [fit_scheme_curves()].
#' @param faces Number of faces that are not bridges.
#' @return List by name of the curves that were found: `path` (`mesh_path`, uncut, over bridges
#'   where there are holes), `s` (arc length there of each of the curve's points, NA where missing),
#'   `kept` (length that the scheme keeps), `cut` (whether the first point stands where the scheme
#'   cuts the curve off, and not at a landmark), `off` (rows of the path that end a segment over a
#'   bridge).
#' @noRd
curve_tracks <- function(fits, scheme, faces) {
  found <- Filter(function(fit) !is.null(fit$path) && !is.null(fit$points), fits)
  cut <- !is.na(scheme$curves$cut_share[match(names(found), scheme$curves$curve)])
  Map(function(fit, cut) {
    path <- if (is.null(fit$track)) fit$path else fit$track$path
    path <- new_mesh_path(unclass(path)[c("s", mesh_columns)], attr(path, "length"),
                          attr(path, "key"), attr(path, "id"))
    s <- ifelse(is.na(fit$points$x), NA,
                fit$points$s + if (is.null(fit$track)) 0 else fit$track$start)
    list(path = path, s = s, kept = if (is.null(fit$track)) fit$length else fit$track$kept,
         cut = cut,
         off = which(path$face > faces))
  }, found, cut)
}

#' Refuse tracks that do not lie on the mesh of a shape, or whose points do not lie on them
#'
#' @param scan The shape's specimen with its holes bridged, as of [walkable()].
#' @noRd
check_tracks <- function(shape, scan) {
  for (name in names(shape$tracks)) {
    track <- shape$tracks[[name]]
    said <- sprintf("the track of %s", name)
    check_class(track$path, "mesh_path", said, "fit_shape()")
    check_places(track$path, scan, said, shape$id)
    s <- track$s[!is.na(track$s)]
    right <- is.numeric(track$s) && length(track$s) == sum(shape$points$level == "curves" &
                                                           shape$points$part == name) &&
      !is.unsorted(s) && all(abs(s / attr(track$path, "length") - 0.5) <= 0.5 + 1e-9)
    if (!right) {
      crestline_abort(sprintf("%s has points that are not on it, in order.", said),
                      "Give a shape as fit_shape() or slide() returns it, whole.", stage = "shape",
                      id = shape$id,
                      class = "crestline_wrong_mesh", call = NULL)
    }
  }
}
