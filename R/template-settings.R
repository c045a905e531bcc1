#' Settings of sliding
#'
#' All tuning constants of [slide()] in one place. The preset `"crestline"` makes points of many
#' specimens most nearly homologous, as measured below. `"paper"` reproduces the choices of the
#' paper.
#'
#' We chose the constants of `"crestline"` on 23 simulated faces whose true point-to-point
#' correspondence is known, by minimising the scatter of each point along its curve. Nearby values
#' do almost as well. A lower bending energy does not mean better correspondence: with the paper's
#' energies it is lowest, and the scatter larger than without sliding.
#' `vignette("homology", "crestline")` has the table.
#'
#' @param preset `"crestline"` or `"paper"`.
#' @param ... Settings to change, by name; print a preset to see its values. A radius is the root
#'   mean square distance of the template's landmarks and curve points from their centre, so nothing
#'   depends on the unit.
#'   * `energy`: which points share a bending energy: a curve and all `"landmarks"`, which stay
#'     where they are; each curve's `"own"` points (the paper, which describes it for one curve); or
#'     `"all"` landmarks and curves;
#'   * `nugget`: of curve points, in radii (20 mm on a face; landmarks have none), see
#'     [bending_energy()]: it keeps a point from moving along its curve only to make up for an error
#'     across it;
#'   * `nugget_by`: `"length"`, the same for all; `"error"`, this times the square of a point's
#'     standard error over the median square, where the template has any (that of [homologise()]
#'     has: the sample's root mean square);
#'   * `strain`: weight of the squared excess of spacings along a curve over equal ones, in means of
#'     the diagonal of the energy's matrix;
#'   * `cut_ends`: where the scheme cuts a curve off there is no landmark; such an end `"slide"`s
#'     too, or must `"stay"` (the paper, where the end points of every curve stay);
#'   * `gap`: neighbours on a curve keep this share of equal spacing between them;
#'   * `tolerance`: done when no point slides further than this share of its spacing; `sweeps`: most
#'     sweeps over the points;
#'   * `surface`: the points inside patches slide freely on the `"mesh"`, along their `"transect"`
#'     (the paper), or not at all and stay `"between"` the slid curves;
#'   * `surface_energy`: of `"all"` points (curves and landmarks held), or of each `"patch"` (our
#'     reading of the paper, which slides each transect as a curve and does not say which points
#'     share its energy);
#'   * `surface_nugget`: of curve and surface points there, in radii (300 mm on a face);
#'   * `surface_tolerance` (radii) and `surface_sweeps`, as those of curves;
#'   * `rank`: `tolerance` of [bending_energy()].
#' @return List of class `slide_settings`.
#' @section Errors: of class `crestline_error`, for a name that is no setting or a value out of
#'   range.
#' @references The paper, section 4.
#' @examples
#' slide_settings(strain = 0)
#' slide_settings("paper")
#' @export
slide_settings <- function(preset = c("crestline", "paper"), ...) {
  preset <- check_choice(preset, c("crestline", "paper"), "preset")
  settings <- list(energy = "landmarks", nugget = 0.35, nugget_by = "length", strain = 0.5,
                   cut_ends = "slide", gap = 0.1,
                   tolerance = 1e-5, sweeps = 1000, surface = "mesh", surface_energy = "all",
                   surface_nugget = 5,
                   surface_tolerance = 1e-5, surface_sweeps = 200, rank = 1e-6)
  paper <- list(energy = "own", nugget = 0, strain = 0, cut_ends = "stay", surface = "transect",
                surface_energy = "patch", surface_nugget = 0)
  if (preset == "paper") settings[names(paper)] <- paper
  change <- list(...)
  unknown <- setdiff(names(change), names(settings))
  if (length(unknown) > 0 || (length(change) > 0 && is.null(names(change)))) {
    crestline_abort(sprintf("there is no setting %s.",
                            paste0("\"", unknown, "\"", collapse = ", ")),
                    paste0("Settings are: ", paste(names(settings), collapse = ", "), "."),
                    stage = "arguments")
  }
  settings[names(change)] <- change
  structure(check_slide_settings(settings), preset = preset, class = "slide_settings")
}

check_slide_settings <- function(settings) {
  for (name in c("nugget", "strain",
                 "surface_nugget")) check_number(settings[[name]], name, lower = 0)
  for (name in c("tolerance", "surface_tolerance",
                 "rank")) check_number(settings[[name]], name, lower = 0, open = TRUE)
  check_number(settings$gap, "gap", lower = 0, upper = 0.5)
  check_count(settings$sweeps, "sweeps")
  check_count(settings$surface_sweeps, "surface_sweeps")
  check_choice(settings$energy, c("landmarks", "own", "all"), "energy")
  check_choice(settings$nugget_by, c("length", "error"), "nugget_by")
  check_choice(settings$cut_ends, c("slide", "stay"), "cut_ends")
  check_choice(settings$surface, c("mesh", "transect", "between"), "surface")
  check_choice(settings$surface_energy, c("all", "patch"), "surface_energy")
  settings
}

#' @export
print.slide_settings <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat(sprintf("<slide_settings> preset \"%s\"\n", attr(x, "preset")))
    cat(strwrap(paste(names(x), vapply(x, format, ""), sep = " = ", collapse = ", "), indent = 2,
                exdent = 2), sep = "\n")
    invisible(x)
  })
}
