# Statistics of a sample in files: time, memory, and the same numbers as in memory.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/blocks.R [cohort] [all] [model] [same] [n]
#     [folder]
#
# The points are made: some 920 points of the 23 dense meshes of simpop, their components
# resampled, with 0.3 mm of independent noise, a pose of its own for each face, and in the second
# half a step of 1 mm. cohort: n faces (50,000 if not given) written in blocks of 500, opened,
# aligned, 50 components, two groups with 1,000 permutations, a linear model of two terms. Prints
# processor and elapsed seconds, and the peak of the process. same: 500 faces in files against the
# same in memory. The folder (a temporary one if not given) is removed.

library(crestline)

inner <- function(name) getFromNamespace(name, "crestline")
quiet <- function(code) suppressWarnings(suppressMessages(code))
args <- commandArgs(TRUE)
wanted <- intersect(args, c("cohort", "same", "model", "all"))
if (!length(wanted)) wanted <- c("same", "cohort")
n <- as.integer(c(grep("^[0-9]+$", args, value = TRUE), 50000)[1])
folder <- c(setdiff(args, c(wanted, n)), tempfile("cohort-"))[1]

# Mean (k x 3, mm), components (3k x 22) times their standard deviations, triangles, of the points.
real_sample <- function() {
  shared <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
  ids <- unique(read.csv(file.path(shared, "landmarks.csv"))$id)
  meshes <- lapply(file.path(shared, paste0(ids, ".ply")), Rvcg::vcgImport, readcolor = FALSE,
                   silent = TRUE)
  coarse <- Rvcg::vcgQEdecim(meshes[[1]], tarface = 1704, silent = TRUE)
  at <- unique(Rvcg::vcgKDtree(meshes[[1]], t(coarse$vb[1:3, ]), k = 1)$index[, 1])
  own <- Rvcg::vcgKDtree(t(meshes[[1]]$vb[1:3, at]), t(coarse$vb[1:3, ]), k = 1)$index[, 1]
  it <- matrix(own[coarse$it], 3)
  it <- it[, apply(it, 2, anyDuplicated) == 0]
  points <- vapply(meshes, function(mesh) t(mesh$vb[1:3, at]), matrix(0, length(at), 3))
  aligned <- quiet(align(points, scale = FALSE))
  pca <- shape_pca(aligned)
  list(mean = aligned$mean, parts = pca$rotation * rep(pca$sdev, each = nrow(pca$rotation)),
       it = it)
}

# Some faces; those that `moved` says with a step of 1 mm at the 50 points nearest to the first.
faces <- function(real, ids, moved, seed) {
  set.seed(seed)
  k <- nrow(real$mean)
  m <- length(ids)
  near <- order(rowSums(sweep(real$mean, 2, real$mean[1, ])^2))[1:50]
  flat <- as.vector(real$mean) + real$parts %*% matrix(rnorm(m * ncol(real$parts)), ncol = m) +
    rnorm(3 * k * m, sd = 0.3)
  x <- array(flat, c(k, 3, m), list(paste0("p", seq_len(k)), c("x", "y", "z"), ids))
  x[near, 3, moved] <- x[near, 3, moved] + 1
  for (i in seq_len(m)) {
    turn <- qr.Q(qr(diag(3) + matrix(rnorm(9, sd = 0.1), 3)))
    x[, , i] <- sweep(x[, , i] %*% (turn * sign(det(turn))), 2, rnorm(3, sd = 20), `+`)
  }
  x
}

write_faces <- function(real, n, folder, block = 500) {
  ids <- sprintf("face%05d", seq_len(n))
  at <- (seq_len(n) - 1L) %/% block + 1L
  dir.create(folder)
  for (i in unique(at)) {
    x <- faces(real, ids[at == i], which(at == i) > n / 2, i)
    points <- inner("points_of_array")(x)
    inner("write_block")(x, points, folder, i)
  }
  inner("write_sample_head")(
    list(ids = ids, block = at, points = points, axes = c("x", "y", "z"), triangles = real$it,
         template = NULL, provenance = list()), folder
  )
}

row <- function(what, code) {
  time <- system.time(code)
  cat(sprintf("%-44s %6.1f processor s, %6.1f elapsed; %s\n", what, sum(time[1:2]), time[3],
              peak()))
}
peak <- function() {
  status <- "/proc/self/status"
  if (!file.exists(status)) return("")
  sub("VmHWM:\\s+", "peak ", grep("VmHWM", readLines(status), value = TRUE))
}

cohort <- function() {
  real <- real_sample()
  row(sprintf("%d faces of %d points made and written", n, nrow(real$mean)),
      write_faces(real, n, folder))
  row("opened", stored <- open_sample(folder))
  row("aligned", aligned <- quiet(align(stored)))
  cat("rounds:", length(aligned$moved), "\n")
  row("50 components", pca <- shape_pca(aligned, components = 50))
  group <- stats::setNames(rep(c("a", "b"), c(ceiling(n / 2), floor(n / 2))), names(aligned))
  whole <- comparison_settings()$tests
  for (tests in c(list(c("size", "shape", "points")), if ("all" %in% wanted) list(whole))) {
    what <- if (length(tests) > 3) "all tests" else "size, shape, map"
    row(paste("two groups, 1,000 permutations:", what), found <- compare_groups(
      aligned, group, seed = 1, settings = comparison_settings(tests = tests)
    ))
  }
  print(found)
  if ("model" %in% wanted) {
    data <- data.frame(id = names(aligned), sex = group, age = seq_len(n) %% 60)
    row("shape_lm(), two terms, all tests", shape_lm(aligned, ~ sex + age, data, seed = 1))
  }
  unlink(c(folder, attr(aligned, "files")$dir), recursive = TRUE)
}

# Greatest difference of each field, as a share of its greatest value.
same <- function() {
  x <- faces(real <- real_sample(), sprintf("face%03d", 1:500), 1:500 > 250, 1)
  folder <- tempfile("blocks-")
  stored <- write_blocks(x, folder, 70, triangles = real$it)
  memory <- align(x, triangles = real$it)
  files <- align(stored)
  off <- function(what, a, b) {
    own <- mapply(function(a, b) if (is.numeric(a)) max(abs(a - b), 0, na.rm = TRUE) /
                    max(abs(b), 1e-300, na.rm = TRUE) else 0, as.list(a), as.list(b))
    cat(sprintf("%-34s %.1e\n", what, max(own)))
  }
  cat("\n500 faces in files against in memory, greatest relative difference:\n")
  off("mean and sizes", list(files$mean, files$size), list(memory$mean, memory$size))
  for (count in list(NULL, 50)) {
    fields <- c("x", "sdev", "rotation", "share")
    off(paste("components,", if (is.null(count)) "all" else count),
        shape_pca(files, components = count)[fields],
        shape_pca(memory, components = count)[fields])
  }
  group <- stats::setNames(rep(c("a", "b"), each = 250), names(memory))
  each <- lapply(list(files, memory), compare_groups, group, seed = 1)
  off("compare_groups(), table of tests", each[[1]]$tests, each[[2]]$tests)
  off("compare_groups(), points", each[[1]]$points, each[[2]]$points)
  data <- data.frame(id = names(memory), sex = group, age = 1:500 %% 60)
  each <- lapply(list(files, memory), shape_lm, ~ sex + age, data, seed = 1)
  off("shape_lm(), table of tests", each[[1]]$tests, each[[2]]$tests)
  off("shape_lm(), points", each[[1]]$points, each[[2]]$points)
  unlink(folder, recursive = TRUE)
}

if ("same" %in% wanted) same()
if ("cohort" %in% wanted) cohort()
