# One face against its norms as a page that prints on A4: pictures, table, growth charts, limits.

#' @exportS3Method
page_of.assessment <- function(x, file, title) {
  if (is.null(title)) title <- paste(x$id, "against the norms of its", norm_of(x))
  tags <- htmltools::tags
  seen <- x
  seen$points[!x$points$assessed, c("x", "y", "z")] <- NA
  page <- page_document(
    title, assessment_verdicts(x), assessment_maps(seen), assessment_findings(x),
    assessment_charts(x), assessment_values(x), assessment_unknown(x), assessment_limits(x),
    tags$section(tags$h2("The norm"), assessment_norm(x$norms)),
    lead = list(assessment_facts(x),
                tags$p(class = "warn", "No diagnosis. What is rare in the norm's sample is not",
                       "therefore ill; see the limits below.")),
    provenance = x$provenance, class = "patient"
  )
  save_page(page, file, TRUE)
}

assessment_facts <- function(x) {
  who <- paste0(if (x$sex != "all") paste0(x$sex, ", "), format(signif(x$age, 4)), " years")
  few <- if (x$effective < x$norms$few) {
    sprintf(" (few: the norm's own error of z is %.1f, median)", stats::median(x$points$se_norm,
                                                                              na.rm = TRUE))
  }
  fact_list(c(Person = x$id, stats::setNames(who, if (x$sex == "all") "Age" else "Sex and age"),
              Norm = sprintf("%s%s", if (length(x$norms$name)) paste0(x$norms$name, ", ") else "",
                             amount(x$norms$n, "face")),
              `Faces that count at this age` = paste0(sprintf("%.0f", x$effective), few),
              `Error of the scan` = scan_error_words(x)))
}

#' How exact the scan is, and whether it is judged on a wider scale
#' @noRd
scan_error_words <- function(x) {
  wider <- if (wider_scale(x)) {
    "; larger than the norm's, so that all answers allow for it"
  }
  if (x$errors == "given") {
    return(sprintf("%.2g %s at a point (median)%s", stats::median(x$points$se, na.rm = TRUE),
                   x$unit, if (is.null(wider)) "" else wider))
  }
  sprintf("not known; by its roughness %.2g of the norm's variance%s", x$rough,
          if (is.null(wider)) "" else wider)
}

family_words <- c(
  size = "Size of the face", measurements = "Measurements", components = "Shape as a whole",
  map = "Each place against the norm", scan = "Does each place fit the rest of the face?",
  asymmetry = "Asymmetry of left and right"
)

assessment_verdicts <- function(x) {
  tags <- htmltools::tags
  words <- list(real = tags$b("differs by more than chance"),
                `not distinguishable` = "no difference shown",
                `not assessable` = "could not be assessed")
  rows <- lapply(seq_len(nrow(x$verdicts)), function(i) {
    one <- x$verdicts[i, ]
    tags$tr(tags$td(family_words[[one$family]]), tags$td(words[[one$verdict]]),
            tags$td(if (one$verdict == "real") verdict_place(one, x)),
            tags$td(class = "n p", p_words(one$p_holm)))
  })
  head <- tags$tr(tags$th("question"), tags$th("answer"), tags$th("most at"),
                  tags$th(class = "n", "p, corrected"))
  answers <- page_table(head, rows, "answers")
  tags$section(tags$h2("In short"), answers, unassessed_warning(x), tags$p(
    class = "note",
    sprintf("A face \"differs\" where p, corrected for %s (Holm), is at most %g. By",
            amount(sum(!is.na(x$verdicts$p)), "question"), x$alpha),
    "construction this also happens in up to that share of people of the norm. \"No difference",
    "shown\" does not mean that there is none. Left and right are the person's own."
  ))
}

#' Where a family differs most, in which direction, and by how much if it is known
#' @param one Row of the verdicts.
#' @noRd
verdict_place <- function(one, x) {
  at <- match(one$where, x$points$point)
  part <- x$points$part[at]
  if (one$family == "measurements") {
    centile <- x$values$centile[match(one$where, x$values$name)]
    return(sprintf("%s, centile %s", one$where, centile_words(centile)))
  }
  switch(
    one$family, size = paste("centile", centile_words(x$values$centile[1])), components = "",
    map = paste(part, outward_words(x$points$z_map[at]), sep = ", "),
    asymmetry = sprintf("%s, further %s against the other side than usual", part,
                        outward_words(x$points$z_asymmetry[at])),
    scan = if (nrow(x$findings)) paste(c(finding_place(x$findings[1, ], x), if (
      nrow(x$findings) > 1) sprintf("and %d more", nrow(x$findings) - 1)), collapse = " ") else
        paste0(one$where, "; not replaced, as too little of the face is left")
  )
}

outward_words <- function(x) if (x > 0) "outward" else "inward"

finding_place <- function(one, x) {
  sprintf("%s, %s by %s %s", x$points$part[match(one$point, x$points$point)],
          outward_words(one$height), height_words(one), x$unit)
}

#' The height of a finding with its 95 % interval; negative if it may be on the other side
#' @noRd
height_words <- function(one) {
  off <- abs(one$height)
  with_minus(sprintf("%.1f (%.1f to %.1f)", off, off - 1.96 * one$sd, off + 1.96 * one$sd))
}

with_minus <- function(text) gsub("-(?=[0-9])", "\u2212", text, perl = TRUE)

unassessed_warning <- function(x) {
  lost <- !x$points$assessed
  if (!any(lost)) return(NULL)
  htmltools::tags$p(
    class = "warn", sprintf("Not all of the face was assessed: %d of %s are missing, in %s.",
                            sum(lost), amount(length(lost), "surface point"),
                            lost_words(x$points$part, lost)),
    "The answers are of the rest."
  )
}

assessment_findings <- function(x) {
  tags <- htmltools::tags
  if (!nrow(x$findings)) return(NULL)
  rows <- lapply(seq_len(nrow(x$findings)), function(i) {
    one <- x$findings[i, ]
    place <- paste0(one$point, if (isTRUE(one$both)) " (both sides at once)")
    tags$tr(tags$td(place), tags$td(outward_words(one$height)),
            tags$td(class = "n", height_words(one)),
            tags$td(class = "n", sprintf("%.0f", 2 * one$radius)),
            tags$td(class = "n", format(signif(abs(one$volume), 2), trim = TRUE)),
            tags$td(class = "n", sprintf("%.1f", one$z)))
  })
  unit <- x$unit
  head <- tags$tr(tags$th("place (point)"), tags$th("direction"),
                  tags$th(class = "n", sprintf("height (95 %%), %s", unit)),
                  tags$th(class = "n", sprintf("width, some %s", unit)),
                  tags$th(class = "n", sprintf("volume, %s\u00b3", unit)),
                  tags$th(class = "n", "z"))
  tags$section(tags$h2("Places that do not fit the rest of the face"), page_table(head, rows),
               tags$p(class = "note", "Height: at the centre, from the surface that people with",
                      "such surroundings have there. The 95 % interval is how much they differ",
                      "among themselves. Width: of the few discs that were tried, the one that",
                      "fits best.",
                      if (!isTRUE(x$finished)) "After these the rest still differs."))
}

#' Measurements, in the order of the norm; components apart
#' @noRd
assessment_values <- function(x) {
  tags <- htmltools::tags
  component <- startsWith(x$values$name, "component ")
  shown <- sum(!component & !is.na(x$values$z))
  wider <- wider_scale(x)
  digits <- value_decimals(x$values)
  block <- function(own) page_table(value_head(wider), lapply(which(own), function(i) {
    value_row(x$values[i, ], digits[i], wider)
  }), "values")
  tags$section(
    tags$h2("Measurements"), block(!component),
    tags$p(class = "note", "Size: root of the summed squared distances of all points from their",
           sprintf("centre. Centile: share of people of this %s with a smaller value.", norm_of(x)),
           "z: the same as standard deviations from the mean, bold beyond 2. The two errors are",
           "standard errors of z, of this scan and of the norm.",
           if (wider) "The answers above use \"z, wider\", which allows for this scan's error.",
           sprintf("Of %d values some %.0f lie beyond 2 standard deviations in any typical face;",
                   shown, max(1, 0.05 * shown)),
           "the answer on measurements above takes their number into account."),
    if (any(component)) tags$details(tags$summary("Components of shape"), block(component))
  )
}

value_head <- function(wider) {
  tags <- htmltools::tags
  tags$tr(tags$th("measurement"), lapply(
    c("value", "expected", "centile", "z", if (wider) "z, wider", "error: scan", "error: norm"),
    tags$th, class = "n"
  ))
}

#' Decimals of values: as many as the error of the scan has, alike for one unit
#'
#' @param digits Of values without an error: significant digits.
#' @noRd
value_decimals <- function(values, digits = 4) {
  at <- function(x) pmax(0, -floor(log10(x)))
  se <- (values$upper - values$lower) / (2 * 1.96)
  kind <- ifelse(startsWith(values$name, "component "), "component", values$unit)
  each <- lapply(split(seq_len(nrow(values)), kind), function(rows) {
    known <- stats::median(se[rows], na.rm = TRUE)
    size <- stats::median(abs(values$value[rows]), na.rm = TRUE)
    found <- if (isTRUE(known > 0)) at(known) else if (isTRUE(size > 0)) {
      at(size / 10^(digits - 1))
    } else digits
    rep(found, length(rows))
  })
  unsplit(each, kind)
}

value_row <- function(one, digits, wider) {
  tags <- htmltools::tags
  unit <- sub("\\^2", "\u00b2", sub("\\^3", "\u00b3", sub("degrees", "\u00b0", one$unit)))
  number <- function(x, form) if (is.na(x)) "" else with_minus(sprintf(form, x))
  plain <- sprintf("%%.%df", digits)
  cell <- function(text) tags$td(class = "n", text)
  if (!is.na(one$reason)) {
    return(tags$tr(tags$td(one$name),
                   tags$td(colspan = 6 + wider, paste("not assessed:", one$reason))))
  }
  space <- if (unit == "\u00b0") "" else " "
  z <- number(one$z, "%+.2f")
  tags$tr(tags$td(one$name),
          cell(paste0(number(one$value, plain), if (unit != "1") paste0(space, unit))),
          cell(number(one$expected, plain)), cell(centile_words(one$centile)),
          cell(if (abs(one$z) > 2) tags$b(z) else z),
          if (wider) cell(number(one$z_widened, "%+.2f")), cell(small_words(one$se_scan)),
          cell(small_words(one$se_norm)))
}

small_words <- function(x) {
  if (is.na(x)) "unknown" else if (x < 0.005) "< 0.01" else sprintf("%.2f", x)
}

assessment_unknown <- function(x) {
  tags <- htmltools::tags
  lost <- !x$points$assessed
  none <- x$verdicts$family[x$verdicts$verdict == "not assessable"]
  values <- sum(!is.na(x$values$reason))
  said <- c(
    if (any(lost)) paste0(
      sprintf("%s of %d missing in the scan (holes in the pictures): %s. ",
              amount(sum(lost), "surface point"), length(lost), lost_words(x$points$part, lost)),
      "A difference there would not be seen. If the place matters, scan again."
    ),
    if (values) sprintf("%s: the reason is in the table.", amount(values, "measurement")),
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
    paste("Small or flat differences are missed. How often is only known from simulated faces; on",
          "real faces more is missed."),
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
