# Seconds from an interrupt, sent to another process in the midst of `code`, to the end of that code
# there; NA where it was at its end before, Inf where it went on.
seconds_to_end <- function(code, patience = 20) {
  begun <- tempfile()
  ended <- tempfile()
  script <- tempfile(fileext = ".R")
  on.exit(unlink(c(begun, ended, script)))
  writeLines(sprintf("
    options(rgl.useNULL = TRUE)
    library(crestline)
    ball <- Rvcg::vcgSphere(6)
    grDevices::pdf(NULL)
    say <- function(text, file) {
      writeLines(text, paste0(file, '.new'))
      file.rename(paste0(file, '.new'), file)
    }
    prepared <- { %s }
    say(as.character(Sys.getpid()), '%s')
    how <- tryCatch({ prepared(); 'finished' }, interrupt = function(e) 'interrupted',
                    error = function(e) 'failed')
    say(c(how, format(as.numeric(Sys.time()), digits = 16)), '%s')", code, begun, ended), script)
  # A shell lets what it starts in the background ignore interrupts, and R 4.5 obeys.
  rscript <- file.path(R.home("bin"), "Rscript")
  system2("env", c("--default-signal=INT", rscript, "--vanilla", script), wait = FALSE,
          stdout = FALSE, stderr = FALSE)
  waits_for <- function(file, seconds) {
    end <- Sys.time() + seconds
    while (!file.exists(file) && Sys.time() < end) Sys.sleep(0.05)
    file.exists(file)
  }
  if (!waits_for(begun, 120)) return(NA)
  pid <- as.integer(readLines(begun))
  Sys.sleep(1)
  sent <- as.numeric(Sys.time())
  tools::pskill(pid, tools::SIGINT)
  if (!waits_for(ended, patience)) {
    tools::pskill(pid, tools::SIGKILL)
    return(Inf)
  }
  said <- readLines(ended)
  if (said[1] == "failed") return(Inf)
  if (said[1] == "interrupted") as.numeric(said[2]) - sent else NA
}

test_that("long work in C++ ends within two seconds of an interrupt", {
  skip_if(suppressWarnings(system2("env", c("--default-signal=INT", "true"), stdout = FALSE,
                                   stderr = FALSE)) != 0, "env cannot reset signals here")
  skip_on_cran()
  # Seconds by the clock say nothing on a machine that runs other parts beside.
  skip_on_ci()
  skip_on_os("windows")
  work <- c(
    "curvature in huge balls" = "function() curvature(ball, 0.9)",
    "the same by threads" = "function() curvature(ball, 0.9, threads = 2)",
    "alignment without end" =
      "x <- array(rnorm(3e6), c(1000, 3, 1000))
       start <- list(coords = x, reference = x[, , 1])
       function() crestline:::fit_alignment(start, rep(1, 1000), 1L, 0, 1e6L)",
    "a picture of triangles across it all" =
      "n <- 20000
       ball$vb <- rbind(matrix(runif(9 * n, -1, 1), 3), 1)
       ball$it <- matrix(seq_len(3 * n), 3)
       ball$normals <- NULL
       function() for (i in 1) draw_surface(ball, resolution = 600, samples = 3)",
    "points slid together without end" =
      "face <- specimen(ball, rbind(a = ball$vb[1:3, 1]), id = 'ball')
       on <- crestline:::walkable(face)
       at <- as.matrix(crestline:::surface_points(face$mesh, t(face$mesh$vb[1:3, 1:500])))
       rows <- cbind(1:500, matrix(0, 500, 14), NA); chain <- crossprod(diff(diag(500)))
       set <- list(scale = 1, reach = 5, relaxation = 1, gap = 0, tolerance = 0, halvings = 0,
                   sweeps = 1e9)
       function() crestline:::cpp_slide_jointly(on$vb, on$it, on$twin, chain, at[, 1:3], rows,
                                                at[, 4:7], set)",
    "distances over the mesh" =
      "at <- data.frame(face = rep(1L, 500), w1 = 1, w2 = 0, w3 = 0)
       function() crestline:::geodesic_distances(ball, at)"
  )
  for (name in names(work)) {
    seconds <- seconds_to_end(work[[name]])
    # A machine that is busy, or so fast that the work was done before, says nothing.
    if (!is.na(seconds)) expect_lt(seconds, 2, label = name)
  }
})
