# A batch of faces, ten with one fault each among good ones: what print(), quality(), summary() and
# align() tell.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/faults.R [found]
options(rgl.useNULL = TRUE, width = 110)
suppressPackageStartupMessages(library(crestline))
shared <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
dir <- tempfile("eight"); dir.create(dir)
all <- read.csv(file.path(shared, "landmarks.csv"), colClasses = c(id = "character"))
ids <- sub("[.]ply$", "", list.files(shared, "[.]ply$"))
marks <- function(id) {
  x <- all[all$id %in% c(id, sub("simpop_", "", id)),
           ]; m <- as.matrix(x[c("x", "y", "z")]); rownames(m) <- x$landmark; m }
put <- function(name, id, change = identity, scale = 1, from = id) {
  m <- Rvcg::vcgImport(file.path(shared, paste0(id, ".ply")), silent = TRUE,
                       clean = FALSE); m$vb[1:3, ] <- m$vb[1:3, ] * scale
  write_mesh(m, file.path(dir, paste0(name, ".ply")))
  write_landmarks(change(marks(from)) * scale, file.path(dir, paste0(name, ".csv")))
}
swap <- function(pairs) function(x) { n <- rownames(x); for (p in pairs) x[p, ] <- x[rev(p), ]; x }
lr <- grep("L$", rownames(marks(ids[1])), value = TRUE)
lr <- lapply(lr, function(l) c(l, sub("L$", "R", l)))
put("all_swapped", ids[1], swap(lr)); put("one_pair", ids[2], swap(list(c("acL", "acR"))))
put("in_cm", ids[3], scale = 0.1); put("in_m", ids[4], scale = 0.001)
put("no_file", ids[5]); unlink(file.path(dir, "no_file.csv"))
put("near_names", ids[6], function(x) {
  rownames(x)[match(c("pn", "chL"), rownames(x))] <- c("prn", "CHL"); x })
put("nine", ids[7], function(x) x[1:9, ])
put("others", ids[8], from = ids[9])
bunny <- Rvcg::vcgSphere(5)
bump <- function(at) 12 * exp(-colSums((bunny$vb[1:3, ] - at / sqrt(sum(at^2)))^2) / 0.05)
r <- 80 + bump(c(0, 0, 1)) + bump(c(.5, .7, .6)) + bump(c(-.5, .7, .6)) + bump(c(0, -.8, .5))
bunny$vb[1:3, ] <- t(t(bunny$vb[1:3, ]) * r)
write_mesh(bunny, file.path(dir, "bunny.ply"))
write_landmarks(marks(ids[9]), file.path(dir, "bunny.csv"))
put("cut", ids[10]); f <- file.path(dir, "cut.ply"); writeBin(readBin(f, "raw", 60000), f)
for (i in 11:length(ids)) put(sub("simpop", "good", ids[i]), ids[i])
files <- list.files(dir, "[.]ply$", full.names = TRUE)
found <- if ("found" %in% commandArgs(TRUE)) TRUE
print(system.time(shapes <- fit_shapes(files, face_scheme(), dir = file.path(dir, "out"),
                                       found = found)))
cat("\n==== print(shapes)\n"); print(shapes, most = 30)
cat("\n==== summary(shapes)\n"); print(summary(shapes), right = FALSE)
graded <- quality(shapes)
cat("\n==== quality(shapes)\n"); print(graded, most = 14)
cat("\n==== summary(quality(shapes))\n"); print(summary(graded))
cat("\n==== align()\n")
told <- character()
sample <- withCallingHandlers(homologise(shapes, progress = FALSE), warning = function(w) {
  told <<- c(told, conditionMessage(w)); invokeRestart("muffleWarning") })
aligned <- withCallingHandlers(align(sample, "curves"), warning = function(w) {
  told <<- c(told, conditionMessage(w)); invokeRestart("muffleWarning") })
print(aligned); cat(paste("-", told), sep = "\n")
pca <- shape_pca(aligned); cat("PC1 by specimen:\n"); print(round(sort(pca$x[, 1]), 3))
faults <- c("all_swapped", "one_pair", "in_cm", "in_m", "no_file", "near_names", "nine", "others",
            "bunny", "cut")
said <- list(print = paste(capture.output(print(shapes, most = 30)), collapse = " "),
             quality = paste(capture.output(print(graded, most = 30)), collapse = " "),
             rows = paste(graded$specimen[graded$level == "specimen" | graded$grade == "red"],
                          collapse = " "))
cat("\n==== named in\n"); print(sapply(said, function(s) sapply(faults, grepl, s, fixed = TRUE)))
good <- grep("^good", names(shapes), value = TRUE); cat("warnings of good ones:",
                                                        sum(warnings_of(shapes)$id %in% good), "\n")
unlink(dir, recursive = TRUE)
