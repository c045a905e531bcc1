# Least distance (CIE 1976, Lab) of any two colours as seen with normal vision, without red and
# without green cones: Machado, Oliveira and Fernandes (2009), severity 1, in linear light.
least_difference <- function(colours) {
  vision <- list(
    normal = diag(3),
    protan = rbind(c(0.152286, 1.052583, -0.204868), c(0.114503, 0.786281, 0.099216),
                   c(-0.003882, -0.048116, 1.051998)),
    deutan = rbind(c(0.367322, 0.860646, -0.227968), c(0.280085, 0.672501, 0.047413),
                   c(-0.011820, 0.042940, 0.968881))
  )
  share <- grDevices::col2rgb(colours) / 255
  light <- t(ifelse(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055)^2.4))
  vapply(vision, function(m) {
    seen <- pmin(pmax(light %*% t(m), 0), 1)
    shown <- ifelse(seen <= 0.0031308, 12.92 * seen, 1.055 * seen^(1 / 2.4) - 0.055)
    min(stats::dist(grDevices::convertColor(shown, "sRGB", "Lab")))
  }, 0)
}
