# Two visits of one person as a page that prints on A4.

#' @exportS3Method
page_of.visit_comparison <- function(x, file, title) {
  if (is.null(title)) title <- visit_title(x$ids)
  tags <- htmltools::tags
  page <- page_document(
    title, visit_answers(x), visit_maps(x), visit_parts(x), visit_measurements(x), visit_limits(x),
    lead = list(visit_facts(x),
                tags$p(class = "warn", "No diagnosis. A change that is real need not matter, and",
                       "one that is smaller than the errors of both scans is not seen.")),
    provenance = x$provenance, class = "patient"
  )
  save_page(page, file, TRUE)
}

visit_title <- function(ids) {
  if (ids[1] == ids[2]) paste0(ids[1], ": two visits") else paste(ids[2], "compared with", ids[1])
}

visit_facts <- function(x) {
  how <- if (isTRUE(x$robust)) "on all points; those that changed have less weight" else
    "on the parts that were named as unchanged"
  fact_list(c(
    `First visit` = x$ids[1], `Second visit` = x$ids[2],
    `Laid on each other` = paste0(how, ", without scaling"),
    Growth = if (length(x$growth)) x$growth else "not subtracted",
    `Error of one change` = with_visit_unit(stats::median(surface_of(x)$se, na.rm = TRUE), x)
  ))
}

surface_of <- function(x) x$points[x$points$level == "surface", ]

#' A length at one point (median) with its unit
#' @noRd
with_visit_unit <- function(length, x) {
  if (is.na(length)) "not known" else sprintf("%.2g %s at a point (median)", length, x$unit)
}

#' Whether something changed, where, by how much, and what could have been missed
#' @noRd
visit_answers <- function(x) {
  tags <- htmltools::tags
  rows <- list(visit_answer("Each point of the surface", sum(surface_of(x)$called),
                            sum(!is.na(surface_of(x)$score)), largest_change(x)),
               visit_answer("Curves and patches as wholes", sum(x$parts$called),
                            sum(!is.na(x$parts$p_holm)), most_changed(x$parts, x$parts$part)))
  own <- x$measurements
  if (NROW(own)) {
    own$called <- !is.na(own$p_holm) & own$p_holm <= x$alpha
    rows <- c(rows, list(visit_answer("Measurements", sum(own$called), sum(!is.na(own$p_holm)),
                                      most_changed(own, own$measurement))))
  }
  head <- tags$tr(lapply(c("question", "answer", "most at"), tags$th))
  tags$section(tags$h2("In short"), page_table(head, rows, "answers"), unseen_warning(x), tags$p(
    class = "note",
    sprintf("Of each question, nothing is called with probability %g if nothing changed and the",
            1 - x$alpha),
    "errors are right.", missed_words(x), "Left and right are the person's own."
  ))
}

#' @param place Words on the largest change.
#' @noRd
visit_answer <- function(question, called, known, place) {
  tags <- htmltools::tags
  answer <- if (!known) "could not be assessed" else if (called) {
    tags$b(sprintf("%d of %d changed", called, known))
  } else sprintf("no change shown (%d compared)", known)
  tags$tr(tags$td(question), tags$td(answer), tags$td(if (called) place))
}

largest_change <- function(x) {
  surface <- surface_of(x)
  surface <- surface[surface$called, ]
  best <- surface[which.max(abs(surface$change)), ]
  sprintf("%s, %s by %s %s", best$part, outward_words(best$change),
          height_words(data.frame(height = best$change, sd = best$se)), x$unit)
}

most_changed <- function(rows, name) {
  called <- which(rows$called)
  called <- called[order(-abs(rows$change / rows$se)[called])]
  more <- length(called) - 3
  paste(c(utils::head(name[called], 3), if (more > 0) sprintf("%d more", more)), collapse = ", ")
}

unseen_warning <- function(x) {
  surface <- surface_of(x)
  lost <- is.na(surface$score)
  if (!any(lost)) return(NULL)
  missing <- sum(is.na(surface$change))
  why <- c(if (missing) sprintf("%d missing at one of the visits", missing),
           if (missing < sum(lost)) sprintf("%d without an error of measurement",
                                            sum(lost) - missing))
  htmltools::tags$p(
    class = "warn",
    sprintf("Not all of the face was compared: %s of %s, in %s.", paste(why, collapse = " and "),
            amount(nrow(surface), "point"), lost_words(surface$part, lost)),
    "A change there would not be seen. If the place matters, scan again."
  )
}

missed_words <- function(x) {
  known <- surface_of(x)
  known <- known[!is.na(known$score), ]
  if (!nrow(known) || is.na(x$limit)) return(NULL)
  sprintf(paste("A point is called from a change of some %.2g %s; at a point that was chosen",
                "beforehand, %.2g %s are detectable. Smaller changes are missed."),
          stats::median(called_from(x$limit, known)), x$unit, stats::median(known$detectable),
          x$unit)
}

#' @param full Score from which on the colours are full, in both maps.
#' @noRd
visit_maps <- function(x, full = 6) {
  tags <- htmltools::tags
  points <- surface_of(x)
  if (!length(x$triangles) || all(is.na(points$change))) return(NULL)
  xyz <- as.matrix(points[c("x", "y", "z")])
  # Errors alone must not fill the scale
  least <- full * stats::median(points$se, na.rm = TRUE)
  span <- signif(max(abs(points$change), least, 1e-12, na.rm = TRUE), 1)
  known <- any(!is.na(points$score))
  card <- function(title, text, ...) {
    tags$figure(face_image(x, xyz, ..., alt = title), tags$figcaption(tags$b(title), text))
  }
  tags$section(tags$h2("Pictures"), tags$div(
    class = "maps", card("First visit", " at the points that were measured."),
    card("Change along the surface's normal", sprintf(" in %s.", x$unit), points$change, span,
         ring = points$called),
    if (known) card("Change over its standard error", " with a sign where it is real.",
                    points$score, full, x$limit)
  ), sign_legend(span, x$unit), tags$p(class = "note", if (known) paste(
    sprintf("The scale is that of the second picture; in the third, full colours are %g", full),
    sprintf("standard errors. Outlined: beyond the limit %.2f, which the whole", x$limit),
    sprintf("surface keeps with probability %g if nothing changed.", 1 - x$alpha)
  ) else "No error is known, so that nothing can be called: give compare_visits() an `error`.",
  "Grey: missing at the second visit, or without an error. Below each: from the right and from",
  "the left."), grey_print())
}

#' @param most Number of parts that are shown at first.
#' @noRd
visit_parts <- function(x, most = 12) {
  tags <- htmltools::tags
  parts <- x$parts[!is.na(x$parts$change), ]
  parts <- parts[order(!parts$called, -abs(parts$change / parts$se)), ]
  digits <- change_decimals(parts$se, parts$change)
  rows <- lapply(seq_len(nrow(parts)), function(i) {
    one <- parts[i, ]
    tags$tr(tags$td(one$part), tags$td(if (one$level == "surface") "patch" else "curve"),
            change_cells(one, digits, one$called))
  })
  head <- tags$tr(tags$th("part"), tags$th("kind"), change_heads(x$unit))
  first <- seq_len(max(most, sum(parts$called)))
  rest <- rows[-first]
  tags$section(tags$h2("Curves and patches"), page_table(head, utils::head(rows, length(first))),
               tags$p(class = "note", "Mean change along the normal, outward positive.",
                      alone_words(nrow(parts), "part")),
               if (length(rest)) tags$details(tags$summary("The others"), page_table(head, rest)))
}

#' Why a change beyond "detectable" need not be called
#' @noRd
alone_words <- function(n, what) {
  sprintf(paste("Detectable: of one %s that was chosen beforehand. p is corrected for all %d, so",
                "that more is needed for an answer."), what, n)
}

visit_measurements <- function(x) {
  tags <- htmltools::tags
  own <- x$measurements[!is.na(x$measurements$change), ]
  if (!NROW(own)) return(NULL)
  grows <- length(x$growth) > 0
  digits <- unsplit(lapply(split(own, own$unit), function(rows) {
    rep(change_decimals(rows$se, rows$change), nrow(rows))
  }), own$unit)
  rows <- lapply(seq_len(nrow(own)), function(i) {
    one <- own[i, ]
    cell <- function(value, form) {
      tags$td(class = "n", with_minus(sprintf(sprintf(form, digits[i]), value)))
    }
    tags$tr(tags$td(one$measurement), cell(one$before, "%%.%df"),
            tags$td(class = "n", paste0(sprintf("%.*f", digits[i], one$after), unit_words(one))),
            if (grows) cell(one$growth, "%%+.%df"),
            change_cells(one, digits[i], isTRUE(one$p_holm <= x$alpha)))
  })
  head <- tags$tr(tags$th("measurement"), lapply(c("before", "after", if (grows) "growth"),
                                                 tags$th, class = "n"), change_heads(NULL))
  lost <- sum(is.na(x$measurements$change))
  tags$section(tags$h2("Measurements"), page_table(head, rows), tags$p(
    class = "note", if (grows) "Growth is what the norm expects; change is without it.",
    alone_words(nrow(own), "measurement"),
    if (lost) sprintf("%s could not be compared.", amount(lost, "measurement"))
  ))
}

unit_words <- function(one) {
  unit <- sub("\\^2", "\u00b2", sub("\\^3", "\u00b3", one$unit))
  if (unit == "1") "" else if (unit == "degrees") "\u00b0" else paste0(" ", unit)
}

change_heads <- function(unit) {
  lapply(c(paste(c("change", unit), collapse = ", "), "error", "detectable", "p, corrected",
           "answer"), htmltools::tags$th, class = "n")
}

#' Decimals that show two digits of the usual error; of the change where no error is known
#' @noRd
change_decimals <- function(se, change) {
  usual <- stats::median(se[se > 0], na.rm = TRUE)
  if (is.na(usual)) usual <- stats::median(abs(change[change != 0]), na.rm = TRUE)
  if (is.na(usual)) 2 else max(0, 1 - floor(log10(usual)))
}

#' @param one Row with `change`, `se`, `detectable`, `p_holm`.
#' @noRd
change_cells <- function(one, digits, called) {
  tags <- htmltools::tags
  number <- function(x) if (is.na(x)) "unknown" else sprintf("%.*f", digits, x)
  answer <- if (is.na(one$p_holm)) "could not be assessed" else if (called) tags$b("changed") else
    "no change shown"
  lapply(list(with_minus(sprintf("%+.*f", digits, one$change)), number(one$se),
              number(one$detectable), p_words(one$p_holm), answer),
         function(text) tags$td(class = "n", text))
}

visit_limits <- function(x) {
  tags <- htmltools::tags
  said <- c(
    "This page compares two scans of one person. It gives no diagnosis.",
    "Growth, weight, expression and posture change a face as a treatment does.",
    paste("The errors are those that were given. Errors that both scans share, such as one wrong",
          "landmark, are not in them. Errors from a few repeated scans are uncertain themselves:",
          "changes are then called more often."),
    if (length(x$growth)) {
      "One person's growth differs from the norm's. By how much is not known, nor in the errors."
    } else "Growth between the visits was not subtracted."
  )
  tags$section(tags$h2("Limits"), tags$ul(lapply(said, tags$li)))
}
