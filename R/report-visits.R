# Two visits of one person as a page that prints on A4.

#' @exportS3Method
page_of.visit_comparison <- function(x, file, title) {
  if (is.null(title)) title <- paste(x$ids[2], "compared with", x$ids[1])
  tags <- htmltools::tags
  page <- page_document(
    title, visit_maps(x), visit_parts(x), visit_measurements(x), visit_limits(x),
    lead = list(visit_facts(x),
                tags$p(class = "warn", "No diagnosis. A change that is real need not matter, and",
                       "one that is smaller than the errors of both scans is not seen.")),
    provenance = x$provenance, class = "patient"
  )
  save_page(page, file, TRUE)
}

visit_facts <- function(x) {
  surface <- x$points[x$points$level == "surface", ]
  known <- !is.na(surface$score)
  detectable <- stats::median(surface$detectable[known])
  how <- if (isTRUE(x$robust)) "on all points; those that changed have less weight" else
    "on the parts that were named as unchanged"
  fact_list(c(
    `First visit` = x$ids[1], `Second visit` = x$ids[2],
    `Points that changed` = sprintf("%d of %d", sum(surface$called), sum(known)),
    `Smallest detectable change` = sprintf("%.2g %s at one point (median)", detectable, x$unit),
    `Laid on each other` = paste0(how, ", without scaling"),
    Growth = if (length(x$growth)) x$growth else "not subtracted"
  ))
}

visit_maps <- function(x) {
  tags <- htmltools::tags
  points <- x$points[x$points$level == "surface", ]
  if (!length(x$triangles)) return(NULL)
  xyz <- as.matrix(points[c("x", "y", "z")])
  span <- signif(max(abs(points$change), 1e-12, na.rm = TRUE), 1)
  card <- function(title, text, ...) {
    tags$figure(face_image(x, xyz, ..., alt = title), tags$figcaption(tags$b(title), text))
  }
  lost <- sum(is.na(points$change))
  tags$section(tags$h2("Pictures"), if (lost) tags$p(class = "warn", sprintf(
    "%d of %s of the surface are missing at one of the visits, and not in the pictures.", lost,
    amount(nrow(points), "point"))), tags$div(
    class = "maps", card("First visit", " at the points that were measured."),
    card("Change along the surface's normal", sprintf(" in %s.", x$unit), points$change, span,
         ring = points$called),
    card("Change over its standard error", " with a sign where it is real.", points$score, 6,
         x$limit)
  ), sign_legend(span, x$unit), tags$p(
    class = "note", "The scale is that of the second picture; in the third, full colours are 6",
    sprintf("standard errors. Outlined: beyond the limit %.2f,", x$limit),
    sprintf("which the whole surface keeps with probability %g if nothing changed.", 1 - x$alpha)
  ))
}

#' @param most Number of parts that are shown at first.
#' @noRd
visit_parts <- function(x, most = 12) {
  tags <- htmltools::tags
  parts <- x$parts[!is.na(x$parts$change), ]
  parts <- parts[order(!parts$called, -abs(parts$change / parts$se)), ]
  rows <- lapply(seq_len(nrow(parts)), function(i) {
    one <- parts[i, ]
    tags$tr(tags$td(one$part), tags$td(if (one$level == "surface") "patch" else "curve"),
            change_cells(one$change, one$se, one$detectable, one$p_holm, one$called))
  })
  head <- tags$tr(tags$th("part"), tags$th("kind"), change_heads(x$unit))
  first <- seq_len(max(most, sum(parts$called)))
  rest <- rows[-first]
  tags$section(tags$h2("Curves and patches"), page_table(head, utils::head(rows, length(first))),
               tags$p(class = "note", "Mean change along the normal, outward positive."),
               if (length(rest)) tags$details(tags$summary("The others"), page_table(head, rest)))
}

visit_measurements <- function(x) {
  tags <- htmltools::tags
  own <- x$measurements[!is.na(x$measurements$change), ]
  if (!NROW(own)) return(NULL)
  rows <- lapply(seq_len(nrow(own)), function(i) {
    one <- own[i, ]
    tags$tr(tags$td(one$measurement), tags$td(class = "n", format(signif(one$before, 4))),
            tags$td(class = "n", format(signif(one$after, 4))),
            change_cells(one$change, one$se, one$detectable, one$p_holm,
                         isTRUE(one$p_holm <= x$alpha)))
  })
  head <- tags$tr(tags$th("measurement"), tags$th(class = "n", "before"),
                  tags$th(class = "n", "after"), change_heads(NULL))
  tags$section(tags$h2("Measurements"), page_table(head, rows),
               tags$p(class = "note", sprintf("Lengths in %s, angles in degrees.", x$unit)))
}

change_heads <- function(unit) {
  lapply(c(paste(c("change", unit), collapse = ", "), "error", "detectable from", "p, corrected",
           "answer"), htmltools::tags$th, class = "n")
}

change_cells <- function(change, se, detectable, p, called) {
  tags <- htmltools::tags
  number <- function(x) if (is.na(x)) "unknown" else format(signif(x, 2), trim = TRUE)
  lapply(list(sprintf("%+.2g", change), number(se), number(detectable), p_words(p),
              if (is.na(p)) "could not be assessed" else if (called) tags$b("changed") else "no"),
         function(text) tags$td(class = "n", text))
}

visit_limits <- function(x) {
  tags <- htmltools::tags
  said <- c(
    "This page compares two scans of one person. It gives no diagnosis.",
    "Growth, weight, expression and posture change a face as a treatment does.",
    paste("The errors are those that were given. Errors that both scans share, such as one wrong",
          "landmark, are not in them."),
    if (length(x$growth)) {
      "One person's growth differs from the norm's. By how much is not known, nor in the errors."
    } else "Growth between the visits was not subtracted."
  )
  tags$section(tags$h2("Limits"), tags$ul(lapply(said, tags$li)))
}
