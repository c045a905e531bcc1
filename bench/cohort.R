# A cohort through files: the store, array jobs on a Slurm of this machine, a pipeline of targets
# and crew, homology by several workers, two processes in one folder. Run from the package's root.
#
#   Rscript bench/cohort.R scans DIR [n = 48]       simulated scans of some 5,000 vertices
#   Rscript bench/cohort.R serial DIR               all measured by one process
#   Rscript bench/cohort.R slurm DIR [jobs = 8] [minutes = 120]   array jobs: killed, node stopped,
#                                                   disk full
#   Rscript bench/cohort.R targets DIR [local|slurm]   by targets and crew
#   Rscript bench/cohort.R same DIR FOLDER...       are the results of a folder those of "serial"
#   Rscript bench/cohort.R store DIR                bytes of a specimen; print() of 2,000 and 50,000
#   Rscript bench/cohort.R quality DIR [n = 2000] [runs = 3]   quality() of n entries
#   Rscript bench/cohort.R together [times = 50]    two processes at once in one folder
#   Rscript bench/cohort.R homology DIR [times = 1] slid by two workers against one; memory
#   Rscript bench/cohort.R parquet DIR              tables written and read back
#   Rscript bench/cohort.R old DIR LIBRARY          a folder of a former version (LIBRARY) read
#
# "slurm" needs munged, slurmctld and slurmd (Debian: munge slurmctld slurmd), root, and one node
# that is this machine. "targets" needs targets, crew and crew.cluster.

suppressMessages(library(crestline))
given <- commandArgs(TRUE)
part <- given[1]
dir <- given[2]
argument <- function(i, default) if (length(given) < i) default else given[i]
inner <- function(name) getFromNamespace(name, "crestline")

resident <- function(pid = Sys.getpid(), field = "VmHWM") {
  lines <- readLines(sprintf("/proc/%d/status", pid))
  as.numeric(gsub("[^0-9]", "", grep(field, lines, value = TRUE))) / 1024
}

# Processor seconds of this process and of those that it started and that have ended.
processor <- function(code) {
  took <- system.time(code)
  c(elapsed = took[["elapsed"]], user = took[["user.self"]] + took[["user.child"]])
}

scans_in <- function(dir) file.path(dir, "scans")

# Rvcg's face, decimated to 5,000 vertices, deformed by six pushes of some 2 mm that fade over 30 mm
# about a landmark each, with independent noise of 0.1 mm.
write_scans <- function(dir, n) {
  folder <- scans_in(dir)
  dir.create(folder, recursive = TRUE)
  write_scheme(mouth_scheme(), file.path(dir, "scheme"))
  data(humface, package = "Rvcg", envir = environment())
  file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
  landmarks <- read_landmarks(file)
  mesh <- Rvcg::vcgQEdecim(humface, tarface = 9800, silent = TRUE)
  push <- function(xyz, face) {
    set.seed(face)
    centre <- landmarks[sample(nrow(landmarks), 6), ]
    apart <- outer(rowSums(xyz^2), rowSums(centre^2), "+") - 2 * xyz %*% t(centre)
    xyz + exp(-apart / (2 * 30^2)) %*% matrix(rnorm(18, sd = 2), 6)
  }
  for (face in seq_len(n)) {
    one <- mesh
    moved <- push(t(mesh$vb[1:3, ]), face)
    own <- push(landmarks, face)
    one$vb[1:3, ] <- t(moved + rnorm(length(moved), sd = 0.1))
    one$normals <- NULL
    file <- file.path(folder, sprintf("face %04d", face))
    Rvcg::vcgPlyWrite(one, file, binary = TRUE)
    write.csv(data.frame(landmark = rownames(own), own), paste0(file, ".csv"), row.names = FALSE)
  }
  cat(n, "scans of", ncol(one$vb), "vertices\n")
}

# The nine curves of the mouth: lips, philtrum ridges, mid-line. A scan takes a tenth of the time of
# face_scheme().
mouth_scheme <- function() {
  whole <- face_scheme()
  wanted <- "^philtrum ridge|^(upper|lower) lip|^mid-line (phil|upper|lower)"
  curves <- subset(whole$curves, grepl(wanted, curve))
  pairs <- subset(whole$pairs, left %in% c(curves$curve, whole$landmarks$landmark))
  pairs <- subset(pairs, level %in% c("landmarks", "curves"))
  curve_scheme(whole$landmarks, curves, pairs = pairs, name = "mouth")
}

measure_serial <- function(dir) {
  scheme <- read_scheme(file.path(dir, "scheme"))
  took <- processor(shapes <- fit_shapes(scans_in(dir), scheme, file.path(dir, "serial")))
  print(shapes)
  cat(sprintf("serial: %d scans, %.1f s, %.2f s of processor a scan, peak %.0f MB\n",
              length(shapes), took[["elapsed"]], took[["user"]] / length(shapes), resident()))
}

# Points, status, paths and checks of two folders, by id; how many are identical.
compare_results <- function(one, other) {
  a <- suppressMessages(read_batch(one))
  b <- suppressMessages(read_batch(other))
  stopifnot(nrow(failures(a)) == 0, nrow(failures(b)) == 0)
  fields <- c("points", "status", "checks", "paths", "tracks", "key")
  same <- vapply(names(a), function(id) {
    identical(unclass(a[[id]])[fields], unclass(b[[id]])[fields])
  }, NA)
  cat(sprintf("%s: %d of %d specimens there, %d identical\n", basename(other),
              sum(names(a) %in% names(b)), length(a), sum(same)))
}

# Slurm of this machine --------------------------------------------------------------------------

shell <- function(...) {
  out <- suppressWarnings(system2("sh", c("-c", shQuote(sprintf(...))), stdout = TRUE))
  as.character(out)
}

say <- function(...) cat(format(Sys.time(), "%H:%M:%S "), sprintf(...), "\n", sep = "")

# Results that are written, and how often each was: a result that is measured again is a new file.
watch_results <- function(folder, seen) {
  files <- list.files(folder, "[.]shape$", full.names = TRUE)
  now <- unlist(lapply(files, function(file) paste(basename(file), file.info(file)$mtime)))
  unique(c(seen, now))
}

# Processes that measure into a folder.
measuring_processes <- function(results) {
  as.integer(shell("pgrep -f 'R .*file=.*measure[.]R .*%s' || true", results))
}

# The job's script with a line more, where COHORT_NICE has a number: jobs are of a session of their
# own, which gets that share of the processor (other programs of this machine are measured too).
job_script <- function(dir) {
  lines <- readLines(system.file("cohort", "measure.sh", package = "crestline"))
  at <- match("", lines)
  script <- file.path(dir, "measure.sh")
  nice <- Sys.getenv("COHORT_NICE")
  writeLines(if (nzchar(nice)) {
    append(lines, sprintf("echo %s > /proc/self/autogroup || true", nice), at)
  } else lines, script)
  script
}

# Slurm's daemon of the node is stopped (kill -9, with the job that it runs) and started again.
stop_node <- function(results) {
  pid <- shell("cat /tmp/cohort-slurm/slurmd.pid")
  jobs <- measuring_processes(results)
  tools::pskill(as.integer(pid), 9)
  if (length(jobs)) tools::pskill(jobs, 9)
  say("slurmd stopped, %d jobs with it", length(jobs))
  Sys.sleep(30)
  shell("slurmd")
  say("slurmd started: node %s", paste(shell("sinfo -h -o %%T"), collapse = " "))
}

# The disk of the results fills up: a small tmpfs, filled by another file, and freed again.
fill_disk <- function(folder) {
  filler <- file.path(folder, "filler")
  shell("dd if=/dev/zero of='%s' bs=1k 2>/dev/null || true", filler)
  say("disk full: %s", paste(shell("df -h '%s' | tail -1", folder), collapse = ""))
  Sys.sleep(20)
  unlink(filler)
  say("disk freed")
}

by_slurm <- function(dir, jobs, minutes) {
  results <- file.path(dir, "slurm")
  dir.create(results)
  system2("mount", c("-t", "tmpfs", "-o", "size=80m", "tmpfs", shQuote(results)))
  script <- job_script(dir)
  Sys.setenv(CRESTLINE_SCHEME = file.path(dir, "scheme"))
  submit <- function() shell("cd '%s' && sbatch --array=1-%s '%s' '%s' '%s'", dir, jobs, script,
                             scans_in(dir), results)
  n <- length(list.files(scans_in(dir), "[.]ply$"))
  say("%s, %d scans", submit(), n)
  seen <- character()
  done <- character()
  events <- list(k1 = 0.1, k2 = 0.2, k3 = 0.3, node = 0.4, disk = 0.6)
  in_flight <- 0
  started <- Sys.time()
  repeat {
    Sys.sleep(1)
    seen <- watch_results(results, seen)
    count <- length(list.files(results, "[.]shape$"))
    due <- setdiff(names(events)[unlist(events) <= count / n], done)
    for (event in due) {
      running <- measuring_processes(results)
      if (startsWith(event, "k") && length(running)) {
        tools::pskill(running[1], 9)
        in_flight <- in_flight + 1
        say("kill -9 of a job at %d of %d", count, n)
        done <- c(done, event)
      } else if (event == "node") {
        in_flight <- in_flight + length(running)
        stop_node(results)
        done <- c(done, event)
      } else if (event == "disk") {
        fill_disk(results)
        done <- c(done, event)
      }
    }
    queue <- shell("squeue -h -n crestline | wc -l")
    if (as.integer(queue) == 0) {
      if (count >= n) break
      say("queue empty, %d of %d: submitted again. %s", count, n, submit())
      Sys.sleep(5)
    }
    if (difftime(Sys.time(), started, units = "mins") > minutes) break
  }
  seen <- watch_results(results, seen)
  final <- suppressMessages(read_batch(results))
  print(final)
  say("%d results, written %d times; scans in flight when something was killed: %d",
      length(list.files(results, "[.]shape$")), length(seen), in_flight)
  dir.create(file.path(dir, "kept"))
  file.copy(results, file.path(dir, "kept"), recursive = TRUE, copy.date = TRUE)
  system2("umount", shQuote(results))
  if (dir.exists(file.path(dir, "serial"))) {
    compare_results(file.path(dir, "serial"), file.path(dir, "kept", "slurm"))
  }
}

# Targets and crew -----------------------------------------------------------------------------

by_targets <- function(dir, controller) {
  results <- file.path(dir, paste0("targets-", controller))
  work <- paste0(results, "-pipeline")
  dir.create(work)
  file.copy(system.file("cohort", "_targets.R", package = "crestline"), work)
  ids <- sub("[.]ply$", "", list.files(scans_in(dir), "[.]ply$"))
  write.csv(data.frame(id = ids, group = rep_len(c("a", "b"), length(ids))),
            file.path(work, "groups.csv"), row.names = FALSE)
  Sys.setenv(CRESTLINE_SCANS = scans_in(dir), CRESTLINE_RESULTS = results, CRESTLINE_WORKERS = 2,
             CRESTLINE_CONTROLLER = controller, CRESTLINE_AT_ONCE = 12,
             CRESTLINE_SCHEME = file.path(dir, "scheme"))
  setwd(work)
  took <- system.time(targets::tar_make())[["elapsed"]]
  cat(sprintf("targets, %s: %.0f s\n", controller, took))
  print(targets::tar_read(shapes))
  print(targets::tar_read(sample))
  print(targets::tar_read(comparison))
  compare_results(file.path(dir, "serial"), results)
}

# The store ------------------------------------------------------------------------------------

# A folder of n entries: copies of results under other names and ids, with lines of the index.
copied_entries <- function(from, n) {
  folder <- file.path(from, paste0("entries-", n))
  dir.create(folder)
  index <- inner("folder_index")(file.path(from, "serial"))
  index <- index[index$state == "whole", ]
  first <- index$path[1]
  file.copy(list.files(file.path(from, "serial"), "^common-", full.names = TRUE), folder)
  rows <- index[rep_len(seq_len(nrow(index)), n), inner("index_columns")]
  rows$id <- sprintf("copy %06d", seq_len(n))
  rows$file <- paste0(rows$id, ".shape")
  rows$surface <- paste0(rows$surface, seq_len(n))
  rows$key <- paste0(rows$key, seq_len(n))
  # One file under many names (a disk allows some ten thousand each): names, sizes and times are
  # there, their bytes are not copied.
  for (names in split(file.path(folder, rows$file), (seq_len(n) - 1) %/% 10000)) {
    file.copy(first, names[1], copy.date = TRUE)
    stopifnot(all(file.link(names[1], names[-1])))
  }
  info <- file.info(file.path(folder, rows$file), extra_cols = FALSE)
  rows$size <- inner("size_text")(info)
  rows$time <- inner("time_text")(info)
  writeLines(inner("index_lines")(rows), file.path(folder, "index-copied.tsv"))
  columns <- inner("measures_columns")
  known <- inner("read_index")(file.path(from, "serial"), "quality", columns)
  known <- known[match(index$file, known$file), ][rep_len(seq_len(nrow(index)), n), ]
  known[c("file", "size", "time", "key")] <- rows[c("file", "size", "time", "key")]
  writeLines(inner("index_lines")(known), file.path(folder, "quality-copied.tsv"))
  folder
}

# quality() of a folder of n entries from the measures beside its index; that of the folder that
# they are copied from is compared with that of its results, read one by one.
show_quality <- function(dir, n = 2000, runs = 3) {
  quality(suppressMessages(read_batch(file.path(dir, "serial"))))
  folder <- copied_entries(dir, n)
  batch <- read_batch(folder)
  for (run in seq_len(runs)) {
    took <- processor(graded <- quality(batch))
    cat(sprintf("quality() of %d: %.2f s, %.2f s of processor, %d rows, %.0f MB, peak %.0f MB\n", n,
                took[["elapsed"]], took[["user"]], nrow(graded),
                as.numeric(object.size(graded)) / 2^20, resident()))
  }
  took <- processor(utils::capture.output(print(graded)))
  cat(sprintf("print() of it: %.2f s of processor\n", took[["user"]]))
  files <- list.files(file.path(dir, "serial"), "^quality-.*tsv", full.names = TRUE)
  index <- suppressMessages(read_batch(file.path(dir, "serial")))
  cat(sprintf("measures: %.0f bytes a specimen; equal to those of the results: %s\n",
              sum(file.size(files)) / length(index),
              identical(quality(index), quality(as.list(index)))))
  unlink(folder, recursive = TRUE)
}

show_store <- function(dir) {
  files <- list.files(file.path(dir, "serial"), full.names = TRUE)
  shapes <- grepl("[.]shape$", files)
  size <- file.size(files)
  cat(sprintf("a specimen: %.0f bytes (%.0f to %.0f); common files %.0f, index %.0f a specimen\n",
              mean(size[shapes]), min(size[shapes]), max(size[shapes]),
              sum(size[grepl("common", files)]), sum(size[grepl("index", files)]) / sum(shapes)))
  for (n in c(2000, 50000)) {
    folder <- copied_entries(dir, n)
    for (run in 1:3) {
      took <- processor(utils::capture.output(print(batch <- read_batch(folder))))
      cat(sprintf("read_batch() and print() of %d: %.2f s, %.2f s of processor\n", n,
                  took[["elapsed"]], took[["user"]]))
    }
    took <- processor(print(batch))
    cat(sprintf("print() alone: %.2f s; failures() %.2f s; memory of the batch %.0f MB\n",
                took[["elapsed"]], system.time(failures(batch))[["elapsed"]],
                as.numeric(object.size(unclass(batch))) / 2^20))
    unlink(folder, recursive = TRUE)
  }
}

# Two processes at once ------------------------------------------------------------------------

# Two processes measure the same eight balls, by two settings where the number is odd, in one
# folder; afterwards each result that either has measured is there and whole.
together <- function(times) {
  code <- 'library(crestline)
    given <- commandArgs(TRUE)
    balls <- lapply(1:8, function(i) {
      ball <- Rvcg::vcgSphere(3)
      ball$vb[1, ] <- (1 + i / 50) * ball$vb[1, ]
      corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2)) / sqrt(6)
      specimen(ball, corners %*% diag(c(1 + i / 50, 1, 1)), id = paste("ball", i))
    })
    curve <- data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 7)
    scheme <- curve_scheme(data.frame(landmark = c("a", "b")), curve, name = "one line")
    while (!file.exists(given[2])) Sys.sleep(0.01)
    shapes <- suppressMessages(fit_shapes(
      balls, scheme, given[1], measuring = shape_settings(bridge = as.numeric(given[3]))
    ))
    saveRDS(list(failures(shapes), lapply(as.list(shapes), coords)), given[4])'
  script <- tempfile(fileext = ".R")
  writeLines(code, script)
  lost <- damaged <- failed <- 0
  for (i in seq_len(times)) {
    out <- tempfile("together-")
    go <- tempfile("go-")
    values <- file.path(tempdir(), c("a.rds", "b.rds"))
    unlink(values)
    second <- if (i %% 2) 0.1 else 0.2
    for (k in 1:2) {
      system2("Rscript", c(script, out, go, c(0.2, second)[k], values[k]), wait = FALSE,
              stdout = FALSE, stderr = FALSE)
    }
    Sys.sleep(2)
    file.create(go)
    waited <- 0
    while (!all(file.exists(values)) && waited < 120) {
      Sys.sleep(0.2)
      waited <- waited + 0.2
    }
    Sys.sleep(0.3)
    both <- lapply(values, readRDS)
    failed <- failed + nrow(both[[1]][[1]]) + nrow(both[[2]][[1]])
    index <- inner("folder_index")(out)
    opened <- lapply(index$path, inner("open_kept"))
    damaged <- damaged + sum(vapply(opened, `[[`, "", "state") != "whole")
    lost <- lost + (if (second == 0.1) 16 else 8) - nrow(index)
    unlink(c(out, go), recursive = TRUE)
  }
  cat(sprintf("%d times two processes: %d results lost, %d damaged, %d failures\n", times, lost,
              damaged, failed))
}

# Homology -------------------------------------------------------------------------------------

# The shapes of a folder several times over, under other ids.
repeated <- function(shapes, times) {
  each <- lapply(seq_len(times), function(i) {
    lapply(inner("plain_list")(shapes), function(one) {
      attr(one, "id") <- paste(attr(one, "id"), i)
      attr(one, "surface") <- paste(attr(one, "surface"), i)
      one
    })
  })
  each <- unlist(each, recursive = FALSE)
  names(each) <- vapply(each, attr, "", "id")
  inner("new_shape_batch")(each, scheme = attr(shapes, "scheme"))
}

show_homology <- function(dir, times) {
  shapes <- repeated(suppressMessages(read_batch(file.path(dir, "serial"))), times)
  from <- 12
  run <- function(workers, folder) {
    if (workers > 1) future::plan("multisession", workers = workers) else
      future::plan("sequential")
    on.exit(future::plan("sequential"))
    pids <- if (workers > 1) unlist(lapply(1:8, function(i) future::future(Sys.getpid())) |>
                                      lapply(future::value)) else Sys.getpid()
    pids <- unique(c(Sys.getpid(), pids))
    busy <- function() {
      vapply(pids, function(pid) {
        as.numeric(strsplit(readLines(sprintf("/proc/%d/schedstat", pid)), " ")[[1]][1:2]) / 1e9
      }, c(0, 0))
    }
    before <- busy()
    took <- system.time(sample <- homologise(shapes, template_from = from, seed = 1, red = "keep",
                                             dir = folder, progress = FALSE))[["elapsed"]]
    spent <- busy() - before
    # Without other programs: the work of this process, then that of the slower worker.
    alone <- spent[1, 1] + max(0, spent[1, -1])
    cat(sprintf("%d workers: %.1f s; processes ran %s s, waited for a core %s s\n", workers, took,
                paste(sprintf("%.1f", spent[1, ]), collapse = " "),
                paste(sprintf("%.1f", spent[2, ]), collapse = " ")))
    cat(sprintf("own work and the slower worker's: %.1f s; peak memory %s MB\n", alone,
                paste(sprintf("%.0f", vapply(pids, resident, 0)), collapse = " ")))
    list(sample = sample, seconds = c(took, alone))
  }
  one <- run(1, tempfile("one-"))
  two <- run(2, tempfile("two-"))
  all <- function(x) unlist(lapply(seq_len(inner("n_blocks")(x)), inner("read_block"), x = x))
  a <- all(one$sample)
  b <- all(two$sample)
  cat(sprintf("%d specimens, template from %d: ratio %.2f, by own times %.2f; largest %s %.1e\n",
              length(one$sample), from, one$seconds[1] / two$seconds[1],
              one$seconds[2] / two$seconds[2], "difference", max(abs(a - b), na.rm = TRUE)))
}

# Tables ---------------------------------------------------------------------------------------

show_parquet <- function(dir) {
  shapes <- suppressMessages(read_batch(file.path(dir, "serial")))
  for (form in c("long", "wide")) {
    file <- tempfile(fileext = ".parquet")
    took <- system.time(write_parquet(shapes, file, form = form))[["elapsed"]]
    back <- nanoparquet::read_parquet(file)
    cat(sprintf("%s: %d rows, %d columns, %.1f kB a specimen, %.1f s\n", form, nrow(back),
                ncol(back), file.size(file) / length(shapes) / 1e3, took))
  }
}

# Old folders ----------------------------------------------------------------------------------

# Three scans are measured by a former version in another process; its folder is read twice, the
# second time after it was written anew, and compared with what that version has in memory.
read_old <- function(dir, library) {
  folder <- tempfile("old-")
  memory <- tempfile(fileext = ".rds")
  scans <- list.files(scans_in(dir), "[.]ply$", full.names = TRUE)[1:3]
  script <- tempfile(fileext = ".R")
  dput_scans <- paste(deparse(scans), collapse = "")
  writeLines(c(sprintf("library(crestline, lib.loc = '%s')", library),
               sprintf("scheme <- read_scheme('%s')", file.path(dir, "scheme")),
               sprintf("shapes <- fit_shapes(%s, scheme, '%s')", dput_scans, folder),
               sprintf("saveRDS(as.list(shapes), '%s')", memory)), script)
  system2("Rscript", script)
  before <- readRDS(memory)
  size <- file.size(list.files(folder, "shape$", full.names = TRUE))
  for (run in 1:2) {
    read <- read_batch(folder)
    equal <- vapply(names(before), function(id) {
      fields <- setdiff(names(before[[id]]), "specimen")
      a <- unclass(read[[id]])
      b <- unclass(before[[id]])
      isTRUE(all.equal(a[fields], b[fields], tolerance = 1e-9)) &&
        identical(a$points[c("x", "y", "z")], b$points[c("x", "y", "z")]) &&
        identical(a$specimen$mesh, b$specimen$mesh)
    }, NA)
    now <- file.size(list.files(folder, "shape$", full.names = TRUE))
    cat(sprintf("time %d: %d of %d equal; %.0f bytes a result before, %.0f now\n", run, sum(equal),
                length(equal), mean(size), mean(now)))
  }
}

switch(part, scans = write_scans(dir, as.integer(argument(3, 48))), serial = measure_serial(dir),
       old = read_old(dir, given[3]),
       slurm = by_slurm(dir, as.integer(argument(3, 8)), as.numeric(argument(4, 120))),
       targets = by_targets(dir, argument(3, "local")),
       same = for (folder in given[-(1:2)]) compare_results(file.path(dir, "serial"), folder),
       store = show_store(dir),
       quality = show_quality(dir, as.integer(argument(3, 2000)), as.integer(argument(4, 3))),
       together = together(as.integer(argument(2, 50))),
       homology = show_homology(dir, as.integer(argument(3, 1))), parquet = show_parquet(dir))
