# Expressions that are no small displacement: the template with its jaw open, or its mouth's corners
# drawn up and out.

#' The template with the expression that a scan has, as far as the scan shows it
#'
#' An open jaw shows in the pose's misfit. A smile does not: it shows in how far the template must
#' then be bent, and must not lower the agreement.
#'
#' @param template As of [prepared_template()], with `modes`.
#' @param laid As of [settled_pose()].
#' @return List: `template`, `laid` (its pose and what follows from it taken anew).
#' @noRd
expressed_pose <- function(template, laid, settings) {
  same <- list(template = template, laid = laid)
  if (!length(template$modes$slit)) return(same)
  parts <- misfit_parts(template, laid$cloud, laid$pose, settings)
  if (parts[["unlike"]] < settings$expressive) return(same)
  opened <- best_jaw(template, laid, settings)
  local <- cloud_in_frame(laid$cloud, opened$pose)
  light <- utils::modifyList(settings, list(whole_steps = 0))
  tried <- c(list(opened$template),
             lapply(settings$smile, function(share) smiled(opened$template, share)))
  bend <- vapply(tried, function(one) {
    sum(fit_warp(one, local, light, settings$weight)$coefficients^2)
  }, 0)
  best <- if (min(bend) < (1 - settings$smile_gain) * bend[1]) which.min(bend) else 1
  if (best == 1 && !opened$open) return(same)
  laid[c("pose", "score", "misfit")] <- opened[c("pose", "score", "misfit")]
  plain <- if (opened$open) agreed_pose(opened$template, laid, settings) else same$laid
  smiling <- if (best > 1) agreed_pose(tried[[best]], laid, settings)
  if (best == 1 || smiling$agree < plain$agree) {
    return(list(template = opened$template, laid = plain))
  }
  list(template = tried[[best]], laid = smiling)
}

#' The angle of the jaw with the least misfit, 0 where none is better by enough
#'
#' Poses start from what is laid, and from where the part above the mouth comes to lie by itself.
#'
#' @return List: `template`, `pose`, `score`, `misfit`, `open`.
#' @noRd
best_jaw <- function(template, laid, settings) {
  upper <- at_points(template[c("xyz", "normal")],
                     which(jaw_share(t(template$xyz), template$modes) < 0.3))
  reach <- c(2, 0.5) * settings$reach[2]
  high <- fit_poses(upper, laid$cloud, cbind(laid$pose), reach, settings$loose, settings, FALSE)
  starts <- cbind(laid$pose, high$poses)
  fits <- lapply(c(0, settings$jaw), function(angle) {
    one <- if (angle > 0) jaw_opened(template, angle) else template
    found <- fitted_poses(one, laid$cloud, starts, c(1, 0.5) * settings$reach[2], settings$loose,
                          settings)
    c(list(template = one, open = angle > 0),
      found[[which.min(vapply(found, `[[`, 0, "misfit"))]])
  })
  misfit <- vapply(fits, `[[`, 0, "misfit")
  best <- which.min(misfit)
  if (misfit[best] < min(laid$misfit, misfit[1]) - settings$jaw_gain) return(fits[[best]])
  c(list(template = template, open = FALSE), laid[c("pose", "score", "misfit")])
}

#' Where a template's expressions take place, in its own frame
#'
#' @param at Landmarks (k x 3), those predicted too.
#' @param hinge,moves,slit As of [landmark_template()].
#' @return List: `hinge` (y and z of the line that the jaw turns about), `corner` (x > 0) and
#'   `middle` (3, of the slit), `moves`, `slit` (names).
#' @noRd
template_modes <- function(at, hinge, moves, slit) {
  ends <- at[slit, , drop = FALSE]
  corner <- which.max(ends[, 1])
  list(hinge = unname(colMeans(at[hinge, 2:3, drop = FALSE])), corner = unname(ends[corner, ]),
       middle = unname(ends[which.min(abs(ends[, 1])), ]), moves = moves, slit = slit)
}

#' How far each point goes with the jaw, 0 to 1
#'
#' A logistic function of the distance below the plane through the hinge and the slit's corners; the
#' plane is bent down to the slit's middle. It is sharp between the lips, and blurred beyond their
#' corners and behind, where skin stretches. Lengths are shares of the slit's half width.
#'
#' @param xyz n x 3, in the template's frame.
#' @noRd
jaw_share <- function(xyz, modes) {
  half <- modes$corner[1]
  along <- modes$corner[2:3] - modes$hinge
  up <- c(along[2], -along[1]) / sqrt(sum(along^2))
  if (up[1] < 0) up <- -up
  across <- abs(xyz[, 1])
  from <- sweep(xyz[, 2:3, drop = FALSE], 2, modes$corner[2:3])
  below <- -drop(from %*% up)
  sag <- -sum((modes$middle - modes$corner)[2:3] * up) * pmax(1 - (across / half)^2, 0)
  beside <- pmin(pmax(across / half - 0.8, 0), 1)
  behind <- pmin(pmax(modes$corner[3] - 0.4 * half - xyz[, 3], 0) / (1.6 * half), 1)
  stats::plogis((below - sag) / (half * (0.03 + 0.28 * pmax(beside, behind))))
}

#' A prepared template with its jaw turned about the hinge by an angle (radians)
#' @noRd
jaw_opened <- function(template, angle) {
  modes <- template$modes
  turn <- function(xyz, share, about) {
    y <- xyz[, 2] - about[1]
    z <- xyz[, 3] - about[2]
    a <- angle * share
    cbind(xyz[, 1], about[1] + cos(a) * y - sin(a) * z, about[2] + sin(a) * y + cos(a) * z)
  }
  share <- jaw_share(t(template$xyz), modes)
  names <- rownames(template$landmarks)
  of_landmarks <- ifelse(names %in% modes$moves, 1, ifelse(names %in% modes$slit, 0.5, 0))
  template$xyz <- t(turn(t(template$xyz), share, modes$hinge))
  template$normal <- t(turn(t(template$normal), share, c(0, 0)))
  template$landmarks[] <- turn(template$landmarks, of_landmarks, modes$hinge)
  template
}

#' A prepared template whose mouth's corners are drawn out, up and back
#'
#' @param share Of the slit's half width: how far. The skin about a corner follows by a Gaussian of
#'   0.65 of that width.
#' @noRd
smiled <- function(template, share) {
  corner <- template$modes$corner
  half <- corner[1]
  way <- share * half * c(0.7, 0.6, -0.4) / sqrt(1.01)
  moved <- function(xyz) {
    side <- ifelse(xyz[, 1] < 0, -1, 1)
    from <- cbind(abs(xyz[, 1]) - half, xyz[, 2] - corner[2], xyz[, 3] - corner[3])
    weight <- exp(-rowSums(from^2) / (2 * (0.65 * half)^2))
    list(xyz = xyz + weight * cbind(side * way[1], way[2], way[3]),
         slope = -weight * from / (0.65 * half)^2, side = side)
  }
  found <- moved(t(template$xyz))
  # Normals turn by the inverse transpose of I + way slope'.
  normal <- t(template$normal)
  normal[, 1] <- found$side * normal[, 1]
  lean <- drop(normal %*% way) / (1 + drop(found$slope %*% way))
  normal <- normal - lean * found$slope
  normal[, 1] <- found$side * normal[, 1]
  template$xyz <- t(found$xyz)
  template$normal <- t(normal / row_lengths(normal))
  template$landmarks[] <- moved(template$landmarks)$xyz
  template
}
