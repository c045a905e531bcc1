# Left-right pairs of a scheme that is being built: proposed by the mirror image of the landmarks.

#' Pairs of points, each near the mirror image of the other
#'
#' The plane that is tried stands half-way between two of the points. The one counts whose mirror
#' images meet most of the points, then the one that meets them nearest.
#'
#' @param at k x 3 with row names.
#' @param tolerance Greatest distance of a point from its partner's mirror image, as a share of the
#'   points' greatest distance from their middle.
#' @param least Share of the points that must meet a point.
#' @return Data frame `left`, `right`: names, the one that comes first in `at` is left unless the
#'   names end in L and R; no row where there is no such plane.
#' @noRd
mirror_pairs <- function(at, tolerance = 0.12, least = 0.6) {
  none <- data.frame(left = character(), right = character())
  at <- at[stats::complete.cases(at), , drop = FALSE]
  k <- nrow(at)
  if (k < 3) return(none)
  size <- max(row_lengths(sweep(at, 2, colMeans(at))))
  two <- utils::combn(k, 2)
  tried <- lapply(seq_len(ncol(two)), function(i) {
    met <- mirror_met(at, at[two[1, i], ] - at[two[2, i], ],
                      (at[two[1, i], ] + at[two[2, i], ]) / 2, tolerance * size)
    c(met$count, met$mean)
  })
  tried <- do.call(rbind, tried)
  best <- order(-tried[, 1], tried[, 2])[1]
  if (tried[best, 1] < least * k) return(none)
  # Once more by the mean plane of all pairs that were met
  i <- two[, best]
  met <- mirror_met(at, at[i[1], ] - at[i[2], ], (at[i[1], ] + at[i[2], ]) / 2, tolerance * size)
  pair <- which(met$partner > seq_len(k))
  normal <- main_direction(at[pair, , drop = FALSE] - at[met$partner[pair], , drop = FALSE])
  middle <- colMeans((at[pair, , drop = FALSE] + at[met$partner[pair], , drop = FALSE]) / 2)
  met <- mirror_met(at, normal, middle, tolerance * size)
  pair <- which(met$partner > seq_len(k))
  two <- cbind(rownames(at)[pair], rownames(at)[met$partner[pair]])
  turned <- name_side(two[, 1]) == "right" & name_side(two[, 2]) == "left"
  two[turned, ] <- two[turned, 2:1]
  data.frame(left = two[, 1], right = two[, 2])
}

#' Which points lie where a plane mirrors others
#'
#' @param normal,middle Of the plane.
#' @param within Greatest distance.
#' @return List: `partner` (rows; a point's own row for one on the plane, NA for none), `count`,
#'   `mean` (distance of those that are met).
#' @noRd
mirror_met <- function(at, normal, middle, within) {
  normal <- unit_vector(normal)
  mirrored <- at - 2 * outer(drop(sweep(at, 2, middle) %*% normal), normal)
  gap <- sqrt(pmax(outer(rowSums(mirrored^2), rowSums(at^2), `+`) - 2 * tcrossprod(mirrored, at),
                   0))
  nearest <- max.col(-gap, "first")
  least <- gap[cbind(seq_along(nearest), nearest)]
  met <- least <= within & nearest[nearest] == seq_along(nearest)
  list(partner = ifelse(met, nearest, NA), count = sum(met), mean = mean(least[met]))
}

#' Pairs of all levels that follow from the pairs of landmarks
#'
#' @param pairs Data frame `left`, `right` of landmarks.
#' @return Table as `pairs` of [curve_scheme()].
#' @noRd
pairs_of_all <- function(pairs, curves, patches) {
  rows <- function(level, left, right) {
    data.frame(level = rep(level, length(left)), left = left, right = right)
  }
  table <- rows("landmarks", pairs$left, pairs$right)
  swap <- function(x) partner_of(x, table, "landmarks")
  mirror <- curves
  mirror[c("from", "to")] <- lapply(curves[c("from", "to")], swap)
  mirror$via <- swapped_via(curves$via, swap)
  two <- partner_rows(curves, mirror,
                      c("from", "to", "kind", "path", "via", "radius", "width", "n"),
                      curves$from %in% pairs$left | curves$to %in% pairs$left)
  table <- rbind(table, rows("curves", curves$curve[two[, 1]], curves$curve[two[, 2]]))
  if (!NROW(patches)) return(table)
  mirror <- patches
  sides <- c("curve_a", "curve_b")
  mirror[sides] <- lapply(patches[sides], mirrored_side, pairs = table)
  plain <- patches
  plain[sides] <- lapply(patches[sides], mirrored_side, pairs = table[0, ])
  named <- vapply(patches$curve_a, function(side) curve_parts(side)$curve[1], "")
  two <- partner_rows(plain, mirror, c(sides, "rows", "rows_kept", "columns"),
                      named %in% table$left[table$level == "curves"])
  rbind(table, rows("surface", patches$patch[two[, 1]], patches$patch[two[, 2]]))
}

#' Cells of `via` with other names in place; NULL where the table has no such column
#' @noRd
swapped_via <- function(via, swap) {
  if (is.null(via)) return(NULL)
  vapply(via, function(cell) {
    if (is.na(cell)) cell else paste(swap(via_names(cell)), collapse = " ")
  }, "", USE.NAMES = FALSE)
}

#' Rows of a table that are the mirror images of other rows, each pair once, the left one first
#' @noRd
partner_rows <- function(rows, mirror, columns, is_left) {
  text <- function(x) do.call(paste, c(unname(lapply(x[intersect(columns, names(x))], format)),
                                       sep = "|"))
  at <- match(text(mirror), text(rows))
  first <- which(!is.na(at) & at > seq_along(at) & at[at] == seq_along(at))
  two <- cbind(first, at[first])
  turned <- !is_left[two[, 1]]
  two[turned, ] <- two[turned, 2:1]
  two
}
