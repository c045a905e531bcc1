# Closed-form surfaces with their exact curvatures, on irregular meshes.

# A parametric surface: expressions in u and v (mm), with ranges; normals by r_u x r_v.
closed_forms <- function() {
  graph <- function(z, half = 30) {
    list(x = quote(u), y = quote(v), z = z, u = c(-half, half), v = c(-half, half))
  }
  list(
    sphere = list(x = quote(40 * sin(u / 40)), y = quote(40 * cos(u / 40) * sin(v / 40)),
                  z = quote(40 * cos(u / 40) * cos(v / 40)), u = c(-30, 30), v = c(-30, 30)),
    torus = list(x = quote((50 + 20 * cos(v / 20)) * sin(u / 60)), y = quote(20 * sin(v / 20)),
                 z = quote((50 + 20 * cos(v / 20)) * cos(u / 60)), u = c(-30, 30), v = c(-30, 30)),
    cylinder = list(x = quote(25 * sin(u / 25)), y = quote(v), z = quote(25 * cos(u / 25)),
                    u = c(-30, 30), v = c(-30, 30)),
    saddle = graph(quote((u^2 - v^2) / 80)),
    paraboloid = graph(quote(u^2 / 60 + v^2 / 100)),
    monkey = graph(quote((u^3 - 3 * u * v^2) / 2400)),
    bumpy = graph(quote(3 * sin(u / 12) * cos(v / 14)))
  )
}

# Vertices on a jittered grid of the parameters, diagonals at random; truth at every vertex.
closed_form_mesh <- function(form, spacing = 1, noise = 0, seed = 1, jitter = 0.3) {
  with_seed(seed, {
    u <- seq(form$u[1], form$u[2], by = spacing)
    v <- seq(form$v[1], form$v[2], by = spacing)
    at <- expand.grid(u = u, v = v)
    at <- at + stats::runif(2 * nrow(at), -jitter, jitter) * spacing
    it <- grid_triangles(length(u), length(v),
                         flip = stats::runif((length(u) - 1) * (length(v) - 1)) < 0.5)
    truth <- exact_curvature(form, at$u, at$v)
    xyz <- truth$xyz + noise * stats::rnorm(nrow(at)) * truth$normal
  })
  margin <- pmin(at$u - form$u[1], form$u[2] - at$u, at$v - form$v[1], form$v[2] - at$v)
  list(mesh = rgl::mesh3d(vertices = t(cbind(xyz, 1)), triangles = it), truth = truth,
       margin = margin, uv = at)
}

grid_triangles <- function(nu, nv, flip) {
  cell <- as.vector(outer(seq_len(nu - 1), (seq_len(nv - 1) - 1) * nu, `+`))
  a <- cell; b <- cell + 1; c <- cell + nu + 1; d <- cell + nu
  cbind(rbind(a, b, ifelse(flip, d, c)), rbind(ifelse(flip, b, a), c, d))
}

# Exact first and second fundamental forms by symbolic differentiation.
exact_curvature <- function(form, u, v) {
  parts <- lapply(form[c("x", "y", "z")], function(e) {
    value <- eval(stats::deriv3(e, c("u", "v")), list(u = u, v = v))
    n <- length(u)
    gradient <- matrix(attr(value, "gradient"), ncol = 2)
    hessian <- array(attr(value, "hessian"), c(length(gradient) / 2, 2, 2))
    list(value = rep_len(as.numeric(value), n),
         g = gradient[rep_len(seq_len(nrow(gradient)), n), , drop = FALSE],
         h = hessian[rep_len(seq_len(nrow(gradient)), n), , , drop = FALSE])
  })
  bind <- function(get) sapply(parts, get)
  ru <- bind(function(p) p$g[, 1]); rv <- bind(function(p) p$g[, 2])
  normal <- cross_rows(ru, rv)
  normal <- normal / sqrt(rowSums(normal^2))
  E <- rowSums(ru^2); F <- rowSums(ru * rv); G <- rowSums(rv^2)
  L <- rowSums(bind(function(p) p$h[, 1, 1]) * normal)
  M <- rowSums(bind(function(p) p$h[, 1, 2]) * normal)
  N <- rowSums(bind(function(p) p$h[, 2, 2]) * normal)
  gauss <- (L * N - M^2) / (E * G - F^2)
  mean <- (E * N - 2 * F * M + G * L) / (2 * (E * G - F^2))
  root <- sqrt(pmax(mean^2 - gauss, 0))
  k1 <- mean + root
  # (II - k I) w = 0
  w1 <- cbind(M - k1 * F, -(L - k1 * E))
  w2 <- cbind(N - k1 * G, -(M - k1 * F))
  longer <- rowSums(w1^2) >= rowSums(w2^2)
  w <- w2
  w[longer, ] <- w1[longer, ]
  direction1 <- w[, 1] * ru + w[, 2] * rv
  direction1 <- direction1 / sqrt(rowSums(direction1^2))
  list(xyz = bind(function(p) p$value), normal = normal, k1 = k1, k2 = mean - root,
       direction1 = direction1)
}

cross_rows <- function(a, b) {
  cbind(a[, 2] * b[, 3] - a[, 3] * b[, 2], a[, 3] * b[, 1] - a[, 1] * b[, 3],
        a[, 1] * b[, 2] - a[, 2] * b[, 1])
}

with_seed <- function(seed, code) {
  old <- if (exists(".Random.seed", globalenv())) get(".Random.seed", globalenv())
  on.exit(if (is.null(old)) rm(".Random.seed", envir = globalenv()) else
          assign(".Random.seed", old, globalenv()))
  set.seed(seed)
  force(code)
}

# Error of k1 and k2 in per cent of the RMS curvedness, of the shape index, and of the direction in
# degrees (where the two curvatures differ), at the given vertices.
curvature_errors <- function(curved, truth, at) {
  scale <- sqrt(mean((truth$k1[at]^2 + truth$k2[at]^2) / 2))
  index <- function(k1, k2) 2 / pi * atan2(-(k1 + k2), k1 - k2)
  distinct <- at[(truth$k1 - truth$k2)[at] > 0.5 * scale]
  along <- abs(rowSums(curved$direction1[distinct, , drop = FALSE] *
                       truth$direction1[distinct, , drop = FALSE]))
  bent <- at[sqrt((truth$k1^2 + truth$k2^2) / 2)[at] > 0.2 * scale]
  list(k1 = 100 * abs(curved$k1 - truth$k1)[at] / scale,
       index = abs(index(curved$k1, curved$k2) - index(truth$k1, truth$k2))[bent],
       direction = acos(pmin(along, 1)) * 180 / pi)
}
