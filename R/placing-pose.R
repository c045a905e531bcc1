# Where the template lies in a scan: rotation, shift and scale, fitted from starts.

#' Starts: each of the template's anchors on each of the scan's of its kind, in turns about the
#' normal
#'
#' @param own Which of the template's anchors.
#' @return 13 x s: a column a pose.
#' @noRd
anchor_starts <- function(template, cloud, own, settings) {
  pairs <- which(outer(template$anchors$kind, cloud$anchors$kind, `==`), arr.ind = TRUE)
  pairs <- pairs[pairs[, 1] %in% own, , drop = FALSE]
  turn <- 2 * pi * (seq_len(settings$turns) - 1) / settings$turns
  each <- lapply(seq_len(nrow(pairs)), function(i) {
    from <- attr(template$anchors, "frames")[[pairs[i, 1]]]
    to <- attr(cloud$anchors, "frames")[[pairs[i, 2]]]
    at <- attr(template$anchors, "places")[, pairs[i, 1]]
    onto <- attr(cloud$anchors, "places")[, pairs[i, 2]]
    vapply(turn, function(angle) {
      about <- matrix(c(cos(angle), sin(angle), 0, -sin(angle), cos(angle), 0, 0, 0, 1), 3)
      rotation <- to %*% about %*% t(from)
      c(rotation, onto - rotation %*% at, 1)
    }, numeric(13))
  })
  do.call(cbind, c(list(matrix(0, 13, 0)), each))
}

#' The best pose of a template in a cloud
#'
#' All starts go some steps on thin clouds; the better go on; the best that differ are fitted on the
#' whole, with a tight scale and with a loose one, and that of the least misfit wins.
#'
#' @param starts 13 x s, as of [proud_starts()] or [anchor_starts()].
#' @param reach Greatest distance of a match at the first step.
#' @return List: `pose` (13 numbers: rotation, shift, scale), `score`, `misfit` (the score where the
#'   cloud has no curvature), `rests` (whether a further step would move it).
#' @noRd
best_pose <- function(template, cloud, starts, reach, settings) {
  if (!ncol(starts)) return(no_pose())
  middle <- exp(mean(log(settings$reach)))
  first <- fit_poses(template, cloud, starts, c(reach, middle), settings$tight, settings,
                     thin = TRUE)
  better <- utils::head(order(first$score), settings$followed)
  second <- fit_poses(template, cloud, first$poses[, better, drop = FALSE],
                      c(middle, settings$reach[2]), settings$tight, settings, thin = TRUE)
  # Which of the fitted poses to go on with: the best that put the template's points elsewhere
  left <- order(second$score)
  probe <- template$xyz[, template$coarse, drop = FALSE]
  placed <- function(pose) pose[13] * matrix(pose[1:9], 3) %*% probe + pose[10:12]
  chosen <- integer()
  while (length(left) && length(chosen) < settings$refined) {
    chosen <- c(chosen, left[1])
    mine <- placed(second$poses[, left[1]])
    gap <- vapply(left, function(i) sqrt(mean(colSums((placed(second$poses[, i]) - mine)^2))), 0)
    left <- left[gap > settings$saturation]
  }
  last <- c(1, 0.5) * settings$reach[2]
  tried <- lapply(list(settings$tight, settings$loose), function(scale) {
    fitted_poses(template, cloud, second$poses[, chosen, drop = FALSE], last, scale, settings)
  })
  tried <- unlist(tried, recursive = FALSE)
  best <- tried[[which.min(vapply(tried, `[[`, 0, "misfit"))]]
  rested_pose(template, cloud, best, settings)
}

#' A pose fitted on until it rests, where that makes it better
#' @return List as of [best_pose()].
#' @noRd
rested_pose <- function(template, cloud, best, settings) {
  long <- utils::modifyList(settings, list(steps = settings$rest_steps[1]))
  found <- fitted_poses(template, cloud, cbind(best$pose), c(1, 0.5) * settings$reach[2],
                        settings$loose, long, settings$rest_steps[2])[[1]]
  if (found$misfit < best$misfit) found else best
}

no_pose <- function() {
  list(pose = c(diag(3), 0, 0, 0, 1), score = 1, misfit = Inf, rests = FALSE)
}

#' Poses fitted to whole clouds, with score and misfit
#' @return List of lists as of [best_pose()].
#' @noRd
fitted_poses <- function(template, cloud, starts, reach, scale, settings, more = 0) {
  fits <- fit_poses(template, cloud, starts, reach, scale, settings, thin = FALSE, more = more)
  lapply(seq_along(fits$score), function(i) {
    pose <- fits$poses[, i]
    misfit <- if (is.null(cloud$k1)) fits$score[i] else {
      parts <- misfit_parts(template, cloud, pose, settings)
      parts[["unlike"]] + settings$left_over * parts[["left"]]
    }
    list(pose = pose, score = fits$score[i], misfit = misfit, rests = fits$rests[i])
  })
}

#' What speaks against a pose: `unlike`, the template's points without a like in the scan, in place
#' and curvature, and `left`, the share of the scan without a like in the template
#' @noRd
misfit_parts <- function(template, cloud, pose, settings, reach = 2 * settings$saturation) {
  local <- cloud_in_frame(cloud, pose)
  of <- function(x) settings$weight * rbind(x$k1, x$k2)
  found <- match_points(t(template$xyz), template$normal, of(template), local, of(local),
                        settings$warp_reach[1],
                        settings$cosine)
  gap <- sqrt(pmax(found$distance^2 - local$spacing[1]^2, 0) +
              colSums((of(template) - of(local)[, found$index])^2))
  gap[is.na(gap) | local$border[found$index]] <- reach
  thin <- cloud$coarse
  none <- function(n) matrix(0, 0, n)
  back <- match_points(t(local$xyz[, thin]), local$normal[, thin], none(length(thin)), template,
                       none(ncol(template$xyz)),
                       settings$warp_reach[1], settings$cosine)$distance
  apart <- ifelse(is.na(back), 1,
                  pmin(pmax(back - template$spacing[1], 0) / settings$saturation, 1))
  c(unlike = mean(pmin(gap / reach, 1)), left = mean(apart))
}

#' Rigid fits from some poses, each within bounds of scale about its own
#'
#' @param starts 13 x s. @param scale Two factors on the scale of each start.
#' @param more Most further steps at the last reach, until a pose rests.
#' @return List: `poses` (13 x s), `score`, `rests` (s).
#' @noRd
fit_poses <- function(template, cloud, starts, reach, scale, settings, thin, more = 0) {
  own <- if (thin) template$coarse else seq_len(ncol(template$xyz))
  at <- if (thin) cloud$coarse else seq_len(ncol(cloud$xyz))
  moving <- at_points(template[c("xyz", "normal")], own)
  fixed <- at_points(cloud[c("xyz", "normal")], at)
  out <- list(poses = starts, score = rep(1, ncol(starts)), rests = logical(ncol(starts)))
  alike <- round(starts[13, ], 2)
  for (about in unique(alike)) {
    these <- which(alike == about)
    rigid <- list(reach = reach, steps = as.integer(settings$steps), cosine = settings$cosine,
                  kept = settings$trim_share, scale = about * scale,
                  more = as.integer(more), rest = settings$rest,
                  saturation = settings$saturation, spacing = cloud$spacing[1 + thin])
    fits <- cpp_fit_poses(moving$xyz, moving$normal, fixed$xyz, fixed$normal,
                          starts[, these, drop = FALSE], rigid)
    out$poses[, these] <- fits$poses
    out$score[these] <- fits$score
    out$rests[these] <- fits$rests
  }
  out
}

#' A cloud in the frame of the template
#' @noRd
cloud_in_frame <- function(cloud, pose) {
  rotation <- matrix(pose[1:9], 3)
  cloud$xyz <- crossprod(rotation, cloud$xyz - pose[10:12]) / pose[13]
  cloud$normal <- crossprod(rotation, cloud$normal)
  cloud[c("k1", "k2")] <- lapply(cloud[c("k1", "k2")], `*`, pose[13])
  cloud$spacing <- cloud$spacing / pose[13]
  cloud
}

# Similarities, and the frames of template and scan.

#' Rotation, scale and shift that take points nearest to others
#' @noRd
similarity <- function(from, to) {
  a <- sweep(from, 2, colMeans(from))
  b <- sweep(to, 2, colMeans(to))
  turn <- nearest_rotation(a, b)
  rotation <- t(turn$rotation)
  scale <- sum(turn$d) / sum(a^2)
  list(rotation = rotation, scale = scale,
       shift = colMeans(to) - scale * drop(rotation %*% colMeans(from)))
}

apply_similarity <- function(xyz, by) {
  moved <- by$scale * xyz %*% t(by$rotation) + rep(by$shift, each = nrow(xyz))
  dimnames(moved) <- dimnames(xyz)
  moved
}

#' Points of the template's frame in that of a scan, and back
#' @noRd
from_frame <- function(xyz, laid) {
  t(laid$pose[13] * matrix(laid$pose[1:9], 3) %*% t(xyz) + laid$pose[10:12]) / laid$unit
}
into_frame <- function(xyz, laid) {
  t(crossprod(matrix(laid$pose[1:9], 3), t(xyz) * laid$unit - laid$pose[10:12])) / laid$pose[13]
}
