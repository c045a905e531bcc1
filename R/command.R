# The package from a shell: commands, their options, and exit codes.

#' Run crestline from a shell
#'
#' The script `exec/crestline` of the installed package calls this function with the words of a
#' shell's line. It finds, measures and compares scans from Python, 3D Slicer, Snakemake, or any
#' other program that can start a process. `crestline --help` lists the commands, and `crestline fit
#' --help` the options of one. Results are files. Progress and messages go to the standard error.
#'
#' | command | takes | gives |
#' |---|---|---|
#' | `find` | scans | landmarks with state and confidence |
#' | `fit` | scans | a folder of results, and tables of points, grades and failures |
#' | `quality` | a folder of results | grades of all parts, a page |
#' | `homologise` | a folder of results | slid semilandmarks, a sample |
#' | `compare` | a folder of results, or a sample | tests of groups |
#' | `page` | a scan or a result | a page of the face with its curves |
#'
#' @param arguments Character vector: the words after the name of the program.
#' @return The exit code: 0 if all was done, 1 if a specimen failed and the others were done, 2 if
#'   nothing was done, since an argument or a file was wrong. The standard error then has one line
#'   with the reason and the remedy.
#' @section Errors: none. Every error becomes an exit code and a line.
#' @template glossary
#' @seealso [find_landmarks()], [fit_shapes()], [quality()], [homologise()], [compare_groups()],
#'   [write_page()], which do the work.
#' @examples
#' # The path of the script; in a shell: crestline fit scans/*.ply --out results
#' file.path(system.file("exec", package = "crestline"), "crestline")
#' run_command(c("find", "--help"))
#' @export
run_command <- function(arguments = commandArgs(trailingOnly = TRUE)) {
  if (!is.character(arguments) || anyNA(arguments)) {
    refuse_argument("arguments", arguments, "Give words: c(\"find\", \"face.ply\").")
  }
  name <- arguments[1]
  if (is.na(name) || name %in% c("-h", "--help", "help")) {
    cat(commands_help(), sep = "\n")
    return(0L)
  }
  tryCatch({
    known <- commands()
    command <- if (name %in% names(known)) known[[name]] else {
      near <- names(known)[order(utils::adist(name, names(known), ignore.case = TRUE))][1]
      crestline_abort(sprintf("there is no command of that name; %s is near.", near),
                      "crestline --help lists the commands.", stage = "arguments")
    }
    given <- arguments[-1]
    if (any(given %in% c("-h", "--help"))) {
      cat(command_help(name, command), sep = "\n")
      return(0L)
    }
    withCallingHandlers(command$run(read_options(given, command, name)), warning = tell_aside,
                        message = tell_aside)
  }, error = function(e) {
    said <- if (inherits(e, "crestline_error")) c(e$problem, e$remedy) else conditionMessage(e)
    write(gsub("[[:space:]]+", " ", paste(c(paste0("crestline ", name, ":"), said),
                                          collapse = " ")), stderr())
    2L
  })
}

#' A warning or message as one line of the standard error
#' @noRd
tell_aside <- function(condition) {
  text <- gsub("[[:space:]]+", " ", conditionMessage(condition))
  write(trimws(text), stderr())
  rlang::cnd_muffle(condition)
}

commands_help <- function() {
  known <- commands()
  c("crestline: ridge and valley curves of surface scans", "",
    "  crestline COMMAND [FILE ...] [--option VALUE ...]", "",
    sprintf("  %-11s %s", names(known), vapply(known, `[[`, "", "says")), "",
    "crestline COMMAND --help lists the options of a command. Exit codes: 0 done, 1 a specimen",
    "failed (the others are done), 2 nothing was done.")
}

command_help <- function(name, command) {
  left <- vapply(command$options, function(one) {
    paste0("--", one$name, if (!is.na(one$value)) paste0(" ", one$value))
  }, "")
  said <- vapply(command$options, function(one) {
    paste0(one$says, if (!is.null(one$default)) sprintf(" (%s)", one$default))
  }, "")
  c(sprintf("crestline %s %s [--option VALUE ...]", name, command$takes), "",
    strwrap(command$says, 80), "",
    unlist(Map(function(left, said) {
      strwrap(said, 80, initial = formatC(left, width = -22), prefix = strrep(" ", 22))
    }, paste0("  ", left), said), use.names = FALSE))
}

#' Words of a command's line as files and options
#'
#' @return List: `files`, and every option by name, its default where it was not given.
#' @noRd
read_options <- function(words, command, name) {
  fail <- function(problem) {
    crestline_abort(problem, sprintf("crestline %s --help lists its options.", name),
                    stage = "arguments")
  }
  known <- stats::setNames(command$options, vapply(command$options, `[[`, "", "name"))
  read <- lapply(known, function(one) if (is.na(one$value)) FALSE else one$default)
  files <- character()
  while (length(words)) {
    word <- words[1]
    words <- words[-1]
    if (!startsWith(word, "--")) {
      files <- c(files, word)
      next
    }
    own <- sub("=.*$", "", substring(word, 3))
    one <- known[[own]]
    if (is.null(one)) fail(sprintf("it has no option --%s.", own))
    if (is.na(one$value)) {
      read[[own]] <- TRUE
      next
    }
    value <- if (grepl("=", word, fixed = TRUE)) sub("^[^=]*=", "", word) else words[1]
    if (!grepl("=", word, fixed = TRUE)) words <- words[-1]
    if (is.na(value) || !nzchar(value)) fail(sprintf("--%s needs a value: %s.", own, one$value))
    read[[own]] <- if (one$number) {
      number <- suppressWarnings(as.numeric(value))
      if (is.na(number) || number < 0 || number != round(number)) {
        fail(sprintf("--%s is \"%s\", not a whole number.", own, value))
      }
      number
    } else value
  }
  if (!length(files)) fail(sprintf("it needs %s.", command$takes))
  c(list(files = files), read)
}
