# Starts of the rigid fits: the template set down on every place of the scan that stands proud.

#' Starts: the template's own start on every proud place of a cloud, in turns about the normal
#'
#' A place stands proud by its height over the centroid of the ball about it, along the mean normal
#' of the ball. Poses, turns and cells are in the cloud's own axes, so that its pose has no say.
#'
#' @param scales Factors on the template.
#' @return 13 x s: a column a pose, the best first, those that hardly differ left out.
#' @noRd
proud_starts <- function(template, cloud, scales, settings) {
  thin <- at_points(cloud[c("xyz", "normal")], cloud$coarse)
  axes <- principal_axes(t(thin$xyz))
  thin$xyz <- crossprod(axes$rotation, thin$xyz - axes$centre)
  thin$normal <- crossprod(axes$rotation, thin$normal)
  at <- thin$xyz[, cell_vertices(t(thin$xyz), settings$step), drop = FALSE]
  mound <- cpp_mounds(thin$xyz, thin$normal, at, settings$ball)
  proud <- which(mound[4, ] > settings$proud * template$start$height)
  search <- list(turns = as.integer(settings$start_turns), scales = scales,
                 voxel = settings$look_up[1], reach = settings$look_up[2],
                 spacing = cloud$spacing[2], cosine = settings$start_cosine,
                 each = as.integer(settings$start_each))
  found <- cpp_search_starts(template$start, thin, at[, proud, drop = FALSE],
                             mound[, proud, drop = FALSE], search)
  chosen <- distinct_starts(found, at[, proud, drop = FALSE], settings)
  vapply(chosen, function(i) {
    pose <- found[1:13, i]
    rotation <- axes$rotation %*% matrix(pose[1:9], 3) %*% t(template$start$frame)
    shift <- axes$rotation %*% pose[10:12] + axes$centre -
      pose[13] * rotation %*% template$start$anchor
    c(rotation, shift, pose[13])
  }, numeric(13))
}

#' Which starts to keep: the best, each apart from those before it in place, turn or scale
#' @param found As of `cpp_search_starts()`; `at` (3 x places).
#' @noRd
distinct_starts <- function(found, at, settings, most = 1000) {
  left <- seq_len(min(ncol(found), most))
  chosen <- integer()
  while (length(left) && length(chosen) < settings$starts) {
    i <- left[1]
    chosen <- c(chosen, i)
    cosine <- (drop(crossprod(found[1:9, left, drop = FALSE], found[1:9, i])) - 1) / 2
    gap <- sqrt(colSums((at[, found[15, left], drop = FALSE] - at[, found[15, i]])^2))
    like <- cosine > cos(settings$start_angle * pi / 180) & gap < settings$start_gap &
      found[13, left] == found[13, i]
    left <- left[!like]
  }
  chosen
}

#' Where a template is set down: its points about its anchor, along the anchor's mean normal
#'
#' @param anchor The place (3); NULL: the proudest.
#' @return List: `anchor` (3), `frame` (3 x 3, columns: two axes and the normal), `height` (of the
#'   anchor), `xyz`, `normal` (3 x n, some of the points, in the frame about the anchor).
#' @noRd
template_start <- function(template, anchor, settings) {
  few <- at_points(template[c("xyz", "normal")], template$coarse)
  at <- if (is.null(anchor)) few$xyz else cbind(unname(anchor))
  mound <- cpp_mounds(few$xyz, few$normal, at, settings$ball)
  best <- which.max(mound[4, ])
  normal <- mound[1:3, best]
  frame <- cbind(qr.Q(qr(cbind(normal, diag(3))))[, 2:3], normal)
  if (det(frame) < 0) frame[, 1] <- -frame[, 1]
  area <- template$spacing[2]^2 * ncol(few$xyz)
  own <- cell_vertices(t(few$xyz), sqrt(area / settings$start_points))
  list(anchor = at[, best], frame = frame, height = mound[4, best],
       xyz = crossprod(frame, few$xyz[, own, drop = FALSE] - at[, best]),
       normal = crossprod(frame, few$normal[, own, drop = FALSE]))
}
