# The scheme of a molar of vignette("own-object"): horns by suggest_landmarks(), crests between them
# by plane cuts and along the crest. Writes the picture that the vignette keeps.
#   Rscript bench/molar.R [picture]
# Needs the package doolkit (CRAN), or its file dkpongo.rda named by DKPONGO.
suppressMessages(library(crestline))
options(rgl.useNULL = TRUE, width = 100)
picture <- c(commandArgs(TRUE), tempfile(fileext = ".jpg"))[1]
if (nzchar(Sys.getenv("DKPONGO"))) load(Sys.getenv("DKPONGO")) else
  data("dkpongo", package = "doolkit")
tooth <- suppressWarnings(specimen(dkpongo$EDJ, id = "molar"))
time <- system.time(suggested <- suggest_landmarks(tooth, radius = 0.4, n = 4, kinds = "cap"))
print(suggested)
cat(sprintf("suggested in %.1f s\n", time[["user.self"]]))
suggested$landmark <- c("a", "b", "c", "d")
tooth <- suppressWarnings(specimen(dkpongo$EDJ, suggested, id = "molar"))
curves <- data.frame(
  curve = c("a-b", "b-d", "d-c", "c-a", "a-d"), from = c("a", "b", "d", "c", "a"),
  to = c("b", "d", "c", "a", "d"), kind = "ridge", radius = 0.4, width = 0.6, n = 25
)
tables <- function(curves) curve_scheme(data.frame(landmark = letters[1:4]), curves, name = "molar")
plain <- check_scheme(tables(cbind(curves, path = "plane")), tooth)
crest <- check_scheme(tables(cbind(curves, path = "crest")), tooth)
print(plain)
print(crest)
both <- data.frame(curve = curves$curve, plane = 0.4 * plain$strength, crest = 0.4 * crest$strength)
print(both, digits = 3)
saveRDS(list(plain = plain, crest = crest), paste0(picture, ".rds"))
jpeg(picture, 460, 400, quality = 45)
par(mar = rep(0, 4))
scene <- plot(tooth, "plain", view = diag(3), engine = "picture", labels = TRUE)
for (path in attr(plain, "shape")$paths) draw_lines(scene, path, "#D08000", 1.5, halo = "white")
for (path in attr(crest, "shape")$paths) draw_lines(scene, path, "#A0002A", 2.5, halo = "white")
invisible(dev.off())
cat(picture, file.size(picture), "bytes\n")
