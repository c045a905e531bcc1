# What the pages for a clinic share: numbers in words.

p_words <- function(p) if (is.na(p)) "" else if (p < 0.001) "< 0.001" else sprintf("%.3f", p)

centile_words <- function(x) {
  if (x < 0.1) "< 0.1" else if (x > 99.9) "> 99.9" else if (x < 1 || x > 99) sprintf("%.1f", x) else
    sprintf("%.0f", x)
}
