# Crests that bow and crests that close: bench/bowed.md.
#   Rscript bench/bowed.R [open|closed|skull|stops|tooth|faces|cost] [seeds]
# "tooth" needs the data of the package doolkit: its source tarball, unpacked where DOOLKIT says.
suppressMessages(library(crestline))
options(rgl.useNULL = TRUE)
part <- c(commandArgs(TRUE), "open")[1]
seeds <- as.integer(c(commandArgs(TRUE)[-1], 4)[1])

xyz_of <- function(x) as.matrix(as.data.frame(x)[c("x", "y", "z")])
# Distance of points from a line, which is made dense: by the nearest of 50,000 places of it.
dense <- function(path, n = 50000) {
  at <- seq(0, attr(path, "length"), length.out = n)
  sapply(c("x", "y", "z"), function(axis) approx(path$s, path[[axis]], at, ties = "ordered")$y)
}
off <- function(x, truth) {
  line <- if (is.matrix(truth)) truth else dense(truth)
  Rvcg::vcgKDtree(line, xyz_of(x), k = 1)$distance
}
quiet <- function(code) suppressWarnings(code)

# A height field on an irregular mesh of spacing 1 (or `spacing`).
field <- function(height, half, spacing = 1, noise = 0, seed = 1) {
  set.seed(seed)
  at <- seq(-half, half, spacing)
  n <- length(at)
  g <- as.matrix(expand.grid(at, at))
  inner <- abs(g[, 1]) < half & abs(g[, 2]) < half
  g[inner, ] <- g[inner, ] + runif(2 * sum(inner), -0.25, 0.25) * spacing
  first <- as.vector(outer(1:(n - 1), n * (0:(n - 2)), `+`))
  it <- rbind(cbind(first, first + 1, first + n + 1), cbind(first, first + n + 1, first + n))
  z <- height(g) + rnorm(nrow(g), 0, noise)
  structure(list(vb = rbind(t(g), z, 1), it = t(it)), class = "mesh3d")
}

# A crest of given height and width (Gauss) over a plane curve.
crest <- function(curve, height = 4, sigma = 4) {
  function(g) {
    d <- Rvcg::vcgKDtree(cbind(curve, 0), cbind(g, 0), k = 1)$distance
    height * exp(-as.vector(d)^2 / (2 * sigma^2))
  }
}

# A band of revolution: profile of t in [-1, 1], out and up, noise along the normals.
revolved <- function(profile, length, spacing = 1, noise = 0, seed = 1) {
  set.seed(seed)
  t <- seq(-1, 1, length.out = ceiling(length / spacing) + 1)
  p <- profile(t)
  k <- ceiling(2 * pi * max(p[, 1]) / spacing)
  g <- expand.grid(j = seq_len(k), i = seq_along(t))
  turn <- 2 * pi * (g$j + 0.5 * (g$i %% 2)) / k
  vb <- rbind(p[g$i, 1] * cos(turn), p[g$i, 1] * sin(turn), p[g$i, 2], 1)
  id <- function(j, i) (j - 1) %% k + 1 + (i - 1) * k
  q <- expand.grid(j = seq_len(k), i = seq_len(length(t) - 1))
  it <- rbind(cbind(id(q$j, q$i), id(q$j + 1, q$i), id(q$j + 1, q$i + 1)),
              cbind(id(q$j, q$i), id(q$j + 1, q$i + 1), id(q$j, q$i + 1)))
  mesh <- structure(list(vb = vb, it = t(it)), class = "mesh3d")
  mesh <- Rvcg::vcgUpdateNormals(mesh, silent = TRUE)
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] + mesh$normals[1:3, ] * rep(rnorm(ncol(vb), 0, noise), each = 3)
  mesh["normals"] <- NULL
  mesh
}

turn <- seq(0, 2 * pi, length.out = 8000)
circle <- function(r) cbind(r * cos(turn), r * sin(turn))
trefoil <- (40 * (1 + 0.2 * cos(3 * turn))) * cbind(cos(turn), sin(turn))
three_quarters <- circle(40)[turn <= 1.5 * pi, ]

marked <- function(mesh, marks) {
  specimen(mesh, marks, id = "simulated", outward = "keep", tolerance = 0.25)
}
radius <- 5
ridge <- function(on, from, to, ...) {
  quiet(ridge_curve(on, from, to, "ridge", radius = radius, width = 1.5 * radius, n = 60, ...))
}

if (part == "open") {
  rival <- 28 / 40 * three_quarters
  truth <- cbind(three_quarters, 4)
  ends <- truth[c(1, nrow(truth)), ]
  rownames(ends) <- c("a", "b")
  rows <- lapply(list(none = 0, weaker = 3, stronger = 5), function(height) {
    lapply(c(0, 0.1), function(noise) {
      runs <- sapply(seq_len(seeds), function(seed) {
        beside <- if (height > 0) crest(rival, height) else function(g) 0
        surface <- function(g) pmax(crest(three_quarters)(g), beside(g))
        on <- marked(field(surface, 65, 1, noise, seed), ends)
        plane <- ridge(on, "a", "b", settings = ridge_settings(longest = Inf))
        path <- quiet(reference_path(on, "a", "b", "ridge", radius = radius, path = "crest"))
        fit <- ridge(on, "a", "b", path = "crest")
        c(plane = mean(off(plane$points, truth)), path = mean(off(path, truth)),
          fit = mean(off(fit$points, truth)), competing = attr(path, "competing"),
          determined = fit$determined)
      })
      data.frame(noise = noise, t(rowMeans(runs)), worst_path = max(runs["path", ]),
                 worst_fit = max(runs["fit", ]))
    })
  })
  for (name in names(rows)) {
    cat("rival:", name, "\n")
    print(do.call(rbind, rows[[name]]), digits = 3, row.names = FALSE)
  }
}

if (part == "closed") {
  at_angle <- function(curve, angle) {
    curve[sapply(angle, function(a) which.min(abs((turn - a + pi) %% (2 * pi) - pi))), ]
  }
  rim <- circle(40)
  shapes <- list(
    ring = list(curve = cbind(rim, 4), mesh = function(...) field(crest(rim), 60, 1, ...)),
    trefoil = list(curve = cbind(trefoil, 4),
                   mesh = function(...) field(crest(trefoil), 65, 1, ...)),
    cone = list(curve = cbind(rim, 0), mesh = function(...) {
      revolved(function(t) cbind(46 - sqrt((18 * t)^2 + 36), 16 * t), 50, 1, ...)
    }),
    torus = list(curve = cbind(rim, 0), mesh = function(...) {
      revolved(function(t) cbind(28 + 12 * cos(pi * t * 0.98), 6 * sin(pi * t * 0.98)), 58, 1, ...)
    })
  )
  places <- 4
  for (name in names(shapes)) for (noise in c(0, 0.1)) {
    own <- shapes[[name]]
    runs <- sapply(seq_len(seeds), function(seed) {
      first <- 0.3 + 2 * pi * (0:(places - 1)) / places / 2
      marks <- rbind(at_angle(own$curve, first), at_angle(own$curve, first + pi))
      rownames(marks) <- c(paste0("a", 1:places), paste0("b", 1:places))
      on <- marked(own$mesh(noise = noise, seed = seed), marks)
      curves <- lapply(1:places, function(i) {
        ridge(on, paste0("a", i), paste0("a", i), via = paste0("b", i))
      })
      c(off = mean(off(curves[[1]]$points, own$curve)),
        same = max(sapply(curves[-1], function(x) max(off(x$path, curves[[1]]$path)))),
        mean_same = max(sapply(curves[-1], function(x) mean(off(x$path, curves[[1]]$path)))),
        se = curves[[1]]$se, determined = mean(sapply(curves, `[[`, "determined")))
    })
    cat(sprintf(paste("%-8s noise %.2f: off the crest %.3f (worst of %d %.3f); stops moved round:",
                      "greatest %.3f, greatest mean %.3f; determined %.2f\n"), name, noise,
                mean(runs["off", ]), seeds, max(runs["off", ]), max(runs["same", ]),
                max(runs["mean_same", ]), mean(runs["determined", ])))
  }
}

skull_marks <- function() {
  read_landmarks(system.file("extdata", "skull_landmarks.csv", package = "crestline"))
}
skull <- function(marks = skull_marks()) {
  data(boneData, package = "Morpho", envir = environment())
  specimen(skull_0144_ch_fe.mesh, marks, id = "skull", tolerance = 0.25)
}
outlines <- list(
  `orbit left` = list(from = "soL", two = "orL", four = c("mfL", "orL", "ecL"), radius = c(4, 6)),
  `orbit right` = list(from = "soR", two = "orR", four = c("ecR", "orR", "mfR"), radius = c(4, 6)),
  aperture = list(from = "rhi", two = "ac", four = c("alL", "ac", "alR"), radius = c(2, 3))
)
outline <- function(on, own, via, radius) {
  quiet(ridge_curve(on, own$from, own$from, "ridge", radius = radius, width = 1.5 * radius, n = 40,
                    via = via))
}
described <- function(curve) {
  competing <- attr(curve$reference, "competing")
  sprintf("length %.1f, %s, competing %.2f%s", curve$length,
          if (isTRUE(curve$determined)) "determined" else "NOT determined", competing,
          if (is.na(curve$reason)) "" else paste0(" (", curve$reason, ")"))
}

if (part == "skull") {
  on <- skull()
  scheme <- read_scheme(system.file("extdata", "skull_scheme", package = "crestline"))
  shape <- quiet(fit_shape(on, scheme, ridge_settings(error = FALSE), progress = FALSE))
  pieces <- list(`orbit left` = "rim.*left", `orbit right` = "rim.*right", aperture = "aperture")
  for (name in names(outlines)) for (radius in outlines[[name]]$radius) {
    own <- outlines[[name]]
    two <- outline(on, own, own$two, radius)
    four <- outline(on, own, own$four, radius)
    some <- shape$paths[grep(pieces[[name]], names(shape$paths))]
    from_pieces <- off(two$points, do.call(rbind, lapply(some, dense)))
    cat(sprintf(paste("%s, radius %g: two from four %.2f at most, %.2f mean; from the scheme's",
                      "pieces %.2f\n"),
                name, radius, max(off(two$path, four$path)), mean(off(two$path, four$path)),
                mean(from_pieces)))
    cat("  two:  ", described(two), "\n  four: ", described(four), "\n")
  }
}

if (part == "stops") {
  on <- skull()
  cat("unspread stops\n")
  unspread <- list(c("soL", "mfL"), c("soL", "ecL"), c("orR", "ecR"), c("mfR", "orR"),
                   c("rhi", "alL"), c("ac", "alR"), c("soL", "mfL", "ecL"), c("orR", "mfR", "ecR"))
  for (stops in unspread) {
    own <- list(from = stops[1])
    small <- any(c("rhi", "ac") %in% stops)
    curve <- outline(on, own, stops[-1], if (small) 3 else 6)
    cat(" ", toString(stops), ":", described(curve), "\n")
  }
  marks <- skull_marks()
  for (by in c(2, 3.5)) for (name in names(outlines)) {
    own <- outlines[[name]]
    good <- outline(on, own, own$two, own$radius[2])
    set.seed(20)
    for (i in seq_len(seeds)) {
      step <- matrix(rnorm(length(marks), 0, by), nrow(marks))
      moved <- skull(xyz_of(locate(on$mesh, marks + step)) |> `rownames<-`(rownames(marks)))
      curve <- outline(moved, own, own$two, own$radius[2])
      away <- max(off(curve$path, good$path))
      cat(sprintf("%s, stops %.1f off, draw %d: %.2f from the right one; %s\n", name, by, i, away,
                  described(curve)))
    }
  }
}

if (part == "tooth") {
  # Four dentine horns: highest places of the enamel-dentine junction of a molar.
  load(file.path(Sys.getenv("DOOLKIT"), "data", "dkpongo.rda"))
  tooth <- dkpongo$EDJ
  horns <- rbind(a = c(-3.191, -2.198, 6.915), b = c(-5.043, 2.446, 6.795),
                 c = c(3.417, -3.461, 6.209), d = c(3.696, 2.418, 6.440))
  on <- specimen(tooth, horns, id = "tooth", tolerance = 0.1)
  rho <- function(curve, radius = 0.4) {
    sprintf("rho %.2f, length %.2f, %s", radius * curve$strength, curve$length,
            if (isTRUE(curve$determined)) "determined" else
              paste0("NOT determined (", curve$reason, ")"))
  }
  for (chord in c("ab", "bd", "dc", "ca", "ad")) {
    ends <- strsplit(chord, "")[[1]]
    for (path in c("plane", "crest")) {
      curve <- quiet(ridge_curve(on, ends[1], ends[2], "ridge", radius = 0.4, width = 0.6, n = 40,
                                 path = path))
      cat(chord, sprintf("%-5s", path), rho(curve), sprintf(
        "competing %.2f\n", c(attr(curve$reference, "competing"), NA)[1]
      ))
    }
  }
  for (via in list(c("b", "d", "c"), c("b", "c"), c("d", "c"))) {
    ring <- quiet(ridge_curve(on, "a", "a", "ridge", radius = 0.4, width = 0.6, n = 60, via = via))
    cat("ring", toString(c("a", via)), rho(ring), "\n")
  }
}

if (part == "faces") {
  shared <- Sys.getenv("CRESTLINE_SHARED")
  data(humface, package = "Rvcg")
  file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
  faces <- list(humface = specimen(humface, read_landmarks(file), id = "humface"))
  for (face in faces) {
    shape <- quiet(fit_shape(face, face_scheme(), progress = FALSE))
    cat(face$id, rlang::hash(lapply(shape$points[c("x", "y", "z", "face", "w1", "w2", "se")],
                                    as.numeric)), "\n")
  }
}

if (part == "cost") {
  rim <- circle(40)
  marks <- rbind(a = c(rim[1, ], 4), b = c(rim[4000, ], 4), c = c(rim[6000, ], 4))
  on <- marked(field(crest(rim), 65, 0.75, 0.02), marks)
  curved <- curvature(on, radius, "adaptive cubic")
  timed <- function(code) {
    expression <- substitute(code)
    frame <- parent.frame()
    each <- replicate(5, system.time(quiet(eval(expression, frame)))[["user.self"]])
    1000 * median(each)
  }
  cat(ncol(on$mesh$vb), "vertices\n")
  cat(sprintf("crest path %.0f ms\n", timed(
    reference_path(on, "a", "c", "ridge", radius, curvature = curved, path = "crest"))))
  cat(sprintf("loop %.0f ms\n", timed(
    reference_path(on, "a", "a", "ridge", radius, curvature = curved, via = "b"))))
  cat(sprintf("closed curve, loop and fit %.0f ms\n", timed(
    ridge(on, "a", "a", via = "b", curvature = curved))))
  cat(sprintf("curvature of all vertices %.0f ms\n", timed(
    curvature(on, radius, "adaptive cubic"))))
}
