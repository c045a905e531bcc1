# A page without a specimen, put into `folder` under a name.
save_small_page <- function(folder, name = "scan.html", selfcontained = FALSE, text = "text") {
  testthat::skip_if_not_installed("htmltools")
  script <- file.path(tempdir(), "crestline-small")
  dir.create(script, showWarnings = FALSE)
  writeLines("var one = 1;", file.path(script, "one.js"))
  needed <- htmltools::htmlDependency("small", "1.0", script, script = "one.js")
  save_page(htmltools::attachDependencies(htmltools::tags$p(text), needed), file.path(folder, name),
            selfcontained)
}

new_folder <- function(...) {
  folder <- tempfile()
  dir.create(file.path(folder, ...), recursive = TRUE)
  folder
}

test_that("a folder of the user's beside the page stays as it is", {
  folder <- new_folder("scan_files")
  own <- file.path(folder, "scan_files", "notes.txt")
  writeLines("my own data", own)
  save_small_page(folder, selfcontained = TRUE)
  expect_setequal(list.files(folder, recursive = TRUE), c("scan.html", "scan_files/notes.txt"))
  save_small_page(folder)
  expect_true(file.exists(file.path(folder, "scan_files", "small-1.0", "one.js")))
  expect_equal(readLines(own), "my own data")
  # The same page once more finds its own files there.
  save_small_page(folder, text = "other text")
  expect_match(paste(readLines(file.path(folder, "scan.html")), collapse = ""), "other text")
  writeLines("my own script", file.path(folder, "scan_files", "small-1.0", "one.js"))
  expect_crestline_error(save_small_page(folder), c("scan_files", "one.js"))
  expect_equal(readLines(file.path(folder, "scan_files", "small-1.0", "one.js")), "my own script")
  unlink(folder, recursive = TRUE)
})

test_that("odd names of files are no hindrance", {
  folder <- new_folder()
  for (name in c("a b#c&d%20.html", "quote ' and \u00e9.html")) {
    for (selfcontained in c(TRUE, FALSE)) save_small_page(folder, name, selfcontained)
    html <- paste(readLines(file.path(folder, name), encoding = "UTF-8"), collapse = "")
    source <- sub('.*<script src="([^"]+one[.]js)".*', "\\1", html)
    expect_no_match(source, "[ #&]")
    expect_true(file.exists(file.path(folder,
                                      enc2native(`Encoding<-`(utils::URLdecode(source), "UTF-8")))))
  }
  unlink(folder, recursive = TRUE)
})

test_that("what cannot be written is an error of ours", {
  folder <- new_folder("page.html")
  expect_crestline_error(save_small_page(folder, "page.html", TRUE),
                         c("page.html", "cannot be written"))
  writeLines("no folder", file.path(folder, "scan_files"))
  expect_crestline_error(save_small_page(folder), c("scan_files", "cannot be written"))
  expect_equal(readLines(file.path(folder, "scan_files")), "no folder")
  unlink(folder, recursive = TRUE)
})

test_that("text in the data of a page neither opens nor ends a script", {
  bad <- "<!--<script> </script> \u2028 & ' \""
  json <- script_json(jsonlite::toJSON(bad))
  expect_false(grepl("[<\u2028]", json))
  expect_equal(jsonlite::fromJSON(json), bad)
  page <- paste0("<p>&lt;</p><script type=\"application/json\" data-for=\"a\">",
                 "[\"<!--<script>\"]</script><b>1</b>",
                 "<script type=\"application/json\" data-for=\"b\">[\"<b\"]</script>",
                 "<script>if (1 < 2) {}</script>")
  expect_equal(safe_scripts(page),
               gsub("<b\"", "\\u003cb\"",
                    gsub("<!--<script>", "\\u003c!--\\u003cscript>", page, fixed = TRUE),
                    fixed = TRUE))
  expect_equal(safe_scripts("<p>no script</p>"), "<p>no script</p>")
})

test_that("text of a script cannot end it", {
  folder <- tempfile()
  dir.create(folder)
  writeLines("x = '</script>' + \"\\\\1\";", file.path(folder, "a.js"))
  html <- inline_files("<p></p><script src=\"a.js\"></script><p></p>", folder,
                       '<script src="([^"]+)"></script>', "script", "</script")
  expect_equal(html, "<p></p><script>\nx = '<\\/script>' + \"\\\\1\";\n</script><p></p>")
  unlink(folder, recursive = TRUE)
})

test_that("a large page stays whole", {
  big <- paste0("<script type=\"application/json\">[\"", strrep("a<", 1e6),
                "\"]</script><p>end</p>")
  expect_match(safe_scripts(big), "</script><p>end</p>$")
})
