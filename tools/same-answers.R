# Do two installed versions of the package give the same shapes, bit for bit?
#
#   CRESTLINE_SHARED=../shared/data Rscript tools/same-answers.R BEFORE AFTER
#
# BEFORE and AFTER are R libraries, each with crestline installed. Measured are humface (of Rvcg),
# the skull (of Morpho), and, where CRESTLINE_SHARED names their folder, scan_a and template_male.
# Compared are all co-ordinates, faces, weights and standard errors of all points. Fails where
# co-ordinates differ by more than 1e-10 of the object's size.
asked <- commandArgs(TRUE)
if (length(asked) != 2) stop("Give two R libraries.")

shapes_in <- function(library, out) {
  code <- c(
    sprintf(".libPaths(c(%s, .libPaths()))", deparse1(normalizePath(library))),
    "options(rgl.useNULL = TRUE)",
    "library(crestline)",
    "data(humface, package = \"Rvcg\")",
    "own <- function(name) system.file(\"extdata\", name, package = \"crestline\")",
    "made <- list(humface = fit_shape(",
    "  specimen(humface, read_landmarks(own(\"humface_landmarks.csv\")), id = \"humface\")",
    "))",
    "if (requireNamespace(\"Morpho\", quietly = TRUE)) {",
    "  data(boneData, package = \"Morpho\")",
    "  marks <- read_landmarks(own(\"skull_landmarks.csv\"))",
    "  skull <- specimen(skull_0144_ch_fe.mesh, marks, id = \"skull\")",
    "  made$skull <- fit_shape(skull, read_scheme(own(\"skull_scheme\"), name = \"skull\"))",
    "}",
    "for (name in c(\"scan_a\", \"template_male\")) {",
    "  mesh <- file.path(Sys.getenv(\"CRESTLINE_SHARED\"), name, \"surface.ply\")",
    "  if (!file.exists(mesh)) next",
    "  marks <- file.path(dirname(mesh), \"landmarks.csv\")",
    "  made[[name]] <- fit_shape(read_specimen(mesh, marks, id = name))",
    "}",
    "points <- lapply(made, function(shape) {",
    "  columns <- c(\"x\", \"y\", \"z\", \"face\", \"w1\", \"w2\", \"w3\", \"se\")",
    "  as.matrix(as.data.frame(shape)[columns])",
    "})",
    sprintf("saveRDS(points, %s)", deparse1(out))
  )
  script <- tempfile(fileext = ".R")
  writeLines(code, script)
  if (system2(file.path(R.home("bin"), "Rscript"), script) != 0) stop(library, " fails.")
  readRDS(out)
}

both <- lapply(asked, shapes_in, out = tempfile(fileext = ".rds"))
rows <- lapply(names(both[[1]]), function(name) {
  a <- both[[1]][[name]]
  b <- both[[2]][[name]]
  size <- sqrt(sum(apply(a[, 1:3], 2, function(x) diff(range(x, na.rm = TRUE)))^2))
  off <- abs(a - b)
  alike <- identical(dim(a), dim(b)) && identical(is.na(a), is.na(b))
  data.frame(object = name, points = nrow(a), missing = sum(is.na(a[, "x"])),
             identical = identical(a, b),
             differ = if (alike) sum(off[, 1:3] > 0, na.rm = TRUE) else NA,
             of_size = if (alike) max(off[, 1:3], na.rm = TRUE) / size else Inf,
             se = if (alike) max(c(0, off[, "se"]), na.rm = TRUE) else NA)
})
table <- do.call(rbind, rows)
print(table, digits = 3, row.names = FALSE)
if (any(table$of_size > 1e-10)) quit(status = 1)
