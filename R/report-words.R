# What the pages for a clinic share: lists of facts, tables, numbers in words.

#' Names and texts as a list of definitions
#' @noRd
fact_list <- function(facts) {
  tags <- htmltools::tags
  tags$dl(class = "facts", lapply(names(facts), function(name) {
    tags$div(tags$dt(name), tags$dd(facts[[name]]))
  }))
}

p_words <- function(p) if (is.na(p)) "" else if (p < 0.001) "< 0.001" else sprintf("%.3f", p)

page_table <- function(head, rows, class = NULL) {
  tags <- htmltools::tags
  tags$div(class = "scroll", tags$table(class = class, tags$thead(head), tags$tbody(rows)))
}

centile_words <- function(x) {
  if (x < 0.1) "< 0.1" else if (x > 99.9) "> 99.9" else if (x < 1 || x > 99) sprintf("%.1f", x) else
    sprintf("%.0f", x)
}
