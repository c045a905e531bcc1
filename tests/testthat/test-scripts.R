# The scripts of bench/ and tools/ call functions of the package as these are today. They are not
# run by the tests, so that nothing else would tell.

scripts <- function() {
  root <- testthat::test_path("..", "..")
  testthat::skip_if_not(dir.exists(file.path(root, "bench")), "scripts not here")
  list.files(file.path(root, c("bench", "tools")), "[.]R$", full.names = TRUE)
}

# All calls in some expressions, nested ones too.
every_call <- function(x) {
  if (!is.call(x) && !is.expression(x) && !is.pairlist(x)) return(NULL)
  # Empty arguments, as in x[, 1], are no values.
  parts <- Filter(function(one) !identical(one, quote(expr = )), as.list(x))
  c(if (is.call(x)) list(x), do.call(c, lapply(unname(parts), every_call)))
}

is_call_of <- function(x, name) is.call(x) && any(vapply(name, function(one) {
  identical(x[[1]], as.name(one))
}, NA))

# Names that a script gives values: by assignment, or as arguments of its functions.
own_names <- function(calls) {
  each <- lapply(calls, function(one) {
    if (is_call_of(one, c("<-", "<<-", "=")) && (is.name(one[[2]]) || is.character(one[[2]]))) {
      return(as.character(one[[2]]))
    }
    if (is_call_of(one, "function")) names(one[[2]])
  })
  unique(unlist(each))
}

# The function of ours that an expression names: crestline:::f, own("f"), getFromNamespace("f",
# "crestline"), or f itself. NULL for others.
named_function <- function(x, theirs, exported) {
  if (is_call_of(x, c("::", ":::"))) {
    return(if (identical(as.character(x[[2]]), "crestline")) as.character(x[[3]]))
  }
  fetched <- is_call_of(x, "getFromNamespace") && identical(as.list(x)[[3]], "crestline")
  if ((fetched || is_call_of(x, "own")) && length(x) > 1 && is.character(x[[2]])) return(x[[2]])
  if (is.name(x) && as.character(x) %in% setdiff(exported, theirs)) as.character(x)
}

# Why the arguments of a call are not those of a function; NULL where they may be.
wrong_arguments <- function(call, f) {
  known <- names(formals(f))
  given <- as.list(call)[-1]
  if (any(vapply(given, identical, NA, as.name("...")))) return(NULL)
  name <- if (is.null(names(given))) character(length(given)) else names(given)
  before <- if ("..." %in% known) known[seq_len(match("...", known) - 1)] else known
  named <- name[nzchar(name)]
  unknown <- named[is.na(pmatch(named, known, duplicates.ok = TRUE))]
  if (!"..." %in% known && length(unknown)) return(paste("has no argument", unknown[1]))
  more <- sum(!nzchar(name)) - length(setdiff(before, named))
  if (!"..." %in% known && more > 0) {
    return(sprintf("takes %d arguments, not %d", length(known), length(given)))
  }
  NULL
}

# What is wrong with the calls of one script: lines of text.
wrong_calls <- function(file, space = asNamespace("crestline")) {
  calls <- every_call(parse(file, keep.source = FALSE))
  theirs <- own_names(calls)
  exported <- getNamespaceExports(space)
  named <- lapply(calls, function(one) {
    c(named_function(one, theirs, character()), named_function(one[[1]], theirs, exported))
  })
  each <- Map(function(call, names) {
    lapply(names, function(name) {
      problem <- if (!exists(name, space, inherits = FALSE)) "does not exist" else
        if (!is.null(named_function(call[[1]], theirs, exported)) &&
            is.function(space[[name]])) wrong_arguments(call, space[[name]])
      if (!is.null(problem)) paste(basename(file), name, problem)
    })
  }, calls, named)
  unique(unlist(each))
}

test_that("scripts call functions that are there, with arguments that they have", {
  found <- lapply(scripts(), wrong_calls)
  expect_equal(as.character(unlist(found)), character())
})

test_that("a call of a function that is gone, or with other arguments, is found", {
  file <- tempfile("calls-", fileext = ".R")
  on.exit(unlink(file))
  writeLines(c("own <- function(name) getFromNamespace(name, \"crestline\")",
               "locate <- function(a) a", "locate(1, 2, 3, 4, 5, 6, 7, 8)",
               "own(\"gone\")(1)", "f <- crestline:::went", "own(\"unit_vector\")(1, 2, 3)",
               "crestline::align(x, nonsense = 1)", "mesh[, 1]", "shape_index(1, 1, 1, 1, 1, 1)",
               "crestline:::unit_vector(...)", "align(x, \"curves\", scale = FALSE)"), file)
  found <- sub("^[^ ]* ", "", wrong_calls(file))
  expect_setequal(sub(" .*", "", found), c("gone", "went", "unit_vector", "shape_index"))
  expect_match(found, "does not exist", all = FALSE)
  expect_match(found, "takes 1 arguments, not 3", all = FALSE)
})

test_that("a vignette that names a script says where it is: not in the installed package", {
  root <- testthat::test_path("..", "..", "vignettes")
  skip_if_not(dir.exists(root), "vignettes not here")
  files <- list.files(root, "[.](Rmd|orig)$", full.names = TRUE)
  text <- vapply(files, function(file) paste(readLines(file), collapse = " "), "")
  names <- grepl("bench/|make studies", text)
  expect_gt(sum(names), 5)
  expect_equal(basename(files[names & !grepl("repository", text)]), character())
})
