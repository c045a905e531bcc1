# Pages and pictures in a browser: how long until the first picture, which examples draw without a
# display, and how far colours are apart for three kinds of vision.
#   Rscript bench/pages.R time FOLDER     a face's page in headless Chromium (needs chromote)
#   Rscript bench/pages.R engines [NAME ...]   every example of pictures, by "widget" and "picture"
#   Rscript bench/pages.R vignettes [widget|picture] [NAME ...]   every vignette of pictures (needs
#     pandoc)
#   Rscript bench/pages.R colours         least CIE 1976 distance of any two colours
suppressPackageStartupMessages(library(crestline))
options(rgl.useNULL = TRUE)

face_page <- function(file) {
  data <- new.env()
  utils::data("humface", package = "Rvcg", envir = data)
  face <- find_landmarks(data$humface, id = "humface")
  write_page(face, file, fit_shape(face, face_scheme()), radius = 7, length_unit = "mm")
}

# Seconds from navigation until the second frame after the canvas of the scene is there.
first_picture <- function(file, size) {
  page <- chromote::ChromoteSession$new(width = size[1], height = size[2])
  page$default_timeout <- 120
  page$Page$navigate(paste0("file://", normalizePath(file)))
  code <- "new Promise(done => { const look = () => {
    const canvas = document.querySelector('canvas');
    if (document.readyState === 'complete' && canvas && canvas.width > 0)
      requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())));
    else setTimeout(look, 20); }; look(); })"
  seconds <- page$Runtime$evaluate(code, awaitPromise = TRUE, returnByValue = TRUE)
  shot <- page$Page$captureScreenshot(format = "png")$data
  page$close()
  list(seconds = seconds$result$value / 1000, shot = jsonlite::base64_dec(shot))
}

measure_time <- function(folder) {
  options(chromote.headless = "new")
  chromote::set_chrome_args(c("--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                              "--enable-unsafe-swiftshader"))
  dir.create(folder, FALSE, TRUE)
  file <- file.path(folder, "face.html")
  face_page(file)
  for (size in list(c(1280, 1400), c(390, 844))) for (run in 1:3) {
    seen <- first_picture(file, size)
    cat(sprintf("%d x %d, run %d: %.2f s to the first picture, %.2f MB\n", size[1], size[2], run,
                seen$seconds, file.size(file) / 1e6))
    writeBin(seen$shot, file.path(folder, sprintf("face-%d.png", size[1])))
  }
}

# The examples of all help pages that draw, in R processes without a display.
run_examples <- function(wanted) {
  stopifnot(!nzchar(Sys.getenv("DISPLAY")), !nzchar(Sys.which("Xvfb")))
  pages <- tools::Rd_db("crestline")
  draws <- c("draw_surface|plot[.]|write_page|write_pca_page|plot_curves|plot_shape_scale",
             "write_picture|quality_report|write_glb|suggest_landmarks|write_slicer|shape_category")
  topics <- grep(paste(draws, collapse = "|"), names(pages), value = TRUE)
  if (length(wanted)) topics <- intersect(topics, paste0(wanted, ".Rd"))
  for (engine in c("widget", "picture")) for (topic in topics) {
    code <- utils::capture.output(tools::Rd2ex(pages[[topic]], commentDontrun = TRUE))
    code <- gsub("engine = \"picture\"", sprintf("engine = \"%s\"", engine), code, fixed = TRUE)
    script <- tempfile(fileext = ".R")
    writeLines(c("library(crestline)", "grDevices::pdf(NULL)",
                 sprintf("options(crestline.engine = \"%s\", warn = 1)", engine), code), script)
    said <- suppressWarnings(system2(file.path(R.home("bin"), "Rscript"), script, stdout = TRUE,
                                     stderr = TRUE))
    failed <- !is.null(attr(said, "status"))
    x11 <- any(grepl("X11|unable to open", said))
    cat(sprintf("%-8s %-32s %s%s\n", engine, topic, if (failed) "FAILED" else "ok",
                if (x11) ", asks for X11" else ""))
    if (failed) cat(utils::tail(said, 4), sep = "\n")
  }
}

# The vignettes that draw, rendered in R processes without a display, all pictures by one engine.
render_vignettes <- function(arguments) {
  engines <- intersect(c("widget", "picture"), arguments)
  if (!length(engines)) engines <- c("widget", "picture")
  names <- setdiff(arguments, engines)
  stopifnot(!nzchar(Sys.getenv("DISPLAY")), !nzchar(Sys.which("Xvfb")))
  files <- list.files("vignettes", "[.]Rmd$", full.names = TRUE)
  if (length(names)) files <- file.path("vignettes", paste0(names, ".Rmd"))
  for (file in files) for (engine in engines) {
    lines <- readLines(file, encoding = "UTF-8")
    if (!any(grepl("engine = \"|plot\\(|write_page\\(|draw_surface\\(", lines))) next
    folder <- tempfile("vignette")
    dir.create(folder)
    file.copy(list.files("vignettes", full.names = TRUE), folder)
    lines <- gsub("engine = \"(picture|rgl)\"", sprintf("engine = \"%s\"", engine), lines)
    writeLines(enc2utf8(lines), file.path(folder, basename(file)), useBytes = TRUE)
    code <- sprintf(paste("options(crestline.engine = '%s'); setwd('%s');",
                          "rmarkdown::render('%s', quiet = TRUE)"), engine, folder, basename(file))
    said <- suppressWarnings(system2(file.path(R.home("bin"), "Rscript"),
                                     c("-e", shQuote(code)), stdout = TRUE, stderr = TRUE))
    made <- file.path(folder, sub("Rmd$", "html", basename(file)))
    html <- if (file.exists(made)) paste(readLines(made, warn = FALSE), collapse = "\n") else ""
    count <- function(pattern) lengths(regmatches(html, gregexpr(pattern, html)))
    cat(sprintf("%-8s %-22s %s, %d scenes, %d pictures%s\n", engine, basename(file),
                if (is.null(attr(said, "status"))) "ok" else "FAILED",
                count("class=\"crestline-scene\""), count("<img "),
                if (any(grepl("X11|unable to open", said))) ", asks for X11" else ""))
    if (!is.null(attr(said, "status"))) cat(utils::tail(said, 6), sep = "\n")
    unlink(folder, recursive = TRUE)
  }
}

print_colours <- function() {
  source("tests/testthat/helper-colours.R", local = TRUE)
  ours <- asNamespace("crestline")
  sets <- list("shape index" = ours$shape_scale(ours$check_shape_palette(NULL))$colour,
               "shape index, paper" = ours$shape_palettes$paper,
               "kinds of curve" = ours$kind_colours,
               grades = ours$grade_colours, "states of landmarks" = ours$review_colours()$state,
               "two groups" = eval(formals(ours$plot.group_comparison)$colour))
  print(round(t(vapply(sets, least_difference, numeric(3)))))
}

arguments <- commandArgs(trailingOnly = TRUE)
switch(c(arguments, "")[1],
       time = measure_time(c(arguments[-1], tempfile())[1]),
       engines = run_examples(arguments[-1]), vignettes = render_vignettes(arguments[-1]),
       colours = print_colours(),
       stop("say time, engines, vignettes or colours"))
