# The app in a browser, with real clicks: a folder of eight faces, one damaged, from files to a
# comparison and exported pages; then its code in a fresh R, whose numbers must be the same.
#   CRESTLINE_SHARED=... Rscript bench/app.R [folder] [desk] [find] [390]
# desk: the desk in between. find: the faces come without landmarks, and "Find" is pressed. 390: the
# width of a phone.
# Needs the packages shiny and chromote and a Chromium or Chrome (CHROMOTE_CHROME names it); no
# display, no graphics card.
suppressMessages(library(crestline))
arguments <- commandArgs(TRUE)
folder <- c(arguments, tempfile("app"))[1]
finds <- "find" %in% arguments
size <- if ("390" %in% arguments) c(390, 844) else c(1400, 900)
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
source("bench/browser.R")
shared <- Sys.getenv("CRESTLINE_SHARED")
stopifnot(nzchar(shared))

# ---- Eight faces with their landmarks beside them; the last is cut off in the middle of its file
scans <- file.path(folder, "scans")
unlink(scans, recursive = TRUE)
dir.create(scans)
files <- list.files(file.path(shared, "simpop"), "[.]ply$", full.names = TRUE)[1:8]
marks <- read.csv(file.path(shared, "simpop", "landmarks.csv"))
name <- intersect(c("id", "specimen", "face"), names(marks))[1]
invisible(file.copy(files, scans))
if (!finds) for (file in files) {
  id <- sub("[.]ply$", "", basename(file))
  own <- marks[marks[[name]] == id, ]
  write_landmarks(as.matrix(data.frame(own[c("x", "y", "z")], row.names = own$landmark)),
                  file.path(scans, paste0(id, ".csv")))
}
last <- file.path(scans, basename(files[8]))
writeBin(readBin(last, "raw", 2e5), last)
ids <- sub("[.]ply$", "", basename(files))
table <- file.path(folder, "groups.csv")
write.csv(data.frame(id = ids, group = rep(c("a", "b"), 4)), table, row.names = FALSE)

served <- serve(sprintf("result <- crestline_app('%s', port = 8271, launch.browser = FALSE)",
                        normalizePath(scans)), 8271)
page <- open_page(served, size, "!!document.getElementById('said')")
begun <- Sys.time()
text <- function(id) look(page, sprintf("document.getElementById('%s').textContent", id))
write_into <- function(id, value) {
  press(page, paste0("#", id))
  look(page, sprintf("document.getElementById('%s').select()", id))
  page$Input$insertText(text = value)
  Sys.sleep(0.5)
}
step <- function(id, done, seconds = 900) {
  press(page, paste0("#", id))
  took <- until(function() {
    if (grepl("not done", text("said"))) stop(text("said"))
    grepl(done, text("said")) && !busy(page)
  }, done, seconds)
  data.frame(step = id, seconds = took)
}
steps <- step("step_folder", "The scans of a folder: done")
steps <- rbind(steps, if (finds) step("step_find", "found by machine .*: done") else
  step("step_beside", "beside the scans: done"))
press(page, "#step_measure")
bars <- 0
until(function() {
  if (look(page, "!!document.querySelector('.shiny-progress-notification')")) bars <<- bars + 1
  if (bars == 40) shoot(page, "app-measuring.png")
  grepl("scan measured: done", text("said")) && !busy(page)
}, "measured", 1200)
cat(text("said"), "\n")
shoot(page, "app-measured.png")

# The desk, from the app: one landmark kept on the first face, and back
if ("desk" %in% arguments) {
  press(page, "#desk")
  until(function() look(page, "!!Shiny.shinyapp.$inputValues['ready']"), "the desk", 300)
  Sys.sleep(2)
  until(function() !busy(page), "rest", 300)
  press(page, "[data-landmark=\"pn\"]")
  Sys.sleep(1)
  shoot(page, "app-desk.png")
  press(page, "#keep")
  until(function() !busy(page) && state_of(page, "pn") == "placed", "pn", 120)
  press_done(page)
  until(function() look(page, "!!document.getElementById('said')"), "the app again", 300)
  cat(text("said"), "\n")
  steps <- rbind(steps, step("step_beside", "beside the scans: done"))
}
for (one in list(c("step_quality", "Quality: done"), c("step_homologise", "points: done"))) {
  steps <- rbind(steps, step(one[1], one[2]))
}
write_into("table", normalizePath(table))
for (one in list(c("step_groups", "from a table: done"), c("step_compare", "compared: done"),
                 c("step_pictures", "Pictures: done"), c("step_exports", "programs: done"),
                 c("save", "Saved in"))) {
  steps <- rbind(steps, step(one[1], one[2]))
  if (one[1] == "step_compare") shoot(page, "app-compared.png")
}
shoot(page, "app-done.png")
minutes <- as.numeric(difftime(Sys.time(), begun, units = "mins"))
wide <- look(page, "document.documentElement.scrollWidth")
result <- finish(page, served)
print(steps)

# ---- The code in a fresh R, without what the app has measured
output <- file.path(scans, "output")
code <- file.path(folder, "analysis.R")
invisible(file.copy(file.path(output, "analysis.R"), code, overwrite = TRUE))
files <- list.files(output)
unlink(output, recursive = TRUE)
again <- file.path(folder, "again.rds")
writeLines(c(readLines(code), sprintf("saveRDS(list(compared = compared, sample = sample), '%s')",
                                      again)), code)
status <- system2(file.path(R.home("bin"), "Rscript"), code, stdout = FALSE, stderr = FALSE)
fresh <- readRDS(again)
print(data.frame(
  minutes = minutes, width = size[1], scroll_width = wide, found = finds, bars_seen = bars > 0,
  measured = length(result$values$sample),
  files = paste(files, collapse = " "), fresh_status = status,
  same_points = identical(as.array(fresh$sample), as.array(result$values$sample)),
  same_tests = identical(fresh$compared$tests, result$values$compared$tests)
))
cat("screenshots in", folder, "\n")
