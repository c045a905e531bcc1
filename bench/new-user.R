# As a new user would, by the lines of README: 23 landmarks placed by clicks on two faces, one curve
# drawn, measured, compared; the time of each part, and every stop.
#   Rscript bench/new-user.R [folder]
# Needs the packages shiny and chromote and a Chromium or Chrome; no display, no graphics card.
suppressMessages(library(crestline))
folder <- c(commandArgs(TRUE), tempfile("user"))[1]
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
source("bench/browser.R")
goal <- read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline"))
scans <- file.path(folder, "scans")
unlink(c(scans, file.path(folder, "desk")), recursive = TRUE)
dir.create(scans)
data(humface, package = "Rvcg")
stretch <- list(anna = c(1, 1, 1), bea = c(1.05, 1, 1))
for (name in names(stretch)) {
  mesh <- humface
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] * stretch[[name]]
  write_mesh(structure(mesh[c("vb", "it")], class = "mesh3d"),
             file.path(scans, paste0(name, ".ply")))
}
code <- c(sprintf("setwd('%s')", normalizePath(folder)),
          "files <- list.files('scans', '[.]ply$', full.names = TRUE)",
          paste("result <- digitise(files, dir = 'desk', observer = 'AB', port = 8291,",
                "launch.browser = FALSE)"))
begun <- Sys.time()
since <- function() as.numeric(difftime(Sys.time(), begun, units = "secs"))
served <- serve(code, 8291)
page <- open_page(served, c(1400, 900))
stops <- character()
turn <- function(by) if (by != 0) drag(page, c(500, 120), c(500 + by, 120))
at_rest <- function() until(function() !busy(page), "rest")
place_all <- function(name) {
  mesh <- read_specimen(file.path(scans, paste0(name, ".ply")))$mesh
  for (mark in rownames(goal)) {
    row <- sprintf("[data-landmark=\"%s\"]", mark)
    middle_of(page, row)
    Sys.sleep(0.3)
    press(page, row)
    until(function() !busy(page) && look(
      page, "document.querySelector('#chosen b').textContent"
    ) == mark, mark)
    by <- if (grepl("L$", mark)) -180 else if (grepl("R$", mark)) 180 else 0
    turn(by)
    click(page, pixel_of(page, mesh, goal[mark, ] * stretch[[name]]))
    placed <- tryCatch(until(function() state_of(page, mark) == "placed" && !busy(page), mark, 20),
                       error = function(e) NA)
    if (is.na(placed)) stops <<- c(stops, sprintf("%s of %s: not on the surface", mark, name))
    turn(-by)
  }
}
until(function() look(page, "!!Shiny.shinyapp.$inputValues['ready']"), "the face")
at_rest()
times <- c(opened = since())
place_all("anna")
times["first face"] <- since()
press(page, "[data-curve=\"mid-line lip left\"]")
Sys.sleep(1)
at_rest()
mesh <- read_specimen(file.path(scans, "anna.ply"))$mesh
for (share in c(0.3, 0.7)) {
  on <- locate(mesh, goal["chL", ] + share * (goal["st", ] - goal["chL", ]))
  click(page, pixel_of(page, mesh, unlist(on[c("x", "y", "z")])))
  Sys.sleep(1)
  at_rest()
}
press(page, "#snap")
until(function() look(
  page, "document.querySelector('[data-curve=\"mid-line lip left\"] .state').textContent"
) == "snapped", "snapped")
times["curve"] <- since()
shoot(page, "user-curve.png")
press(page, "#following")
until(function() grepl("^2 of", look(page, "document.querySelector('#where').textContent")), "bea")
Sys.sleep(2)
at_rest()
place_all("bea")
times["second face"] <- since()
desk <- finish(page, served)
measured <- lapply(desk$specimens, fit_shape, progress = FALSE)
times["measured"] <- since()
apart <- curve_distance(measured[[1]], measured[[2]])
times["compared"] <- since()
print(desk)
print(round(times))
print(stops)
off <- vapply(names(stretch), function(name) {
  at <- desk$specimens[[name]]$landmarks[rownames(goal), ]
  max(sqrt(rowSums((at - sweep(goal, 2, stretch[[name]], `*`))^2)), na.rm = TRUE)
}, 0)
print(off)
status <- measured[[1]]$status
print(status[status$part == "mid-line lip left", c("part", "kind", "ok", "reason")])
print(head(as.data.frame(apart), 3))
