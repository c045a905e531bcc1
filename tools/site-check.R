# Every page of a built site: does it open in headless Chromium without a word in its console, does
# every link within the site arrive, and does nothing of a page come from elsewhere? Rscript
# tools/site-check.R FOLDER Links that leave the site are counted by host, not followed.
site <- normalizePath(commandArgs(TRUE)[1])
browser <- Sys.which("chromium")

if (!nzchar(browser)) stop("no Chromium here: install it (Debian: apt-get install chromium)")

pages <- list.files(site, "[.]html$", recursive = TRUE)

# What the console says, from Chromium's log. WebGL is drawn in software.
console <- function(page) {
  log <- tempfile()
  system2(browser,
          c("--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--enable-logging=stderr", "--virtual-time-budget=4000", "--dump-dom",
                     shQuote(paste0("file://", utils::URLencode(file.path(site, page))))),
          stdout = tempfile(), stderr = log, timeout = 60)
  said <- grep("CONSOLE", readLines(log, warn = FALSE), value = TRUE, fixed = TRUE)
  sub(".*CONSOLE[^\"]*", "", said)
}

attribute <- function(html,
                      name) xml2::xml_attr(xml2::xml_find_all(html, sprintf("//*[@%s]", name)),
                                           name)

content <- lapply(stats::setNames(pages, pages), function(page) {
  html <- xml2::read_html(file.path(site, page))
  list(links = unique(attribute(html, "href")),
       sources = unique(c(attribute(html, "src"), xml2::xml_attr(
    xml2::xml_find_all(html, "//link[@rel='stylesheet']"), "href"))),
    ids = c(attribute(html, "id"), attribute(html, "name")))
})

is_outside <- function(link) grepl("^(https?|mailto|data|javascript):", link)

# Links of a page that lead nowhere: a file that is not there, or a place that a page does not have.
dead_links <- function(page) {
  inside <- Filter(function(link) !is_outside(link), c(content[[page]]$links,
                   content[[page]]$sources))
  arrives <- vapply(inside, function(link) {
    parts <- strsplit(paste0(link, "#"), "#", fixed = TRUE)[[1]]
    path <- sub("[?].*", "", utils::URLdecode(parts[1]))
    target <- if (path == "") page else file.path(dirname(page), path)
    full <- normalizePath(file.path(site, target), mustWork = FALSE)
    if (dir.exists(full)) full <- file.path(full, "index.html")
    if (!file.exists(full)) return(FALSE)
    known <- content[[substring(full, nchar(site) + 2)]]
    length(parts) < 2 || parts[2] == "" || is.null(known) ||
      utils::URLdecode(parts[2]) %in% known$ids
  }, logical(1))
  inside[!arrives]
}

faults <- function(label, found) {
  found <- Filter(length, found)
  for (page in names(found)) cat(sprintf("%s, %s: %s\n", page, label, found[[page]]), sep = "")
  sum(lengths(found))
}

by_page <- function(look) lapply(stats::setNames(pages, pages), look)
said <- by_page(console)
counts <- c(
  "words in consoles" = faults("console", said),
  "dead links" = faults("dead link", by_page(dead_links)),
  "parts from elsewhere" = faults("from elsewhere", by_page(function(page) {
    Filter(function(link) grepl("^https?:", link), content[[page]]$sources)
  }))
)
outside <- unlist(lapply(content, function(page) Filter(is_outside, page$links)))
cat("\nLinks that leave the site, not followed:\n")
print(sort(table(sub("^([a-z]+:(//[^/]*)?).*", "\\1", outside)), decreasing = TRUE))
cat(sprintf("\n%d pages; %s\n", length(pages), paste(counts, names(counts), collapse = ", ")))
quit(status = as.integer(any(counts > 0)))
