#' Settings of the search for a reference path
#'
#' All tuning constants of [reference_path()]. Numbers have no unit, but for angles.
#'
#' @template setting-names
#' @param reach Greatest distance of a cut from the straight line between the landmarks, as a share
#'   of that line's length (the paper: 1/2). `Inf`: no limit.
#' @param longest Greatest length of a cut, as a multiple of the shortest. `Inf`: no limit.
#' @param spacing Greatest distance between the places along a cut at which strength is taken, as a
#'   share of `radius`.
#' @param angles Number of angles of the coarse grid over a half turn.
#' @param refined Number of angles between the neighbours of each local optimum.
#' @param tie Relative difference from the best criterion below which local optima count as equal;
#'   the shortest of these cuts is taken. Curvature has an error of some per cent, and planes that
#'   nearly touch the surface give ragged cuts.
#' @param rival Relative difference from the best criterion below which another optimum is a rival.
#'   A rival gives a warning.
#' @param distinct Least distance of a rival from the path at some place, as a share of the path's
#'   length.
#' @param order Order of the curvature fits, as in [curvature()]. [ridge_curve()] uses the `order`
#'   of its own settings.
#' @param limited Number of angles of a curve whose planes a scheme limits (`angle_limit`, see
#'   [curve_scheme()]).
#' @param floor Of a path of least cost (`path = "crest"`): a unit of length costs `floor` /
#'   (`floor` + rho), with rho the radius times the strength. The lower, the longer a way round it
#'   takes to stay on a crest. Below 0.1 paths on skulls ran through the inside of the bone.
#' @param smoothing Wavelength at which such a path is made smooth, in radii. A wave of this length
#'   keeps half its height. A closed path takes it, or a half, a quarter, an eighth of it: the first
#'   that moves no place by more than `moved` radii.
#' @param smoothing_step,moved See `smoothing`; both in radii. `smoothing_step`: distance of the
#'   places that are smoothed.
#' @param corridor Half width of the corridor about such a path with stops on the way, within which
#'   it is found again without them, in radii.
#' @param block,block_free,block_cost The later parts of a closed path keep off the earlier ones:
#'   within `block` radii of them the cost is `block_cost` times the greatest, but not within
#'   `block_free` radii along them of their ends.
#' @param rival_reach The best other path of least cost is found with the cost raised by as much
#'   within this distance of the first, in radii.
#' @param twice,twice_reach,twice_apart A curve of least cost is not determined if more than a share
#'   `twice` of it runs twice over: another part of it lies within `twice_reach` radii, and
#'   more than `twice_apart` radii away along the curve.
#' @param loop_shortest A closed curve shorter than this has closed in on itself and is not
#'   determined, in radii.
#' @param loop_longest A closed curve longer than this is not determined, in greatest distances of
#'   its stops.
#' @param widest Greatest radius, as a multiple of the distance of the two ends (on a path with
#'   `via`, of its length). A wider one gives a warning, as it is most likely in another unit than
#'   the mesh. Of the ridges of [face_scheme()] the widest has 0.33.
#' @return List of class `path_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @templateVar where section 3.1
#' @template paper
#' @examples
#' path_settings(longest = 1.5)
#' @export
path_settings <- function(..., reach = 0.5, longest = 1.25, spacing = 0.25, angles = 60,
                          refined = 21, tie = 0.002, rival = 0.05, distinct = 0.05,
                          order = "adaptive", limited = 61, floor = 0.1, smoothing = 8,
                          smoothing_step = 0.2, moved = 0.5, corridor = 2, block = 1,
                          block_free = 3, block_cost = 10, rival_reach = 1.5, twice = 0.05,
                          twice_reach = 1, twice_apart = 4, loop_shortest = 6,
                          loop_longest = 4.5, widest = 0.75) {
  new_settings("path_settings", check_path_settings, list(...))
}

check_path_settings <- function(settings) {
  check_reach(settings$reach)
  if (!identical(settings$longest, Inf)) check_number(settings$longest, "longest", lower = 1)
  for (name in c("angles", "refined", "limited")) check_count(settings[[name]], name)
  for (name in c("spacing", "tie", "rival", "distinct")) {
    check_number(settings[[name]], name, lower = 0)
  }
  for (name in c("floor", "smoothing", "smoothing_step", "moved", "corridor", "block", "block_free",
                 "block_cost", "rival_reach", "twice_reach", "twice_apart", "loop_shortest",
                 "loop_longest", "widest")) {
    check_number(settings[[name]], name, lower = 0, open = TRUE)
  }
  check_number(settings$twice, "twice", lower = 0, upper = 1)
  settings$order <- check_order(settings$order)
  settings
}

#' @export
print.path_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<path_settings> of reference_path()")
}
