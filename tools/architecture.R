# How the sources hang together, as figures; the rules that must hold are in
# tests/testthat/test-layers.R.
#
#   Rscript tools/architecture.R        (from the package's root; the package must be installed)
#
# Static, from the parsed sources: functions, longest function, internal functions with a single
# caller, the longest chain of calls below fit_shape(), and the longest chain of functions that hand
# an argument on under its own name, each to the next: in all, and among what fit_shape() calls. A
# constant that a function uses is no call. Of the internal functions with a single caller a part
# could not be folded into it: it is called at several places, calls itself, is called by a bench or
# tool too, or the two together are longer than the 40 lines that a function may have.
# Dynamic, from one fit_shape() of Rvcg's face: calls, files entered, argument checks.
source("tests/testthat/helper-layers.R")

defined <- sources_of("R")
calls <- calls_between(defined)
exports <- sub("^export\\((.*)\\)$", "\\1",
               grep("^export\\(", readLines("NAMESPACE"), value = TRUE))
methods <- gsub("^S3method\\((generics::)?\"?|\"?\\)$", "",
                grep("^S3method", readLines("NAMESPACE"), value = TRUE))
methods <- sub("\"?,\"?", ".", methods)

# Longest path below a function, a cycle counted as one step.
depth_below <- function(from, edges, seen = character()) {
  memory <- new.env()
  visit <- function(f, above) {
    if (f %in% above) return(0)
    if (!is.null(memory[[f]])) return(memory[[f]])
    next_ones <- edges$to[edges$from == f]
    memory[[f]] <- if (length(next_ones)) 1 + max(vapply(next_ones, visit, 0, c(above, f))) else 0
    memory[[f]]
  }
  visit(from, seen)
}

# Calls by which f gives its own argument `name` to g as g's argument `name`.
handed_on <- function(defined) {
  each <- lapply(names(defined), function(f) {
    value <- defined[[f]]$value
    if (!is_function(value)) return(NULL)
    own <- names(value[[2]])
    found <- list()
    walk <- function(e) {
      if (is.call(e)) {
        g <- if (is.name(e[[1]])) as.character(e[[1]]) else ""
        if (g %in% names(defined) && is_function(defined[[g]]$value)) {
          theirs <- names(defined[[g]]$value[[2]])
          given <- vapply(as.list(e)[-1], function(a) if (is.name(a)) as.character(a) else "", "")
          same <- intersect(intersect(given[nzchar(given)], own), theirs)
          if (length(same)) found[[length(found) + 1]] <<- data.frame(from = f, to = g, name = same)
        }
      }
      if (is.recursive(e)) for (part in as.list(e)) if (!missing(part)) walk(part)
    }
    walk(value[[3]])
    unique(do.call(rbind, found))
  })
  do.call(rbind, each)
}

# By how many functions each argument is handed on, the most first; and that chain's functions.
traffic <- function(chain) {
  most <- vapply(unique(chain$name), function(name) {
    own <- chain[chain$name == name, ]
    max(vapply(unique(own$from), depth_below, 0, own))
  }, 0)
  sort(most, decreasing = TRUE)[1:5]
}

functions <- Filter(function(one) is_function(one$value), defined)
function_calls <- calls[calls$from %in% names(functions) & calls$to %in% names(functions), ]
chain <- handed_on(defined)
below <- "fit_shape"
repeat {
  more <- setdiff(function_calls$to[function_calls$from %in% below], below)
  if (!length(more)) break
  below <- c(below, more)
}

# Of internal functions with a single caller: which could be a paragraph of it.
lines <- vapply(functions, function(one) one$lines, 0)
callers <- table(factor(calls$to, unique(names(defined))))
internal <- setdiff(names(functions), c(exports, methods))
single <- internal[callers[internal] == 1]
caller <- calls$from[match(single, calls$to)]
elsewhere <- unique(unlist(lapply(
  list.files(c("inst", "bench", "tools", "exec", "tests"), "[.]R$|^crestline$", recursive = TRUE,
             full.names = TRUE),
  function(file) all.names(parse(file))
)))
places <- mapply(function(f, g) sum(all.names(defined[[g]]$value) == f), single, caller)
recursive <- vapply(single, function(f) f %in% all.names(functions[[f]]$value), NA)
# Of the two signatures, pairs of braces and empty lines three lines go.
together <- lines[single] + lines[caller] - 3
foldable <- places == 1 & !recursive & !single %in% elsewhere & !is.na(together) & together <= 40

cat(sprintf("functions and values %d in %d files, %d lines of R\n", length(defined),
            length(unique(vapply(defined, `[[`, "", "file"))),
            sum(vapply(list.files("R", full.names = TRUE), function(f) length(readLines(f)), 0L))))
cat(sprintf("longest function: %s, %d lines\n", names(which.max(lines)), max(lines)))
cat(sprintf("internal functions with a single caller: %.0f %% of %d; could be folded: %.0f %%\n",
            100 * mean(callers[internal] == 1), length(internal),
            100 * sum(foldable) / length(internal)))
cat(sprintf("depth below fit_shape(): %d; with constants %d\n",
            depth_below("fit_shape", function_calls), depth_below("fit_shape", calls)))
said <- function(most) paste0(names(most), " ", most, collapse = ", ")
cat("an argument is handed on by the most functions:", said(traffic(chain)), "\n")
cat("the same among the functions below fit_shape():",
    said(traffic(chain[chain$from %in% below & chain$to %in% below, ])), "\n")

options(rgl.useNULL = TRUE)
space <- asNamespace("crestline")
tally <- new.env(parent = emptyenv())
counted <- Filter(function(f) is.function(space[[f]]) && !is.primitive(space[[f]]), names(defined))
counter <- function(name) {
  force(name)
  function() assign(name, get0(name, tally, ifnotfound = 0) + 1, tally)
}
for (f in counted) {
  own <- space[[f]]
  body(own) <- call("{", as.call(list(counter(f))), body(own))
  unlockBinding(f, space)
  assign(f, own, space)
}
library(crestline)
data(humface, package = "Rvcg", envir = environment())
file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
face <- specimen(humface, read_landmarks(file), id = "humface")
scheme <- face_scheme()
rm(list = ls(tally), envir = tally)
invisible(space$fit_shape(face, scheme, progress = FALSE))
number <- unlist(as.list(tally))
cat(sprintf("one fit_shape(): %d calls of %d functions in %d files, %d argument checks\n",
            sum(number), length(number),
            length(unique(vapply(defined[names(number)], `[[`, "", "file"))),
            sum(number[grepl("^check_", names(number))])))
