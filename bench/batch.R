# Batches: the 23 simpop faces with one worker and two, on every kind of plan; a run killed in the
# middle and gone on with; memory.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R speed [pairs = 3]
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R plans
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R killed
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R memory [copies = 250]
#
# "speed": seconds of all 23 faces by future's multisession, workers started before, one and two in
# turn; how long the processes waited for a core tells how busy the machine was else (Linux).
# "plans": the same line with each plan, and whether shapes are identical; Slurm where `sbatch` and
# future.batchtools are there. "killed": the run is killed (kill -9) once some results are there,
# and started again: how many were measured twice, how many are missing; three files are damaged
# first. "memory": resident memory of the process after 25 and after all of many copies of one face.

library(crestline)

inner <- function(name) getFromNamespace(name, "crestline")
shared <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
mode <- c(commandArgs(TRUE), "speed")[1]
scheme <- face_scheme()

# The faces' meshes with a landmark file beside each.
laid_out <- function(dir, ids = sub("[.]ply$", "", list.files(shared, "[.]ply$"))) {
  dir.create(dir, recursive = TRUE)
  landmarks <- read.csv(file.path(shared, "landmarks.csv"), colClasses = c(id = "character"))
  for (id in ids) {
    file.copy(file.path(shared, paste0(id, ".ply")), dir)
    own <- landmarks[landmarks$id %in% c(id, sub("simpop_", "", id)), ]
    write.csv(own[c("landmark", "x", "y", "z")], file.path(dir, paste0(id, ".csv")),
              row.names = FALSE)
  }
  list.files(dir, "[.]ply$", full.names = TRUE)
}

# Seconds that a process has run, and has waited for a core because others ran.
times_of <- function(pid) {
  as.numeric(strsplit(readLines(sprintf("/proc/%d/schedstat", pid)), " ")[[1]][1:2]) / 1e9
}

pids <- function(workers) {
  if (workers == 1) return(Sys.getpid())
  c(Sys.getpid(), unlist(future.apply::future_lapply(1:2, function(i) {
    Sys.sleep(0.5)
    Sys.getpid()
  }, future.chunk.size = 1)))
}

# What a run takes, and what it would without other work on the machine: of the slowest worker the
# time that it ran or had nothing to do, but not that in which it waited for a core.
seconds_with <- function(workers, files) {
  if (workers > 1) future::plan("multisession", workers = workers) else future::plan("sequential")
  invisible(fit_shapes(files[seq_len(workers)], scheme))
  processes <- pids(workers)
  before <- vapply(processes, times_of, c(0, 0))
  seconds <- system.time(shapes <- fit_shapes(files, scheme, tempfile("out-")))[["elapsed"]]
  took <- vapply(processes, times_of, c(0, 0)) - before
  stopifnot(nrow(failures(shapes)) == 0)
  slowest <- if (workers == 1) 1 else 1 + which.max(seconds - took[2, -1])
  cat(sprintf("%d: %.2f s, %.2f without waiting for a core; processes ran %s, waited %s\n",
              workers, seconds, seconds - took[2, slowest],
              paste(sprintf("%.2f", took[1, ]), collapse = " "),
              paste(sprintf("%.2f", took[2, ]), collapse = " ")))
  c(seconds, seconds - took[2, slowest])
}

resident <- function() {
  as.numeric(gsub("[^0-9]", "", grep("VmRSS", readLines("/proc/self/status"), value = TRUE))) / 1024
}

dir <- tempfile("batch-")
if (mode == "speed") {
  files <- laid_out(dir)
  for (pair in seq_len(as.integer(c(commandArgs(TRUE)[-1], 3)[1]))) {
    ratio <- seconds_with(1, files) / seconds_with(2, files)
    cat(sprintf("ratio %.2f, without waiting %.2f\n", ratio[1], ratio[2]))
  }
} else if (mode == "plans") {
  Sys.setenv(RGL_USE_NULL = "TRUE", USER = Sys.info()[["user"]])
  setwd(tempdir())
  files <- laid_out(dir)
  plans <- list(
    sequential = function() future::plan("sequential"),
    multisession = function() future::plan("multisession", workers = 2),
    cluster = function() future::plan("cluster", workers = c("localhost", "localhost")),
    slurm = function() future::plan(future.batchtools::batchtools_slurm, workers = 2,
                                    resources = list(ncpus = 1, memory = 1000, walltime = 600),
                                    template = system.file("extdata", "slurm.tmpl",
                                                           package = "crestline"))
  )
  if (!nzchar(Sys.which("sbatch")) || !requireNamespace("future.batchtools", quietly = TRUE))
    plans$slurm <- NULL
  found <- lapply(names(plans), function(name) {
    start <- system.time(plans[[name]]())[["elapsed"]]
    seconds <- system.time(shapes <- fit_shapes(files, scheme, file.path(dir, name)))[["elapsed"]]
    again <- system.time(fit_shapes(files, scheme, file.path(dir, name)))[["elapsed"]]
    cat(sprintf("%s: started in %.1f s, %d shapes in %.1f s; once more in %.2f s\n", name, start,
                23 - nrow(failures(shapes)), seconds, again))
    as.list(shapes)
  })
  future::plan("sequential")
  points <- lapply(found, function(shapes) lapply(shapes, `[[`, "points"))
  cat("identical to the first:", vapply(points, identical, NA, points[[1]]), "\n")
} else if (mode == "killed") {
  files <- laid_out(dir)
  for (file in files[c(4, 9, 20)]) writeLines(head(readLines(file, warn = FALSE), 40), file)
  out <- file.path(dir, "out")
  pid <- file.path(dir, "pid")
  line <- "fit_shapes(list.files('%s', '[.]ply$', full.names = TRUE), face_scheme(), '%s')"
  code <- sprintf(paste("writeLines(format(Sys.getpid()), '%s'); library(crestline);", line),
                  pid, dir, out)
  system2(file.path(R.home("bin"), "Rscript"), c("-e", shQuote(code)), stdout = FALSE,
          stderr = FALSE, wait = FALSE)
  while (length(list.files(out, "[.]shape$")) < 8) Sys.sleep(0.2)
  tools::pskill(as.integer(readLines(pid)), tools::SIGKILL)
  done <- list.files(out, "[.]shape$", full.names = TRUE)
  good <- done[vapply(done, function(file) inner("open_kept")(file)$state == "whole", NA)]
  before <- file.mtime(good)
  shapes <- fit_shapes(files, scheme, out)
  cat(sprintf(paste("killed after %d results (%d good); then: %d of those measured again, %d",
                    "shapes, %d failures\n"), length(done),
              length(good), sum(file.mtime(good) != before),
              sum(!vapply(as.list(shapes), is.null, NA)), nrow(failures(shapes))))
  print(failures(shapes), right = FALSE)
} else {
  copies <- as.integer(c(commandArgs(TRUE)[-1], 250)[1])
  first <- laid_out(dir, "simpop_01")
  files <- file.path(dir, sprintf("copy_%03d.ply", seq_len(copies)))
  file.copy(rep(first, copies), files)
  file.copy(rep(sub("ply$", "csv", first), copies), sub("ply$", "csv", files))
  out <- file.path(dir, "out")
  invisible(fit_shapes(files[1:25], scheme, out))
  invisible(gc())
  early <- resident()
  invisible(fit_shapes(files, scheme, out))
  invisible(gc())
  cat(sprintf("resident: %.0f MB after 25, %.0f MB after %d: ratio %.3f\n", early, resident(),
              copies, resident() / early))
}
unlink(dir, recursive = TRUE)
