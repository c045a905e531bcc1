# Batches: the 23 simpop faces with one worker and two; a run killed in the middle and gone on with; memory.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R speed
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R killed
#   CRESTLINE_SHARED=../shared/data Rscript bench/batch.R memory [copies = 250]
#
# "speed": seconds of all 23 faces by future's multisession, workers started before. "killed": the run is killed (kill -9)
# once some results are there, and started again: how many were measured twice, how many are missing; three files are damaged
# first. "memory": resident memory of the process after 25 and after all of many copies of one face.

library(crestline)

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
    write.csv(own[c("landmark", "x", "y", "z")], file.path(dir, paste0(id, ".csv")), row.names = FALSE)
  }
  list.files(dir, "[.]ply$", full.names = TRUE)
}

seconds_with <- function(workers, files) {
  if (workers > 1) future::plan("multisession", workers = workers) else future::plan("sequential")
  invisible(fit_shapes(files[seq_len(workers)], scheme))
  seconds <- system.time(shapes <- fit_shapes(files, scheme))[["elapsed"]]
  stopifnot(nrow(failures(shapes)) == 0)
  seconds
}

resident <- function() as.numeric(gsub("[^0-9]", "", grep("VmRSS", readLines("/proc/self/status"), value = TRUE))) / 1024

dir <- tempfile("batch-")
if (mode == "speed") {
  files <- laid_out(dir)
  times <- vapply(c(1, 2, 1, 2), seconds_with, 0, files = files)
  cat(sprintf("one worker %.1f and %.1f s, two %.1f and %.1f s: ratios %.2f and %.2f\n", times[1], times[3], times[2], times[4],
              times[1] / times[2], times[3] / times[4]))
} else if (mode == "killed") {
  files <- laid_out(dir)
  for (file in files[c(4, 9, 20)]) writeLines(head(readLines(file, warn = FALSE), 40), file)
  out <- file.path(dir, "out")
  code <- sprintf("library(crestline); fit_shapes(list.files('%s', '[.]ply$', full.names = TRUE), face_scheme(), '%s')", dir, out)
  system2(file.path(R.home("bin"), "Rscript"), c("-e", shQuote(code)), stdout = FALSE, stderr = FALSE, wait = FALSE)
  while (length(list.files(out, "[.]rds$")) < 8) Sys.sleep(0.2)
  system2("pkill", c("-9", "-f", shQuote(out)))
  done <- list.files(out, "[.]rds$", full.names = TRUE)
  good <- done[vapply(done, function(file) inherits(readRDS(file)$result, "shape"), NA)]
  before <- file.mtime(good)
  shapes <- fit_shapes(files, scheme, out)
  cat(sprintf("killed after %d results (%d good); then: %d of those measured again, %d shapes, %d failures\n", length(done),
              length(good), sum(file.mtime(good) != before), sum(!vapply(as.list(shapes), is.null, NA)), nrow(failures(shapes))))
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
  cat(sprintf("resident: %.0f MB after 25, %.0f MB after %d: ratio %.3f\n", early, resident(), copies, resident() / early))
}
unlink(dir, recursive = TRUE)
