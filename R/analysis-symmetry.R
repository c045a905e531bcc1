# Symmetric and asymmetric variation of a sample (object symmetry).

#' Symmetric and asymmetric variation of a sample
#'
#' Splits each shape into a symmetric and an asymmetric part. The symmetric part is the mean of the
#' shape and its reflection (left and right relabelled). The asymmetric part is half of their
#' difference. Both parts are samples for all tests and maps of the package. Two tests are of
#' asymmetry itself. The first tests directional asymmetry: the same side differs in all specimens.
#' The second tests fluctuating asymmetry against the error of measurement; it needs specimens that
#' were measured more than once.
#'
#' All shapes and their reflections are aligned together (Klingenberg, Barluenga and Meyer 2002).
#' Degrees of freedom, sums of squares and F are those of `geomorph::bilat.symmetry()` with
#' `object.sym = TRUE`. Its p-values come from permuted residuals of all configurations. Here
#' directional asymmetry is tested by random exchanges of left and right in each specimen.
#' Fluctuating asymmetry is tested by exchanges of the measurements' asymmetry between specimens.
#' Both tests are exact. With 5 individuals directional asymmetry has 16 exchanges, and p is at
#' least 1/16.
#'
#' @param sample,level,scale,weights,missing As in [compare_groups()]. Arrays need `pairs`.
#' @param individual Individual of each shape: a factor of length n, or a vector that can become
#'   one. Values with names are matched to the specimens by name. `NULL`: each shape is of another
#'   individual.
#' @param pairs Pairs of an array: two columns with names or numbers of points, left and right.
#'   Points in no pair lie on the midline. For a `shape_sample` the scheme has the pairs.
#' @param n_perm Number of random permutations. If there are fewer exchanges of sides, all are used.
#' @param seed As in [compare_groups()].
#' @return Object of class `symmetry_parts`, a list:
#'   * `symmetric`, `asymmetric`: lists by level of `aligned`s of the same specimens. The first are
#'     the symmetric means. The second are the mean shape plus half of the difference between a
#'     shape and its reflection. Give either to [compare_groups()], [shape_lm()]; one level to
#'     [shape_pca()], [shape_lda()].
#'   * `tests`: data frame with a row for each level and source: `level`, `source` ("individual",
#'     "directional", "fluctuating", "error"), `df`, `squares`, `mean_squares`, `share`,
#'     `statistic`, `p_value`. `statistic` is F: individual and directional over fluctuating,
#'     fluctuating over error;
#'   * `specimens`: data frame with a row for each level and specimen: `level`, `id`, `asymmetry`,
#'     `fluctuating`. `asymmetry` is the root mean square distance of the points from the symmetric
#'     mean, in the unit of the meshes. `fluctuating` is the same after the mean asymmetry is
#'     subtracted;
#'   * `directional`: list by level of k x 3 matrices: the mean asymmetry, in the unit of the
#'     meshes.
#'
#'   `as.data.frame()` gives `tests`.
#' @section Errors: of class `crestline_error`: the scheme has no pairs, `pairs` are not two columns
#'   of points, or there are fewer than two individuals.
#' @template glossary
#' @references Klingenberg, Barluenga and Meyer (2002) Shape analysis of symmetric structures,
#'   *Evolution* 56, 1909-1920; Palmer and Strobeck (1986) Fluctuating asymmetry, *Annual Review of
#'   Ecology and Systematics* 17, 391-421.
#' @seealso [symmetrise()] and [asymmetry()] for one shape
#' @examples
#' kite <- rbind(left = c(-1, 0, 0), right = c(1, 0, 0), top = c(0, 2, 0), low = c(0, -1, 0.5))
#' shapes <- array(kite, c(4, 3, 12), list(rownames(kite), NULL, paste0("s", 1:12)))
#' shapes <- shapes + rnorm(144, sd = 0.05)
#' shapes["left", 2, ] <- shapes["left", 2, ] + 0.2
#' parts <- symmetry_parts(shapes, pairs = cbind("left", "right"), seed = 1)
#' parts
#' compare_groups(parts$asymmetric, gl(2, 6), n_perm = 99,
#'                settings = comparison_settings(components = 2))
#' @export
symmetry_parts <- function(sample, level = c("landmarks", "curves", "surface"), individual = NULL,
                           pairs = NULL, n_perm = 1000, seed = NULL, scale = TRUE, weights = NULL,
                           missing = c("estimate", "drop", "stop")) {
  check_given()
  seed <- check_seed(seed)
  n_perm <- check_count(n_perm, "n_perm", upper = argument_limits()$permutations)
  aligned <- aligned_levels(sample, level, scale, weights, missing)
  ids <- names(aligned[[1]])
  individual <- if (is.null(individual)) {
    factor(ids, ids)
  } else {
    check_block(individual, ids, "individual")
  }
  if (nlevels(individual) < 2) {
    crestline_abort("`individual` names one individual.", "Give two or more.", stage = "symmetry")
  }
  check_memory(length(ids) * as.numeric(n_perm), n_perm, "n_perm")
  warn_few_orders(1 / min(n_perm + 1, 2^(nlevels(individual) - 1)), "symmetry")
  template <- if (inherits(sample, "shape_sample")) sample$template
  each <- Map(function(one, name) {
    parts <- parts_of_level(one, partners(one, name, template, pairs))
    c(parts, symmetry_tests(parts, individual, n_perm, seed))
  }, aligned, names(aligned))
  structure(list(symmetric = lapply(each, `[[`, "symmetric"),
                 asymmetric = lapply(each, `[[`, "asymmetric"),
                 tests = with_level(each, "tests"), specimens = with_level(each, "specimens"),
                 directional = lapply(each, `[[`, "directional"), individual = individual,
                 n_perm = n_perm, exchanges = 2^(nlevels(individual) - 1), seed = seed),
            class = "symmetry_parts")
}

#' The point that each point of an alignment is mirrored to
#' @noRd
partners <- function(aligned, level, template, pairs) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "symmetry")
  }
  points <- rownames(aligned$mean)
  if (is.null(pairs) && !is.null(template)) {
    scheme <- template$scheme
    if (level == "model") {
      partner <- mirror_places(scheme)
      all <- rownames(places_of(template))
    } else {
      at <- which(scheme$points$level == level)
      partner <- match(mirror_rows(scheme)[at], at)
      all <- rownames(coords(template, level))
    }
    # Points that the alignment dropped are in neither.
    partner <- match(all[partner], points)[match(points, all)]
  } else {
    if (is.data.frame(pairs)) pairs <- as.matrix(pairs)
    if (!is.matrix(pairs) || ncol(pairs) != 2) {
      fail(sprintf("`pairs` is %s.", describe_value(pairs)),
           "Give two columns with the names or numbers of points, left and right.")
    }
    at <- if (is.numeric(pairs)) pairs else matrix(match(pairs, points), ncol = 2)
    if (anyNA(at) || !all(at %in% seq_along(points)) || anyDuplicated(as.vector(at))) {
      fail("`pairs` name points that are not there, or one twice.",
           sprintf("The points are %s.", shorten(points)))
    }
    partner <- replace(seq_along(points), c(at[, 1], at[, 2]), c(at[, 2], at[, 1]))
  }
  if (anyNA(partner)) {
    fail(sprintf("%s: the partner of %s was dropped.", level, shorten(points[is.na(partner)])),
         "Use missing = \"estimate\".")
  }
  if (all(partner == seq_along(points))) {
    fail(sprintf("%s: nothing is paired.", level), "Give the scheme pairs, see `?curve_scheme`.")
  }
  partner
}

#' Symmetric and asymmetric parts of an alignment
#' @return List: `symmetric`, `asymmetric` (`aligned`s), `off` (n x dk: half differences).
#' @noRd
parts_of_level <- function(aligned, partner) {
  raw <- before_projection(aligned)
  turned <- raw[partner, , , drop = FALSE]
  turned[, 1, ] <- -turned[, 1, ]
  ids <- names(aligned)
  n <- length(ids)
  both <- array(c(raw, turned), dim(raw) * c(1, 1, 2),
                list(rownames(aligned$mean), colnames(aligned$mean), seq_len(2 * n)))
  settings <- aligned$settings
  fit <- fit_alignment(list(coords = both, reference = aligned$mean), aligned$weights,
                       check_scaling(aligned$scale),
                       if (is.null(settings)) 1e-12 else settings$tolerance,
                       if (is.null(settings)) 200 else settings$rounds)
  if (!fit$converged) warn_alignment(settings$rounds, utils::tail(fit$moved, 1))
  if (aligned$tangent) fit$coords <- tangent_projection(fit$coords, fit$mean, aligned$weights)
  own <- fit$coords[, , seq_len(n), drop = FALSE]
  other <- fit$coords[, , n + seq_len(n), drop = FALSE]
  part <- function(coords) {
    dimnames(coords) <- c(dimnames(aligned$mean), list(ids))
    mean <- `dimnames<-`(apply(coords, 1:2, mean), dimnames(aligned$mean))
    new_aligned(coords, mean, aligned$size, aligned$weights, aligned$places, aligned$scale, FALSE,
                aligned$level, aligned$missing, triangles = aligned$triangles,
                provenance = aligned$provenance)
  }
  middle <- apply(fit$coords, 1:2, mean)
  off <- (own - other) / 2
  list(symmetric = part((own + other) / 2), asymmetric = part(off + as.vector(middle)),
       off = t(matrix(off, length(middle))))
}

#' Sums of squares of individuals, sides and both, and their tests
#' @noRd
symmetry_tests <- function(parts, individual, n_perm, seed) {
  aligned <- parts$symmetric
  code <- as.integer(individual)
  count <- tabulate(code)
  n <- length(code)
  weight <- sqrt(rep(aligned$weights, ncol(aligned$mean)))
  off <- parts$off * rep(weight, each = n)
  whole <- t(matrix(aligned$coords, length(aligned$mean)))
  whole <- (whole - rep(colMeans(whole), each = n)) * rep(weight, each = n)
  means <- function(x) rowsum(x, code) / count
  squares <- c(individual = 2 * sum(means(whole)^2 * count),
               directional = 2 * n * sum(colMeans(off)^2))
  squares["fluctuating"] <- 2 * sum(means(off)^2 * count) - squares[["directional"]]
  repeated <- n > length(count)
  if (repeated) squares["error"] <- 2 * sum(whole^2) + 2 * sum(off^2) - sum(squares)
  df <- c(length(count) - 1, 1, length(count) - 1, if (repeated) 2 * (n - length(count)))
  mean_squares <- squares / df
  f <- mean_squares / c(mean_squares[c(3, 3)], if (repeated) mean_squares[c(4, NA)] else NA)
  p <- c(NA, with_seed(seed, asymmetry_p(off, code, n_perm)), if (repeated) NA)
  size <- if (isFALSE(aligned$scale)) 1 else mean(aligned$size)
  points <- nrow(aligned$mean)
  rms <- function(x) size * sqrt(rowSums(x^2) / points)
  list(tests = data.frame(
         source = names(squares), df = df, squares = unname(squares),
         mean_squares = unname(mean_squares), share = unname(squares / sum(squares)),
         statistic = unname(f), p_value = p, row.names = NULL
       ),
       specimens = data.frame(
         id = names(aligned), asymmetry = rms(off),
         fluctuating = rms(off - rep(colMeans(off), each = n)), row.names = NULL
       ),
       directional = size * matrix(colMeans(parts$off), points, dimnames = dimnames(aligned$mean)))
}

#' p-values of directional and fluctuating asymmetry, the latter NA without repeats
#' @noRd
asymmetry_p <- function(off, code, n_perm) {
  count <- tabulate(code)
  units <- length(count)
  n <- length(code)
  # Exchange of sides turns an individual's asymmetry round; its length stays.
  sums <- tcrossprod(rowsum(off, code))
  # All exchanges where they are few: the first individual's side may stay as it is.
  sign <- if (2^(units - 1) <= n_perm) {
    rbind(1, t(as.matrix(expand.grid(rep(list(c(1, -1)), units - 1)))))
  } else cbind(1, matrix(sample(c(-1, 1), units * n_perm, TRUE), units))
  directional <- permutation_p(cbind(colSums(sign * (sums %*% sign))))
  if (n == units) return(c(directional, NA))
  labels <- cbind(code, replicate(n_perm, code[sample.int(n)]), deparse.level = 0)
  gram <- tcrossprod(off - rep(colMeans(off), each = n))
  among <- apply(labels, 2, function(own) sum(gram * outer(own, own, `==`) / count[own]))
  c(directional, permutation_p(cbind(among)))
}

#' @exportS3Method
validate.symmetry_parts <- function(x) {
  sample <- function(value) is.list(value) && length(value) > 0 &&
    all(vapply(value, inherits, NA, "aligned"))
  right <- sample(x$symmetric) && sample(x$asymmetric) && is.data.frame(x$tests) &&
    all(c("level", "source", "df", "statistic", "p_value") %in% names(x$tests))
  if (!right) {
    crestline_abort("the parts are damaged: they do not fit together.",
                    "Make them anew: symmetry_parts().", stage = "symmetry", call = NULL)
  }
  invisible(x)
}

#' @rdname symmetry_parts
#' @param x A `symmetry_parts`.
#' @template as-data-frame
#' @export
as.data.frame.symmetry_parts <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  x$tests
}

#' @export
print.symmetry_parts <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat("<symmetry_parts> ", amount(length(x$symmetric[[1]]), "specimen"), ", ",
        amount(nlevels(x$individual), "individual"), "; ", amount(x$n_perm, "permutation"),
        if (!is.null(x$exchanges) && x$exchanges <= x$n_perm) {
          sprintf(" (all %d exchanges of sides)", as.integer(x$exchanges))
        }, "\n", sep = "")
    for (level in names(x$symmetric)) {
      own <- x$tests[x$tests$level == level, ]
      cat("  ", level, ":\n", sep = "")
      table <- data.frame(Df = own$df, SS = own$squares, Rsq = own$share, F = own$statistic,
                          p = own$p_value, row.names = own$source)
      print(signif(table, 4))
    }
    invisible(x)
  })
}
