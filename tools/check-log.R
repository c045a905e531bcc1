# Reads a 00check.log and fails on every error, warning and note but those the machine makes, listed
# here.
#   Rscript tools/check-log.R crestline.Rcheck/00check.log

# The check that speaks, the version of R below which (Inf: in all), what each line it prints must
# match, and why it is not ours.
known <- list(
  list(
    check = "package dependencies", level = "NOTE", below = "4.4.0",
    lines = paste("^(Packages? suggested but not available for",
                  "checking:.*|\\s*['\u2018]?(geomorph|RRPP).*)$"),
    why = "geomorph and RRPP are offered from R 4.4 on"
  ),
  list(
    check = "R files for syntax errors", level = "WARNING", below = Inf,
    lines = paste("^(Warnings in file .*|Warning.*|.*Sys.setlocale.*|.*OS reports request to",
                  "set locale to \"en_US.UTF-8\" cannot be honou?red.*)$"),
    why = "with LC_ALL=C the check asks for a locale that a bare machine does not have"
  )
)

read_remarks <- function(log) {
  log <- grep("^Status: ", log, value = TRUE, invert = TRUE)
  starts <- grep("^\\* ", log)
  blocks <- split(log, cumsum(seq_along(log) %in% starts))
  spoken <- blocks[vapply(blocks, function(block) any(grepl("(^| )(NOTE|WARNING|ERROR)$", block)),
                          NA)]
  lapply(spoken, function(block) {
    said <- grep("(^| )(NOTE|WARNING|ERROR)$", block)[[1]]
    list(
      check = sub("^\\* checking (.*) \\.\\.\\..*$", "\\1", block[[1]]),
      level = sub(".* ", "", block[[said]]),
      lines = Filter(nzchar, trimws(block[-seq_len(said)]))
    )
  })
}

is_known <- function(remark) {
  any(vapply(known, function(rule) {
    remark$check == rule$check && remark$level == rule$level &&
      (identical(rule$below, Inf) || getRversion() < rule$below) &&
      all(grepl(rule$lines, remark$lines))
  }, NA))
}

# The check's own count, so that a remark this script fails to see cannot pass.
status_count <- function(log) {
  status <- grep("^Status: ", log, value = TRUE)
  if (length(status) != 1) return(NA_integer_)
  number <- regmatches(status, gregexpr("[0-9]+", status))[[1]]
  sum(as.integer(number))
}

log <- readLines(commandArgs(TRUE)[1], encoding = "UTF-8")
remarks <- read_remarks(log)
ours <- Filter(Negate(is_known), remarks)
for (remark in remarks) {
  cat(sprintf("    %s in \"%s\"%s\n", remark$level, remark$check,
              if (is_known(remark)) " (the machine's)" else ""))
}
complete <- identical(status_count(log), length(remarks))
if (!complete) cat(paste("    the log and its status line do not agree: the check did not end",
                         "as it should\n"))
cat(sprintf("    R CMD check on R %s: %d remarks, %d ours\n", getRversion(), length(remarks),
            length(ours)))
quit(status = as.integer(length(ours) > 0 || !complete))
