# 600 single-bit flips and 50 truncations of a result file: noticed, and measured again?
#
#   Rscript bench/damage.R
options(rgl.useNULL = TRUE); suppressPackageStartupMessages(library(crestline))
ball <- Rvcg::vcgSphere(4); ball$vb[1:3, ] <- 40 * ball$vb[1:3, ]; ball$normals <- NULL
at <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2),
            c = c(0, 1.5, 2)); at <- 40 * at / sqrt(rowSums(at^2))
scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")),
                       data.frame(curve = c("ab", "bc"), from = c("a", "b"), to = c("b", "c"),
                                  kind = "plane", n = 7), name = "two sides")
one <- specimen(ball, at, id = "u"); dir <- tempfile("damage")
first <- fit_shapes(list(one), scheme,
                    dir); file <- list.files(dir,
                                             full.names = TRUE); whole <- readBin(file, "raw", 1e8)
points <- coords(first[[1]], "curves"); mesh <- first[[1]]$specimen$mesh$vb
cat("file:", basename(file), length(whole), "bytes\n")
try_it <- function(bytes) {
  for (f in list.files(dir, full.names = TRUE)) unlink(f)
  writeBin(bytes, file)
  noticed <- nrow(failures(first)) == 1 && is.null(suppressWarnings(first[[1]]))
  told <- tryCatch({ first[[1]]; FALSE }, crestline_warning = function(w) TRUE)
  again <- fit_shapes(list(one), scheme, dir); shape <- again[[1]]
  fresh <- any(file.mtime(list.files(dir, full.names = TRUE)) > now)
  c(noticed = noticed, told = told,
    `measured again` = identical(coords(shape, "curves"), points) &&
    identical(shape$specimen$mesh$vb, mesh),
    whole = any(vapply(list.files(dir, full.names = TRUE),
                       function(f) getFromNamespace("open_kept", "crestline")(f)$state == "whole",
                       NA)))
}
now <- Sys.time(); set.seed(1)
flips <- vapply(sample(length(whole), 600, replace = length(whole) < 600), function(i) {
  b <- whole; b[i] <- xor(b[i], as.raw(bitwShiftL(1L, sample(0:7, 1)))); try_it(b) }, logical(4))
# All of the first lines, where a flip changes what the file claims to be.
head <- vapply(1:200, function(i) {
  b <- whole; b[i] <- xor(b[i], as.raw(bitwShiftL(1L, sample(0:7, 1)))); try_it(b) }, logical(4))
cuts <- vapply(round(seq(0, length(whole) - 1, length.out = 50)),
               function(n) try_it(whole[seq_len(n)]), logical(4))
show <- function(what,
                 x) cat(sprintf("%-28s %s\n", what,
                                paste(rownames(x), paste(rowSums(x), "of", ncol(x)),
                                      collapse = ", ")))
show("single-bit flips", flips); show("flips in the first 200 bytes",
                                      head); show("truncations", cuts)
cat("seconds:", round(as.numeric(difftime(Sys.time(), now, units = "secs"))), "\n")
