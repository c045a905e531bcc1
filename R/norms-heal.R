# The healed face: places that do not fit the rest are made up from it.

#' The face healed: discs where the scan finds something are made up from the rest
#'
#' @param alpha Level of the scan.
#' @param most Most discs.
#' @return List: `found` (data frame with a row for each disc: `at`, `radius`, `both`, `z`), `out`
#'   (k), `u` (3k, healed), `variance` (3k), `scan` (the first), `finished` (whether the rest has no
#'   more).
#' @noRd
heal_face <- function(field, found, age, sex, missing, alpha, most = 5) {
  out <- missing
  wider <- rep(1, length(out))
  healed <- list(u = found$u, variance = 0 * found$u)
  first <- scan <- scanned_face(field, found, age, sex, out)
  # A large lesion moves the whole face as it is laid on: pose and scale over the spread of this age
  laid <- field
  laid$sd <- found$spread
  hits <- data.frame(at = integer(), radius = numeric(), both = logical(), z = numeric())
  while (scan$p <= alpha && nrow(hits) < most) {
    centres <- unique(c(scan$at, if (scan$both) field$partner[scan$at]))
    distance <- Reduce(pmin, lapply(centres, function(at) {
      row_lengths(sweep(field$points, 2, field$points[at, ]))
    }))
    disc <- lesion_disc(distance, scan$radius)
    # Less than half of the face says nothing about the rest.
    if (mean(out | disc) > 0.5) break
    out <- out | disc
    wider[disc] <- pmax(wider[disc], wider_by(field, scan, distance[disc]))
    hits <- rbind(hits, data.frame(at = centres, radius = scan$radius,
                                   both = length(centres) > 1, z = scan$z_at))
    made <- given_the_rest(laid, found$u, rep(out, 3))
    healed <- list(u = made$fit, variance = made$variance * rep(wider, 3))
    scan <- scanned_face(field, utils::modifyList(found, list(u = made$fit)), age, sex, out)
  }
  c(list(found = hits, out = out & !missing, scan = first, finished = scan$p > alpha), healed)
}

#' The disc that is left out for a lesion that the scan finds
#'
#' @param distance k: of the points from the centre.
#' @param reach Its radius as a multiple of the scan's, which is often less than the lesion's.
#' @param most Share of the points that it has at most: the rest must tell of it.
#' @noRd
lesion_disc <- function(distance, radius, reach = 1.5, most = 0.4) {
  largest <- sort(distance)[max(1, floor(most * length(distance)))]
  distance <= min(reach * radius, largest)
}

#' How much more held-out faces vary in a disc than the field makes expected, given the rest
#'
#' The kernel is the same everywhere, faces are not. Discs about some centres are left out of
#' held-out faces and made up. The squares of what is missed, over the variance that the field
#' gives, are `base` at the rim and `base + peak` at the centre.
#'
#' @param u n x 3k: standardised deviations of held-out faces.
#' @param centres Number of centres, far from each other.
#' @param faces Number of faces that are used at most.
#' @return Data frame by centre and radius: `at` (row of the points), `radius`, `base`, `peak`.
#' @noRd
healing_table <- function(field, u, radii, centres = 12, faces = 300) {
  rows <- unique(round(seq(1, nrow(u), length.out = min(faces, nrow(u)))))
  inverse <- invert_field(field)
  inner <- lapply(inverse$roots, chol2inv)
  solved <- apply_inverse(inverse, t(u[rows, ]))
  distance <- as.matrix(stats::dist(field$points))
  at <- which.min(rowSums(distance))
  while (length(at) < min(centres, nrow(distance))) {
    at <- c(at, which.max(apply(distance[, at, drop = FALSE], 1, min)))
  }
  table <- expand.grid(at = at, radius = radii)
  each <- vapply(seq_len(nrow(table)), function(i) {
    own <- distance[table$at[i], ]
    disc <- which(lesion_disc(own, table$radius[i]))
    squares <- disc_squares(field, inverse, inner, solved, disc)
    if (length(disc) < 5) return(c(mean(squares), 0))
    stats::lm.fit(cbind(1, bump(own[disc], max(own[disc]))), squares)$coefficients
  }, numeric(2))
  data.frame(table, base = signif(each[1, ], 4), peak = signif(each[2, ], 4))
}

#' Mean squares along the normals of what is missed in a disc, over the field's variance
#'
#' Of the inverse Q of the correlation and the disc's part of it: \eqn{u_I - E(u_I | rest) = Q_II^-1
#' (Q u)_I}, whose covariance is Q_II^-1.
#'
#' @param inner Inverses of the kernels of the three co-ordinates, each k x k.
#' @param solved Q u, 3k x n.
#' @noRd
disc_squares <- function(field, inverse, inner, solved, disc) {
  k <- nrow(field$points)
  m <- length(disc)
  rows <- c(disc, k + disc, 2 * k + disc)
  part <- inverse$solved[rows, , drop = FALSE]
  own <- -part %*% inverse$inner %*% t(part)
  for (axis in 1:3) {
    at <- (axis - 1) * m + seq_len(m)
    own[at, at] <- own[at, at] + inner[[axis]][disc, disc]
  }
  covariance <- chol2inv(chol(own))
  missed <- covariance %*% solved[rows, , drop = FALSE]
  along <- as.vector(field$normal[disc, ]) * field$sd[rows]
  missed <- rowSums(array(along * missed, c(m, 3, ncol(missed))) |> aperm(c(1, 3, 2)), dims = 2)
  rowMeans(missed^2) / rowSums(matrix(along^2 * diag(covariance), m))
}

#' Factor of the variance at points of a disc by the nearest centre of the table
#' @param distance Of these points from the centre of the disc.
#' @noRd
wider_by <- function(field, scan, distance) {
  # Radii that were read from different files differ by rounding.
  off <- abs(field$healing$radius - scan$radius)
  table <- field$healing[off <= min(off), ]
  apart <- row_lengths(sweep(field$points[table$at, , drop = FALSE], 2, field$points[scan$at, ]))
  one <- table[which.min(apart), ]
  pmax(1, one$base + one$peak * bump(distance, max(distance, .Machine$double.xmin)))
}
