# What each command of the shell takes and does.

#' All commands by name
#'
#' @return Named list; of each: `says`, `takes` (in words), `options` (list of [command_option()]),
#'   `run` (function of what [read_options()] gives, with the exit code as value).
#' @noRd
commands <- function() c(measuring_commands(), sample_commands())

measuring_commands <- function(option = command_option) {
  scheme <- option("scheme", "DIR", "folder of a scheme's tables", "the face's")
  list(
    find = list(
      says = "Find the landmarks of faces by the built-in template.", takes = "SCAN ...",
      options = list(out_option("the landmarks of all scans")), run = command_find
    ),
    fit = list(
      says = paste("Measure scans by a scheme. A result that is in the folder already is used",
                   "again."),
      takes = "SCAN|FOLDER ...",
      options = list(
        option("out", "DIR", "folder of results, points.csv, quality.csv, failures.csv"), scheme,
        option("landmarks", "FILE", "landmarks: a file for all, or a folder", "beside the scans"),
        option("find", NA, "find the landmarks of scans that have none"),
        option("workers", "N", "number of processes", 1, number = TRUE)
      ), run = command_fit
    ),
    page = list(
      says = "Write a page with the face and its curves, which turns in the browser.",
      takes = "SCAN|RESULT", options = list(option("out", "FILE", "page, .html"), scheme),
      run = command_page
    )
  )
}

sample_commands <- function(option = command_option) {
  list(
    quality = list(
      says = "Grade all parts of measured specimens: green, amber or red, with the reason.",
      takes = "DIR|RESULT ...",
      options = list(out_option("the grades"),
                     option("page", "FILE", "page for the browser, .html")),
      run = command_quality
    ),
    homologise = list(
      says = "Slide the semilandmarks of all specimens of a folder until they are homologous.",
      takes = "DIR|RESULT ...",
      options = list(out_option("the points"),
                     option("sample", "FILE", "the sample for crestline compare, .rds"),
                     option("red", "WHAT", "parts graded red: warn, leave out or keep", "warn")),
      run = command_homologise
    ),
    compare = list(
      says = "Test groups by permutation: size, mean shape, T2, components.",
      takes = "SAMPLE.rds|DIR",
      options = list(
        option("groups", "FILE", "table with a row for each specimen, .csv"),
        option("by", "COLUMN", "its column with the group", "group"),
        option("id", "COLUMN", "its column with the specimen", "id"),
        option("level", "NAME", "landmarks, curves or surface", "curves"),
        option("permutations", "N", "number of permutations", 1000, number = TRUE),
        option("seed", "N", "start of the random stream: the same seed, the same answer", 1,
               number = TRUE),
        out_option("the tests")
      ), run = command_compare
    )
  )
}

#' What a command's option is: `value` names what it takes, NA of a switch
#' @noRd
command_option <- function(name, value, says, default = NULL, number = FALSE) {
  list(name = name, value = value, says = says, default = default, number = number)
}

out_option <- function(what) {
  command_option("out", "FILE",
                 paste(what, "as a table, .csv, .json or .parquet; else to the output"))
}

#' Write a table, by the ending of its file; to the output where there is none
#' @noRd
write_command_table <- function(table, file) {
  if (is.null(file)) {
    utils::write.csv(table, row.names = FALSE, na = "")
    return(invisible())
  }
  switch(file_extension(check_table_file(file)),
         csv = utils::write.csv(table, file, row.names = FALSE, na = "", fileEncoding = "UTF-8"),
         json = jsonlite::write_json(table, file, digits = NA, na = "null", null = "null",
                                     auto_unbox = TRUE),
         parquet = nanoparquet::write_parquet(table, file))
  invisible()
}

#' The path of a table that can be written
#' @noRd
check_table_file <- function(file) {
  file <- check_path_to_write(file, "--out", c("csv", "json", "parquet"))
  if (file_extension(file) == "parquet" && !requireNamespace("nanoparquet", quietly = TRUE)) {
    crestline_abort("--out is a Parquet file, and the package nanoparquet is not installed.",
                    "Install it, or give a .csv file.", stage = "arguments")
  }
  file
}

#' One file, or an error
#' @noRd
one_file <- function(files) {
  if (length(files) == 1) return(files)
  crestline_abort(sprintf("%s are given, and one is taken.", amount(length(files), "file")),
                  "Run it for each.", stage = "arguments")
}

check_needed <- function(value, name, what) {
  if (is.null(value)) {
    crestline_abort(sprintf("--%s is missing.", name), sprintf("Give %s.", what),
                    stage = "arguments")
  }
  value
}

command_scheme <- function(given) {
  if (is.null(given) || given == "the face's") face_scheme() else read_scheme(given)
}

command_find <- function(given) {
  if (!is.null(given$out)) check_table_file(given$out)
  failed <- 0L
  tables <- Map(function(file, id) {
    table <- tryCatch({
      found <- find_landmarks(read_specimen(file, id = id))
      data.frame(specimen = found$id, found$placing)
    }, crestline_error = function(e) {
      write(sprintf("%s: %s %s", file, e$problem, e$remedy), stderr())
      NULL
    })
    if (is.null(table)) failed <<- failed + 1L
    table
  }, given$files, file_ids(given$files))
  if (failed == length(given$files)) return(2L)
  write_command_table(do.call(rbind, unname(tables)), given$out)
  as.integer(failed > 0)
}

command_fit <- function(given) {
  dir <- check_needed(given$out, "out", "a folder for the results")
  scheme <- command_scheme(given$scheme)
  if (given$workers > 1) {
    rlang::check_installed("future", "to measure in several processes.")
    plan <- future::plan("multisession", workers = given$workers)
    on.exit(future::plan(plan))
  }
  landmarks <- if (given$landmarks != "beside the scans") given$landmarks
  shapes <- fit_shapes(given$files, scheme, dir = dir, landmarks = landmarks,
                       found = if (given$find) TRUE)
  failed <- failures(shapes)
  measured <- shapes[setdiff(names(shapes), failed$id)]
  points <- lapply(names(measured), function(id) {
    data.frame(id = id, as.data.frame(measured[[id]]))
  })
  table <- function(what, name) {
    utils::write.csv(what, file.path(dir, name), row.names = FALSE, na = "")
  }
  if (length(measured)) {
    table(do.call(rbind, points), "points.csv")
    table(as.data.frame(quality(measured)), "quality.csv")
  }
  table(failed, "failures.csv")
  write(sprintf("%s, %s: %s %s", failed$id, failed$stage, failed$message, failed$remedy), stderr())
  write(sprintf("%d measured, %d failed, in %s", length(measured), nrow(failed), dir), stderr())
  if (!length(measured)) 2L else as.integer(nrow(failed) > 0)
}

command_quality <- function(given) {
  shapes <- read_batch(given$files)
  if (!is.null(given$page)) quality_report(shapes, given$page)
  write_command_table(as.data.frame(quality(shapes)), given$out)
  as.integer(nrow(failures(shapes)) > 0)
}

command_homologise <- function(given) {
  if (!is.null(given$sample)) check_path_to_write(given$sample, "--sample", "rds")
  shapes <- read_batch(given$files)
  sample <- homologise(shapes, red = given$red)
  if (!is.null(given$sample)) saveRDS(sample, given$sample)
  write_command_table(as.data.frame(sample), given$out)
  as.integer(length(sample) < length(shapes))
}

command_compare <- function(given) {
  groups <- check_needed(given$groups, "groups", "a table of groups, .csv")
  file <- one_file(given$files)
  sample <- if (dir.exists(file)) homologise(read_batch(file)) else read_sample(file)
  # Groups by the specimens' ids, from a table
  if (!file.exists(groups)) {
    crestline_abort(sprintf("there is no file %s.", groups), "Check its path.", stage = "groups")
  }
  table <- utils::read.csv(groups, colClasses = "character", fileEncoding = "UTF-8-BOM",
                           check.names = FALSE)
  absent <- setdiff(c(given$id, given$by), names(table))
  if (length(absent)) {
    crestline_abort(sprintf("%s has no column %s; it has %s.", groups, shorten(absent),
                            shorten(names(table))),
                    "Name the columns by --id and --by.", stage = "groups")
  }
  group <- stats::setNames(table[[given$by]], table[[given$id]])
  compared <- compare_groups(sample, group, given$level, n_perm = given$permutations,
                             seed = given$seed)
  write(utils::capture.output(print(compared)), stderr())
  write_command_table(compared$tests, given$out)
  0L
}

#' A sample that `crestline homologise --sample` wrote
#' @noRd
read_sample <- function(file) {
  sample <- tryCatch(suppressWarnings(readRDS(file)), error = function(e) NULL)
  if (!inherits(sample, "shape_sample")) {
    crestline_abort(sprintf("%s is not there, or is no sample.", file),
                    "Give the file of crestline homologise --sample, or a folder of results.",
                    stage = "reading")
  }
  validate(sample)
  sample
}

command_page <- function(given) {
  out <- check_needed(given$out, "out", "the path of a page, .html")
  file <- one_file(given$files)
  kept <- file_extension(file) == "shape"
  shapes <- if (kept) read_batch(file) else fit_shapes(file, command_scheme(given$scheme))
  failed <- failures(shapes)
  if (nrow(failed)) crestline_abort(failed$message, failed$remedy, failed$stage, failed$id)
  shape <- shapes[[1]]
  write_page(shape$specimen, out, curves = shape)
  0L
}
