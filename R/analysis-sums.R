# Sums of the groups of a sample in files, for all regroupings in one pass over the files.

#' What tests of the whole shape and of points take of a sample in files
#'
#' @param aligned An `aligned_files`.
#' @param labels n x B matrix of group numbers.
#' @param counts n x R, of [bootstrap_counts()].
#' @param normals k x 3, along which points are tested; NULL: by all their co-ordinates.
#' @return List:
#'   * `sums`: by group, but for the greatest: dk x B, of the centred co-ordinates of its members;
#'   * `own`: the same, k x B, of the squares of what each point is tested by;
#'   * `drawn`: dk x R, of bootstrap samples: first group's mean less the second's; NULL where there
#'     are more than two groups;
#'   * `products`: list of k sums, of the products of what each point is tested by, two and two;
#'   * `squares`: n, all weighted squares of a specimen;
#'   * `normals`.
#' @noRd
sums_in_files <- function(aligned, labels, counts, normals) {
  files <- attr(aligned, "files")
  sizes <- tabulate(labels[, 1])
  summed <- seq_along(sizes)[-which.max(sizes)]
  sign <- if (length(sizes) == 2) c(1, -1)[labels[, 1]] / sizes[labels[, 1]]
  check_sums(aligned, length(summed), ncol(labels), if (!is.null(sign)) ncol(counts))
  weight <- rep(aligned$weights, ncol(aligned$mean))
  squares <- numeric(length(aligned))
  found <- NULL
  for (i in seq_len(n_blocks(files))) {
    rows <- block_rows(files, i)
    off <- matrix(read_block(files, i), length(aligned$mean)) - as.vector(attr(aligned, "center"))
    squares[rows] <- colSums(off^2 * weight)
    own <- sums_of_block(off, tested_of_block(off, normals, length(aligned$weights)),
                         labels[rows, , drop = FALSE], summed)
    if (!is.null(sign)) {
      own$drawn <- drawn_sums(off * rep(sign[rows], each = nrow(off)), counts[rows, , drop = FALSE])
    }
    found <- if (is.null(found)) own else added(found, own)
  }
  c(found, list(squares = squares, normals = normals))
}

#' The sums are not larger than memory
#' @param groups,orders,drawn Numbers of groups that are summed, of regroupings, of bootstrap
#'   samples (NULL: none).
#' @param copies How often the sums of the regroupings are held at once: those of the blocks before,
#'   those of one more, and both added.
#' @noRd
check_sums <- function(aligned, groups, orders, drawn, copies = 3) {
  points <- nrow(aligned$mean)
  by_order <- (length(aligned$mean) + points) * as.numeric(groups) * orders
  by_draw <- length(aligned$mean) * as.numeric(max(drawn, 0))
  check_memory(copies * (by_order + by_draw), orders - 1, "n_perm")
}

added <- function(a, b) if (is.list(a)) Map(added, a, b) else a + b

#' What the points of a block are tested by: a list of k x m
#' @param off dk x m, centred.
#' @noRd
tested_of_block <- function(off, normals, k) {
  each <- lapply(seq_len(nrow(off) / k), function(d) off[(d - 1) * k + seq_len(k), , drop = FALSE])
  if (is.null(normals)) each else list(normal_parts(each, normals))
}

#' @param each List of three k x m.
#' @noRd
normal_parts <- function(each, normals) {
  each[[1]] * normals[, 1] + each[[2]] * normals[, 2] + each[[3]] * normals[, 3]
}

#' @param summed Which groups.
#' @noRd
sums_of_block <- function(off, tested, labels, summed) {
  both <- rbind(off, Reduce(`+`, lapply(tested, function(y) y^2)))
  each <- lapply(summed, function(g) cpp_member_sums(both, (labels == g) + 0L))
  first <- seq_len(nrow(off))
  products <- lapply(tested, function(a) lapply(tested, function(b) rowSums(a * b)))
  list(sums = lapply(each, function(one) one[first, , drop = FALSE]),
       own = lapply(each, function(one) one[-first, , drop = FALSE]),
       products = unlist(products, recursive = FALSE))
}

#' Sums of the specimens as often as each is drawn, of every bootstrap sample
#'
#' A number of times is a sum of powers of two, each of which some specimens have.
#' @noRd
drawn_sums <- function(off, counts) {
  sums <- 0
  power <- 1L
  while (power <= max(counts)) {
    sums <- sums + power * cpp_member_sums(off, counts %/% power %% 2L)
    power <- 2L * power
  }
  sums
}

#' A function of the sums of every group; the greatest group's are minus those of the others, and
#' the function takes them for the same without the sign
#' @return List by group.
#' @noRd
of_groups <- function(sums, of, sizes) {
  greatest <- which.max(sizes)
  each <- vector("list", length(sizes))
  each[-greatest] <- lapply(sums, of)
  each[[greatest]] <- if (length(sizes) == 2) each[[3 - greatest]] else of(Reduce(`+`, sums))
  each
}

#' Squared sums over all variables of every group
#' @return List by group of B x 1.
#' @noRd
whole_of_sums <- function(aligned, sums, sizes) {
  of_groups(sums, function(one) weighted_squares(aligned, one), sizes)
}

weighted_squares <- function(aligned, sums) {
  cbind(colSums(sums^2 * rep(aligned$weights, ncol(aligned$mean))))
}

#' Second group's mean minus the first's, k x d
#' @noRd
differences_of_sums <- function(sums, sizes, mean) {
  own <- sums$sums[[1]][, 1] * sum(1 / sizes)
  mean[] <- if (which.max(sizes) == 2) -own else own
  mean
}
