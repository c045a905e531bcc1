# Curves of which a scheme keeps the part next to one end: how much that is, and what to do where
# the other end is not on the mesh or cannot be reached.

#' A curve of a scheme on one specimen: all its fields are declared here
#'
#' @param points Data frame of n rows: x, y, z, face, w1, w2, w3, s, se; NA where the mesh ends
#'   before; NULL where the curve failed.
#' @param path,length,strength,contrast,se,se_max,competing,determined,noise_factor Of the curve.
#' @param reason What there is to say, NA where nothing.
#' @param remark As of [curve_remark()].
#' @param cut Of curves that are cut off: their share of the length asked for.
#' @param guessed Of these: whether way or length did without a landmark on the mesh.
#' @param track Of these: list of the whole `path`, `start` (arc length there of the first point),
#'   `kept` (length asked for).
#' @param followed Of these: what it was followed towards, NA where it was joined to both ends.
#' @noRd
new_record <- function(points = NULL, path = NULL, length = NA_real_, strength = NA_real_,
                       contrast = NA_real_, se = NA_real_, se_max = NA_real_,
                       competing = NA_real_, determined = NA, reason = NA_character_,
                       cut = NA_real_, guessed = NA, track = NULL, followed = NA_character_,
                       noise_factor = NA_real_, remark = NA_character_) {
  list(points = points, path = path, length = length, strength = strength, contrast = contrast,
       se = se, se_max = se_max, competing = competing, determined = determined, reason = reason,
       cut = cut, guessed = guessed, track = track, followed = followed,
       noise_factor = noise_factor, remark = remark)
}

#' Cut off the curves that a scheme cuts, all of one specimen by one factor
#'
#' If a curve between two landmarks is shorter than its share, the factor is lowered until all are
#' long enough, so that no two curves from one landmark both keep it. If the border of the mesh ends
#' a curve before its far landmark, the factor stays, and that curve lacks points.
#' @noRd
cut_curves <- function(scan, curves, fits, cut_scale) {
  cut <- which(!is.na(curves$cut_share))
  spans <- lapply(cut, function(i) cut_span(curves[i, ], scan))
  wanted <- curves$cut_share[cut] * vapply(spans, `[[`, 0, "length")
  whole <- vapply(fits[cut],
                  function(fit) if (is.na(fit$followed)) fit$length else NA_real_, 0)
  factor <- min(cut_scale, whole / wanted, na.rm = TRUE)
  shared <- if (factor < cut_scale) {
    sprintf("cut at %.3g of the scheme's share, as curves are short", factor)
  }
  for (k in seq_along(cut)) {
    i <- cut[k]
    if (is.null(fits[[i]]$path)) next
    fits[[i]] <- if (is.na(wanted[k])) {
      new_record(reason = spans[[k]]$note)
    } else {
      part <- cut_curve(scan, fits[[i]], factor * wanted[k], curves$n[i])
      part$cut <- factor / cut_scale
      part$guessed <- !is.null(spans[[k]]$note) || !is.na(fits[[i]]$followed)
      add_note(part, c(spans[[k]]$note, shared))
    }
  }
  fits
}

#' The `cut_scale` that a shape was measured with; NA where no curve was cut off
#' @noRd
asked_cut_scale <- function(shape) {
  curves <- shape$scheme$curves
  at <- list(landmarks = coords(shape, "landmarks"))
  checks <- shape$checks[shape$checks$level == "curves" & !is.na(shape$checks$cut), ]
  each <- vapply(intersect(checks$part, names(shape$tracks)), function(name) {
    row <- curves[match(name, curves$curve), ]
    ends <- landmark_places(at, c(row$cut_from, row$cut_to))
    kept <- shape$tracks[[name]]$kept / checks$cut[match(name, checks$part)]
    kept / (row$cut_share * sqrt(sum((ends[1, ] - ends[2, ])^2)))
  }, 0)
  if (all(is.na(each))) NA_real_ else stats::median(each, na.rm = TRUE)
}

#' Warn of shapes that were measured with different `cut_scale`s
#' @param apart Least relative difference that gives a warning.
#' @noRd
warn_cut_scales <- function(shapes, stage, apart = 0.02) {
  scale <- vapply(unname(shapes), asked_cut_scale, 0)
  warn_cut_factors(stats::setNames(scale, vapply(unname(shapes), `[[`, "", "id")), stage, apart)
}

#' @param scale Factors by id, NA where there is none.
#' @noRd
warn_cut_factors <- function(scale, stage, apart) {
  ids <- names(scale)[!is.na(scale)]
  scale <- unname(scale[!is.na(scale)])
  if (length(scale) < 2 || min(scale) >= (1 - apart) * max(scale)) return(invisible())
  far <- order(-abs(log(scale / stats::median(scale))))
  crestline_warn(
    sprintf("the curves were cut off by different factors (`cut_scale`): %s.",
            shorten(sprintf("%s by %.3g", ids[far], scale[far]))),
    sprintf(paste("Their ends are not the same places. Measure all with",
                  "fit_shape(measuring = shape_settings(cut_scale = %.3g)), then homologise()."),
            min(scale)),
    stage = stage, class = "crestline_cut_scale"
  )
}

#' A fit with more to say; one that failed has said why
#' @noRd
add_note <- function(fit, notes) {
  if (is.null(fit$points) || !length(notes)) return(fit)
  fit$reason <- paste(c(stats::na.omit(fit$reason), notes), collapse = "; ")
  fit
}

#' The distance between two landmarks that a curve's share is of
#'
#' Where one of a left-right pair is missing: twice the distance of the other from the mirror plane.
#' @return List: `length` (NA where it is not known), `note` (NULL where there is nothing to say).
#' @noRd
cut_span <- function(row, scan) {
  pairs <- scan$scheme$pairs
  at <- landmark_places(scan, c(row$cut_from, row$cut_to))
  known <- !is.na(at[, 1])
  if (all(known)) return(list(length = sqrt(sum((at[1, ] - at[2, ])^2))))
  gone <- c(row$cut_from, row$cut_to)[!known]
  plane <- if (any(known) && partner_of(row$cut_from, pairs, "landmarks") == row$cut_to) {
    mirror_plane(scan, pairs)
  }
  if (is.null(plane)) {
    return(list(length = NA_real_, note = sprintf(
      "%s is missing: where to cut it is not known", toString(gone)
    )))
  }
  list(length = 2 * abs(sum(at[known, ] * plane$normal) - plane$offset),
       note = sprintf("%s is missing: cut by the distance of its pair from the mirror plane", gone))
}

#' Positions of landmarks by name, NA where missing
#' @noRd
landmark_places <- function(specimen, names) {
  unname(specimen$landmarks[match(names, rownames(specimen$landmarks)), , drop = FALSE])
}

#' The plane of symmetry of a specimen's landmarks
#'
#' Its normal is the mean direction from right to left of the pairs; without a whole pair that of
#' the plane through the landmarks of the middle.
#' @param flat Without a pair: greatest spread of the middle landmarks across their plane, as a
#'   share of their least spread in it. More of it, or fewer than three landmarks, give no plane.
#' @return List: `normal`, `offset`; NULL where there is none.
#' @noRd
mirror_plane <- function(specimen, pairs, flat = 0.5) {
  pairs <- pairs[pairs$level == "landmarks", ]
  left <- landmark_places(specimen, pairs$left)
  right <- landmark_places(specimen, pairs$right)
  whole <- !is.na(left[, 1] + right[, 1])
  left <- left[whole, , drop = FALSE]
  right <- right[whole, , drop = FALSE]
  middle <- setdiff(rownames(specimen$landmarks), c(pairs$left, pairs$right))
  middle <- rbind(stats::na.omit(landmark_places(specimen, middle)), (left + right) / 2)
  if (any(whole)) {
    normal <- unit_vector(colSums(left - right))
  } else if (nrow(middle) >= 3) {
    spread <- svd(sweep(middle, 2, colMeans(middle)), nu = 0)
    if (spread$d[3] > flat * spread$d[2]) return(NULL)
    normal <- spread$v[, 3]
  } else {
    return(NULL)
  }
  list(normal = normal, offset = mean(middle %*% normal))
}

#' Where a landmark is in space: its own co-ordinates, or the mirror image of its pair
#' @noRd
far_target <- function(name, scan) {
  pairs <- scan$scheme$pairs
  own <- landmark_places(scan, name)
  if (!is.na(own[1])) return(list(at = as.vector(own), name = name))
  partner <- partner_of(name, pairs, "landmarks")
  at <- landmark_places(scan, partner)
  plane <- if (partner != name && !is.na(at[1])) mirror_plane(scan, pairs)
  if (is.null(plane)) return(NULL)
  list(at = as.vector(at) - 2 * (sum(at * plane$normal) - plane$offset) * plane$normal,
       name = paste("the mirror image of", partner))
}

#' The farthest place of the mesh on the way to a point in space
#'
#' Of the cuts through both the shortest, what the mesh lacks counted in, followed to where it comes
#' nearest to the point.
#' @param near A place on the mesh, named as `mesh_columns`.
#' @param target Three co-ordinates.
#' @param angles Number of planes, over a half turn.
#' @param bend Length of what the mesh lacks, as a multiple of the straight distance. A quarter of a
#'   circle has 1.11, half of one 1.57. With less than 1.3 cuts win that end early (on a face with
#'   its ear cut off), with more those that run along the edge.
#' @param inside As in [path_ends()].
#' @return A place on the mesh; NULL where no cut comes nearer than `near` is.
#' @noRd
way_out <- function(scan, near, target, angles = 121, bend = 1.35, inside = 1e-6) {
  xyz <- scan$vb[1:3, , drop = FALSE]
  weight <- near[c("w1", "w2", "w3")] + inside
  at <- as.vector(xyz[, scan$it[, near[["face"]]]] %*% weight) / sum(weight)
  axis <- unit_vector(target - at)
  across <- unit_vector(cross_product(axis, path_normals(scan, as.list(near))[, 1]))
  normals <- plane_normal(
    list(axis = axis, across = across), seq(-pi / 2, pi / 2, length.out = angles)[-1]
  )
  ways <- lapply(seq_len(ncol(normals)), function(i) {
    level <- as.vector(normals[, i] %*% xyz) - sum(normals[, i] * at)
    walk <- cpp_level_path(scan$vb, scan$it, scan$twin, near[["face"]], 0, seq_along(level), level,
                           axis)$points
    way_towards(walk, at, target, bend)
  })
  ways <- Filter(Negate(is.null), ways)
  if (!length(ways)) return(NULL)
  best <- ways[[which.min(vapply(ways, `[[`, 0, "length"))]]
  stats::setNames(best$end, mesh_columns)
}

#' How far a walk leads towards a point: length to the place nearest to it and from there on, and
#' that place
#' @noRd
way_towards <- function(walk, at, target, bend) {
  gap <- row_lengths(sweep(rbind(at, walk[, 1:3]), 2, target))
  best <- which.min(gap)
  if (best == 1) return(NULL)
  steps <- row_lengths(diff(rbind(at, walk[seq_len(best - 1), 1:3])))
  list(length = sum(steps) + bend * gap[best], end = walk[best - 1, ])
}

#' The last part of a curve, of a given length, as n points; where the curve is shorter, those of
#' them that it has
#' @noRd
cut_curve <- function(mesh, fit, length, n) {
  step <- length / (n - 1)
  placed <- min(n, floor(fit$length / step * (1 + sqrt(.Machine$double.eps))) + 1)
  ended <- sprintf("it ends after %.3g of %.3g: %d of %d points missing", fit$length, length,
                   n - placed, n)
  if (placed < 2) {
    return(new_record(reason = paste(c(stats::na.omit(fit$reason), ended), collapse = "; ")))
  }
  start <- max(fit$length - (placed - 1) * step, 0)
  path <- part_of_path(mesh, fit$path, start, fit$length)
  at <- resample_path(mesh, path, placed)
  se <- rep(NA_real_, placed)
  if (any(is.finite(fit$points$se))) {
    se <- stats::approx(fit$points$s, fit$points$se, at$s + start, rule = 2)$y
  }
  points <- cbind(at[c(mesh_columns, "s")], se = se)[c(rep(NA, n - placed), seq_len(placed)), ]
  rownames(points) <- NULL
  cut <- list(points = points, path = path, length = attr(path, "length"), se = stats::median(se),
              se_max = largest(se),
              track = list(path = fit$path, start = start, kept = length))
  fit[names(cut)] <- cut
  add_note(fit, if (placed < n) ended)
}

# Where the points of a shape's curves can slide: the whole curve as it was found, before it was cut
# off.

#' Tracks of curves
#'
#' @param fits As of [fit_scheme_curves()].
#' @param scan As of [prepare_scan()].
#' @return List by name of the curves that were found: `path` (`mesh_path`, uncut, over bridges
#'   where there are holes), `s` (arc length there of each of the curve's points, NA where missing),
#'   `kept` (length that the scheme keeps), `cut` (whether the first point stands where the scheme
#'   cuts the curve off, and not at a landmark), `off` (rows of the path that end a segment over a
#'   bridge).
#' @noRd
curve_tracks <- function(fits, scan) {
  found <- Filter(function(fit) !is.null(fit$path) && !is.null(fit$points), fits)
  curves <- scan$scheme$curves
  cut <- !is.na(curves$cut_share[match(names(found), curves$curve)])
  Map(function(fit, cut) {
    path <- if (is.null(fit$track)) fit$path else fit$track$path
    path <- new_mesh_path(unclass(path)[c("s", mesh_columns)], attr(path, "length"),
                          attr(path, "key"), attr(path, "id"), closed = attr(path, "closed"))
    s <- ifelse(is.na(fit$points$x), NA,
                fit$points$s + if (is.null(fit$track)) 0 else fit$track$start)
    list(path = path, s = s, kept = if (is.null(fit$track)) fit$length else fit$track$kept,
         cut = cut,
         off = which(path$face > scan$faces))
  }, found, cut)
}

#' Refuse tracks that do not lie on the mesh of a shape, or whose points do not lie on them
#'
#' @param scan The shape's specimen with its holes bridged, as of [walkable()].
#' @noRd
check_tracks <- function(shape, scan) {
  for (name in names(shape$tracks)) {
    track <- shape$tracks[[name]]
    said <- sprintf("the track of %s", name)
    check_class(track$path, "mesh_path", said, "fit_shape()")
    check_places(track$path, scan, said, shape$id)
    s <- track$s[!is.na(track$s)]
    right <- is.numeric(track$s) &&
      length(track$s) == sum(shape$points$level == "curves" & shape$points$part == name) &&
      !is.unsorted(s) && on_its_path(s, track$path)
    if (!right) {
      crestline_abort(sprintf("%s has points that are not on it, in order.", said),
                      "Give a shape as fit_shape() or slide() returns it, whole.", stage = "shape",
                      id = shape$id,
                      class = "crestline_wrong_mesh", call = NULL)
    }
  }
}

#' Whether points at rising arc lengths lie on a path: those of a closed one within one turn, which
#' may cross its seam
#' @param rounding Relative.
#' @noRd
on_its_path <- function(s, path, rounding = 1e-9) {
  length <- attr(path, "length")
  if (is_closed(path)) return(all(abs(s) <= 2 * length) && diff(range(s)) < length)
  all(abs(s / length - 0.5) <= 0.5 + rounding)
}
