# Thousands of shapes made homologous: a template from a random share, then every specimen slid
# against it by itself, one in memory at a time.

#' Further arguments of [homologise()] for large samples
#' @return List: `template_from`, `seed`, `dir`, NULL where not given; NULL where nothing is.
#' @noRd
share_settings <- function(given) {
  if (!length(given)) return(NULL)
  from <- given$template_from
  if (is.null(from)) {
    refuse_argument("template_from", from, paste("`seed` and `dir` go with the number of specimens",
                                                 "that the template is made from."))
  }
  from <- check_count(from, "template_from", lower = 2)
  seed <- given$seed
  if (!is.null(seed)) seed <- check_number(seed, "seed")
  list(template_from = from, seed = seed,
       dir = if (!is.null(given$dir)) empty_sample_folder(given$dir))
}

#' @param many As of [share_settings()].
#' @param given Arguments of [homologise()].
#' @noRd
homologise_share <- function(shapes, many, given, progress) {
  elements <- cohort_elements(shapes)
  ids <- names(elements)
  share <- with_seed(many$seed, sort(sample(length(ids), min(many$template_from, length(ids)))))
  some <- if (inherits(shapes, "shape_batch")) shapes[ids[share]] else elements[share]
  base <- homologise_all(some, given, progress)
  settings <- given$settings
  tasks <- slide_tasks(elements, base$template, given, many$dir)
  arguments <- list(plan = slide_plan(base$template, settings), template = base$template,
                    settings = settings, red = given$red, limits = given$limits,
                    specimens = if (!is.function(given$specimens)) given$specimens)
  if (is.function(given$specimens)) tasks <- lapply(tasks, c, list(specimen = given$specimens))
  tick <- progress_ticks(progress, length(tasks), "the sample")
  slid <- with_told_progress(each_in_workers(tasks, slide_task, arguments, tick),
                             progress && plan_workers() > 1, what = "homologise()")
  tell_cohort(slid, given$red)
  done <- Filter(function(one) !inherits(one$shape, "shape_failure"), slid)
  shapes <- lapply(done, `[[`, "shape")
  base$provenance$settings$homologise$template_from <- length(share)
  base$provenance$settings$homologise$seed <- many$seed
  if (!is.null(many$dir)) return(write_cohort(shapes, base, many$dir))
  validate_shape_sample(new_shape_sample(shapes, base$template, base$convergence,
                                         base$provenance))
}

#' The shapes of a list or batch by id, those in files as they are
#' @noRd
cohort_elements <- function(shapes) {
  if (inherits(shapes, "shape_batch")) {
    shapes <- renewed_batch(shapes)
    return(Filter(Negate(is.null), plain_list(shapes)))
  }
  check_shapes(shapes)
}

#' What there is to slide: `shape`, and where the result goes
#'
#' The key of a result is of what was measured, points and all, not of the mesh alone, and of what
#' decides how it is slid.
#' @noRd
slide_tasks <- function(elements, template, given, dir) {
  ids <- names(elements)
  way <- list(template_provenance(template$id, places_of(template)), template$energy_scale,
              lapply(unclass(given$settings), identity), given$red,
              if (given$red == "leave out") lapply(unclass(given$limits), identity))
  way <- content_hash(way)
  stems <- file_stems(ids)
  Map(function(shape, id, stem) {
    own <- if (inherits(shape, "kept_shape")) attr(shape, "key") else
      list(shape_key(shape), shape$points)
    list(name = id, shape = shape, key = content_hash(list(own, way)),
         file = if (!is.null(dir)) file.path(dir, paste0(stem, ".shape")))
  }, elements, ids, stems)
}

#' One shape read, slid and stored
#'
#' @param plan,template,settings As [slide()] has them.
#' @return List: `shape` (slid; a `kept_shape` where it is in a file; or a `shape_failure`), `red`
#'   (its red parts), `cut` (its `cut_scale`).
#' @noRd
slide_task <- function(task, plan, template, settings, red, limits, specimens) {
  none <- list(red = NULL, cut = NA_real_)
  kept <- if (is.null(task$file)) NULL else {
    opened <- open_kept(task$file)
    if (opened$state == "whole" && identical(opened$about$key, task$key)) {
      kept_shape(task, opened$about)
    }
  }
  if (!is.null(kept)) return(c(list(shape = kept), said_when_slid(opened$about)))
  shape <- task$shape
  if (inherits(shape, "kept_shape")) shape <- read_shape(shape)
  if (inherits(shape, "shape_failure")) return(c(list(shape = shape), none))
  tryCatch({
    check_same_scheme(shape, template)
    parts <- if (red != "keep") red_parts(stats::setNames(list(shape), shape$id), limits)
    cut <- asked_cut_scale(shape)
    if (red == "leave out") shape <- without_parts(shape, parts)
    specimen <- specimen_of(shape, if (is.null(task$specimen)) specimens else task$specimen)
    one <- list(name = task$name, shape = shape, state = slide_state(shape, settings),
                specimen = specimen)
    one$cut <- cut_task(one, plan)
    one["start"] <- list(start_task(one, plan))
    slid <- finish_task(one, plan)
    said <- list(red = parts[c("specimen", "part", "level")], cut = cut)
    if (!is.null(task$file)) slid <- keep_slid(slid, task, said)
    c(list(shape = slid), said)
  }, crestline_error = function(e) c(list(shape = failure_of(e)), none))
}

#' @param said List: `red`, `cut` of [slide_task()], for a run that continues this one.
#' @noRd
keep_slid <- function(shape, task, said) {
  about <- c(list(key = task$key, mesh = c(shape$key, "none")[1], id = task$name, slid = said),
             told_of(shape))
  keep(stored_shape(shape, dirname(task$file)), about, task$file, "xz")
  kept_shape(task, about)
}

#' What was said of a shape when it was slid, by an earlier run
#' @param about Of its file.
#' @noRd
said_when_slid <- function(about) {
  red <- about$slid$red
  list(red = if (NROW(red)) as.data.frame(red), cut = c(as.numeric(about$slid$cut), NA)[1])
}

#' Warn of what the workers met: specimens that could not be slid, red parts, other cuts
#' @noRd
tell_cohort <- function(slid, red, most = 5, apart = 0.02) {
  failed <- Filter(function(one) inherits(one$shape, "shape_failure"), slid)
  if (length(failed)) {
    said <- vapply(failed, function(one) one$shape$message, "")
    crestline_warn(sprintf("%s could not be slid, and left out: %s.",
                           amount(length(failed), "specimen"),
                           shorten(sprintf("%s (%s)", names(failed), said), most)),
                   "Mend them, and run it again: what is slid stays.", stage = "homologise",
                   class = "crestline_not_slid")
  }
  if (red == "warn") {
    warn_red(do.call(rbind, unname(lapply(slid, `[[`, "red"))), "homologise", paste(
      "quality(shapes) has the reasons. Leave these parts out with red = \"leave out\", or",
      "keep them without a warning with red = \"keep\"."
    ))
  }
  warn_cut_factors(vapply(slid, `[[`, 0, "cut"), "homologise", apart)
}

#' Slid shapes in files as a sample in files; workers write its blocks, each with one in memory
#'
#' @param block,least Most and fewest specimens of a block; between these there are `parts` blocks,
#'   so that several workers have some. They do not depend on the number of workers.
#' @noRd
write_cohort <- function(shapes, base, dir, block = 500, least = 20, parts = 8) {
  points <- points_of_sample(base$template)
  size <- min(block, max(least, ceiling(length(shapes) / parts)))
  at <- (seq_along(shapes) - 1L) %/% as.integer(size) + 1L
  tasks <- lapply(unique(at), function(i) {
    list(name = sprintf("block %d", i), number = i, shapes = shapes[at == i])
  })
  each_in_workers(tasks, block_task, list(points = points, dir = dir), function() NULL)
  write_sample_head(list(ids = names(shapes), block = at, points = points,
                         axes = c("x", "y", "z"), triangles = NULL, template = base$template,
                         provenance = base$provenance), dir)
  open_sample(dir)
}

#' The points of some slid shapes written as a block
#' @param task List: `name`, `number` of the block, `shapes` (in files).
#' @noRd
block_task <- function(task, points, dir) {
  each <- lapply(task$shapes, function(shape) {
    columns_of(unkept(shape)$points, c("x", "y", "z"))
  })
  array <- array(unlist(each), c(nrow(points), 3, length(each)),
                 list(NULL, c("x", "y", "z"), names(each)))
  write_block(array, points, dir, task$number)
  task$name
}
