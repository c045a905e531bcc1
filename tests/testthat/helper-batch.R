# What the tests of batches share: three balls, each a little wider, as specimens and as files.

# Specimens of the quad's ball, each a little wider; written as PLY with their landmarks beside
# them.
batch_specimens <- function(n = 3) {
  lapply(seq_len(n), function(i) {
    wide <- function(mesh) {
      mesh$vb[1, ] <- (1 + i / 50) * mesh$vb[1, ]
      mesh
    }
    one <- quad_specimen(wide, quad_corners() %*% diag(c(1 + i / 50, 1, 1)))
    one$id <- paste("ball", i)
    one
  })
}

batch_folder <- function(specimens = batch_specimens()) {
  dir <- tempfile("batch-")
  dir.create(dir)
  for (one in specimens) {
    write_mesh(one, file.path(dir, paste0(one$id, ".ply")))
    write_landmarks(one, file.path(dir, paste0(one$id, ".csv")))
  }
  dir
}

meshes_in <- function(dir) list.files(dir, "[.]ply$", full.names = TRUE)

skip_without_futures <- function() {
  for (package in c("future", "progressr")) testthat::skip_if_not_installed(package)
}

same_points <- function(a, b, ...) {
  for (level in c("landmarks", "curves", "surface")) {
    expect_equal(coords(a, level), coords(b, level), ...)
  }
}

# A scheme of two curves of the ball, quickly measured.
edge_scheme <- function(n = 5) {
  curves <- data.frame(curve = c("bottom", "top"), from = c("a", "d"), to = c("b", "c"),
                       kind = "plane", n = n)
  curve_scheme(data.frame(landmark = c("a", "b", "c", "d")), curves, name = "edges")
}
