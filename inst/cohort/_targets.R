# Measures a folder of scans and compares two groups, as a pipeline of the package targets. Its
# workers are started by the package crew: here on this machine, or by Slurm with crew.cluster.
#
#   file.copy(system.file("cohort", "_targets.R", package = "crestline"), ".")
#   targets::tar_make()
#
# Set these in the environment, or change them here: the folder of scans, the folder of results, a
# table of specimens (columns id, group), a folder of write_scheme() (the whole face where there is
# none), the number of workers, and "slurm" for a cluster.
setting <- function(name, default) Sys.getenv(paste0("CRESTLINE_", name), default)
scans <- setting("SCANS", "scans")
results <- setting("RESULTS", "results")
groups <- setting("GROUPS", "groups.csv")
own_scheme <- setting("SCHEME", "")
workers <- as.integer(setting("WORKERS", "2"))

library(targets)
controller <- if (setting("CONTROLLER", "local") == "slurm") {
  crew.cluster::crew_controller_slurm(
    name = "crestline", workers = workers, seconds_idle = 60, crashes_max = 5,
    options_cluster = crew.cluster::crew_options_slurm(
      script_lines = "export OMP_NUM_THREADS=1 RGL_USE_NULL=TRUE",
      log_output = "crew-%j.log", memory_gigabytes_per_cpu = 2, cpus_per_task = 1
    )
  )
} else {
  crew::crew_controller_local(name = "crestline", workers = workers, crashes_max = 5)
}
tar_option_set(packages = "crestline", controller = controller, error = "null")

# Scans of one branch: large enough for minutes of work.
at_once <- as.integer(setting("AT_ONCE", "50"))
lots_of <- function(files) split(files, ceiling(seq_along(files) / at_once))

# Scans with the landmark files beside them: a lot is measured again if the content of one changes.
landmark_ends <- c(".csv", ".mrk.json", ".fcsv", ".pts", ".pp", ".tps", ".nts", ".dta", ".ckpt",
                   ".landmarkAscii")
with_landmarks <- function(lot) {
  beside <- as.vector(outer(sub("[.]ply$", "", lot), landmark_ends, paste0))
  c(lot, beside[file.exists(beside)])
}

list(
  # A branch for each lot of scans. One that is in `results` already is read in no time, so that
  # nothing is measured twice if the pipeline is stopped.
  tar_target(files, list.files(scans, "[.]ply$", full.names = TRUE), cue = tar_cue("always")),
  tar_target(scheme, if (nzchar(own_scheme)) read_scheme(own_scheme) else face_scheme(),
             deployment = "main", cue = tar_cue("always")),
  tar_target(lot, unname(lots_of(files)), iteration = "list"),
  tar_target(content, with_landmarks(lot), pattern = map(lot), format = "file",
             deployment = "main", cue = tar_cue("always")),
  tar_target(measured, {
    shapes <- fit_shapes(grep("[.]ply$", content, value = TRUE), scheme, dir = results,
                         progress = FALSE)
    c(names(shapes), tools::md5sum(content))
  }, pattern = map(content)),
  # The whole, whatever became of single branches.
  tar_target(shapes, {
    measured
    read_batch(results)
  }, deployment = "main"),
  tar_target(failed, failures(shapes), deployment = "main"),
  tar_target(sample, homologise(shapes, template_from = 100, seed = 1, progress = FALSE,
                                red = "keep")),
  tar_target(group_file, groups, format = "file", deployment = "main"),
  tar_target(group, {
    table <- utils::read.csv(group_file, colClasses = "character")
    stats::setNames(table$group, table$id)[names(sample)]
  }),
  tar_target(comparison, compare_groups(sample, group, "curves", n_perm = 999, seed = 1,
                                        progress = FALSE))
)
