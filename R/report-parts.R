# The pieces of the quality report's page.

#' A bar of the three shares
#' @noRd
report_bar <- function(green, amber, red) {
  total <- max(green + amber + red, 1)
  piece <- function(class, n) {
    if (n > 0) {
      htmltools::tags$span(
        class = class, style = sprintf("width:%.3f%%", 100 * n / total), title = paste(n, class)
      )
    }
  }
  htmltools::tags$div(class = "bar", piece("red", red), piece("amber", amber),
                      piece("green", green))
}

#' The specimens with their counts, the worst first; nothing for one
#' @noRd
report_overview <- function(counts) {
  if (nrow(counts) < 2) return(NULL)
  tags <- htmltools::tags
  counts <- counts[order(-counts$red, -counts$amber), ]
  rows <- lapply(seq_len(nrow(counts)), function(i) {
    one <- counts[i, ]
    tags$tr(tags$td(tags$a(href = "#parts", `data-specimen` = one$specimen, one$specimen)),
            tags$td(class = "n", one$red),
            tags$td(class = "n", one$amber), tags$td(class = "n", one$green),
            tags$td(class = "wide", report_bar(one$green, one$amber, one$red)))
  })
  head <- tags$tr(tags$th("specimen"), lapply(c("red", "amber", "green"), tags$th, class = "n"),
                  tags$th())
  tags$section(tags$h2("Specimens"), page_table(head, rows, "overview"))
}

#' The place of the matrix of specimens by parts, which the script fills; nothing for one specimen
#' @noRd
report_matrix <- function(counts) {
  if (nrow(counts) < 2) return(NULL)
  tags <- htmltools::tags
  levels <- list(tags$option(value = "curves", "curves"), tags$option(value = "surface", "patches"),
                 tags$option(value = "landmarks", "landmarks"))
  tags$section(
    tags$h2("Specimens by ", tags$select(id = "matrix-level", `aria-label` = "level", levels)),
    tags$p(class = "note",
           "Rest the pointer on a cell for its reason; a click lists it below.",
           "A cross: not there."),
    tags$div(class = "scroll", tags$table(id = "matrix"))
  )
}

report_figure <- function(name, picture, graded, open) {
  tags <- htmltools::tags
  counts <- table(graded$grade)
  label <- tags$summary(tags$b(paste0(name, ":")),
                        paste(rev(counts), rev(names(counts)), collapse = ", "))
  shown <- if (is.null(picture)) tags$p("Nothing to draw.") else {
    tags$img(src = picture, alt = sprintf("%s from three sides, coloured by grade", name))
  }
  tags$details(open = if (open) NA, label, shown)
}

report_figures <- function(figures) {
  if (!length(figures)) return(NULL)
  tags <- htmltools::tags
  key <- lapply(names(grade_colours),
                function(grade) tags$span(class = paste("chip", grade), grade))
  tags$section(tags$h2("Pictures"),
               tags$p(class = "note", "Curves and surface points by grade: ", key), figures)
}

#' The place of the table of parts with its filters, which the script fills
#' @noRd
report_parts <- function(table) {
  tags <- htmltools::tags
  choice <- function(value, text = value) tags$option(value = value, text)
  doubtful <- any(table$grade > "green")
  tick <- function(grade) {
    ticked <- if (grade != "green" || !doubtful) NA
    tags$label(class = paste("chip", grade),
               tags$input(type = "checkbox", class = "grade", value = grade, checked = ticked),
               grade)
  }
  specimens <- unique(table$specimen)
  tags$section(
    id = "parts", tags$h2("Parts"),
    tags$div(
      class = "filters", lapply(rev(names(grade_colours)), tick),
      tags$select(id = "level", `aria-label` = "level", choice("", "all levels"),
                  choice("landmarks"), choice("curves"),
                  choice("surface", "patches")),
      if (length(specimens) > 1) {
        tags$select(id = "specimen", `aria-label` = "specimen", choice("", "all specimens"),
                    lapply(specimens, choice))
      },
      tags$input(id = "search", type = "search", placeholder = "part or reason",
                 `aria-label` = "search"),
      tags$span(id = "found")
    ),
    tags$div(class = "scroll", tags$table(id = "table")), tags$button(id = "more", "show more"),
    tags$p(class = "note",
           "Lengths and standard errors (se) in the unit of the mesh, strength in 1 / unit;",
           "z: robust z-score of the length against the other specimens;",
           "asymmetry: distance from the mirror image of the partner,",
           "as a share of the length; missing: share of its points. A click on a heading sorts.")
  )
}

report_limits <- function(limits) {
  tags <- htmltools::tags
  pairs <- limits[lengths(limits) == 2]
  rows <- lapply(names(pairs), function(name) {
    side <- if (name %in% small_is_bad) "below" else "above"
    shown <- ifelse(is.finite(pairs[[name]]), paste(side, format(pairs[[name]], trim = TRUE)),
                    "never")
    tags$tr(tags$td(name), tags$td(shown[1]), tags$td(shown[2]), tags$td(quality_meanings[[name]]))
  })
  head <- tags$tr(lapply(c("measure", "amber", "red", "what it is"), tags$th))
  tags$section(tags$details(
    tags$summary("From what on a part is amber or red"),
    tags$table(class = "limits", tags$thead(head), tags$tbody(rows)),
    tags$p(sprintf("A curve that curvature does not determine is %s;", limits$undetermined),
           sprintf("one whose way or length had to do without a landmark on the mesh is %s.",
                   limits$guessed),
           "A patch is at least amber where a curve that bounds it is not green.")
  ))
}

quality_meanings <- list(
  missing = "share of the points that are not there",
  se = "median standard error across the curve, in radii of the curvature estimate",
  competing = "how good the best other path is, as a share of the one chosen",
  z = "size of the robust z-score of the length against other specimens",
  asymmetry = "distance from the mirror image of the partner, as a share of the length",
  roughness = paste0("mean angle between the normals of the triangles along the part and those at ",
                     "their corners, degrees"),
  coarse = "mean edge of the triangles along the curve, in radii of the curvature estimate",
  bridged = "share of the curve's length that lies over holes",
  faults = "flipped, doubled or crossing triangles of the patch",
  contrast = "mean strength along the curve over that beside it",
  cut = "what was left of a curve that the scheme cuts off, as a share of what was asked for",
  border = "distance from a border or hole, as a share of the part's size",
  spike = "distance within which there are four crumpled triangles, as a share of the part's size"
)

#' The table as JSON, by column, for the script
#' @noRd
report_data <- function(table, digits = 3) {
  columns <- c("specimen", "part", "level", "kind", "grade", "length", "strength", "contrast", "se",
               "competing", "z",
               "asymmetry", "missing", "why")
  shown <- lapply(as.list(table)[columns],
                  function(x) if (is.numeric(x)) signif(x, digits) else as.character(x))
  shown <- lapply(shown, function(x) if (is.numeric(x)) ifelse(is.finite(x), x, NA) else x)
  json <- jsonlite::toJSON(shown, na = "null", digits = NA)
  htmltools::tags$script(id = "data", type = "application/json", htmltools::HTML(script_json(json)))
}
