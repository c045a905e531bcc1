# Closed forms: the truth is exact (helper-surfaces.R).

# Mean over the seven surfaces of the median and 95th percentile of the errors, columns k1, index,
# direction.
seven_errors <- function(order = "adaptive", noise = 0, seed = 1,
                         at = function(margin) margin >= 10) {
  each <- lapply(closed_forms(), function(form) {
    built <- closed_form_mesh(form, noise = noise, seed = seed)
    errors <- curvature_errors(curvature(built$mesh, 10, order), built$truth,
                               which(at(built$margin)))
    vapply(errors, stats::quantile, numeric(2), c(0.5, 0.95), na.rm = TRUE, names = FALSE)
  })
  apply(simplify2array(each), 1:2, mean, na.rm = TRUE)
}

# Two parallel bent sheets, `apart` from each other, not joined.
two_sheets <- function(apart = 1) {
  sheet <- closed_form_mesh(closed_forms()$paraboloid, jitter = 0.2)
  n <- ncol(sheet$mesh$vb)
  second <- sheet$mesh$vb + c(0, 0, apart, 0)
  list(mesh = rgl::mesh3d(vertices = cbind(sheet$mesh$vb, second),
                          triangles = cbind(sheet$mesh$it, sheet$mesh$it + n)),
       single = sheet$mesh, n = n)
}

# Vertices reached over edges without leaving the ball, counted by plain breadth-first search.
connected_ball <- function(mesh, vertex, radius) {
  inside <- which(colSums((mesh$vb[1:3, ] - mesh$vb[1:3, vertex])^2) <= radius^2)
  sides <- cbind(mesh$it[1:2, ], mesh$it[2:3, ], mesh$it[c(3, 1), ])
  sides <- sides[, sides[1, ] %in% inside & sides[2, ] %in% inside, drop = FALSE]
  reached <- vertex
  repeat {
    more <- c(sides[2, sides[1, ] %in% reached], sides[1, sides[2, ] %in% reached])
    more <- setdiff(more, reached)
    if (!length(more)) return(length(reached))
    reached <- c(reached, more)
  }
}

test_that("clean closed forms: the bounds of the adaptive and of every plain order", {
  adaptive <- seven_errors()
  expect_lte(adaptive[1, "k1"], 0.3)
  expect_lte(adaptive[1, "direction"], 0.2)
  expect_lte(seven_errors("quartic")[1, "k1"], 0.3)
  expect_lte(seven_errors("cubic")[1, "k1"], 1.9)
  expect_lte(seven_errors("quadratic")[1, "k1"], 2.3)
  forced <- seven_errors("forced")[1, "k1"]
  expect_lte(forced, 2.3)
  expect_gt(forced, adaptive[1, "k1"])
})

test_that("noise of 0.1: within the bounds inside and at the border, the forced fit is not", {
  over_seeds <- function(...) {
    Reduce(`+`, lapply(1:3, function(seed) seven_errors(noise = 0.1, seed = seed, ...))) / 3
  }
  interior <- over_seeds()
  expect_lte(interior[1, "k1"], 2.4)
  expect_lte(interior[2, "k1"], 7.2)
  expect_lte(interior[1, "index"], 0.009)
  expect_lte(interior[2, "index"], 0.026)
  expect_lte(interior[1, "direction"], 0.6)
  expect_lte(interior[2, "direction"], 2.2)
  border <- over_seeds(at = function(margin) margin < 1)
  expect_lte(border[1, "k1"], 8.5)
  expect_lte(border[2, "k1"], 30)
  expect_gt(seven_errors("forced", noise = 0.1)[1, "k1"], 2 * interior[1, "k1"])
})

test_that("a sphere from outside is a cap with both curvatures -1 / R, inside out a cup", {
  sphere <- ball()
  sphere$vb[1:3, ] <- 40 * sphere$vb[1:3, ]
  curved <- curvature(sphere, 12)
  expect_equal(range(curved$k1, curved$k2), c(-1, -1) / 40, tolerance = 1e-3)
  sphere$it <- sphere$it[c(1, 3, 2), ]
  inside <- curvature(sphere, 12)
  expect_equal(range(inside$k1, inside$k2), c(1, 1) / 40, tolerance = 1e-3)
  expect_equal(inside$normal, -curved$normal, tolerance = 1e-6)
})

test_that("a valley has k1 > 0 across it, a ridge k2 < 0", {
  valley <- closed_form_mesh(list(x = quote(u), y = quote(v), z = quote(v^2 / 50), u = c(-15, 15),
                                  v = c(-15, 15)))
  at <- which.min(colSums(valley$mesh$vb[1:2, ]^2))
  curved <- curvature(valley$mesh, 6, vertices = at)
  expect_equal(curved$k1[at], valley$truth$k1[at], tolerance = 1e-3)
  expect_lt(abs(curved$k2[at]), 1e-5)
  expect_gt(abs(curved$direction1[at, 2]), 0.999)
  ridge <- valley$mesh
  ridge$vb[3, ] <- -ridge$vb[3, ]
  turned <- curvature(ridge, 6, vertices = at)
  expect_equal(turned$k2[at], -curved$k1[at], tolerance = 1e-9)
  expect_gt(abs(turned$direction2[at, 2]), 0.999)
})

test_that("directions and normal are orthonormal and normals agree with the surface's", {
  built <- closed_form_mesh(closed_forms()$bumpy, noise = 0.05)
  curved <- curvature(built$mesh, 8)
  frame <- list(curved$direction1, curved$direction2, curved$normal)
  for (i in 1:3) for (j in i:3) {
    expect_lt(max(abs(rowSums(frame[[i]] * frame[[j]]) - (i == j))), 1e-10)
  }
  expect_gt(min(rowSums(curved$normal * built$truth$normal)), 0.97)
  expect_true(all(curved$k1 >= curved$k2))
})

test_that("chosen vertices have what all have, the rest is not asked for", {
  mesh <- closed_form_mesh(closed_forms()$monkey, noise = 0.05)$mesh
  whole <- curvature(mesh, 7)
  chosen <- c(5, 900, 2000, 3721)
  some <- curvature(mesh, 7, vertices = chosen)
  for (name in c("k1", "k2", "sigma")) {
    expect_equal(some[[name]][chosen], whole[[name]][chosen], tolerance = 1e-9)
  }
  for (name in c("order", "neighbours")) {
    expect_identical(some[[name]][chosen], whole[[name]][chosen])
  }
  expect_true(all(is.na(some$k1[-chosen])))
  expect_equal(unique(some$reason[-chosen]), "not asked for")
  expect_true(all(is.na(some$reason[chosen])))
  marked <- seq_len(ncol(mesh$vb)) %in% chosen
  expect_identical(curvature(mesh, 7, vertices = marked), some)
})

test_that("the number of threads changes nothing", {
  mesh <- closed_form_mesh(closed_forms()$torus, noise = 0.05)$mesh
  expect_identical(curvature(mesh, 6, threads = 2), curvature(mesh, 6, threads = 1))
})

test_that("sheets that are not joined do not see each other", {
  sheets <- two_sheets(apart = 1)
  both <- curvature(sheets$mesh, 8)
  alone <- curvature(sheets$single, 8)
  expect_identical(both$neighbours, rep(alone$neighbours, 2))
  expect_equal(both$k1, rep(alone$k1, 2), tolerance = 1e-7)
  expect_equal(both$k2, rep(alone$k2, 2), tolerance = 1e-7)
})

test_that("the ball holds exactly the vertices joined inside it, also where the mesh folds back", {
  scroll <- list(x = quote((6 + 0.05 * u) * cos(u / 8)), y = quote(v),
                 # sheets 2.5 apart
                 z = quote((6 + 0.05 * u) * sin(u / 8)), u = c(0, 100), v = c(-6, 6))
  mesh <- closed_form_mesh(scroll, jitter = 0.3)$mesh
  at <- with_seed(3, sort(sample(ncol(mesh$vb), 40)))
  caught <- 0
  for (radius in c(2.5, 5, 9)) {
    curved <- suppressWarnings(curvature(mesh, radius, order = "quadratic", vertices = at,
                                         points_per_term = 1, widen = 1))
    wanted <- vapply(at, connected_ball, 0L, mesh = mesh, radius = radius)
    expect_identical(curved$neighbours[at], wanted)
    plain <- vapply(at, function(v) sum(colSums((mesh$vb[1:3, ] - mesh$vb[1:3, v])^2) <= radius^2),
                    0L)
    caught <- caught + sum(plain > wanted)
  }
  expect_gt(caught, 20) # else the folds test nothing
})

test_that("every other vertex of a cell's balls is found for targets of every cell", {
  sheets <- two_sheets(apart = 0.6)
  at <- c(1, 61, sheets$n + 1, sheets$n + 1800, 1800, 2 * sheets$n)
  curved <- curvature(sheets$mesh, 4.5, vertices = at)
  expect_identical(curved$neighbours[at],
                   vapply(at, connected_ball, 0L, mesh = sheets$mesh, radius = 4.5))
})

test_that("an isolated triangle has no curvature, with the reason, and the rest goes on", {
  mesh <- closed_form_mesh(closed_forms()$saddle)$mesh
  n <- ncol(mesh$vb)
  lonely <- rbind(c(50, 51, 50), c(50, 50, 51), 0, 1)
  mesh <- rgl::mesh3d(vertices = cbind(mesh$vb, lonely), triangles = cbind(mesh$it, n + 1:3))
  curved <- curvature(mesh, 5)
  expect_true(all(is.na(curved$k1[n + 1:3])))
  expect_match(curved$reason[n + 1:3], "too few connected points")
  expect_identical(curved$neighbours[n + 1:3], rep(3L, 3))
  expect_false(anyNA(curved$k1[1:n]))
})

test_that("points on a line, and a vertex without triangles, have the other reason", {
  strip <- rbind(rep(seq_len(20), 1), 0, 0, 1)
  it <- rbind(1:18, 2:19, 3:20)
  flat <- rgl::mesh3d(vertices = cbind(strip, ball_mesh(2)$vb + c(90, 0, 0, 0)),
                      triangles = cbind(it, ball_mesh(2)$it + 20))
  expect_warning(curved <- curvature(flat, 30, vertices = 1:40), "times the size of the mesh",
                 class = "crestline_wide_radius")
  expect_match(curved$reason[1:20], "nearly in a line, or no normal")
  expect_false(anyNA(curved$k1[21:40]))
})

test_that("the order steps down where points are few, and the ball widens after that", {
  mesh <- closed_form_mesh(closed_forms()$bumpy)$mesh
  middle <- which.min(colSums(mesh$vb[1:2, ]^2))
  order_at <- function(radius, ...) {
    curvature(mesh, radius, order = "quartic", vertices = middle, ...)$order[middle]
  }
  expect_identical(order_at(5), 4L)
  expect_identical(order_at(2.4), 3L) # 16-22 points
  expect_identical(order_at(2), 2L)
  narrow <- curvature(mesh, 1.2, vertices = middle)
  expect_gt(narrow$neighbours[middle], connected_ball(mesh, middle, 1.2))
  expect_identical(narrow$neighbours[middle], connected_ball(mesh, middle, 1.2 * 1.5))
  expect_error(curvature(mesh, 1.2, vertices = middle, widen = 1), class = "crestline_error")
})

test_that("a one-sided neighbourhood is fitted with order 3 at most", {
  mesh <- closed_form_mesh(closed_forms()$bumpy)$mesh
  corner <- which.min(colSums(mesh$vb[1:2, ]))
  expect_lte(curvature(mesh, 8, vertices = corner)$order[corner], 3L)
  expect_identical(curvature(mesh, 8, vertices = corner, one_sided = 1)$order[corner], 4L)
})

test_that("shrinkage 0 is the quartic, without bound the quadratic", {
  mesh <- closed_form_mesh(closed_forms()$bumpy, noise = 0.1)$mesh
  middle <- which(colSums(mesh$vb[1:2, ]^2) < 30)
  k1 <- function(...) curvature(mesh, 6, vertices = middle, one_sided = 1, ...)$k1[middle]
  expect_equal(k1(shrinkage = 0), k1(order = "quartic"), tolerance = 1e-9)
  expect_equal(k1(shrinkage = 1e12), k1(order = "quadratic"), tolerance = 1e-9)
  expect_gt(max(abs(k1() - k1(order = "quartic"))), 1e-3)
})

test_that("the forced quadratic is that of the paper: least squares through the vertex", {
  built <- closed_form_mesh(closed_forms()$paraboloid, noise = 0.1)
  mesh <- built$mesh
  at <- which.min(colSums(mesh$vb[1:2, ]^2))
  curved <- curvature(mesh, 5, order = "forced", vertices = at)
  normal <- vertex_normals(mesh)[1:3, at]
  across <- qr.Q(qr(cbind(normal, diag(3)[, 1:2])))[, 2:3]
  near <- which(colSums((mesh$vb[1:3, ] - mesh$vb[1:3, at])^2) <= 25)
  relative <- mesh$vb[1:3, near] - mesh$vb[1:3, at]
  x <- as.vector(across[, 1] %*% relative)
  y <- as.vector(across[, 2] %*% relative)
  fit <- stats::lm.fit(cbind(x^2 / 2, x * y, y^2 / 2), as.vector(normal %*% relative))
  k <- eigen(matrix(fit$coefficients[c(1, 2, 2, 3)], 2), symmetric = TRUE)$values
  expect_equal(c(curved$k1[at], curved$k2[at]), k, tolerance = 1e-8)
  expect_equal(curved$sigma[at], sqrt(sum(fit$residuals^2) / (length(near) - 3)), tolerance = 1e-8)
})

test_that("sigma is the noise", {
  built <- closed_form_mesh(closed_forms()$saddle, noise = 0.2)
  expect_equal(stats::median(curvature(built$mesh, 8)$sigma), 0.2, tolerance = 0.05)
})

test_that("errors say what to do", {
  mesh <- ball()
  expect_crestline_error(curvature(mesh, 1e-3), c("no vertex could be fitted", "larger `radius`"))
  expect_crestline_error(curvature(mesh, -1), "`radius`")
  expect_crestline_error(curvature(mesh, 1.8), c("as large as the mesh", "metres"))
  expect_crestline_error(curvature(mesh, c(1, 2)), "`radius`")
  expect_crestline_error(curvature(mesh, 0.3, order = "quintic"), c("quintic", "quartic"))
  expect_crestline_error(curvature(mesh, 0.3, threads = 0), "`threads`")
  expect_crestline_error(curvature(mesh, 0.3, threads = 1.5), "whole number")
  expect_crestline_error(curvature(mesh, 0.3, vertices = 0), "`vertices`")
  expect_crestline_error(curvature(mesh, 0.3, vertices = NA_real_), "`vertices`")
  expect_crestline_error(curvature(mesh, 0.3, vertices = c(TRUE, NA)), "logical values")
  expect_crestline_error(curvature(mesh, 0.3, vertices = "all"), "`vertices`")
  expect_crestline_error(curvature(mesh, 0.3, widen = 0.5), "`widen`")
  expect_crestline_error(curvature(list(), 1), "mesh3d")
  mesh$it <- mesh$it[, 0]
  expect_crestline_error(curvature(mesh, 0.3), "no triangles")
})

test_that("no vertices asked for is no error", {
  none <- curvature(ball(), 0.3, vertices = integer())
  expect_true(all(is.na(none$k1)))
})

test_that("a curvature prints its counts and is a table", {
  mesh <- closed_form_mesh(closed_forms()$saddle, spacing = 3)$mesh
  curved <- curvature(mesh, 9, vertices = 1:50)
  expect_output(print(curved), "adaptive.* at 50 of 441 vertices, radius 9")
  expect_output(print(curved), "391 without: not asked for")
  table <- as.data.frame(curved)
  expect_identical(nrow(table), 441L)
  expect_equal(table$k1, curved$k1)
  expect_equal(as.matrix(table[c("normal_x", "normal_y", "normal_z")]), curved$normal,
               ignore_attr = TRUE)
  expect_output(print(curvature(ball(), 0.3, vertices = integer())), "at 0 of")
})

test_that("a specimen will do for a mesh, numeric triangles too", {
  sphere <- ball()
  through_door <- specimen(sphere)
  sphere$it <- sphere$it + 0.0
  expect_equal(curvature(through_door, 0.3, vertices = 1:20)$k1[1:20],
               curvature(sphere, 0.3, vertices = 1:20)$k1[1:20], tolerance = 1e-6)
})

test_that("curvature asked for piece by piece is that of the whole mesh, estimated once", {
  mesh <- bent_ridge(noise = 0.05)$mesh
  whole <- curvature(mesh, 4, "adaptive cubic")
  source <- curvature_source(mesh, kernel_settings(4, "adaptive cubic"), 1L)
  some <- c(700, 3, 3, 820)
  expect_equal(source(some), curvature_rows(whole, some), tolerance = 1e-12)
  all <- source(seq_along(whole$k1))
  expect_equal(all, curvature_rows(whole, seq_along(whole$k1)), tolerance = 1e-12)
  expect_identical(source(some), lapply(all, function(x) if (is.matrix(x)) x[some, ] else x[some]))
  expect_crestline_error(known_curvature(NULL, mesh, 400, 1L, "quadratic"), "as large as the mesh")
  expect_crestline_error(curvature_source(mesh, kernel_settings(0.1, "quadratic"), 1L)(1:9),
                         "no vertex could be fitted")
})
