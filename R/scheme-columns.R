# The columns of a scheme's tables, and tables turned into those columns with every problem kept.

#' What a column holds
#'
#' @param type "name" (text that must be there), "text", "number", "count" (whole number), or
#'   "choice".
#' @param required Whether the column must be there; a required column has no empty cell.
#' @param default Value where the column is absent.
#' @param lower,upper,open Range of a number; `open`: bounds excluded.
#' @param choices Values of a choice.
#' @noRd
column <- function(type, required = FALSE, default = NA, lower = -Inf, upper = Inf, open = FALSE,
                   choices = NULL) {
  list(type = type, required = required, default = default, lower = lower, upper = upper,
       open = open,
       choices = choices)
}

# Most points of a curve, of a side or of a patch, and most rows: far above any scheme (the face: 28
# a curve, 108 a patch), far below what fills the memory.
most_points <- 1e5

scheme_columns <- list(
  landmarks = list(
    landmark = column("text", TRUE), name = column("text"), where = column("text"),
    x = column("number"), y = column("number"), z = column("number")
  ),
  curves = list(
    curve = column("text", TRUE), from = column("text", TRUE), to = column("text", TRUE),
    kind = column("choice", TRUE, choices = c("ridge", "valley", "plane")),
    radius = column("number", lower = 0, open = TRUE),
    width = column("number", lower = 0, open = TRUE),
    n = column("count", TRUE, lower = 2, upper = most_points),
    cut_share = column("number", lower = 0, open = TRUE), cut_from = column("text"),
    cut_to = column("text"),
    keep_away_from = column("text"), keep_away_to = column("text"),
    keep_away_radius = column("number", lower = 0, open = TRUE),
    keep_away_extension = column("number", lower = 0),
    keep_side_from = column("text"), keep_side_to = column("text"),
    keep_side_towards = column("text"),
    side_of = column("text"), side = column("choice", choices = c("left", "right")),
    trust_from = column("number", lower = 0, upper = 1),
    trust_to = column("number", lower = 0, upper = 1),
    angle_limit = column("number", lower = 0, upper = pi / 2),
    path = column("choice", choices = c("plane", "crest")), via = column("text"),
    note = column("text")
  ),
  patches = list(
    patch = column("text", TRUE), block = column("count", lower = 1, upper = most_points),
    n = column("count", TRUE, lower = 1, upper = most_points), columns = column("text", TRUE),
    rows = column("count", TRUE, lower = 1, upper = most_points), rows_kept = column("text", TRUE),
    curve_a = column("text", TRUE), resample_a = column("count", lower = 2, upper = most_points),
    curve_b = column("text"), resample_b = column("count", lower = 2, upper = most_points),
    first_column = column("text"), outward = column("choice", choices = c("columns", "rows")),
    note = column("text")
  ),
  pairs = list(
    level = column("choice", TRUE, choices = c("landmarks", "curves", "surface")),
    left = column("text", TRUE), right = column("text", TRUE)
  ),
  strips = list(
    part = column("text", TRUE), strip = column("text", TRUE),
    rung = column("count", TRUE, lower = 1, upper = most_points),
    a = column("text", TRUE), b = column("text", TRUE),
    outward = column("choice", TRUE, choices = c("columns", "rows"))
  ),
  definitions = list(
    landmark = column("text", TRUE),
    kind = column("choice", TRUE, choices = c("cap", "cup", "profile", "turn", "end", "crossing")),
    radius = column("number", TRUE, lower = 0, open = TRUE),
    reach = column("number", TRUE, lower = 0, open = TRUE),
    bend = column("choice", choices = c("out", "in", "left", "right")), mirror = column("text"),
    from = column("text"), to = column("text"),
    type = column("choice", choices = c("ridge", "valley", "plane")),
    width = column("number", lower = 0, open = TRUE), across_from = column("text"),
    across_to = column("text"),
    across_type = column("choice", choices = c("ridge", "valley", "plane")), note = column("text")
  ),
  tracks = list(
    curve = column("text", TRUE), place = column("count", TRUE, lower = 1, upper = most_points),
    s = column("number", TRUE, lower = 0, upper = 1),
    x = column("number", TRUE), y = column("number", TRUE), z = column("number", TRUE),
    across_x = column("number", TRUE), across_y = column("number", TRUE),
    across_z = column("number", TRUE),
    spread = column("number", TRUE, lower = 0, open = TRUE)
  )
)

#' A table with all its columns, each of its type, and the problems on the way
#'
#' @param table Data frame, cells perhaps text; other columns than the known ones are kept behind
#'   them.
#' @param columns List of [column()]s.
#' @return List: `table`; `problems` (data frame: `row`, NA for a whole column; `column`; `text`).
#' @noRd
typed_table <- function(table, columns) {
  names(table) <- trimws(names(table))
  given <- intersect(names(columns), names(table))
  missing <- Filter(function(name) columns[[name]]$required, setdiff(names(columns), given))
  problems <- problem(rep(NA, length(missing)), missing,
                      sprintf("missing; the columns are %s", toString(names(table))))
  typed <- lapply(names(columns), function(name) {
    cells <- if (name %in% given) table[[name]] else rep(columns[[name]]$default, nrow(table))
    typed_cells(cells, name, columns[[name]])
  })
  problems <- rbind(problems,
                    do.call(rbind, lapply(typed[names(columns) %in% given], `[[`, "problems")))
  known <- as.data.frame(
    stats::setNames(lapply(typed, `[[`, "cells"), names(columns)), stringsAsFactors = FALSE
  )
  list(table = cbind(known, table[setdiff(names(table), names(columns))]), problems = problems)
}

typed_cells <- function(cells, name, column) {
  text <- trimws(as.character(cells))
  empty <- is.na(text) | text == ""
  text[empty] <- NA
  problems <- if (column$required) problem(which(empty), name, "is empty")
  if (column$type == "choice") {
    wrong <- which(!empty & !text %in% column$choices)
    return(list(cells = text, problems = rbind(problems, problem(
      wrong, name, sprintf("\"%s\" is none of %s", text[wrong], toString(column$choices))))))
  }
  if (column$type == "text") return(list(cells = text, problems = problems))
  number <- if (is.numeric(cells)) as.numeric(cells) else suppressWarnings(as.numeric(text))
  wrong <- which(!empty & !in_range(number, column))
  kind <- if (column$type == "count") "a whole number" else "a number"
  range <- describe_range(column$lower, column$upper, column$open)
  list(cells = if (column$type == "count") as.integer(replace(number, wrong, NA)) else number,
       problems = rbind(problems,
                        problem(wrong, name, sprintf("%s is not %s %s", text[wrong], kind, range))))
}

in_range <- function(x, column) {
  inside <- if (column$open) x > column$lower & x < column$upper else
    x >= column$lower & x <= column$upper
  !is.na(x) & is.finite(x) & inside & (column$type != "count" | x == round(x))
}

#' Problems of a table: none where `row` is empty
#' @noRd
problem <- function(row, column, text) {
  if (!length(row)) return(data.frame(row = integer(), column = character(), text = character()))
  data.frame(row = row, column = column, text = text)
}

#' Stop with all problems of one table, by row and column
#'
#' @param problems As of [typed_table()].
#' @param label How the table is called: "curves", or its file.
#' @param names Names of the rows.
#' @param most Number of problems that are written out.
#' @noRd
refuse_table <- function(problems, label, names, most = 8) {
  if (is.null(problems) || nrow(problems) == 0) return(invisible())
  problems <- problems[order(problems$row, na.last = FALSE), ]
  shown <- utils::head(problems, most)
  row <- ifelse(is.na(shown$row), "", sprintf("row %d (%s), ", shown$row, names[shown$row]))
  more <- nrow(problems) - nrow(shown)
  lines <- c(sprintf("%scolumn %s: %s", row, shown$column, shown$text),
             if (more > 0) sprintf("and %d more", more))
  crestline_abort(
    sprintf("table %s has %d problem%s.\n%s", label, nrow(problems),
            if (nrow(problems) > 1) "s" else "",
            paste0("- ", lines, collapse = "\n")),
    paste("Mend the table; rows are counted below the header. `?curve_scheme` says what each",
          "column holds."),
    stage = "scheme", class = "crestline_scheme_error", call = NULL
  )
}

unknown_names <- function(x, known, column, what) {
  wrong <- which(!is.na(x) & !x %in% known)
  nearest <- function(name) {
    if (!length(known)) return("none")
    known[which.min(utils::adist(name, known, ignore.case = TRUE))]
  }
  near <- vapply(x[wrong], nearest, "")
  problem(wrong, column, sprintf("there is no %s \"%s\" (nearest: %s)", what, x[wrong], near))
}

#' The left landmarks that a cell of `mirror` names
#' @noRd
mirror_names <- function(cell) strsplit(trimws(cell), " +")[[1]]

#' Which curves of a scheme are closed
#' @noRd
closed_curves <- function(curves) !is.na(curves$from) & curves$from %in% curves$to &
  curves$from == curves$to
