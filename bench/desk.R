# The desk in a browser, with real clicks: three specimens, two curves drawn and snapped, the window
# closed and resumed, a second observer, the records measured by fit_shapes(), and the array for
# geomorph (kept as array-WIDTH.rds); at two widths.
#   Rscript bench/desk.R [folder for screenshots] [width ...]
# Needs the packages shiny and chromote and a Chromium or Chrome (CHROMOTE_CHROME names it); no
# display, no graphics card.
suppressMessages(library(crestline))
arguments <- commandArgs(TRUE)
folder <- c(arguments, tempfile("desk"))[1]
widths <- if (length(arguments) > 1) as.numeric(arguments[-1]) else c(1400, 390)
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
source("bench/browser.R")

goal <- read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline"))
marks <- c("chL", "st", "chR", "ls")
lips <- c("mid-line lip left" = "chL", "mid-line lip right" = "chR")
# Three faces: humface, and two that are stretched
stretch <- list(one = c(1, 1, 1), two = c(1.06, 1, 1), three = c(1, 0.95, 1.04))
code <- c(
  "stretch <- list(one = c(1, 1, 1), two = c(1.06, 1, 1), three = c(1, 0.95, 1.04))",
  "faces <- lapply(stretch, function(by) { mesh <- humface; mesh$normals <- NULL",
  "  mesh$vb[1:3, ] <- mesh$vb[1:3, ] * by; mesh })"
)
data(humface, package = "Rvcg")
meshes <- lapply(stretch, function(by) {
  mesh <- humface
  mesh$normals <- NULL
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] * by
  specimen(mesh)$mesh
})

desk_call <- function(dir, who, port) {
  sprintf(paste("result <- digitise(faces, dir = '%s', observer = '%s', view = 'front',",
                "port = %d, launch.browser = FALSE)"), dir, who, port)
}
rest <- function(page) until(function() !busy(page), "rest")
said <- function(page) look(page, "document.querySelector('#told').textContent")
state <- function(page, kind, name) {
  look(page, sprintf("document.querySelector('[data-%s=\"%s\"] .state').textContent", kind, name))
}
where <- function(page) look(page, "document.querySelector('#where').textContent")
choose <- function(page, kind, name) {
  row <- sprintf("[data-%s=\"%s\"]", kind, name)
  middle_of(page, row)
  Sys.sleep(0.5)
  press(page, row)
  until(function() !busy(page) && look(
    page, "document.querySelector('#chosen b').textContent"
  ) == name, name)
}
seen <- function(page, number) {
  until(function() isTRUE(grepl(sprintf("^%d of", number), where(page))), "the specimen")
  until(function() look(page, "!!Shiny.shinyapp.$inputValues['ready']"), "the face")
  Sys.sleep(1)
  rest(page)
}
key <- function(page, name, code = name) {
  for (type in c("keyDown", "keyUp")) {
    page$Input$dispatchKeyEvent(type = type, key = name, code = code, timeout_ = 120)
  }
}

place <- function(page, mesh, at, name) {
  choose(page, "landmark", name)
  click(page, pixel_of(page, mesh, at))
  until(function() state(page, "landmark", name) == "placed" && !busy(page), name)
}

# A button that has the focus, and Enter.
press_focused <- function(page, id) {
  look(page, sprintf("document.getElementById('%s').focus()", id))
  page$Input$dispatchKeyEvent(type = "keyDown", key = "Enter", code = "Enter", text = "\r",
                              windowsVirtualKeyCode = 13, timeout_ = 120)
  page$Input$dispatchKeyEvent(type = "keyUp", key = "Enter", code = "Enter",
                              windowsVirtualKeyCode = 13, timeout_ = 120)
}

# Three clicks beside the line between the lips, then the key of "Snap".
draw <- function(page, mesh, from, to, name, snap = TRUE) {
  choose(page, "curve", name)
  for (share in c(0.25, 0.5, 0.75)) {
    at <- from + share * (to - from) + c(0, 2, 0)
    on <- locate(mesh, at)
    before <- look(page, "document.querySelector('#chosen').textContent")
    click(page, pixel_of(page, mesh, unlist(on[c("x", "y", "z")])))
    until(function() !busy(page) && look(page, "document.querySelector('#chosen').textContent") !=
          before, "a point")
  }
  shoot(page, sprintf("desk-%d-drawn.png", width))
  if (!snap) return(invisible())
  key(page, "s")
  until(function() state(page, "curve", name) == "snapped" && !busy(page), "snapped")
  press(page, sprintf("[data-curve=\"%s\"]", name))
  rest(page)
}

specimen_by_hand <- function(page, number, off = 0, curves = TRUE) {
  mesh <- meshes[[number]]
  at <- sweep(goal, 2, stretch[[number]], `*`)
  for (name in marks) place(page, mesh, at[name, ] + off * c(1, 0, 0), name)
  if (curves) for (name in names(lips)) draw(page, mesh, at[lips[[name]], ], at["st", ], name)
}

# geomorph's own alignment of the array, as a share of ours; NA without geomorph.
superimposed <- function(array) {
  if (!requireNamespace("geomorph", quietly = TRUE)) return(NA)
  theirs <- geomorph::gpagen(array, print.progress = FALSE)$coords
  ours <- as.array(align(array))
  max(abs(as.matrix(stats::dist(t(apply(theirs, 3, as.vector)))) /
            as.matrix(stats::dist(t(apply(ours, 3, as.vector)))) - 1), na.rm = TRUE)
}

session <- function(width, port) {
  dir <- file.path(folder, paste0("records-", width))
  unlink(dir, recursive = TRUE)
  begun <- Sys.time()
  served <- serve(c(code, desk_call(dir, "AB", port)), port)
  page <- open_page(served, c(width, if (width < 700) 844 else 900))
  seen(page, 1)
  specimen_by_hand(page, 1)
  shoot(page, sprintf("desk-%d-first.png", width))
  key(page, "n")
  seen(page, 2)
  specimen_by_hand(page, 2, curves = FALSE)
  # The window is closed: R gets what there is; the same call goes on
  page$close()
  until(function() file.exists(served$result), "the end of the first session")
  first <- readRDS(served$result)
  served <- serve(c(code, desk_call(dir, "AB", port + 1)), port + 1)
  page <- open_page(served, c(width, if (width < 700) 844 else 900))
  seen(page, 1)
  resumed <- said(page)
  kept <- state(page, "curve", names(lips)[1])
  shoot(page, sprintf("desk-%d-resumed.png", width))
  for (number in 2:3) {
    press(page, "#following")
    seen(page, number)
    if (number == 3) specimen_by_hand(page, 3)
  }
  # Undo and redo by keys; drag a landmark 3 mm and take it back
  before <- state(page, "landmark", "ls")
  choose(page, "landmark", "ls")
  drag(page, pixel_of(page, meshes[[3]], goal["ls", ] * stretch[[3]]),
       pixel_of(page, meshes[[3]], unlist(locate(meshes[[3]], goal["ls", ] * stretch[[3]] +
                                                   c(3, 0, 0))[c("x", "y", "z")])))
  until(function() !busy(page) && grepl("moved", look(
    page, "document.querySelector('[data-landmark=ls]').title"
  )), "the drag")
  press_focused(page, "undo")
  until(function() !busy(page) && grepl("placed", look(
    page, "document.querySelector('[data-landmark=ls]').title"
  )), "undone")
  wide <- look(page, "document.documentElement.scrollWidth")
  face <- look(page, "document.getElementById('face').getBoundingClientRect().height")
  second <- finish(page, served)

  # A second observer, half a millimetre beside
  served <- serve(c(code, desk_call(dir, "CD", port + 2)), port + 2)
  page <- open_page(served, c(width, if (width < 700) 844 else 900))
  seen(page, 1)
  blind <- look(page, "document.querySelectorAll('.row.landmark.missing').length")
  for (number in 1:3) {
    specimen_by_hand(page, number, off = 0.5, curves = FALSE)
    if (number < 3) {
      press(page, "#following")
      seen(page, number + 1)
    }
  }
  other <- finish(page, served)
  minutes <- as.numeric(difftime(Sys.time(), begun, units = "mins"))

  both <- read_digitised(dir)
  array <- as.array(second, "landmarks")
  geomorph <- as.array(both, "landmarks")[marks, , ]
  who <- unique(both$marks[c("specimen", "observer")])
  name <- paste(who$specimen, who$observer)
  agreed <- repeatability(geomorph, stats::setNames(who$specimen, name),
                          stats::setNames(who$observer, name), "landmarks")
  shape <- fit_shape(second$specimens$one, progress = FALSE)
  own <- shape$status[match(names(lips), shape$status$part), ]
  full <- specimen(meshes$one, goal)
  ridge <- fit_shape(full, progress = FALSE)
  off <- vapply(names(lips), function(name) {
    drawn <- coords(shape, "curves")
    rows <- startsWith(rownames(drawn), paste0(name, " "))
    path <- as.matrix(as.data.frame(ridge$paths[[name]])[c("x", "y", "z")])
    # To the line, not to its places, which are up to 2.4 mm apart
    line <- apply(path, 2, function(v) stats::approx(seq_along(v), v, n = 50 * length(v))$y)
    max(apply(drawn[rows, ], 1, function(at) min(sqrt(colSums((t(line) - at)^2)))))
  }, 0)
  # The records alone, from files to shapes: curves are those that were drawn
  scans <- file.path(folder, paste0("scans-", width))
  dir.create(scans, showWarnings = FALSE)
  files <- file.path(scans, paste0(names(meshes), ".ply"))
  for (i in seq_along(files)) write_mesh(meshes[[i]], files[i])
  measured <- fit_shapes(files, landmarks = file.path(dir, "AB"), found = FALSE)
  taken <- measured$one$status[match(names(lips), measured$one$status$part), "reason"]
  saveRDS(array[marks, , ], file.path(folder, sprintf("array-%d.rds", width)))
  print(both)
  data.frame(
    width = width, minutes = minutes, resumed = resumed, kept = kept,
    closed = sum(first$marks$state == "placed"), scroll_width = wide, face_height = face,
    blind = blind, placed = sum(!is.na(array[marks, 1, ])),
    array = paste(dim(array), collapse = " x "),
    off_goal = max(abs(array[marks, , "one"] - goal[marks, ])),
    off_ridge = max(off), said = own$reason[1], from_files = taken[1],
    same_as_files = max(abs(coords(measured$one, "curves") - coords(shape, "curves")),
                        na.rm = TRUE),
    gpagen = superimposed(array[marks, , ]),
    observers_apart = mean(sqrt(rowSums((geomorph[, , "one AB"] - geomorph[, , "one CD"])^2))),
    error = max(agreed$parts$error)
  )
}

for (width in widths) {
  print(t(session(width, 8200 + 10 * match(width, widths))), quote = FALSE)
}
cat("screenshots in", folder, "\n")
