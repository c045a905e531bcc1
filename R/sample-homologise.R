# Many shapes made homologous: slid against a template that is their own mean.

#' Make the semilandmarks of a sample homologous by sliding
#'
#' Slides the semilandmarks of all shapes. The curve points of all shapes slide against a template,
#' and the Procrustes mean of the slid shapes is the next template. This is repeated until the mean
#' no longer moves. The result therefore does not depend on the first template. Then the points of
#' curves and patches slide together over the surface, see [slide()]. [crestline-package] has a
#' glossary.
#'
#' Sliding all points of a curve the same way in every specimen hardly changes the bending energies.
#' Without a constraint the mean could drift along its curves. In every round we therefore space the
#' points of the mean curves evenly along the arc length, averaged over the sample. The template of
#' a patch's points is the mean of the cuts between the slid curves.
#'
#' In the joint step the bending energy is weighed against the standard errors of the curves. The
#' scale of the energy is estimated from the sample. It is the mean over specimens of the energy of
#' the warp by landmarks, for each place and direction. As in a variance, the sum is divided by the
#' number of specimens less one, since the template is their own mean. The template stores it
#' (`sample$template$energy_scale`, unit of the mesh squared). `slide(shape, sample)` uses it to
#' slide a new specimen in the same way.
#'
#' If the scheme has left-right pairs, the template is made symmetric in every round
#' ([symmetrise()]).
#'
#' Look at parts that [quality()] grades red first, see `red`.
#'
#' Specimens are slid by the workers of your plan of the package future, as in [fit_shapes()]:
#' `future::plan("multisession", workers = 4)`. Each worker has one scan in memory at a time. The
#' result does not depend on the number of workers. For thousands of specimens use `template_from`
#' and `dir`; then not all shapes are in memory either.
#'
#' @param shapes List of `shape`s of one scheme with different `id`s, as [fit_shape()] returns them,
#'   or a `shape_batch` of [fit_shapes()]. Failed specimens are left out. For a batch in files one
#'   scan at a time is in memory. The ends of trimmed curves are homologous only if all shapes were
#'   measured with the same `cut_scale`.
#' @param template First template: a `shape` of the same scheme, or a `shape_sample`, whose template
#'   is used. `NULL`: the first of the shapes with the most points, made symmetric.
#' @param settings [slide_settings()].
#' @param specimens Specimens of the shapes, if the shapes do not have them (`shape$specimen` is
#'   NULL). Either a list of specimens, matched by its names or by their ids; or a function that
#'   gives the specimen of an id, so that only one is in memory.
#' @param tolerance The rounds end when no point of the mean moves by more than this share of the
#'   mean's RMS radius (2e-4: about 0.01 mm on a face).
#' @param rounds Greatest number of rounds. 0: the shapes slide against the given template, which is
#'   not changed. Use 0 for new specimens of an old sample.
#' @template progress
#' @param red Treatment of parts that [quality()] grades red. "warn": they are used, and a warning
#'   names the parts and their specimens. "keep": they are used without a warning. "leave out":
#'   their points are missing from the start. So are the patch points that depend on a red curve;
#'   the landmarks at its ends are used. `status` of each shape then gives the reason, and `missing`
#'   of the sample the number of points. [align()] estimates missing points or drops them. A part
#'   that is red only because points are missing is used with the points that it has.
#' @param limits [quality_limits()] by which parts are red.
#' @param ... For large samples, by name:
#'   * `template_from`: number of specimens, drawn at random, whose mean is the template. All
#'     specimens are then slid against it, each by itself. Its parts are graded by itself too, not
#'     against the lengths of other specimens. By default the template is the mean of all.
#'   * `seed`: number that the draw starts from. `NULL`: it depends on R's random numbers.
#'   * `dir`: path of a folder for the slid shapes. The result is then a sample in files, see
#'     [open_sample()], and a run that was interrupted continues.
#' @return Object of class `shape_sample`, a list:
#'   * `shapes`: named list of the slid shapes, as of [slide()], without their specimens;
#'   * `template`: the `shape` against which they were slid. `slide(shape, template)` gives a slid
#'     shape again;
#'   * `convergence`: data frame with a row for each round; lengths in the unit of the mesh. Columns
#'     are `round`, `movement` and `largest` (RMS and largest movement of the template's points),
#'     `energy`, and `slide` (RMS distance that curve points have slid). `energy` is the mean over
#'     specimens of the sum over curves;
#'   * `missing`: data frame with a row for each specimen and part that has missing points: `id`,
#'     `level`, `part`, `points` (their number);
#'   * `provenance`: versions, scheme, specimens and settings, see [summary.shape_sample()].
#'
#'   It is a container of its shapes: `sample[ids]`, `sample[-3]`, `c()`, see [shape_sample].
#'   `as.array(x, level)` gives k x 3 x n co-ordinates, see [as.array.shape_sample()]. With `dir`:
#'   an object of class `sample_files`.
#' @section Errors: of class `crestline_error`: `shapes` is not a list of shapes; schemes differ;
#'   two shapes have one id; a specimen is missing, or has another mesh than its shape. Of class
#'   `crestline_unit_error`: the shapes have different units (`unit` of [fit_shape()]).
#' @section Warnings: of class `crestline_not_converged`: the mean still moves after the last round.
#'   Of class `crestline_other_radius`: curves were measured with different radii, widths or kinds.
#'   Of class `crestline_red_parts`: parts are red, see `red`. Of class `crestline_twin`: two
#'   specimens have the same mesh and the same landmarks. Of class
#'   `crestline_cut_scale`: curves were trimmed by different `cut_scale`s; the warning gives the one
#'   to use for all. Of class `crestline_not_slid`: some specimens could not be slid against the
#'   template of a share (`template_from`), and are left out.
#' @templateVar where section 4
#' @template paper
#' @details The defaults of [slide_settings()] differ from the paper's. The paper does not space the
#'   points of the mean curves.
#' @examples
#' \donttest{
#' mesh <- Rvcg::vcgSphere(4)
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 7)
#' pairs <- data.frame(level = c("landmarks", "curves"), left = c("a", "bc"), right = c("b", "ac"))
#' curves[2, c("from", "to")] <- c("b", "c")
#' landmarks <- data.frame(landmark = c("a", "b", "c"))
#' scheme <- curve_scheme(landmarks, curves, pairs = pairs, name = "triangle")
#' shapes <- lapply(1:3, function(i) {
#'   one <- mesh
#'   one$vb[1, ] <- one$vb[1, ] * (1 + i / 10)
#'   own <- specimen(one, corners %*% diag(c(1 + i / 10, 1, 1)), id = paste0("ball", i))
#'   fit_shape(own, scheme, progress = FALSE)
#' })
#' sample <- homologise(shapes)
#' sample
#' dim(as.array(sample, "curves"))
#' }
#' @export
homologise <- function(shapes, template = NULL, settings = slide_settings(), specimens = NULL,
                       tolerance = 2e-4, rounds = 20, progress = interactive(),
                       red = c("warn", "leave out", "keep"), limits = quality_limits(), ...) {
  check_given()
  check_flags(progress)
  red <- check_choice(red, c("warn", "leave out", "keep"), "red")
  check_class(limits, "quality_limits", "limits", "quality_limits()")
  check_specimens(specimens)
  check_class(settings, "slide_settings", "settings", "slide_settings()")
  check_dots(..., known = c("template_from", "seed", "dir"))
  many <- share_settings(list(...))
  given <- list(template = template, settings = settings, specimens = specimens,
                tolerance = check_number(tolerance, "tolerance", lower = 0, open = TRUE),
                rounds = check_count(rounds, "rounds", lower = 0), red = red, limits = limits)
  if (length(many)) return(homologise_share(shapes, many, given, progress))
  homologise_all(shapes, given, progress)
}
