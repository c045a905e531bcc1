# Growth charts as drawings of a page: centile curves by age, and one person's value with its bar.

#' Size, and the measurements that are most unusual
#' @param most Number of charts.
#' @noRd
assessment_charts <- function(x, most = 4) {
  tags <- htmltools::tags
  values <- x$values[x$values$name %in% x$chart$name & !is.na(x$values$z), ]
  first <- values$name == "size"
  values <- values[order(!first, -abs(values$z)), ]
  chosen <- utils::head(values, most)
  figures <- lapply(seq_len(nrow(chosen)), function(i) {
    one <- chosen[i, ]
    unit <- if (one$unit == "1") "" else paste0("(", sub("\\^(.)", "<sup>\\1</sup>", one$unit), ")")
    tags$figure(growth_drawing(x$chart[x$chart$name == one$name, ], x$age, one),
                tags$figcaption(tags$b(one$name), htmltools::HTML(paste0(unit, ":")),
                                sprintf("centile %s", centile_words(one$centile))))
  })
  tags$section(
    tags$h2("Growth charts"), tags$div(class = "charts", figures),
    tags$p(class = "note",
           sprintf("Curves: centiles 3, 15, 50, 85, 97%s by age in years. Point and bar: this",
                   if (x$sex == "all") "" else " of this sex"),
           "person, and the 95 % interval of the scan's error.",
           if (nrow(values) > most) "Shown: size and the measurements that are most unusual.")
  )
}

#' @param chart Rows of one name of [growth_chart()].
#' @param one Row of the values.
#' @param room Share of the range that stays free above and below, so that no bar seems cut.
#' @noRd
growth_drawing <- function(chart, age, one, size = c(360, 266), margin = c(44, 42, 34, 8),
                           room = 0.03) {
  shown <- c(chart$value, one$value, one$lower, one$upper)
  y_range <- grDevices::extendrange(shown[!is.na(shown)], f = room)
  x_range <- range(chart$age)
  x <- function(v) margin[1] + (v - x_range[1]) / diff(x_range) * (size[1] - margin[1] - margin[3])
  y <- function(v) {
    size[2] - margin[2] - (v - y_range[1]) / diff(y_range) * (size[2] - margin[2] - margin[4])
  }
  curves <- lapply(split(chart, chart$centile), chart_curve, x, y)
  bar <- if (!is.na(one$lower)) {
    sprintf("<path d=\"M%.1f %.1fV%.1f\" stroke=\"#000\" stroke-width=\"2\"/>", x(age),
            y(one$lower), y(one$upper))
  }
  point <- sprintf("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\"/>", x(age), y(one$value))
  inside <- function(at, range) at[at >= range[1] & at <= range[2]]
  ages <- inside(pretty(x_range, 6), x_range)
  values <- inside(pretty(y_range, 5), y_range)
  bottom <- size[2] - margin[2]
  chart_axes <- paste(c(
    sprintf(paste0("<path d=\"M%g %gH%g\" stroke=\"#ddd\"/>",
                   "<text x=\"%g\" y=\"%g\" text-anchor=\"end\">%s"), margin[1],
            y(values), size[1] - margin[3], margin[1] - 5, y(values) + 4,
            paste0(format(values, trim = TRUE, big.mark = ","), "</text>")),
    sprintf(paste0("<path d=\"M%g %gv4\" stroke=\"#444\"/>",
                   "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">%s"), x(ages),
            bottom, x(ages), bottom + 17, paste0(ages, "</text>")),
    sprintf("<path d=\"M%g %gV%gH%g\" fill=\"none\" stroke=\"#444\"/>", margin[1], margin[4],
            bottom, size[1] - margin[3]),
    sprintf("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">age, years</text>",
            (margin[1] + size[1] - margin[3]) / 2, bottom + 34)
  ), collapse = "")
  htmltools::HTML(paste0(
    sprintf("<svg viewBox=\"0 0 %g %g\" role=\"img\" aria-label=\"growth chart\">", size[1],
            size[2]),
    chart_axes, paste(unlist(curves), collapse = ""), bar,
    point, "</svg>"
  ))
}

#' One centile curve with its number at the end
#' @noRd
chart_curve <- function(own, x, y) {
  own <- own[!is.na(own$value), ]
  if (!nrow(own)) return("")
  style <- switch(as.character(own$centile[1]), "50" = "stroke-width=\"2\"",
                  "15" = , "85" = "stroke-dasharray=\"5 3\"", "")
  last <- nrow(own)
  sprintf(paste0("<path d=\"M%s\" fill=\"none\" stroke=\"#444\" %s/>",
                 "<text x=\"%.1f\" y=\"%.1f\">%g</text>"),
          paste(sprintf("%.1f %.1f", x(own$age), y(own$value)), collapse = "L"), style,
          x(own$age[last]) + 4, y(own$value[last]) + 4, own$centile[1])
}
