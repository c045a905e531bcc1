# One face against its norms as a page that prints on A4: pictures, table, growth charts, limits.

#' @exportS3Method
page_of.assessment <- function(x, file, title) {
  if (is.null(title)) title <- paste(x$id, "against the norms of its age and sex")
  tags <- htmltools::tags
  page <- page_document(
    title, assessment_verdicts(x), assessment_maps(x), assessment_findings(x),
    assessment_charts(x), assessment_values(x), assessment_unknown(x), assessment_limits(x),
    tags$section(tags$h2("Where this came from"), assessment_norm(x$norms)),
    lead = list(assessment_facts(x),
                tags$p(class = "warn", "No diagnosis. What is rare in the norm's sample is not",
                       "therefore ill; see the limits below.")),
    provenance = x$provenance, class = "patient"
  )
  save_page(page, file, TRUE)
}

assessment_facts <- function(x) {
  who <- paste0(if (x$sex != "all") paste0(x$sex, ", "), format(signif(x$age, 4)), " years")
  errors <- if (x$errors == "given") "known for this scan" else {
    sprintf("not known for this scan; estimated by its roughness (%.2g of the norm's)", x$rough)
  }
  fact_list(c(Person = x$id, `Sex and age` = who,
              Norm = sprintf("%s%s", if (length(x$norms$name)) paste0(x$norms$name, ", ") else "",
                             amount(x$norms$n, "face")),
              `Effective at this age` = sprintf("%.0f faces%s", x$effective, if (
                x$effective < x$norms$few) " (few: read with the norm's error)" else ""),
              `Error of measurement` = errors))
}

family_words <- c(
  size = "Size of the face", measurements = "Measurements", components = "Shape as a whole",
  map = "Each place against the norm", scan = "Does each place fit the rest of the face?",
  asymmetry = "Asymmetry of left and right"
)

assessment_verdicts <- function(x) {
  tags <- htmltools::tags
  words <- c(real = "outside what chance explains",
             `not distinguishable` = "within what is expected",
             `not assessable` = "could not be assessed")
  rows <- lapply(seq_len(nrow(x$verdicts)), function(i) {
    one <- x$verdicts[i, ]
    where <- if (one$verdict == "real" && !is.na(one$where)) one$where else ""
    tags$tr(tags$td(family_words[[one$family]]), tags$td(tags$b(words[[one$verdict]])),
            tags$td(class = "n", p_words(one$p_holm)), tags$td(where))
  })
  head <- tags$tr(tags$th("question"), tags$th("answer"), tags$th(class = "n", "p, corrected"),
                  tags$th("most at"))
  tags$section(tags$h2("In short"), page_table(head, rows), tags$p(
    class = "note",
    sprintf("An answer is \"outside\" where p, corrected for six questions (Holm), is at most %g.",
            x$alpha),
    "By construction this also happens in up to that share of people of the norm."
  ))
}

assessment_findings <- function(x) {
  tags <- htmltools::tags
  if (!nrow(x$findings)) return(NULL)
  rows <- lapply(seq_len(nrow(x$findings)), function(i) {
    one <- x$findings[i, ]
    tags$tr(tags$td(one$point), tags$td(if (one$height > 0) "outward" else "inward"),
            tags$td(class = "n", sprintf("%.1f \u00b1 %.1f", abs(one$height), 1.96 * one$sd)),
            tags$td(class = "n", sprintf("%.0f", 2 * one$radius)),
            tags$td(class = "n", format(signif(abs(one$volume), 2), trim = TRUE)),
            tags$td(class = "n", sprintf("%.1f", one$z)))
  })
  unit <- x$unit
  head <- tags$tr(tags$th("place"), tags$th("direction"),
                  tags$th(class = "n", sprintf("height, %s", unit)),
                  tags$th(class = "n", sprintf("width searched, %s", unit)),
                  tags$th(class = "n", sprintf("volume, %s\u00b3", unit)),
                  tags$th(class = "n", "z"))
  tags$section(tags$h2("Places that do not fit the rest of the face"), page_table(head, rows),
               tags$p(class = "note", "Height at the centre, with its 95 % interval: what the rest",
                      "of the face cannot tell about a normal face there.",
                      if (!isTRUE(x$finished)) "After these the rest still differs."))
}

#' Measurements, in the order of the norm; components apart
#' @noRd
assessment_values <- function(x) {
  tags <- htmltools::tags
  component <- startsWith(x$values$name, "component ")
  shown <- sum(!component & !is.na(x$values$z))
  block <- function(values) page_table(value_head(), lapply(seq_len(nrow(values)), function(i) {
    value_row(values[i, ])
  }), "values")
  tags$section(
    tags$h2("Measurements"), block(x$values[!component, ]),
    tags$p(class = "note", "Centile: share of people of this age and sex with a smaller value.",
           "z: the same as standard deviations from the mean. The two errors are standard",
           "errors of z, of this scan and of the norm.",
           sprintf("Of %d values some %.0f lie beyond 2 standard deviations in any typical face.",
                   shown, max(1, 0.05 * shown))),
    if (any(component)) tags$details(tags$summary("Components of shape"),
                                     block(x$values[component, ]))
  )
}

value_head <- function() {
  tags <- htmltools::tags
  tags$tr(tags$th("measurement"), lapply(
    c("value", "expected", "centile", "z", "error: scan", "error: norm"), tags$th, class = "n"
  ))
}

value_row <- function(one) {
  tags <- htmltools::tags
  unit <- sub("\\^2", "\u00b2", sub("\\^3", "\u00b3", sub("degrees", "\u00b0", one$unit)))
  number <- function(x, digits = 4) if (is.na(x)) "" else format(signif(x, digits), trim = TRUE)
  cell <- function(text) tags$td(class = "n", text)
  if (!is.na(one$reason)) {
    return(tags$tr(tags$td(one$name), tags$td(colspan = 6, paste("not assessed:", one$reason))))
  }
  tags$tr(tags$td(one$name), cell(paste(number(one$value), if (unit != "1") unit)),
          cell(number(one$expected)), cell(centile_words(one$centile)),
          cell(sprintf("%+.2f", one$z)),
          cell(if (is.na(one$se_scan)) "unknown" else sprintf("%.2f", one$se_scan)),
          cell(sprintf("%.2f", one$se_norm)))
}

assessment_unknown <- function(x) {
  tags <- htmltools::tags
  lost <- sum(!x$points$assessed)
  none <- x$verdicts$family[x$verdicts$verdict == "not assessable"]
  said <- c(
    if (lost) sprintf("%s of %d missing in the scan (grey in the pictures).",
                      amount(lost, "surface point"), nrow(x$points)),
    if (length(none)) paste0(family_words[none], ": not in this norm, or its points are missing.")
  )
  if (!length(said)) return(NULL)
  tags$section(tags$h2("What could not be assessed"), tags$ul(lapply(said, tags$li)))
}

assessment_limits <- function(x) {
  tags <- htmltools::tags
  said <- c(
    paste("This page compares one scan with a norm. It gives no diagnosis and proposes no",
          "treatment."),
    paste("The norm describes the people and the scanner that it was made of. For people of",
          "another population, or another scanner, it may be wrong."),
    paste("Small or flat changes are missed. How often is only known from simulated faces; on real",
          "faces more is missed."),
    paste("The pictures compare places in the direction that the surface faces. How far places lie",
          "along the surface is not judged, as it depends on how points were placed."),
    paste("An open mouth, an expression, hair, a plaster or a bad scan look like differences of",
          "shape."),
    paste("The shape expected at a place is what people with such surroundings have there. It is",
          "no picture of what this face was, nor a plan for an operation.")
  )
  tags$section(tags$h2("Limits"), tags$ul(lapply(said, tags$li)))
}

assessment_norm <- function(norms) {
  known <- intersect(c("name", "population", "device", "licence", "citation", "package"),
                     names(norms))
  label <- c(name = "Norm", population = "People", device = "Scanner", licence = "Licence",
             citation = "Cite as", package = "Fitted with crestline")
  if (!length(known)) return(htmltools::tags$p("The norm's makers say nothing of it."))
  fact_list(stats::setNames(vapply(norms[known], as.character, ""), label[known]))
}
