# The steps of the app: each is lines of R code, which are shown as they are run.

#' Text as R code
#' @noRd
as_code <- function(x) paste(deparse(x, width.cutoff = 500L), collapse = "")

#' Which objects each step needs, and which step makes them
#' @noRd
app_needs <- function() {
  list(folder = character(), find = "files", hand = "files", beside = "files",
       measure = c("files", "landmarks"), quality = "shapes", homologise = "shapes",
       groups = "sample", compare = c("sample", "group"), pictures = c("sample", "compared"),
       exports = c("sample", "graded", "compared"))
}

#' What was made of the objects that each step makes anew: it has to be made again
#' @noRd
app_outdated <- function(name) {
  sample <- c("graded", "sample", "compared", "pca")
  switch(name, folder = c("landmarks", "found", "shapes", "group", sample), find = , beside = ,
         hand = c("shapes", sample), measure = sample, homologise = c("compared", "pca"),
         groups = "compared", character())
}

#' The code of a step
#'
#' @param name Name of a step, see [app_needs()].
#' @param form Named list: what the page's fields hold.
#' @return Lines of code.
#' @noRd
step_code <- function(name, form) {
  switch(
    name, folder = code_folder(form), find = code_landmarks("found", form),
    hand = code_landmarks("hand", form), beside = code_landmarks("beside", form),
    measure = code_measure(form), quality = code_quality(),
    homologise = "sample <- homologise(shapes, progress = FALSE)",
    groups = code_groups(form), compare = code_compare(form), pictures = code_pictures(),
    exports = code_exports()
  )
}

code_folder <- function(form) {
  dir <- normalizePath(form$folder, winslash = "/", mustWork = FALSE)
  pattern <- "[.](ply|obj|stl)([.]gz)?$"
  c(sprintf("dir <- %s", as_code(dir)),
    sprintf("files <- list.files(dir, %s, full.names = TRUE, ignore.case = TRUE)",
            as_code(pattern)),
    "output <- file.path(dir, \"output\")",
    "dir.create(output, showWarnings = FALSE)",
    if (nzchar(c(form$scheme, "")[1])) {
      sprintf("scheme <- read_scheme(%s)", as_code(normalizePath(form$scheme, winslash = "/")))
    } else {
      "scheme <- face_scheme()"
    })
}

#' Where landmarks come from: files beside the scans, the finder, or an observer's desk
#' @noRd
code_landmarks <- function(how, form) {
  where <- if (how == "hand") {
    sprintf("file.path(dir, \"desk\", %s)", as_code(file_word(form$observer)))
  } else {
    "NULL"
  }
  c(sprintf("landmarks <- %s", where), sprintf("found <- %s", how == "found"))
}

code_measure <- function(form) {
  settings <- if (isTRUE(form$errors)) "ridge_settings()" else "ridge_settings(error = FALSE)"
  c(sprintf("settings <- %s", settings),
    paste("shapes <- fit_shapes(files, scheme, file.path(output, \"results\"), landmarks,",
          "settings = settings, found = found)"),
    "failures(shapes)")
}

code_quality <- function() {
  c("graded <- quality(shapes)", "quality_report(shapes, file.path(output, \"quality.html\"))",
    "summary(graded)")
}

code_groups <- function(form) {
  c(sprintf("groups <- read.csv(%s)", as_code(normalizePath(form$table, winslash = "/",
                                                            mustWork = FALSE))),
    sprintf("group <- setNames(groups[[%s]], groups[[%s]])", as_code(form$by), as_code(form$id)),
    "table(group)")
}

code_compare <- function(form) {
  sprintf("compared <- compare_groups(sample, group, %s, n_perm = %d, seed = %d, progress = FALSE)",
          as_code(form$level), as.integer(form$permutations), as.integer(form$seed)) |>
    c("compared")
}

code_pictures <- function() {
  c("png(file.path(output, \"map.png\"), 1200, 900, res = 120)",
    "plot(compared, \"boxes\")", "invisible(dev.off())",
    "pca <- shape_pca(align(sample))", "write_pca_page(pca, file.path(output, \"pca.html\"))")
}

code_exports <- function() {
  c("write.csv(as.data.frame(sample), file.path(output, \"points.csv\"), row.names = FALSE)",
    "write.csv(as.data.frame(graded), file.path(output, \"quality.csv\"), row.names = FALSE)",
    "write.csv(compared$tests, file.path(output, \"tests.csv\"), row.names = FALSE)",
    "saveRDS(sample, file.path(output, \"sample.rds\"))")
}
