# Size and measurements less what errors of their points add.

#' Measurements of shapes less what errors of their points add
#'
#' @param draws A few do: the mean over all faces is exact, and a draw with its mirror image is
#'   without errors of first order.
#' @param some Number of shapes by which it is seen how errors go together.
#' @return Matrix: shapes x measurements. Where the bias is unknown, nothing is taken off; a warning
#'   says so if it is known of other shapes.
#' @noRd
unbiased_values <- function(shapes, plan, draws = 2, some = 20) {
  unknown <- check_landmark_error(NULL, shapes[[1]]$scheme)
  rows <- unique(unlist(plan_rows(plan)))
  # Neither choice nor draws may depend on the order of the faces
  ids <- vapply(shapes, `[[`, "", "id")
  together <- shared_errors(shapes[utils::head(order(ids, method = "radix"), some)])
  each <- vapply(seq_along(shapes), function(i) {
    xyz <- places_of(shapes[[i]])
    value <- measure_places(plan, array(xyz, c(dim(xyz), 1)))[, 1]
    spread <- place_errors(shapes[[i]], unknown, together, rows)
    # Draws of one face must not go together with those of another
    bias <- drawn_errors(plan, xyz, value, spread, draws, id_seed(ids[i]))$bias
    cbind(value, bias)
  }, matrix(0, length(plan), 2))
  known <- is.finite(matrix(each[, 2, ], length(plan)))
  value <- matrix(each[, 1, ], length(plan))
  warn_some_biased(known | is.na(value), ids)
  matrix(t(value - ifelse(known, each[, 2, ], 0)), length(shapes),
         dimnames = list(NULL, names(plan)))
}

#' Faces with errors of their points and faces without cannot be told apart by the norm
#' @param known Measurements x shapes: whether the bias is known, or there is no value.
#' @noRd
warn_some_biased <- function(known, ids) {
  mixed <- rowMeans(known) > 0 & rowMeans(known) < 1
  if (!any(mixed)) return(invisible())
  without <- ids[colSums(!known[mixed, , drop = FALSE]) > 0]
  crestline_warn(sprintf("what errors add to measurements is not taken off %s: %s.",
                         amount(length(without), "face"), shorten(without, 8)),
                 "Their points have no `se`, those of others have. Make a norm of one kind.",
                 stage = "norms", class = "crestline_norm_doubt")
}

#' A seed for a face by its name: its draws do not go together with those of another face, and are
#' the same in any sample
#' @noRd
id_seed <- function(id) strtoi(substr(rlang::hash(enc2utf8(id)), 1, 7), 16L)

not_above_errors <- function() "it is not larger than what its errors add"

#' Log centroid size less what errors of co-ordinates add to it
#' @param se Of the points; nothing is taken off where fewer than half have one.
#' @return A number, NA where errors add more than there is.
#' @noRd
unbiased_log_size <- function(size, se) {
  if (mean(!is.na(se)) < 0.5) return(log(size))
  square <- size^2 - 3 * length(se) * mean(se^2, na.rm = TRUE)
  if (square > 0) log(square) / 2 else NA_real_
}
