# Builds the site with pkgdown into a folder, without a network, from the installed crestline:
# Rscript tools/site.R FOLDER Formulas become MathML (pandoc), where pkgdown would fetch MathJax.
options(pkgdown.internet = FALSE, rgl.useNULL = TRUE)

# Where a package that is spoken of is not installed its address is asked of CRAN: none here.
assignInNamespace("CRAN_urls", function() data.frame(Package = character(), URL = character()),
                  "downlit")

site <- normalizePath(commandArgs(TRUE)[1], mustWork = FALSE)

# One formula a paragraph through pandoc.
mathml <- function(formulas, sign) {
  files <- tempfile(fileext = c(".md", ".html"))
  writeLines(paste0(sign, trimws(formulas), sign, "\n"), files[1], useBytes = TRUE)
  rmarkdown::pandoc_convert(files[1], "html", "markdown", files[2], options = "--mathml")
  html <- paste(readLines(files[2], encoding = "UTF-8"), collapse = "\n")
  found <- regmatches(html, gregexpr("(?s)<math.*?</math>", html, perl = TRUE))[[1]]
  stopifnot(length(found) == length(formulas))
  found
}

# In articles formulas stand in \( \) and \[ \] within spans of class math, in the reference in \(
# \) or $$ $$ of the text.
formula_marks <- list(
  list(place = '(?s)<span class="math inline">\\\\\\((.+?)\\\\\\)</span>', sign = "$"),
  list(place = '(?s)<span class="math display">\\\\\\[(.+?)\\\\\\]</span>', sign = "$$"),
  list(place = "(?s)(?<!\\\\)\\\\\\((.+?)\\\\\\)", sign = "$"),
  list(place = "(?s)\\$\\$(.+?)\\$\\$", sign = "$$")
)

replace_formulas <- function(file) {
  html <- paste(readLines(file, encoding = "UTF-8"), collapse = "\n")
  count <- 0L
  for (mark in formula_marks) {
    places <- gregexpr(mark$place, html, perl = TRUE)
    found <- regmatches(html, places)[[1]]
    if (length(found) == 0) next
    text <- vapply(sub(mark$place, "\\1", found, perl = TRUE), function(one) {
      xml2::xml_text(xml2::read_html(paste0("<p>", one, "</p>"), encoding = "UTF-8"))
    }, "")
    regmatches(html, places) <- list(mathml(text, mark$sign))
    count <- count + length(found)
  }
  if (count > 0) writeLines(html, file, useBytes = TRUE)
  count
}

pkgdown::build_site(".", override = list(destination = site), preview = FALSE, install = FALSE,
                    new_process = FALSE,
                    lazy = FALSE)
pages <- list.files(site, "[.]html$", recursive = TRUE, full.names = TRUE)
formulas <- vapply(pages, replace_formulas, 0L)
cat(sprintf("%d pages, %d formulas\n", length(pages), sum(formulas)))
