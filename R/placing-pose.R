# Where the template lies in a scan: rotation, shift and scale, from anchors in many turns.

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
#' All starts go some steps on thin clouds; the better go on, the best that differ on the whole, and
#' the one with the least misfit is fitted again with a free scale.
#'
#' @return List: `pose` (13 numbers: rotation, shift, scale), `score`, `misfit`.
#' @noRd
best_pose <- function(template, cloud, own, scale, settings) {
  starts <- anchor_starts(template, cloud, own, settings)
  if (!ncol(starts)) return(list(pose = c(diag(3), 0, 0, 0, 1), score = 1, misfit = Inf))
  middle <- exp(mean(log(settings$reach)))
  first <- fit_poses(template, cloud, starts, c(settings$reach[1], middle), scale, settings,
                     thin = TRUE)
  better <- utils::head(order(first$score), settings$followed)
  second <- fit_poses(template, cloud, first$poses[, better, drop = FALSE],
                      c(middle, settings$reach[2]), scale, settings,
                      thin = TRUE)
  # The best of the fitted poses that put the template's centre in different places or turns
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
  tight <- fitted_poses(template, cloud, second$poses[, chosen, drop = FALSE], last, scale,
                        settings)
  best <- tight[[which.min(vapply(tight, `[[`, 0, "misfit"))]]
  free <- fitted_poses(template, cloud, cbind(best$pose), last, settings$loose, settings)[[1]]
  if (free$misfit < best$misfit) free else best
}

#' Poses fitted to whole clouds, with score and misfit
#' @return List of lists as of [best_pose()].
#' @noRd
fitted_poses <- function(template, cloud, starts, reach, scale, settings) {
  fits <- fit_poses(template, cloud, starts, reach, scale, settings, thin = FALSE)
  lapply(seq_along(fits$score), function(i) {
    list(pose = fits$poses[, i], score = fits$score[i],
         misfit = pose_misfit(template, cloud, fits$poses[, i], settings))
  })
}

#' What speaks against a pose: the template's points without a like in the scan, in place and
#' curvature, and the share of the scan without a like in the template
#' @noRd
pose_misfit <- function(template, cloud, pose, settings, reach = 2 * settings$saturation) {
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
  mean(pmin(gap / reach, 1)) + settings$left_over * mean(apart)
}

fit_poses <- function(template, cloud, starts, reach, scale, settings, thin) {
  own <- if (thin) template$coarse else seq_len(ncol(template$xyz))
  at <- if (thin) cloud$coarse else seq_len(ncol(cloud$xyz))
  rigid <- list(reach = reach, steps = as.integer(settings$steps), cosine = settings$cosine,
                kept = settings$trim_share,
                scale = scale, saturation = settings$saturation, spacing = cloud$spacing[1 + thin])
  cpp_fit_poses(template$xyz[, own, drop = FALSE], template$normal[, own, drop = FALSE],
                cloud$xyz[, at, drop = FALSE],
                cloud$normal[, at, drop = FALSE], starts, rigid)
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
