# Bias and spread of k2 at the ridge of known surfaces (section 5.1 of the paper), over radius, mesh
# and noise. Sourced by tools/studies.R. Lengths are in the ridge's own radius of curvature: k2 = -1
# along the crest u = 0.
sys.source("tests/testthat/helper-surfaces.R", environment())

bias_setting <- c("surface", "spacing", "noise", "radius", "order")

ridge_forms <- function(half = 1.8) {
  graph <- function(z, x = quote(u)) {
    list(x = x, y = quote(v), z = z, u = c(-half, half), v = c(-half, half))
  }
  list(
    "parabola" = graph(quote(-u^2 / 2)),
    "bent parabola" = graph(quote(-u^2 / 2), quote(u + 0.25 * v^3)),
    "cylinder" = list(x = quote(sin(u)), y = quote(v), z = quote(cos(u)), u = c(-1.5, 1.5),
                      v = c(-half, half)),
    "torus" = list(x = quote((2 + cos(u)) * sin(v / 3)), y = quote(sin(u)),
                   z = quote((2 + cos(u)) * cos(v / 3)), u = c(-half, half), v = c(-half, half)),
    "rounded edge" = graph(quote(1 - sqrt(1 + u^2))),
    "Gaussian" = graph(quote(exp(-u^2 / 2)))
  )
}

# Error of k2, as a share of it, at the ridge's vertices for every radius and order: one mesh.
ridge_errors <- function(form, spacing, noise, seed, radii, orders, part = 0.5) {
  made <- closed_form_mesh(form, spacing, noise, seed)
  on_ridge <- which(abs(made$uv$u) < spacing / 2 & abs(made$uv$v) < part)
  truth <- made$truth$k2[on_ridge]
  cells <- expand.grid(radius = radii, order = orders, stringsAsFactors = FALSE)
  errors <- lapply(seq_len(nrow(cells)), function(i) {
    found <- crestline::curvature(made$mesh, cells$radius[i], order = cells$order[i],
                                  vertices = on_ridge)$k2[on_ridge]
    100 * (found / truth - 1)
  })
  cbind(cells, seed = seed, mean = vapply(errors, mean, 0),
        square = vapply(errors, function(e) mean(e^2), 0))
}

# In per cent of k2, negative where the ridge comes out too flat: bias, its standard error over the
# meshes, and the spread of single estimates.
run_bias <- function(n, most = 10L, radii = c(0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7, 1),
                     fewest = 2) {
  orders <- c("forced", "quadratic", "adaptive cubic", "adaptive")
  forms <- ridge_forms()
  cells <- expand.grid(noise = c(0, 0.01), spacing = c(0.1, 0.05, 0.025), surface = names(forms),
                       stringsAsFactors = FALSE)[3:1]
  rows <- future.apply::future_lapply(seq_len(nrow(cells)), function(i) {
    cell <- cells[i, ]
    kept <- radii[radii >= fewest * cell$spacing * (1 - 1e-9)]
    each <- lapply(seq_len(min(n, most)), function(seed) {
      ridge_errors(forms[[cell$surface]], cell$spacing, cell$noise, seed, kept, orders)
    })
    each <- do.call(rbind, each)
    of_cell <- lapply(split(each, list(each$radius, each$order), drop = TRUE), function(one) {
      data.frame(surface = cell$surface, spacing = cell$spacing, noise = cell$noise,
                 radius = one$radius[1], order = one$order[1], n = nrow(one), bias = mean(one$mean),
                 bias_error = stats::sd(one$mean) / sqrt(nrow(one)),
                 spread = sqrt(mean(one$square) - mean(one$mean)^2))
    })
    do.call(rbind, of_cell)
  }, future.chunk.size = 1, future.packages = "crestline", future.seed = NULL)
  out <- do.call(rbind, rows)
  rownames(out) <- NULL
  out
}
