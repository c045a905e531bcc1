# A page for the browser: its style, its parts, and how it is written.

#' A page in the one style of the package's pages
#'
#' @param title Title of the page.
#' @param ... Its sections.
#' @param lead What stands below the title.
#' @param provenance As of `provenance_of()`; NULL: no such block.
#' @param class Of its body: "patient" for pages that print on A4.
#' @noRd
page_document <- function(title, ..., lead = NULL, provenance = NULL, class = "page") {
  tags <- htmltools::tags
  styles <- c("quality.css", if (class == "patient") "patient.css")
  tags$body(
    class = class,
    tags$head(tags$title(title),
              tags$meta(name = "viewport", content = "width=device-width, initial-scale=1"),
              tags$style(htmltools::HTML(vapply(styles, report_text, "")))),
    tags$header(tags$h1(title), lead), ...,
    if (!is.null(provenance)) provenance_block(provenance)
  )
}

#' Names and texts as a list of definitions
#' @noRd
fact_list <- function(facts) {
  tags <- htmltools::tags
  tags$dl(class = "facts", lapply(names(facts), function(name) {
    tags$div(tags$dt(name), tags$dd(facts[[name]]))
  }))
}

#' A table of a page from its rows
#' @noRd
page_table <- function(head, rows, class = NULL) {
  tags <- htmltools::tags
  tags$div(class = "scroll", tags$table(class = class, tags$thead(head), tags$tbody(rows)))
}

#' A section of a page
#' @param note A remark below its heading.
#' @noRd
page_section <- function(heading, ..., note = NULL) {
  tags <- htmltools::tags
  tags$section(tags$h2(heading), if (!is.null(note)) tags$p(class = "note", note), ...)
}

#' A table of a page, with what its columns mean
#'
#' @param table Data frame.
#' @param meanings Named texts: what a column of the name is, with its unit.
#' @return NULL without rows.
#' @noRd
column_table <- function(table, meanings = NULL, digits = 3) {
  if (is.null(table) || nrow(table) == 0) return(NULL)
  tags <- htmltools::tags
  numeric <- vapply(table, is.numeric, NA)
  class <- ifelse(numeric, "n", "")
  shown <- vapply(table, function(column) {
    if (is.numeric(column)) column <- signif(column, digits)
    ifelse(is.na(column), "", vapply(column, format, "", USE.NAMES = FALSE))
  }, character(nrow(table)))
  shown <- matrix(shown, nrow(table))
  rows <- lapply(seq_len(nrow(shown)), function(i) tags$tr(unname(Map(
    function(text, class) tags$td(class = class, text), shown[i, ], class
  ))))
  own <- meanings[intersect(names(table), names(meanings))]
  head <- tags$tr(unname(Map(function(name, class) {
    tags$th(class = class, title = own[[name]], name)
  }, names(table), class)))
  htmltools::tagList(
    page_table(head, rows, "overview"),
    if (length(own)) tags$dl(class = "meanings", unname(Map(function(name, text) {
      tags$div(tags$dt(name), tags$dd(text))
    }, names(own), own)))
  )
}

#' The object and the file of a writer; those of a call in the former order, file first, turned
#' round
#'
#' @param x,file Arguments of the writer, given or not.
#' @param writer Its name.
#' @param former Former name of `x`.
#' @param ... The dots of the writer.
#' @return List `x`, `file` and `more`, the rest of the dots.
#' @noRd
object_first <- function(x, file, writer, former, ...) {
  more <- list(...)
  given <- c(x = !missing(x), file = !missing(file))
  if (former %in% names(more)) {
    if (sum(given) != 1) {
      crestline_abort(sprintf("`%s`, the former name of `x`, does not go with these arguments.",
                              former),
                      sprintf("Write %s(x, file), and all that follows by name.", writer),
                      stage = "arguments")
    }
    inform_former(paste0(writer, "(", former, " = )"), sprintf("%s(x, file)", writer))
    return(list(x = more[[former]], file = if (given[["file"]]) file else x,
                more = more[names(more) != former]))
  }
  check_given(frame = rlang::caller_env(), fn = rlang::caller_fn())
  if (!is.character(x) || is.character(file)) return(list(x = x, file = file, more = more))
  inform_former(sprintf("%s(file, x)", writer), sprintf("%s(x, file)", writer))
  list(x = file, file = x, more = more)
}

#' Make a page in a folder of our own, then put it where it belongs: what stands there may be the
#' user's
#' @noRd
save_page <- function(page, file, selfcontained) {
  made <- tempfile("page")
  dir.create(made)
  on.exit(unlink(made, recursive = TRUE))
  draft <- file.path(made, "page.html")
  files <- basename(made)
  htmltools::save_html(page, draft, libdir = files)
  html <- safe_scripts(paste(readLines(draft, encoding = "UTF-8", warn = FALSE), collapse = "\n"))
  if (selfcontained) {
    html <- inline_files(html, made, '<script src="([^"]+)"></script>', "script", "</script")
    html <- inline_files(html, made, '<link href="([^"]+)" rel="stylesheet" />', "style", "</style")
  } else {
    folder <- paste0(tools::file_path_sans_ext(basename(file)), "_files")
    # Copy the files that a page needs into a folder, which may be there already; none of another
    # content is written over
    from <- file.path(made, files)
    to <- file.path(dirname(file), folder)
    found <- list.files(from, recursive = TRUE, all.files = TRUE)
    target <- file.path(to, found)
    there <- file.exists(target)
    same <- unname(tools::md5sum(file.path(from, found))) == unname(tools::md5sum(target))
    if (any(there & !same %in% TRUE)) {
      crestline_abort(sprintf("`file` needs the folder %s, where %s is another file already.", to,
                              shorten(found[there & !same %in% TRUE])),
                      "Give another name to the page, or move that folder.", stage = "page",
                      call = NULL)
    }
    new <- which(!there)
    for (dir in unique(dirname(target[new]))) dir.create(dir, FALSE, recursive = TRUE)
    if (!all(suppressWarnings(file.copy(file.path(from, found[new]), target[new])))) refuse_page(to)
    address <- utils::URLencode(folder, reserved = TRUE, repeated = TRUE)
    html <- gsub(paste0('"', files, "/"), paste0('"', address, "/"), html, fixed = TRUE)
  }
  write_html(html, file)
}

write_html <- function(html, file) {
  tryCatch(suppressWarnings(writeLines(enc2utf8(html), file, useBytes = TRUE)),
           error = function(e) refuse_page(file))
}

refuse_page <- function(path) {
  crestline_abort(sprintf("`file`: %s cannot be written.", path),
                  writing_words(path),
                  stage = "page", call = NULL)
}

#' The data of widgets in a page, so written that no text in them can end or open a script
#' @noRd
safe_scripts <- function(html, opening = '<script type="application/json"') {
  part <- strsplit(html, opening, fixed = TRUE)[[1]]
  end <- regexpr("</script>", part, fixed = TRUE)
  data <- seq_along(part) > 1 & end > 0
  part[data] <- paste0(script_json(substr(part[data], 1, end[data] - 1)),
                       substr(part[data], end[data], nchar(part[data])))
  paste(part, collapse = opening)
}

#' JSON as it may stand between script tags: `<!--<script>` and the line ends of JavaScript are
#' written as escapes
#' @noRd
script_json <- function(json) {
  json <- enc2utf8(json)
  for (sign in c("<", "\u2028", "\u2029")) {
    json <- gsub(sign, sprintf("\\u%04x", utf8ToInt(sign)), json, fixed = TRUE)
  }
  json
}

# Every reference to a file, as `pattern` finds it in the page, replaced by an element that holds
# the file's text.
inline_files <- function(html, folder, pattern, element, closing) {
  for (reference in unique(regmatches(html, gregexpr(pattern, html))[[1]])) {
    name <- utils::URLdecode(sub(pattern, "\\1", reference))
    text <- paste(readLines(file.path(folder, name), encoding = "UTF-8", warn = FALSE),
                  collapse = "\n")
    text <- gsub(closing, sub("/", "\\/", closing, fixed = TRUE), text, fixed = TRUE)
    parts <- strsplit(html, reference, fixed = TRUE)[[1]]
    html <- paste(parts, collapse = paste0("<", element, ">\n", text, "\n</", element, ">"))
  }
  html
}

check_page_file <- function(file) {
  file <- check_path_to_write(file, "file", c("html", "htm"), "page")
  file.path(normalizePath(dirname(file)), basename(file))
}
