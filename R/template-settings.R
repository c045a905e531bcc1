#' Settings of sliding
#'
#' All tuning constants of [slide()] in one place. The preset `"crestline"` makes points of many
#' specimens most nearly homologous, as measured below. `"paper"` reproduces the choices of the
#' paper.
#'
#' Sliding has two steps. First points slide along their curves. Then, with `curves = "free"`,
#' points of curves and patches slide together over the surface ([slide()] describes both). We chose
#' the constants on simulated faces of three populations whose true point-to-point correspondence is
#' known, by minimising the scatter of each point. Nearby values do almost as well. A lower bending
#' energy does not mean better correspondence: with the paper's energies it is lowest, and the
#' scatter larger than without sliding. `vignette("homology", "crestline")` has the table.
#'
#' Is a measured crest the homologous line? Two populations give two answers for the brow. On one
#' the crest is the best place for the points, on the other the corresponding line moves across the
#' crest by 2 mm from face to face. The default takes the middle: `floor` lets the points of broad
#' ridges (brow, mandible) leave the crest by some 1 mm. For a study of the crests themselves give
#' `floor = 0`: points then stay on their ridge within its standard error. Give `curves = "held"` to
#' keep all curve points exactly on the measured curves.
#'
#' A radius is the root mean square distance of the template's landmarks and curve points from their
#' centre, so nothing depends on the unit. The energy of the joint step has the kernel
#' \eqn{(1 + \sqrt{3} r / h) \exp(-\sqrt{3} r / h) - c r}, r in radii. The usage shows the values of
#' `"crestline"`.
#'
#' @param preset `"crestline"` or `"paper"`.
#' @param ... Nothing: settings are given by name, and an unknown name is an error.
#' @param energy Which points share a bending energy: a curve and all `"landmarks"`, which stay
#'   where they are; each curve's `"own"` points (the paper, which describes it for one curve); or
#'   `"all"` landmarks and curves.
#' @param nugget Of curve points, in radii (20 mm on a face; landmarks have none), see
#'   [bending_energy()]: it keeps a point from moving along its curve only to make up for an error
#'   across it.
#' @param nugget_by `"length"`, the same for all; `"error"`, this times the square of a point's
#'   standard error over the median square, where the template has any (that of [homologise()]
#'   has: the sample's root mean square).
#' @param strain Weight of the squared excess of spacings along a curve over equal ones, in means of
#'   the diagonal of the energy's matrix.
#' @param cut_ends Where the scheme cuts a curve off there is no landmark; such an end `"slide"`s
#'   too, or must `"stay"` (the paper, where the end points of every curve stay).
#' @param gap Neighbours on a curve keep this share of equal spacing between them.
#' @param tolerance,sweeps Done when no point slides further than this share of its spacing; most
#'   sweeps over the points.
#' @param surface The points inside patches slide freely on the `"mesh"`, along their `"transect"`
#'   (the paper), or not at all and stay `"between"` the slid curves.
#' @param surface_energy Of `"all"` points (curves and landmarks held), or of each `"patch"` (our
#'   reading of the paper, which slides each transect as a curve and does not say which points
#'   share its energy).
#' @param surface_nugget Of curve and surface points there, in radii (300 mm on a face).
#' @param surface_tolerance,surface_sweeps As those of curves; the tolerance in radii.
#' @param rank `tolerance` of [bending_energy()].
#' @param curves After the first step the points of curves slide `"free"` over the mesh together
#'   with those of patches, or are `"held"` on their curves (the paper; then `surface`,
#'   `surface_energy` and `surface_nugget` say how patches slide).
#' @param range,rough Of the joint step's energy: h, in radii (85 mm on a face), of its smooth part,
#'   and c, the weight of its rough part, the thin-plate spline's. See Details.
#' @param joint_nugget Nugget of curve and surface points in the joint step, in units of its kernel,
#'   1 at r = 0.
#' @param placed_nugget,found_nugget,doubtful_nugget Nuggets there of landmarks that were placed by
#'   hand, found by [find_landmarks()], or only predicted or found with little confidence.
#' @param floor A ridge or valley measured with curvature of radius q counts as known, as a
#'   homologous line, to within `floor` times q^2 / radius at best (on a face 0.25 mm for q = 5 mm
#'   and 1 mm for 10 mm), whatever its standard error; 0 keeps points on crests.
#' @param reach A curve no longer draws points that are so many standard errors off (Tukey's
#'   biweight; `floor` included).
#' @param relaxation Factor on every step towards a point's minimiser (1: exact; less than 2).
#' @param halvings How often a step is halved that would raise the sum or bring a point past its
#'   neighbour (that is, nearer than `gap` of its distance there in the warp).
#' @param joint_tolerance,joint_sweeps Done when the root mean square step of a sweep is below, in
#'   radii; most sweeps.
#' @return List of class `slide_settings`.
#' @section Errors: of class `crestline_error`, for a name that is no setting or a value out of
#'   range.
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
                           doubtful_nugget = 20, floor = 0.55, reach = 5, relaxation = 1.7,
                           halvings = 4, joint_tolerance = 1e-5, joint_sweeps = 100) {
  preset <- check_choice(preset, c("crestline", "paper"), "preset")
  paper <- list(energy = "own", nugget = 0, strain = 0, cut_ends = "stay", surface = "transect",
                surface_energy = "patch", surface_nugget = 0, curves = "held")
  settings <- new_settings("slide_settings", check_slide_settings, list(...),
                           if (preset == "paper") paper)
  structure(settings, preset = preset, class = "slide_settings")
}

check_slide_settings <- function(settings) {
  for (name in c("nugget", "strain", "surface_nugget", "rough", "joint_nugget", "placed_nugget",
                 "found_nugget", "doubtful_nugget", "floor")) {
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
