# Tasks by the user's plan of futures: a worker that dies costs what it held, and no other.

#' Work at each of some tasks by the user's plan, with progress
#'
#' Each lot of `chunk` tasks is a future. Where a plan refuses futures, because one of its workers
#' has died, it is started again once those that run have ended; where it refuses them still, the
#' rest is done in this process.
#'
#' @param tasks List of lists, each with its `name`.
#' @param work Function of a task and of `arguments`, in the package's namespace: what it needs is
#'   sent to workers by `arguments`.
#' @param chunk Number of tasks a future.
#' @param alone Whether each future waits for the one before.
#' @param poll Seconds between two looks at workers that are busy, where the user has set no other:
#'   future's own 0.01 takes a tenth of a core, of which nothing is left when there are as many
#'   workers as cores.
#' @return List of what `work` returns; of tasks whose worker died a `lost_task`.
#' @noRd
run_tasks <- function(tasks, work, arguments, chunk, alone = FALSE, poll = 0.05) {
  rlang::local_options(future.wait.interval = getOption("future.wait.interval", poll),
                       future.globals.maxSize = Inf)
  tick <- if (alone) function(name) NULL else progressr::progressor(steps = length(tasks))
  lots <- unname(split(seq_along(tasks), ceiling(seq_along(tasks) / chunk)))
  values <- vector("list", length(lots))
  open <- seq_along(lots)
  refusals <- 0
  while (length(open) && refusals < 2) {
    started <- lapply(lots[open], function(lot) {
      one <- start_lot(tasks[lot], work, arguments, tick)
      if (alone) lot_values(one, length(lot)) else one
    })
    refused <- vapply(started, inherits, NA, "FutureError")
    values[open[!refused]] <- Map(lot_values, started[!refused], lengths(lots[open[!refused]]))
    refusals <- if (all(refused)) refusals + 1 else 0
    open <- open[refused]
    if (length(open)) restart_plan()
  }
  # A task that has cost a worker already is not tried in the user's own process.
  values[open] <- lapply(lots[open], function(lot) {
    if (alone) return(list(lost_task("the plan's workers cannot be reached")))
    work_lot(tasks[lot], work, arguments, tick)
  })
  unlist(values, recursive = FALSE, use.names = FALSE)
}

#' One future; or the condition by which its worker refused it
#' @noRd
start_lot <- function(tasks, work, arguments, tick) {
  tryCatch(future::future(work_lot(tasks, work, arguments, tick), packages = "crestline",
                          seed = NULL,
                          globals = list(tasks = tasks, work = work, arguments = arguments,
                                         tick = tick, work_lot = work_lot)),
           FutureError = identity)
}

work_lot <- function(tasks, work, arguments, tick) {
  lapply(tasks, function(task) {
    value <- do.call(work, c(list(task), arguments))
    tick(task$name)
    value
  })
}

#' What a future gives, once; where its worker has died, a `lost_task` for each of its tasks
#' @noRd
lot_values <- function(started, n) {
  if (!inherits(started, "Future")) return(started)
  tryCatch(future::value(started), FutureError = function(e) {
    rep(list(lost_task(conditionMessage(e))), n)
  })
}

lost_task <- function(message) structure(list(message = message), class = "lost_task")

#' The user's plan with new workers, in place of those that have died
#' @noRd
restart_plan <- function() {
  plan <- future::plan("list")
  tryCatch(future::plan("sequential"), error = function(e) NULL)
  future::plan(plan)
}

#' Run code that signals progress; with a bar in a session with a user, otherwise with lines
#'
#' @param read Number of results that were there already.
#' @param every Seconds between lines; a run that takes less writes none.
#' @param what Whose progress it is.
#' @noRd
with_told_progress <- function(code, progress, read = 0, every = 60, what = "fit_shapes()") {
  if (!progress) return(code)
  if (isTRUE(getOption("progressr.enable", interactive()))) {
    return(progressr::with_progress(code))
  }
  lines <- progress_lines(read, what)
  handler <- progressr::make_progression_handler("crestline", lines, intrusiveness = 0,
                                                 interval = every, enable = TRUE)
  progressr::with_progress(code, handlers = handler, enable = TRUE)
}

#' What writes progress as lines: how many are measured, since when, and about how long it will take
#' @noRd
progress_lines <- function(read, what, since = Sys.time()) {
  list(update = function(config, state, progression, ...) {
    minutes <- max(0, as.numeric(difftime(Sys.time(), since, units = "mins")))
    left <- minutes * (config$max_steps - state$step) / max(state$step, 1)
    message(sprintf("%s: %d of %d done%s, %.0f min, about %.0f min left", what, state$step,
                    config$max_steps, if (read) sprintf(" (%d read)", read) else "", minutes,
                    left))
  })
}
