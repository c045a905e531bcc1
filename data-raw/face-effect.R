# The places of inst/extdata/face_effect.csv: made once from the curves of humface, by this script.
#
#   Rscript data-raw/face-effect.R
#
# Brow: the 18th of 28 points of each brow ridge, 26 mm from the nearest landmark. Cheek: the place
# of the mesh nearest to the middle between the 11th point of the cheek-nose curve and the 12th of
# the cheek-lip curve, 13 mm from either and 30 mm from the nearest landmark. No radius reaches a
# landmark.

library(crestline)
data(humface, package = "Rvcg")
face <- specimen(humface, read_landmarks(file.path("inst", "extdata", "humface_landmarks.csv")),
                 id = "humface")
curves <- coords(fit_shape(face, face_scheme(), ridge_settings(error = FALSE)), "curves")
side <- c("left", "right")
cheek <- (curves[paste("cheek-nose", side, 11), ] + curves[paste("cheek-lip", side, 12), ]) / 2
places <- crestline:::surface_points(face$mesh,
                                     rbind(curves[paste("brow ridge", side, 18), ], cheek))
table <- data.frame(part = rep(c("brow", "cheek"), each = 2), round(places[c("x", "y", "z")], 3),
                    radius = rep(c(26, 24), each = 2), share = rep(c(1, -1), each = 2))
write.csv(table, file.path("inst", "extdata", "face_effect.csv"), row.names = FALSE, quote = FALSE)
