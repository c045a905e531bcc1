# A scheme of the skull built on the page by real clicks: six landmarks, four curves (one closed), a
# patch, a dragged landmark, undo, pairs, the folder saved; then the folder read back.
#   Rscript bench/build-scheme.R [folder for screenshots]
# Needs the packages shiny, chromote and Morpho and a Chromium or Chrome (CHROMOTE_CHROME names it);
# no display, no graphics card.
suppressMessages(library(crestline))
folder <- c(commandArgs(TRUE), tempfile("build"))[1]
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
source("bench/browser.R")

data(boneData, package = "Morpho")
skull <- specimen(skull_0144_ch_fe.mesh, id = "skull")
goal <- read_landmarks(system.file("extdata", "skull_landmarks.csv", package = "crestline"))
front <- rbind(c(-1, 0, 0), c(0, 0, -1), c(0, -1, 0))
saved <- file.path(folder, "scheme")
closes <- "via" %in% names(as.data.frame(face_scheme(), "curves"))

call <- c(
  "data(boneData, package = 'Morpho')",
  "front <- rbind(c(-1, 0, 0), c(0, 0, -1), c(0, -1, 0))",
  sprintf(paste("result <- build_scheme(specimen(skull_0144_ch_fe.mesh, id = 'skull'), dir = '%s',",
                "radius = 4, view = front, port = 8181, launch.browser = FALSE)"), saved)
)
served <- serve(call, 8181)
page <- open_page(served, c(1400, 900), "!!document.getElementById('told')")
begun <- Sys.time()

# The surface is there: clicks have a place.
until(function() look(page, "Shiny.shinyapp.$inputValues['ready']"), "the skull")
until(function() !busy(page), "rest")
said <- function() look(page, "document.getElementById('told').textContent")
rows <- function(kind) look(page, sprintf("document.querySelectorAll('[data-%s]').length", kind))
shoot(page, "build-empty.png")

# ---- As a hand does it: mark the text of a field, write over it.
write_into <- function(id, text) {
  press(page, paste0("#", id))
  look(page, sprintf("document.getElementById('%s').select()", id))
  page$Input$insertText(text = text)
  invisible(look(page, sprintf("document.getElementById('%s').dispatchEvent(%s)", id,
                               "new Event('change', {bubbles: true})")))
}

choose <- function(id, value) {
  invisible(look(page, sprintf("(() => { const f = document.getElementById('%s'); f.value = '%s';
    f.dispatchEvent(new Event('change', {bubbles: true})); })()", id, value)))
}

place <- function(name) {
  before <- rows("landmark")
  write_into("mark", name)
  Sys.sleep(0.3)
  click(page, pixel_of(page, skull$mesh, goal[name, ]))
  until(function() rows("landmark") == before + 1 && !busy(page), name)
}

join <- function(chain, name, kind, n, radius = 4, width = 6, path = "plane", closed = FALSE) {
  for (mark in chain) {
    click(page, pixel_of(page, skull$mesh, at_now(mark)))
    until(function() !busy(page) && grepl(paste0(mark, "$"), look(
      page, "document.getElementById('chosen_marks').textContent"
    )), mark)
  }
  for (id in c("curve_name", "radius", "width", "points")) {
    write_into(id, list(curve_name = name, radius = radius, width = width, points = n)[[id]] |>
               as.character())
  }
  choose("kind", kind)
  choose("path", path)
  if (closed != look(page, "document.getElementById('closed').checked")) press(page, "#closed")
  Sys.sleep(0.3)
  before <- rows("curve")
  begun <- Sys.time()
  press(page, "#join")
  until(function() rows("curve") == before + 1 && !busy(page), name)
  data.frame(curve = name, seconds = as.numeric(difftime(Sys.time(), begun, units = "secs")),
             said = said())
}

# Where a landmark is now: moved ones are not at their goal.
moved <- list()
at_now <- function(name) if (is.null(moved[[name]])) goal[name, ] else moved[[name]]

for (name in c("mfL", "ecL", "soL", "orL", "alL", "rhi")) place(name)
shoot(page, "build-landmarks.png")
curves <- rbind(
  if (closes) join(c("mfL", "soL", "ecL", "orL"), "orbit left", "ridge", 40, path = "crest",
                   closed = TRUE),
  join(c("mfL", "orL"), "lower rim medial", "ridge", 15),
  join(c("alL", "orL"), "cheek", "plane", 10),
  join(c("rhi", "alL"), "aperture upper", "ridge", 15, 2, 3)
)
shoot(page, "build-curves.png")
print(curves, right = FALSE)

# ---- Drag a landmark 4 mm along the rim, and take it back
lines <- lines_of(page)
to <- locate(skull, goal["orL", ] + c(-4, 0, 0))
at <- pixel_of(page, skull$mesh, goal["orL", ])
drag(page, at, pixel_of(page, skull$mesh, unlist(to[c("x", "y", "z")])))
seconds <- until(function() !identical(lines_of(page), lines) && !busy(page), "the drag")
cat(sprintf("dragged: %.2f s, %d lines changed\n", seconds, sum(!lines_of(page) %in% lines)))
shoot(page, "build-dragged.png")
press(page, "#undo")
until(function() setequal(lines_of(page), lines) && !busy(page), "undone")

# ---- A patch between the rim and the aperture, pairs, the folder
choose("curve_a", "aperture upper")
choose("curve_b", "lower rim medial")
write_into("patch_name", "maxilla")
Sys.sleep(0.3)
press(page, "#bound")
until(function() rows("patch") == 1 && !busy(page), "the patch")
cat(said(), "\n")
press(page, "#pairs")
until(function() !busy(page) && grepl("^No plane mirrors|^Pairs", said()), "pairs")
cat(said(), "\n")
press(page, "#save")
until(function() file.exists(file.path(saved, "curves.csv")) && !busy(page), "the folder")
cat(said(), "\n")
cat(sprintf("all steps: %.0f s\n", difftime(Sys.time(), begun, units = "secs")))
shoot(page, "build-done.png")
none <- page$Emulation$setDeviceMetricsOverride(width = 390, height = 844, deviceScaleFactor = 1,
                                                mobile = FALSE)
Sys.sleep(2)
shoot(page, "build-narrow.png")
wide <- look(page, "document.documentElement.scrollWidth")
none <- page$Emulation$setDeviceMetricsOverride(width = 1400, height = 900, deviceScaleFactor = 1,
                                                mobile = FALSE)
Sys.sleep(1)
shown <- lines_of(page)
built <- finish(page, served)

# ---- The folder read back: the same shape as the page's
scheme <- read_scheme(saved)
marks <- as.matrix(scheme$landmarks[c("x", "y", "z")])
rownames(marks) <- scheme$landmarks$landmark
plain <- ridge_settings(error = FALSE)
again <- fit_shape(specimen(skull_0144_ch_fe.mesh, marks, id = "skull"), scheme, plain)
here <- fit_shape(built$specimen, built$scheme, plain)
print(scheme)
print(data.frame(
  landmarks = nrow(marks), curves = nrow(scheme$curves), patches = nrow(scheme$patches),
  width_at_390 = wide, off_goal = max(sqrt(rowSums((marks - goal[rownames(marks), ])^2))),
  off_surface = max(vapply(rownames(marks), off_surface, 0, specimen = built$specimen)),
  missing = sum(is.na(again$points$x)),
  shape_off = max(abs(coords(again, "curves") - coords(here, "curves")),
                  abs(coords(again, "surface") - coords(here, "surface")))
), digits = 3)
cat("screenshots in", folder, "\n")
