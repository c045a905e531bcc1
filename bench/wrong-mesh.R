# The wrong mesh: every exported function that takes something of a mesh and a mesh (or a specimen),
# with another mesh, a reordered one, a damaged one; in processes of their own, so that a crash is
# seen and named.
#
#   Rscript bench/wrong-mesh.R   (from the root of the package)
#
# Prints every call that was not refused by a crestline_error, and the counts.

arguments <- commandArgs(TRUE)
worker <- length(arguments) >= 4 && arguments[1] == "worker"
source_folder <- if (worker) arguments[2] else c(arguments, ".")[1]

load_case <- function() {
  suppressMessages({
    library(testthat)
    library(crestline)
  })
  options(rgl.useNULL = TRUE, warn = -1)
  env <- new.env(parent = asNamespace("crestline"))
  for (file in list.files(file.path(source_folder, "tests", "testthat"), "^helper",
                          full.names = TRUE)) sys.source(file, env)
  env
}

# All tasks: name, and a function of nothing.
tasks_of <- function(env, case) {
  evalq(NULL, env)
  wrong <- env$wrong_specimens(case)
  meshes <- env$damaged_meshes(case$specimen$mesh)
  other <- grepl("^other", names(wrong))
  bare <- lapply(wrong[other], function(one) one$mesh)
  cross <- function(calls, those, kind) {
    unlist(lapply(names(calls), function(call) {
      stats::setNames(lapply(those, function(one) function() calls[[call]](case, one)),
                      paste(kind, call, names(those), sep = " | "))
    }), recursive = FALSE)
  }
  any <- env$any_mesh_calls()
  on_path <- c("path_coordinates", "lift")
  # What specimen() mends is no wrong mesh for those that make a specimen of it.
  mended <- vapply(meshes,
                   function(mesh) tryCatch(inherits(specimen(mesh), "specimen"),
                                           error = function(e) FALSE), NA)
  makers <- c("find_landmarks", "place_landmarks")
  c(cross(env$own_mesh_calls(), wrong, "own"),
    cross(env$specimen_calls(), wrong[!other], "specimen"),
    cross(any, wrong[!other], "specimen"), cross(any[setdiff(names(any), makers)], meshes, "bare"),
    cross(any[makers], meshes[!mended], "bare"), cross(any[on_path], bare, "bare"),
    stats::setNames(lapply(env$damaged_calls(), function(call) function() call(case)),
                    paste("damaged |", names(env$damaged_calls()))))
}

if (worker) {
  env <- load_case()
  case <- readRDS(arguments[3])
  tasks <- tasks_of(env, case)
  log <- file(arguments[4], "a")
  grDevices::pdf(NULL)
  for (i in as.integer(strsplit(arguments[5], ",")[[1]])) {
    cat("begin", i, "\n", file = log)
    flush(log)
    said <- tryCatch({
      setTimeLimit(elapsed = 60, transient = TRUE)
      tasks[[i]]()
      "answer"
    }, crestline_error = function(e) "refused",
                     error = function(e) paste("internal", gsub("\\s+", " ", conditionMessage(e))))
    setTimeLimit()
    cat("end", i, said, "\n", file = log)
    flush(log)
  }
  quit("no")
}

folder <- tempfile("wrong-mesh-")
dir.create(folder)
env <- load_case()
case <- env$complete_case()
kept <- file.path(folder, "case.rds")
saveRDS(case, kept)
names <- names(tasks_of(env, case))
said <- rep(NA_character_, length(names))
log <- file.path(folder, "log.txt")
script <- sub("^--file=", "", grep("^--file=", commandArgs(), value = TRUE))

while (anyNA(said)) {
  open <- utils::head(which(is.na(said)), 200)
  unlink(log)
  system2(file.path(R.home("bin"), "Rscript"),
          c(shQuote(script), "worker", shQuote(source_folder), shQuote(kept), shQuote(log),
                                                 paste(open, collapse = ",")), stdout = FALSE,
          stderr = file.path(folder, "err.txt"))
  lines <- if (file.exists(log)) readLines(log) else character()
  ended <- regmatches(lines, regexec("^end ([0-9]+) (.*)$", lines))
  for (one in Filter(length, ended)) said[as.integer(one[2])] <- trimws(one[3])
  begun <- as.integer(sub("^begin ", "", grep("^begin", lines, value = TRUE)))
  lost <- begun[is.na(said[begun])]
  if (length(lost)) said[lost] <- "crash" else
    if (!length(begun)) stop("the worker does not start: ",
                             paste(readLines(file.path(folder, "err.txt")), collapse = "\n"))
}

kind <- sub(" .*", "", said)
for (i in which(kind != "refused")) cat(sprintf("%-9s %s%s\n", kind[i], names[i],
                                                if (kind[i] == "internal")
                                                  sub("^internal", ":", said[i]) else ""))
cat(sprintf("%d calls: %d refused, %d crashes, %d answers, %d internal errors\n", length(said),
            sum(kind == "refused"),
            sum(kind == "crash"), sum(kind == "answer"), sum(kind == "internal")))
unlink(folder, recursive = TRUE)
quit("no", status = any(kind != "refused"))
