# The shapes of a sample slid against their own mean, by the user's plan.

#' @param given Arguments of [homologise()], checked.
#' @noRd
homologise_all <- function(shapes, given, progress) {
  specimens <- given$specimens
  if (is.null(specimens)) specimens <- specimens_in_files(shapes)
  shapes <- check_shapes(shapes)
  warn_cut_scales(shapes, "homologise")
  warn_curve_tables(shapes)
  shapes <- with_red(shapes, given$red, given$limits)
  template <- first_template(shapes, given$template, given$rounds)
  tick <- progress_ticks(progress, 3 * length(shapes), "the sample")
  states <- lapply(shapes, slide_state, given$settings)
  found <- mean_curves(states, template, given$settings, given$tolerance, given$rounds)
  slid <- slide_together(shapes, states, found$template, given$settings, specimens,
                         given$rounds > 0, tick)
  provenance <- sample_provenance(slid$template, slid$plan, given[c("tolerance", "rounds", "red")])
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
    list(name = shape$id, shape = shape, state = state,
         specimen = worker_specimen(shape, specimens))
  }, shapes, states)
  with_part <- function(tasks, name, values) {
    Map(function(task, value) replace(task, name, list(value)), tasks, values)
  }
  cuts <- each_in_workers(tasks, cut_task, list(plan = plan), tick)
  if (own_mean) {
    # The template with the mean of the specimens' surface points, each laid onto it by landmarks
    # and curves
    stores <- lapply(cuts, `[[`, "store")
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
    template <- template_shape(template, mean, "mean",
                               template$points$se[!duplicated(template$scheme$points$place)])
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

check_shapes <- function(shapes) {
  if (inherits(shapes, "shape_batch")) shapes <- measured(shapes)
  if (inherits(shapes, "shape")) shapes <- list(shapes)
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "homologise"
  )
  if (!is.list(shapes) || !length(shapes)) {
    fail(sprintf("`shapes` is %s.", describe_value(shapes)), "Give a list of shapes.")
  }
  wrong <- which(!vapply(shapes, inherits, NA, "shape"))
  if (length(wrong)) {
    fail(sprintf("element %d of `shapes` is %s.", wrong[1], describe_value(shapes[[wrong[1]]])),
         "Give shapes only, as fit_shape() returns them: leave out what failed.")
  }
  for (shape in shapes) check_class(shape, "shape", "shapes", "fit_shape()")
  ids <- vapply(shapes, `[[`, "", "id")
  if (anyDuplicated(ids)) {
    fail(sprintf("two shapes have the id \"%s\".", ids[anyDuplicated(ids)]),
         "Give every specimen an `id` of its own.")
  }
  for (shape in shapes) check_same_scheme(shape, shapes[[1]])
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
specimen_of <- function(shape, specimens) {
  nameless <- is.list(specimens) && is.null(names(specimens))
  if (nameless && all(vapply(specimens, inherits, NA, "specimen"))) {
    names(specimens) <- vapply(specimens, `[[`, "", "id")
  }
  specimen <- if (is.null(specimens)) shape$specimen else
    if (is.function(specimens)) specimens(shape$id) else specimens[[shape$id]]
  kept_specimen(shape, specimen)
}

#' A list of specimens by id, a function of the id, or NULL
#' @noRd
check_specimens <- function(specimens) {
  if (is.null(specimens) || is.function(specimens)) return(invisible())
  specimens <- check_list(specimens, "specimen", "specimens", "specimen() or read_specimen()")
  if (is.null(names(specimens))) {
    refuse_argument("specimens", NULL, "Name each by its id.", "a list without names")
  }
}

has_pairs <- function(scheme) any(scheme$pairs$level != "surface")

#' The template to begin with: the given one, or the first of the shapes with the most points
#' @noRd
first_template <- function(shapes, template, rounds) {
  if (inherits(template, "shape_sample")) template <- validate(template)$template
  if (!is.null(template)) {
    check_class(template, "shape", "template", "symmetrise() or homologise()")
    check_same_scheme(shapes[[1]], template)
    return(template)
  }
  if (rounds == 0) {
    crestline_abort("there is no `template`, and `rounds` is 0.",
                    "Give the template of the old sample, or let it be found.",
                    stage = "homologise")
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
    of_curve <- function(curve, s) (s - curve$s)[curve$rows[, "point"]]
    off <- Map(function(state, x) Map(of_curve, state$curves, x$s), states, slid)
    distance_slid <- sqrt(mean(unlist(off)^2))
    table[[round]] <- data.frame(
      round = round, movement = sqrt(mean(moved^2)), largest = max(moved),
      energy = mean(vapply(slid, function(x) sum(x$sliding$energy_after), 0)),
      slide = distance_slid
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
