#' Settings of sliding
#'
#' All tuning constants of [slide()]. The preset `"crestline"` gave the best correspondence of
#' points between specimens, see below. `"paper"` has the choices of the paper.
#'
#' Sliding has two steps. First points slide along their curves. Then, with `curves = "free"`,
#' points of curves and patches slide together over the surface ([slide()] describes both). We chose
#' the constants on simulated faces of three populations whose true point-to-point correspondence is
#' known, by minimising the scatter of each point. Nearby values do almost as well. A lower bending
#' energy does not mean better correspondence. With the paper's settings the energy is lowest, but
#' the scatter is larger than without sliding. `vignette("homology", "crestline")` has the table.
#'
#' Is a measured crest the homologous line? Two populations give two answers for the brow. In one
#' population the crest is the best place for the points. In the other the corresponding line moves
#' across the crest by 2 mm from face to face. The default is a compromise. On two real faces the
#' points of ridges are 0.35 and 0.18 mm (root mean square) from their ridge, on the brow 0.5 mm.
#' With a larger `pull` they are nearer, with a smaller one points vary less on the second
#' population. For a study of the crests themselves give `floor = 0`. Give `curves = "held"` to keep
#' all curve points exactly on the measured curves.
#'
#' Lengths are in radii, so nothing depends on the unit. A radius is the root mean square distance
#' of the template's landmarks and curve points from their centre. The energy of the joint step has
#' the kernel \eqn{(1 + \sqrt{3} r / h) \exp(-\sqrt{3} r / h) - c r}, r in radii. The usage shows
#' the values of `"crestline"`.
#'
#' @param preset `"crestline"` or `"paper"`.
#' @template setting-names
#' @param energy Points that share a bending energy. `"landmarks"`: each curve with all landmarks,
#'   which do not move. `"own"`: the points of each curve (the paper, which describes one curve).
#'   `"all"`: all landmarks and curves.
#' @param nugget Nugget of curve points, in radii (20 mm on a face), see [bending_energy()].
#'   Landmarks have none. With a nugget an error of a point across its curve does not make it move
#'   along the curve.
#' @param nugget_by `"length"`: all curve points have the same nugget. `"error"`: the nugget is
#'   multiplied by the squared standard error of the point, over the median of the squares. The
#'   template of [homologise()] has standard errors: the root mean square over the sample.
#' @param strain Weight of the squared excess of spacings along a curve over equal ones, in means of
#'   the diagonal of the energy's matrix.
#' @param cut_ends Ends at which the scheme trims a curve, where there is no landmark: they
#'   `"slide"` or `"stay"` (the paper, where the end points of every curve stay).
#' @param gap Least distance between neighbours on a curve, as a share of equal spacing.
#' @param tolerance,sweeps The first step ends when no point slides by more than this share of its
#'   spacing. `sweeps` is the greatest number of sweeps over the points.
#' @param surface Sliding of the points inside patches if curves are held. `"mesh"`: freely on the
#'   mesh. `"transect"`: along their transect (the paper). `"between"`: they do not slide, and stay
#'   between the slid curves.
#' @param surface_energy Points inside patches that share a bending energy. `"all"`: those of all
#'   patches, with curves and landmarks held. `"patch"`: those of each patch. This is our reading of
#'   the paper, which slides each transect as a curve and does not define its energy.
#' @param surface_nugget Nugget of curve and surface points in this energy, in radii (300 mm on a
#'   face).
#' @param surface_tolerance,surface_sweeps As `tolerance` and `sweeps`, for the points inside
#'   patches; the tolerance is in radii.
#' @param rank `tolerance` of [bending_energy()].
#' @param curves Points of curves after the first step. `"free"`: they slide over the mesh together
#'   with those of patches. `"held"`: they stay on their curves (the paper), and `surface`,
#'   `surface_energy` and `surface_nugget` apply to the patches.
#' @param range,rough Constants of the joint step's energy, see Details. `range` is h of the smooth
#'   part, in radii (85 mm on a face). `rough` is c, the weight of the rough part, which is that of
#'   the thin-plate spline.
#' @param joint_nugget Nugget of curve and surface points in the joint step, in units of its kernel,
#'   1 at r = 0.
#' @param placed_nugget,found_nugget,doubtful_nugget Nuggets in the joint step, in the same unit, of
#'   landmarks: placed by hand; found by [find_landmarks()]; and predicted or found with little
#'   confidence.
#' @param pull Weight of the curves' pull on their points. 1: the weight that the standard errors
#'   and the sample's scale of the energy give (see [homologise()]).
#' @param floor Uncertainty of a ridge or valley as a homologous line, beside its standard error: a
#'   share of the radius of its curvature. On a face this is 0.4 mm for 5 mm and 0.8 mm for 10 mm.
#'   0: points stay nearest to crests.
#' @param reach Distance, in standard errors (`floor` included), from which on a curve does not
#'   attract a point (Tukey's biweight).
#' @param relaxation Factor on every step towards a point's minimiser (1: exact; less than 2).
#' @param halvings Greatest number of halvings of a step. A step is halved if it would raise the
#'   sum, or bring a point too close to its neighbour: closer than `gap` times their distance in the
#'   warp.
#' @param joint_tolerance,joint_sweeps The joint step ends when the root mean square step of a sweep
#'   is below `joint_tolerance`, in radii. `joint_sweeps` is the greatest number of sweeps.
#' @return List of class `slide_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @templateVar where section 4
#' @template paper
#' @examples
#' slide_settings(strain = 0)
#' slide_settings("paper")
#' @export
slide_settings <- function(preset = c("crestline", "paper"), ..., energy = "landmarks",
                           nugget = 0.35, nugget_by = "length", strain = 0.5, cut_ends = "slide",
                           gap = 0.1, tolerance = 1e-5, sweeps = 1000, surface = "mesh",
                           surface_energy = "all", surface_nugget = 5, surface_tolerance = 1e-5,
                           surface_sweeps = 200, rank = 1e-6, curves = "free", range = 1.5,
                           rough = 3, joint_nugget = 2, placed_nugget = 0.1, found_nugget = 1,
                           doubtful_nugget = 20, pull = 4, floor = 0.08, reach = 5,
                           relaxation = 1.7, halvings = 4, joint_tolerance = 1e-5,
                           joint_sweeps = 100) {
  preset <- check_choice(preset, c("crestline", "paper"), "preset")
  paper <- list(energy = "own", nugget = 0, strain = 0, cut_ends = "stay", surface = "transect",
                surface_energy = "patch", surface_nugget = 0, curves = "held")
  settings <- new_settings("slide_settings", check_slide_settings, list(...),
                           if (preset == "paper") paper)
  structure(settings, preset = preset, class = "slide_settings")
}

check_slide_settings <- function(settings) {
  for (name in c("nugget", "strain", "surface_nugget", "rough", "joint_nugget", "placed_nugget",
                 "found_nugget", "doubtful_nugget", "pull", "floor")) {
    check_number(settings[[name]], name, lower = 0)
  }
  for (name in c("tolerance", "surface_tolerance", "rank", "range", "reach", "joint_tolerance")) {
    check_number(settings[[name]], name, lower = 0, open = TRUE)
  }
  check_number(settings$gap, "gap", lower = 0, upper = 0.5)
  check_number(settings$relaxation, "relaxation", lower = 0, upper = 2, open = TRUE)
  for (name in c("sweeps", "surface_sweeps", "joint_sweeps")) check_count(settings[[name]], name)
  check_count(settings$halvings, "halvings", lower = 0)
  check_choice(settings$curves, c("free", "held"), "curves")
  check_choice(settings$energy, c("landmarks", "own", "all"), "energy")
  check_choice(settings$nugget_by, c("length", "error"), "nugget_by")
  check_choice(settings$cut_ends, c("slide", "stay"), "cut_ends")
  check_choice(settings$surface, c("mesh", "transect", "between"), "surface")
  check_choice(settings$surface_energy, c("all", "patch"), "surface_energy")
  joint <- settings$surface == "mesh" && settings$surface_energy == "all"
  if (settings$curves == "free" && !joint) {
    crestline_abort("free curve points slide together with those of all patches, on the mesh.",
                    "Give `curves = \"held\"` with another `surface` or `surface_energy`.",
                    stage = "arguments")
  }
  settings
}

#' @export
print.slide_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, sprintf("<slide_settings> preset \"%s\"", attr(x, "preset")))
}
