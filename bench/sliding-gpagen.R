# geomorph's own sliding of what bench/sliding.R gpagen FILE has written: on R 4.5, where geomorph
# is.
#
#   tools/chroot.sh Rscript bench/sliding-gpagen.R FILE

file <- commandArgs(TRUE)[1]
given <- readRDS(file)
time <- system.time(slid <- geomorph::gpagen(given$x, curves = given$curves,
                                             surfaces = given$surfaces, ProcD = FALSE,
                                             print.progress = FALSE))
saveRDS(list(coords = slid$coords, seconds = time[["user.self"]]), paste0(file, "-slid.rds"))
