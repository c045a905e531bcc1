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
#'   to use for all. Of class `crestline_not_slid`: with `template_from`, specimens that could not be
#'   slid are left out; the warning names them.
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
  check_dots(..., known = c("template_from", "seed", "dir"))
  if (...length()) {
    given <- list(template = template, settings = settings, specimens = specimens,
                  tolerance = tolerance, rounds = rounds, red = red, limits = limits)
    return(homologise_cohort(shapes, cohort_settings(list(...)), given, progress))
  }
  red <- check_choice(red, c("warn", "leave out", "keep"), "red")
  check_class(limits, "quality_limits", "limits", "quality_limits()")
  check_specimens(specimens)
  if (is.null(specimens)) specimens <- specimens_in_files(shapes)
  shapes <- check_shapes(shapes)
  warn_cut_scales(shapes, "homologise")
  warn_curve_tables(shapes)
  check_class(settings, "slide_settings", "settings", "slide_settings()")
  tolerance <- check_number(tolerance, "tolerance", lower = 0, open = TRUE)
  rounds <- check_count(rounds, "rounds", lower = 0)
  shapes <- with_red(shapes, red, limits)
  template <- first_template(shapes, template, rounds)
  tick <- progress_ticks(progress, 3 * length(shapes), "the sample")
  states <- lapply(shapes, slide_state, settings)
  found <- mean_curves(states, template, settings, tolerance, rounds)
  slid <- slide_together(shapes, states, found$template, settings, specimens, rounds > 0, tick)
  provenance <- sample_provenance(
    slid$template, slid$plan, list(tolerance = tolerance, rounds = rounds, red = red)
  )
  validate_shape_sample(new_shape_sample(slid$shapes, slid$template, found$convergence, provenance))
}

#' All shapes slid against one template
#'
#' @param states As of [slide_state()].
#' @param own_mean Whether the template is the mean of these shapes: then it takes its surface from
#'   them too.
#' @param tick Called three times for every shape.
#' @return List: `shapes` (without their specimens), `template`, `plan`.
#' @noRd
slide_together <- function(shapes, states, template, settings, specimens, own_mean, tick) {
  plan <- slide_plan(template, settings)
  tasks <- Map(function(shape, state) {
    list(name = shape$id, shape = shape, state = state, specimen = worker_specimen(shape, specimens))
  }, shapes, states)
  with_part <- function(tasks, name, values) {
    Map(function(task, value) replace(task, name, list(value)), tasks, values)
  }
  cuts <- each_in_workers(tasks, cut_task, list(plan = plan), tick)
  if (own_mean) {
    template <- with_mean_surface(template, lapply(cuts, `[[`, "store"))
    plan <- slide_plan(template, settings)
  }
  tasks <- with_part(tasks, "cut", cuts)
  starts <- each_in_workers(tasks, start_task, list(plan = plan), tick)
  if (slides_free(settings)) {
    if (is.null(plan$scale)) plan$scale <- energy_scale(starts, own_mean)
    template$energy_scale <- plan$scale
  }
  slid <- each_in_workers(with_part(tasks, "start", starts), finish_task, list(plan = plan), tick)
  list(shapes = slid, template = template, plan = plan)
}

#' One shape's patches cut between its slid curves
#' @param task List: `name`, `shape`, `state` of [slide_state()], `specimen` of [worker_specimen()].
#' @noRd
cut_task <- function(task, plan) {
  cut <- cut_between_slid(task$shape, task$state, slide_curves(task$state, plan),
                          task_specimen(task))
  cut$store[places_left_out(task$shape), ] <- NA
  cut
}

#' Where the joint step of one shape begins; NULL where curve points are held
#' @noRd
start_task <- function(task, plan) {
  if (slides_free(plan$settings)) {
    joint_start(task$shape, task$cut$store, plan, task_specimen(task))
  }
}

finish_task <- function(task, plan) {
  shape <- finish_slide(task$shape, task$cut, task$start, plan, task_specimen(task))
  shape["specimen"] <- list(NULL)
  shape
}

#' What a worker needs to have a shape's scan: the result in its file, the scan itself, or, in this
#' process, a function that gives it
#' @noRd
worker_specimen <- function(shape, specimens) {
  kept <- if (is.function(specimens)) attr(specimens, "kept")[[shape$id]]
  stored <- inherits(shape$specimen, "stored_specimen")
  if (is.null(specimens) || stored && !is.null(kept)) return(shape$specimen)
  if (is.null(kept)) function() specimen_of(shape, specimens) else kept
}

task_specimen <- function(task) {
  specimen <- task$specimen
  if (inherits(specimen, "kept_shape")) specimen <- specimen$specimen
  if (is.function(specimen)) specimen() else kept_specimen(task$shape, specimen)
}

#' A piece of work for each shape: by the user's plan where it has several workers, else one after
#' the other
#'
#' Scans that a function of the user gives stay in this process. Work that a worker did not give
#' back is done again, here.
#'
#' @param tasks List of lists by id, with `name`.
#' @param arguments Further arguments of `work`, the same for all.
#' @param tick Called once for each.
#' @noRd
each_in_workers <- function(tasks, work, arguments, tick) {
  here <- function(task) {
    value <- do.call(work, c(list(task), arguments))
    tick()
    value
  }
  local <- any(vapply(tasks, function(task) is.function(task$specimen), NA))
  workers <- if (local) 1 else plan_workers()
  if (workers < 2) return(lapply(tasks, here))
  chunk <- c(check_chunk(NULL), ceiling(length(tasks) / (2 * workers)))[1]
  values <- run_tasks(unname(tasks), work, arguments, chunk)
  lost <- vapply(values, inherits, NA, "lost_task")
  values[lost] <- lapply(unname(tasks[lost]), here)
  for (i in which(!lost)) tick()
  stats::setNames(values, names(tasks))
}

#' How many workers the user's plan has; 1 without the packages for them
#' @noRd
plan_workers <- function() {
  there <- all(vapply(c("future", "progressr"), requireNamespace, NA, quietly = TRUE))
  if (there) future::nbrOfWorkers() else 1
}

check_shapes <- function(shapes, call = rlang::caller_env()) {
  if (inherits(shapes, "shape_batch")) shapes <- measured(shapes)
  if (inherits(shapes, "shape")) shapes <- list(shapes)
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "homologise", call = call
  )
  if (!is.list(shapes) || !length(shapes)) {
    fail(sprintf("`shapes` is %s.", describe_value(shapes)), "Give a list of shapes.")
  }
  wrong <- which(!vapply(shapes, inherits, NA, "shape"))
  if (length(wrong)) {
    fail(sprintf("element %d of `shapes` is %s.", wrong[1], describe_value(shapes[[wrong[1]]])),
         "Give shapes only, as fit_shape() returns them: leave out what failed.")
  }
  for (shape in shapes) check_class(shape, "shape", "shapes", "fit_shape()", call)
  ids <- vapply(shapes, `[[`, "", "id")
  if (anyDuplicated(ids)) {
    fail(sprintf("two shapes have the id \"%s\".", ids[anyDuplicated(ids)]),
         "Give every specimen an `id` of its own.")
  }
  for (shape in shapes) check_same_scheme(shape, shapes[[1]], call)
  shapes <- stats::setNames(shapes, ids)
  tell_twins(shapes, "homologise")
  shapes
}

#' The shapes of a batch; of one in files without their specimens, which are read again when they
#' are needed
#' @noRd
measured <- function(batch) {
  bare <- !is.null(specimens_in_files(batch))
  shapes <- lapply(names(batch), function(name) {
    shape <- batch[[name]]
    if (bare && !inherits(shape$specimen, "stored_specimen")) shape$specimen <- NULL
    shape
  })
  Filter(Negate(is.null), shapes)
}

#' A function that gives the specimen of an id, for a batch in files; attribute `kept`: its results
#' @noRd
specimens_in_files <- function(x) {
  if (!inherits(x, "shape_batch")) return(NULL)
  kept <- Filter(function(one) inherits(one, "kept_shape"), plain_list(renewed_batch(x)))
  if (length(kept)) structure(function(id) x[[id]]$specimen, kept = kept)
}

#' @param specimens As in [homologise()].
#' @noRd
specimen_of <- function(shape, specimens, call = rlang::caller_env()) {
  nameless <- is.list(specimens) && is.null(names(specimens))
  if (nameless && all(vapply(specimens, inherits, NA, "specimen"))) {
    names(specimens) <- vapply(specimens, `[[`, "", "id")
  }
  specimen <- if (is.null(specimens)) shape$specimen else
    if (is.function(specimens)) specimens(shape$id) else specimens[[shape$id]]
  kept_specimen(shape, specimen, call)
}

#' A list of specimens by id, a function of the id, or NULL
#' @noRd
check_specimens <- function(specimens, call = rlang::caller_env()) {
  if (is.null(specimens) || is.function(specimens)) return(invisible())
  specimens <- check_list(specimens, "specimen", "specimens", "specimen() or read_specimen()", call)
  if (is.null(names(specimens))) {
    refuse_argument("specimens", NULL, "Name each by its id.", call, "a list without names")
  }
}

has_pairs <- function(scheme) any(scheme$pairs$level != "surface")

#' The template to begin with: the given one, or the first of the shapes with the most points
#' @noRd
first_template <- function(shapes, template, rounds, call = rlang::caller_env()) {
  if (inherits(template, "shape_sample")) template <- validate(template)$template
  if (!is.null(template)) {
    check_class(template, "shape", "template", "symmetrise() or homologise()", call)
    check_same_scheme(shapes[[1]], template, call)
    return(template)
  }
  if (rounds == 0) {
    crestline_abort("there is no `template`, and `rounds` is 0.",
                    "Give the template of the old sample, or let it be found.",
                    stage = "homologise", call = call)
  }
  first <- shapes[[which.max(vapply(shapes, function(shape) sum(!is.na(shape$points$x)), 0L))]]
  if (has_pairs(first$scheme)) symmetrise(first) else
    template_shape(first, places_of(first), first$id)
}

#' Rounds of sliding curves and taking their mean as the template
#'
#' On noisy scans a point may have two places of least energy and take one and the other in turn,
#' and the mean with it: then half a step is made.
#'
#' @param states List of [slide_state()]s.
#' @param stalled Half a step where the largest movement is still this share of that of the round
#'   before.
#' @return List: `template`, `convergence`.
#' @noRd
mean_curves <- function(states, template, settings, tolerance, rounds, stalled = 0.9) {
  table <- list()
  moved <- Inf
  for (round in seq_len(rounds)) {
    plan <- slide_plan(template, settings)
    slid <- lapply(states, slide_curves, plan)
    before <- plan$xyz
    after <- mean_template(before, gauge_fixed(states, slid), template$scheme)
    last <- max(moved)
    moved <- sqrt(rowSums((after - before)^2))
    moved <- moved[!is.na(moved)]
    if (max(moved) >= stalled * last) after <- (before + after) / 2
    table[[round]] <- data.frame(
      round = round, movement = sqrt(mean(moved^2)), largest = max(moved),
      energy = mean(vapply(slid, function(x) sum(x$sliding$energy_after), 0)),
      slide = distance_slid(states, slid)
    )
    template <- template_shape(template, after, "mean", mean_error(states))
    if (max(moved) <= tolerance * plan$radius) break
  }
  if (rounds > 0 && max(moved) > tolerance * plan$radius) warn_moving(rounds, max(moved))
  list(template = template, convergence = do.call(rbind, table))
}

#' Root mean square of the standard errors of every place, NA where there is none
#' @noRd
mean_error <- function(states) {
  variance <- vapply(states, function(state) state$store[, "se"]^2, states[[1]]$store[, "se"])
  mean <- rowMeans(matrix(variance, nrow(states[[1]]$store)), na.rm = TRUE)
  sqrt(ifelse(is.nan(mean), NA, mean))
}

warn_moving <- function(rounds, moved) {
  crestline_warn(sprintf("after %d rounds the mean still moves, by %.2g at most.", rounds, moved),
                 "Give more `rounds`, or a larger `tolerance`.", stage = "homologise",
                 class = "crestline_not_converged")
}

distance_slid <- function(states, slid) {
  of_curve <- function(curve, s) (s - curve$s)[curve$rows[, "point"]]
  off <- Map(function(state, x) Map(of_curve, state$curves, x$s), states, slid)
  sqrt(mean(unlist(off)^2))
}

#' Positions of landmarks and curve points, every curve re-parametrised by the sample's mean share
#' of arc length
#'
#' Shares are counted from the curve's last point, of the length that the scheme keeps, so that a
#' cut end has its mean place too.
#' @return List of matrices, a row a place.
#' @noRd
gauge_fixed <- function(states, slid) {
  x <- lapply(slid, `[[`, "x")
  for (name in unique(unlist(lapply(states, function(state) names(state$curves))))) {
    with <- which(vapply(states, function(state) name %in% names(state$curves), NA))
    curves <- lapply(states[with], function(state) state$curves[[name]])
    even <- even_places(curves, lapply(slid[with], function(one) one$s[[name]]))
    for (i in seq_along(with)) {
      at <- which(!is.na(even[[i]]))
      x[[with[i]]][curves[[i]]$place[at], ] <- points_along(curves[[i]]$path, even[[i]][at])
    }
  }
  x
}

#' Arc lengths at which points stand evenly in the mean over specimens
#'
#' @param curves List of one curve's states.
#' @param s List of its arc lengths after sliding.
#' @return List of arc lengths, NA where missing and at fixed ends.
#' @noRd
even_places <- function(curves, s) {
  n <- curves[[1]]$n
  share <- mapply(function(curve, s) (attr(curve$path, "length") - s) / curve$kept, curves, s)
  mean <- rowMeans(matrix(share, n), na.rm = TRUE)
  aim <- seq(1, 0, length.out = n)
  lapply(seq_along(curves), function(i) {
    curve <- curves[[i]]
    known <- !is.na(s[[i]])
    at <- curve$rows[, "point"]
    even <- rep(NA_real_, n)
    if (sum(known) > 1) even[at] <- line_through(mean[known], s[[i]][known], aim[at])
    pmin(pmax(even, 0), attr(curve$path, "length"))
  })
}

#' Linear interpolation, going on straight beyond the first of decreasing x
#' @noRd
line_through <- function(x, y, at) {
  inside <- stats::approx(rev(x), rev(y), at, rule = 2, ties = "ordered")$y
  beyond <- at > x[1]
  inside[beyond] <- y[1] + (at[beyond] - x[1]) * (y[2] - y[1]) / (x[2] - x[1])
  inside
}

#' The mean, symmetric where the scheme has pairs, laid onto the template before
#' @noRd
mean_template <- function(before, x, scheme) {
  core <- rownames(before) %in% scheme$points$place[scheme$points$level != "surface"]
  mean <- procrustes_mean(lapply(x, only_rows, core), only_rows(before, core))
  if (has_pairs(scheme)) mean <- symmetric_mean(mean, mirror_places(scheme), "mean")
  laid_onto(mean, before, scale = FALSE)
}

only_rows <- function(x, rows) replace(x, !rows, NA)

#' The template with the mean of the specimens' surface points, each laid onto it by landmarks and
#' curves
#' @noRd
with_mean_surface <- function(template, stores) {
  xyz <- places_of(template)
  core <- !is.na(xyz[, 1])
  laid <- lapply(stores, function(store) {
    own <- store[, c("x", "y", "z")]
    fit <- superimposition(own[core, ], xyz[core, ], scale = TRUE)
    fit(own)
  })
  mean <- mean_of(laid)
  mean[core, ] <- xyz[core, ]
  if (has_pairs(template$scheme)) {
    mean <- symmetric_mean(mean, mirror_places(template$scheme), "mean", by = core)
  }
  mean[core, ] <- xyz[core, ]
  template_shape(template, mean, "mean",
                 template$points$se[!duplicated(template$scheme$points$place)])
}
