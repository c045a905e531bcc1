# The patch of an ear by which find_landmarks() places the tragion where a scan has ears: points of
# the left ear of Rvcg's `dummyhead` (S. Schlager, GPL), in the frame of the template of the face.
#
#   Rscript data-raw/ear-patch.R      (crestline being installed)
#
# The template of the face is laid on the head by find_landmarks()'s own steps. What lies within 40
# mm of the ear's middle is thinned to cells of 4 mm. Columns: position and normal, the principal
# curvatures in balls of 8 mm. The first row is the tragion, as placed on dummyhead.

library(crestline)
own <- asNamespace("crestline")
utils::data("dummyhead", package = "Rvcg")
file <- system.file("extdata", "dummyhead_landmarks.csv", package = "crestline")
at <- read_landmarks(file)
head <- suppressWarnings(specimen(dummyhead.mesh, at, id = "dummyhead", tolerance = 0.25))
template <- face_template()
settings <- find_settings()
prepared <- own$prepared_template(template, settings, 1L)
laid <- own$laid_template(prepared, template, head, settings, 1L)
cloud <- own$cloud_in_frame(laid$cloud, laid$pose)
ear <- own$into_frame(at[c("tL", "oiL"), ], laid)
middle <- colMeans(ear) + c(0, 5, -12)
near <- which(sqrt(colSums((cloud$xyz - middle)^2)) < 40 & !cloud$border)
near <- near[own$cell_vertices(t(cloud$xyz[, near]), 4)]
rows <- cbind(t(cloud$xyz[, near]), t(cloud$normal[, near]), cloud$k1[near], cloud$k2[near])
table <- as.data.frame(rbind(c(ear[1, ], rep(NA, 5)), rows))
names(table) <- c("x", "y", "z", "nx", "ny", "nz", "k1", "k2")
table[1:3] <- round(table[1:3], 1)
table[4:6] <- round(table[4:6], 2)
table[7:8] <- round(table[7:8], 3)
write.csv(table, "inst/extdata/face_template/ear.csv", row.names = FALSE, na = "")
