# The sources of the package as a graph of calls; also used by tools/architecture.R.

is_function <- function(value) is.call(value) && identical(value[[1]], as.name("function"))

# Every top-level definition of R/*.R by name: `file`, `value` (unevaluated), `lines`.
sources_of <- function(dir) {
  files <- setdiff(list.files(dir, "[.]R$"), "RcppExports.R")
  each <- lapply(files, function(file) {
    parsed <- parse(file.path(dir, file), keep.source = TRUE)
    lines <- vapply(attr(parsed, "srcref"), function(at) at[3] - at[1] + 1, 0)
    is_definition <- vapply(parsed, function(e) is.call(e) && identical(e[[1]], as.name("<-")) &&
                                    length(e[[2]]) == 1, NA)
    found <- Map(function(e, n) list(file = file, value = e[[3]], lines = n), parsed[is_definition],
                 lines[is_definition])
    stats::setNames(found, vapply(parsed[is_definition], function(e) as.character(e[[2]]), ""))
  })
  do.call(c, each)
}

# Data frame from, to, from_file, to_file: which definition uses which.
calls_between <- function(defined) {
  empty <- new.env()
  each <- lapply(names(defined), function(name) {
    value <- defined[[name]]$value
    used <- if (is_function(value)) codetools::findGlobals(eval(value, empty)) else all.names(value)
    to <- setdiff(intersect(used, names(defined)), name)
    data.frame(from = rep(name, length(to)), to = to,
               from_file = rep(defined[[name]]$file, length(to)),
               to_file = vapply(defined[to], `[[`, "", "file"), row.names = NULL)
  })
  do.call(rbind, each)
}

# The groups of files that call each other round in a circle.
file_cycles <- function(calls) {
  links <- unique(calls[calls$from_file != calls$to_file, c("from_file", "to_file")])
  nodes <- unique(unlist(links))
  reach <- matrix(FALSE, length(nodes), length(nodes), dimnames = list(nodes, nodes))
  reach[as.matrix(links)] <- TRUE
  for (k in nodes) reach <- reach | outer(reach[, k], reach[k, ], `&`)
  both <- reach & t(reach)
  groups <- unique(lapply(nodes[diag(both)], function(node) sort(c(node, nodes[both[node, ]]))))
  unique(lapply(groups, unique))
}
