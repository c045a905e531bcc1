# A page of the package in a browser, with real clicks: what bench/review.R and bench/build-scheme.R
# share. They make `folder`, where screenshots go.
options(rgl.useNULL = TRUE, chromote.headless = "new")
chromote::set_chrome_args(c("--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                            "--enable-unsafe-swiftshader"))

until <- function(test, what, seconds = 120) {
  begun <- Sys.time()
  while (!isTRUE(tryCatch(test(), error = function(e) FALSE))) {
    if (difftime(Sys.time(), begun, units = "secs") > seconds)
      stop("waited in vain: ", what, call. = FALSE)
    Sys.sleep(0.02)
  }
  invisible(as.numeric(difftime(Sys.time(), begun, units = "secs")))
}

# ---- The page runs in an R of its own; what it returns comes back in a file.
serve <- function(code, port) {
  script <- tempfile(fileext = ".R")
  result <- tempfile(fileext = ".rds")
  keep <- sprintf("saveRDS(result, '%s.part'); file.rename('%s.part', '%s')", result,
                  result, result)
  writeLines(c("library(crestline)", "options(rgl.useNULL = TRUE)",
               "data(humface, package = 'Rvcg')", code, keep), script)
  system2(file.path(R.home("bin"), "Rscript"), script, stdout = FALSE,
          stderr = paste0(result, ".log"), wait = FALSE)
  # The address, with its token, that R prints once the page is served
  log <- paste0(result, ".log")
  said <- function() sub("^Open ", "", grep("^Open http", readLines(log, warn = FALSE),
                                            value = TRUE))
  until(function() length(said()) == 1, "the server")
  list(result = result, port = port, url = said())
}

open_page <- function(served, size = c(1280, 860),
                      ready = "document.querySelectorAll('[data-landmark]').length > 0") {
  page <- chromote::ChromoteSession$new(width = size[1], height = size[2])
  page$Page$navigate(served$url)
  until(function() look(page, ready), "the page")
  page
}

look <- function(page, code) {
  # Long: a machine with other work is slow to answer
  page$Runtime$evaluate(code, returnByValue = TRUE, timeout_ = 120)$result$value
}

# ---- Real mouse events, as the browser gets them from a hand.
mouse <- function(page, type, at, button = "none", buttons = 0) {
  page$Input$dispatchMouseEvent(type = type, x = at[1], y = at[2], button = button,
                                buttons = buttons, clickCount = 1, timeout_ = 120)
}

click <- function(page, at) {
  mouse(page, "mouseMoved", at)
  mouse(page, "mousePressed", at, "left", 1)
  invisible(mouse(page, "mouseReleased", at, "left"))
}

drag <- function(page, from, to, button = "left", steps = 10) {
  held <- c(left = 1, right = 2)[[button]]
  mouse(page, "mouseMoved", from)
  mouse(page, "mousePressed", from, button, held)
  for (share in seq_len(steps) / steps) {
    mouse(page, "mouseMoved", from + share * (to - from), button, held)
  }
  invisible(mouse(page, "mouseReleased", to, button))
}

wheel <- function(page, at, delta) {
  page$Input$dispatchMouseEvent(type = "mouseWheel", x = at[1], y = at[2], deltaX = 0,
                                deltaY = delta)
}

middle_of <- function(page, selector) {
  look(page, sprintf("document.querySelector('%s').scrollIntoView({block: 'center'})", selector))
  unlist(look(page, sprintf("(() => {
    const b = document.querySelector('%s').getBoundingClientRect();
    return [b.x + b.width / 2, b.y + b.height / 2]; })()", selector)))
}

press <- function(page, selector) click(page, middle_of(page, selector))

# Where a place of a mesh is on the page, by rgl's own projection of its scene.
pixel_of <- function(page, mesh, xyz) {
  xyz <- crestline:::into_scene(matrix(xyz, 1), crestline:::scene_frame(mesh))
  unlist(look(page, sprintf("(() => { const rgl = document.getElementById('face').rglinstance;
    const b = rgl.canvas.getBoundingClientRect();
    const w = rgl.user2window([%s, 1], rgl.scene.rootSubscene);
    return [b.x + w[0] * b.width, b.y + (1 - w[1]) * b.height]; })()",
                            paste(sprintf("%.9g", xyz), collapse = ", "))))
}

# All lines that the browser shows, each as one text.
lines_of <- function(page) {
  unlist(look(page, "Object.values(document.getElementById('face').rglinstance.scene.objects)
    .filter(o => o.type === 'linestrip').map(o => JSON.stringify(o.vertices))"))
}

state_of <- function(page, name) {
  look(page, sprintf("document.querySelector('[data-landmark=\"%s\"] .state').textContent", name))
}

shoot <- function(page, name) {
  shot <- tryCatch(page$Page$captureScreenshot(format = "png"), error = function(e) NULL)
  if (is.null(shot)) message("no screenshot ", name, ": the browser is too slow")
  else writeBin(jsonlite::base64_dec(shot$data), file.path(folder, name))
}
busy <- function(page) look(page, "document.documentElement.classList.contains('shiny-busy')")

# "Done" asks where landmarks are missing.
press_done <- function(page, button = "#done") {
  press(page, button)
  asked <- sprintf("(document.querySelector('%s') || {}).textContent", button)
  if (isTRUE(grepl("?", look(page, asked), fixed = TRUE))) press(page, button)
}

finish <- function(page, served, button = "#done") {
  press_done(page, button)
  until(function() file.exists(served$result), "the specimen")
  page$close()
  readRDS(served$result)
}

# ---- What came back: is it exactly on the surface?
off_surface <- function(specimen, name) {
  located <- specimen$geometry$located[match(name, rownames(specimen$geometry$landmarks)), ]
  weight <- as.matrix(located[c("w1", "w2", "w3")])
  corner <- function(i) t(specimen$mesh$vb[1:3, specimen$mesh$it[i, located$face], drop = FALSE])
  placed <- weight[, 1] * corner(1) + weight[, 2] * corner(2) + weight[, 3] * corner(3)
  max(abs(placed - specimen$landmarks[name, ]), abs(rowSums(weight) - 1), -weight)
}
