# The review page in a browser, with real clicks: what is clicked, what comes back.
#   Rscript bench/review.R [folder for screenshots]
# Needs the packages shiny and chromote and a Chromium or Chrome (CHROMOTE_CHROME names it); no
# display, no graphics card.
suppressMessages(library(crestline))
folder <- c(commandArgs(TRUE), tempfile("review"))[1]
dir.create(folder, showWarnings = FALSE, recursive = TRUE)
source("bench/browser.R")

# The place of the mesh at a distance from a landmark, to the subject's left and up.
place_beside <- function(mesh, at, distance, aim = c(1, 1, 0) / sqrt(2)) {
  for (round in 1:20) {
    target <- at + distance * aim
    target <- t(Rvcg::vcgClostKD(matrix(target, 1), mesh)$vb[1:3, , drop = FALSE])[1, ]
    aim <- (target - at) / sqrt(sum((target - at)^2))
  }
  target
}

move_chL <- function(what, code, unit, port) {
  call <- sprintf("result <- review_landmarks(face, port = %d, launch.browser = FALSE)", port)
  served <- serve(c(code, call), port)
  page <- open_page(served)
  opened <- until(function() length(lines_of(page)) == 40 && !busy(page), "40 curves")
  before <- local({
    data(humface, package = "Rvcg", envir = environment())
    eval(parse(text = paste(code, "; face")))
  })
  lines <- lines_of(page)
  shoot(page, paste0(what, "-before.png"))
  drag(page, c(300, 300), c(380, 330))
  for (turn in 1:3) wheel(page, c(450, 430), -120)
  drag(page, c(300, 500), c(260, 400), "right")
  Sys.sleep(0.5)
  stopifnot(identical(lines_of(page), lines), state_of(page, "chL") != "placed")
  press(page, "[data-landmark=chL]")
  until(function() look(page, "document.querySelector('#chosen b').textContent") == "chL" &&
        !busy(page), "chL chosen")
  target <- place_beside(before$mesh, before$landmarks["chL", ], 5 / unit)
  click(page, pixel_of(page, before$mesh, target))
  seconds <- until(function() state_of(page, "chL") == "placed" &&
                   !identical(lines_of(page), lines), "chL placed")
  until(function() !busy(page), "rest")
  changed <- sum(!lines_of(page) %in% lines)
  shoot(page, paste0(what, "-after.png"))
  press(page, "#undo")
  until(function() state_of(page, "chL") != "placed" && setequal(lines_of(page), lines), "undone")
  press(page, "[data-landmark=chL]")
  click(page, pixel_of(page, before$mesh, target))
  until(function() state_of(page, "chL") == "placed" && !busy(page), "placed again")
  after <- finish(page, served)
  others <- setdiff(rownames(before$landmarks), "chL")
  curves <- function(found) {
    mesh <- found$mesh
    mesh$vb[1:3, ] <- unit * mesh$vb[1:3, ]
    found <- specimen(mesh, unit * found$landmarks, tolerance = 0.25)
    fit_shape(found, face_scheme(), ridge_settings(error = FALSE), progress = FALSE)
  }
  data.frame(
    session = what, seconds_to_move = seconds, curves_changed = changed,
    moved = unit * sqrt(sum((after$landmarks["chL", ] - before$landmarks["chL", ])^2)),
    from_target = unit * sqrt(sum((after$landmarks["chL", ] - target)^2)),
    off_surface = unit * off_surface(after, "chL"),
    others_moved = max(abs(after$landmarks[others, ] - before$landmarks[others, ]), na.rm = TRUE),
    curve_moved = max(curve_distance(curves(before), curves(after))$max, na.rm = TRUE)
  )
}

# Two doubtful landmarks: one is said to be right, the other not to be there.
settle_doubtful <- function(port) {
  code <- c("face <- find_landmarks(humface, id = 'humface')",
            "face$placing$confidence[face$placing$landmark %in% c('enR', 'chR')] <- 0.3",
            sprintf("result <- review_landmarks(face, port = %d, launch.browser = FALSE)", port))
  served <- serve(code, port)
  page <- open_page(served)
  until(function() length(lines_of(page)) == 40 && !busy(page), "40 curves")
  shoot(page, "doubtful.png")
  chosen <- look(page, "document.querySelector('#chosen b').textContent")
  press(page, "#keep")
  until(function() state_of(page, chosen) == "placed" && !busy(page), chosen)
  chosen[2] <- look(page, "document.querySelector('#chosen b').textContent")
  press(page, "#absent")
  until(function() state_of(page, chosen[2]) == "absent" && !busy(page), chosen[2])
  after <- finish(page, served)
  data.frame(chosen = chosen, state = after$placing$state[match(chosen, after$placing$landmark)],
             accepted = inherits(check_placing(after), "specimen"))
}

place_three <- function(port) {
  call <-
    sprintf("result <- place_landmarks(humface, id = 'humface', port = %d, launch.browser = FALSE)",
            port)
  served <- serve(call, port)
  page <- open_page(served)
  until(function() look(page, "document.querySelectorAll('.row.missing').length") == 23 &&
        !busy(page), "23 missing")
  until(function() look(page, "Shiny.shinyapp.$inputValues['ready']"), "the face")
  until(function() !busy(page), "rest")
  data(humface, package = "Rvcg", envir = environment())
  goal <- read_landmarks(system.file("extdata", "humface_landmarks.csv", package = "crestline"))
  shoot(page, "place-before.png")
  asked <- character()
  for (i in 1:3) {
    asked[i] <- look(page, "document.querySelector('#chosen b').textContent")
    turn <- c(pn = 0, acL = -230, acR = 230)[[asked[i]]]
    if (turn != 0) drag(page, c(450, 300), c(450 + turn, 300))
    click(page, pixel_of(page, specimen(humface)$mesh, goal[asked[i], ]))
    until(function() state_of(page, asked[i]) == "placed" && !busy(page), asked[i])
    shoot(page, sprintf("place-%s.png", asked[i]))
    if (turn != 0) drag(page, c(450 + turn, 300), c(450, 300))
  }
  after <- finish(page, served)
  placed <- !is.na(after$landmarks[, 1])
  data.frame(asked = asked, in_order = asked == face_scheme()$landmarks$landmark[1:3],
             off = sqrt(rowSums((after$landmarks[asked, ] - goal[asked, ])^2)),
             off_surface = vapply(asked, off_surface, 0, specimen = after),
             others = sum(placed) - 3, row.names = NULL)
}

given <- "file <- system.file('extdata', 'humface_landmarks.csv', package = 'crestline')
          face <- specimen(humface, read_landmarks(file), id = 'humface')"
metres <- "humface$vb[1:3, ] <- humface$vb[1:3, ] / 1000; humface$normals <- NULL
           face <- find_landmarks(humface, id = 'humface in metres')"
sessions <- list(move_chL("given", given, 1, 8171),
                 move_chL("found", "face <- find_landmarks(humface, id = 'humface')", 1, 8172),
                 move_chL("metres", metres, 1000, 8173))
shared <- Sys.getenv("CRESTLINE_SHARED")
if (nzchar(shared)) {
  file <- normalizePath(file.path(shared, "scan_a", c("surface.ply", "landmarks.csv")))
  scan_a <- sprintf("face <- read_specimen('%s', '%s', id = 'scan_a')", file[1], file[2])
  sessions <- c(sessions, list(move_chL("scan_a", scan_a, 1, 8174)))
}
print(do.call(rbind, sessions), digits = 3)
print(settle_doubtful(8176))
print(place_three(8175), digits = 3)
cat("screenshots in", folder, "\n")
