#' Settings of find_landmarks()
#'
#' All tuning constants of [find_landmarks()] in one place. Lengths are in mm, for a face. They are
#' multiplied by the `unit` of the template, so that they fit a template of another size, see
#' [landmark_template()].
#'
#' @param ... Former names of settings: `kept`, `kernel_length`, `kernel_sd`, `robust`. They give a
#'   message of class `crestline_deprecated`.
#' @param cluster,coarse Edge of the cells by which vertices are thinned out, one vertex in each:
#'   for the fits, and for the first fits (length).
#' @param bend,feature Radii of the curvature estimates: for finding anchors, and for matching
#'   points (length).
#' @param cap Least absolute value of both principal curvatures at an anchor (1 / length).
#' @param apart Least distance of two anchors (length).
#' @param anchors,own Number of anchors that are tried, of caps and of cups each: on the scan, and
#'   on the template.
#' @param turns Number of rotations about the normal that are tried for each pair of anchors.
#' @param reach Greatest distance of a match in the rigid fits, at the first and at the last step
#'   (two lengths).
#' @param steps Number of steps of a rigid fit.
#' @param trim_share Share of the matches that are used, closest first, as in trimmed ICP.
#' @param followed,refined Number of the best starts that are continued: on thinned clouds, and on
#'   full clouds.
#' @param tight,loose Bounds of the scale: at first, and if the fit is poor (two numbers each, no
#'   unit).
#' @param cosine Least cosine of the angle between the normals of two matched points.
#' @param saturation Distance beyond which a point of the template counts as unmatched in the score
#'   (length).
#' @param poor,refuse Scores (0 to 1). Up to `poor`, a fit from a strong cap or cup is good enough.
#'   Above `refuse`, [find_landmarks()] stops with an error.
#' @param left_over Weight of the share of the scan without a match in the template, relative to the
#'   share of the template without a match in the scan. It is used when poses are compared.
#' @param length_scale,length_scale_sd Length scales and standard deviations of the Gaussian
#'   processes of which the displacement is the sum (three lengths each).
#' @param affine Standard deviation of the affine part of the displacement (length).
#' @param uneven Standard deviation of its left-right antisymmetric part, as a share.
#' @param rank Number of basis functions.
#' @param weight Weight of curvature against position in a match (length squared).
#' @param warp_reach,warp_steps Greatest distance of a match in the warp, at the first and at the
#'   last step (two lengths); number of its steps.
#' @param light_points,whole_steps Number of the template's points in the steps of the warp, and
#'   number of last steps that use all points.
#' @param light_points,whole_steps Number of the template's points in the steps of the warp but the
#'   last, and number of those last steps, which take all points.
#' @param error Standard deviation of a match (length).
#' @param robust_scale Scale of the Cauchy weights (length).
#' @param along Weight of the part of a match that runs along the surface.
#' @param points,thin Number of the template's points: of the fits, and of the first fits.
#' @param moved,off,vague Distances at which confidence is a half (lengths). `moved`: between the
#'   positions with and without curvature. `off`: between template and scan near a landmark.
#'   `vague`: the standard deviation that missing parts of the scan add.
#' @param near,about Radius of the neighbourhood of a landmark (length), and the least number of the
#'   template's points in it.
#' @param lost Share of unmatched points near a landmark from which on the landmark counts as
#'   absent.
#' @param slip Distance along the surface beyond which a match is rejected, in units of `cluster`.
#' @param low Confidence below which a found landmark is doubtful.
#' @param wrong Share of doubtful landmarks above which the whole result is doubtful. On 42 faces
#'   with correct results the share is at most 0.47. On two faces with wrong results, and on objects
#'   that are not faces, it is at least 0.68.
#' @param fewest Least number of matches for the deformation of the template.
#' @param step Edge of the cells by which the positions are thinned out that the template's `start`
#'   is placed on (length).
#' @param ball,proud The height of a position is measured over the weighted centroid of a ball of
#'   radius `ball` (length), along the mean normal. A position is tried if it is higher than the
#'   share `proud` of the height of the template's `start`. Nose tips of 38 faces are 11 to 17 mm
#'   high.
#' @param look_up Edge of the cells of the look-up table that scores starts, and the distance beyond
#'   which a point counts as unmatched there (two lengths).
#' @param start_turns,start_scales Number of rotations about the mean normal, and the scales that
#'   are tried if no start of scale 1 is accepted (two numbers).
#' @param start_points,start_cosine Number of the template's points in the score of a start, and
#'   least cosine of the angle between their normals and those of their matches.
#' @param start_each,starts Greatest number of starts that are fitted: of one position, and in all.
#' @param start_angle,start_gap Starts count as equal if their rotations differ by less than this
#'   angle (degrees), and their positions by less than this length.
#' @param start_reach Greatest distance of a match at the first step of the fit of a start (length).
#' @param good,unlike A pose is accepted if its score is at most the first number of `good`. Up to
#'   the second number it is accepted if at most the share `unlike` of the template differs from the
#'   scan in position or curvature.
#' @param agree Limits of the agreement of curvature (-1 to 1), see [find_landmarks()]. Below the
#'   first the scan is no face. From the second on it is a face. Of 60 other objects 58 had less
#'   than 0.30 and two up to 0.33; 20 whole faces and 6 expressions had more than 0.45.
#' @param sure Agreement from which a pose whose score is not accepted is taken all the same. Below
#'   it, caps and cups are tried too. Two faces with a side cut off, which were wrong at 0.49 and
#'   0.56, are right so.
#' @param unsure Greatest confidence of a landmark if the agreement is between these limits.
#' @param clip Curvatures are limited to this absolute value in the agreement (1 / length).
#' @param rest,rest_steps The best pose is fitted further: `rest_steps[1]` steps with a decreasing
#'   reach, then at most `rest_steps[2]` until a step moves the template by less than `rest` (root
#'   mean square, length).
#' @param diagonals,size_apart If nothing agrees and no unit is given, units are tried that bring
#'   the scan to these sizes (five lengths). A size within this factor of the first is left out.
#' @param unit_apart If no unit is given and the object is larger or smaller than the template by
#'   more than this factor, its unit is called a guess. Faces of adults differ by less than 1.2.
#' @param resized If the object is larger or smaller than the template by more than this factor, or
#'   its unit is a guess, and the agreement is below `sure`, it is fitted again in the unit that
#'   makes it as large as the template.
#' @param score_apart A second unit is fitted if its score is greater by at most this.
#' @param ball_points Greatest mean number of vertices in a ball of radius `feature`. A mesh with
#'   more is thinned out before its curvature is estimated.
#' @param expressive Expressions are tried if the share of the template that differs from the scan
#'   is at least this.
#' @param jaw,jaw_gain Angles of the jaw that are tried (four, radians). The best is used if it
#'   lowers the misfit of the pose by at least `jaw_gain`.
#' @param shared_doubt Share by which the landmarks of the mouth's slit have the least confidence of
#'   them all: 0, each its own; 1, all the least. An open mouth displaces them together.
#' @param smile,smile_gain Distances by which the mouth's corners are drawn outwards and up (two, as
#'   shares of half the mouth's width). The best is used if it lowers the energy of the warp by at
#'   least the share `smile_gain`.
#' @param ear Share of a patch of an ear that may differ from the scan in position or curvature
#'   (two numbers): anywhere, and where the scan is as hollow as `ear_hollow` says. Beyond it the
#'   tragion is where the other landmarks predict it. The share was at most 0.57 on 22 ears of 11
#'   simulated faces, 0.63 and 0.71 on those of a scan, and 0.66 to 0.79 on twelve sides without an
#'   ear or with a stump of it.
#' @param ear_radius,ear_shift,ear_tilt,ear_reach The patch is fitted to the scan within
#'   `ear_radius` of the prediction (length). Starts lie `ear_shift` below and above the hollow of
#'   the scan's ear (length), and are tilted by `ear_tilt` (radians). `ear_reach` is the
#'   greatest distance of a match, at the first and at the last step (two lengths).
#' @param ear_hollow The hollow of an ear is sought in balls of this radius, within this distance of
#'   the prediction. From the third number on it counts as deep: the sum of the smaller curvature of
#'   cups over the area of the ball (three lengths). It was 9.5 to 24.5 on these 24 ears, 3.7 and
#'   6.6 on two stumps, and at most 1.5 without an ear.
#' @param ear_thin Edge of the cells by which the patch is thinned out for the first of its fits
#'   (length).
#' @param placed Weight of a landmark that the scan has before, as a number of matched points of the
#'   template. 10 was best of 3, 10, 30 and 100 with four landmarks of 17 faces (the error of the
#'   others is then lower by 0.03 to 0.09 mm in the mean).
#' @param contrary Distance from which on such a landmark contradicts what is found without it (two
#'   lengths): of landmarks that are found, and of those that are predicted, which some put at the
#'   edge of a mask instead of the ear.
#' @return List of class `find_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is not
#'   numeric.
#' @template glossary
#' @examples
#' find_settings(turns = 24)
#' @export
find_settings <- function(..., cluster = 2.5, coarse = 5, bend = 12, feature = 8, cap = 0.03,
                          apart = 12, anchors = 8, own = 2, turns = 12, reach = c(40, 10),
                          steps = 6, trim_share = 0.7, followed = 16, refined = 4,
                          tight = c(0.95, 1.05), loose = c(0.75, 1.3), cosine = 0.5,
                          saturation = 5, poor = 0.55, refuse = 0.76, left_over = 0.5,
                          length_scale = c(60, 30, 15), length_scale_sd = c(4, 2.5, 1.5),
                          affine = 5, uneven = 0.3, rank = 220, weight = 80,
                          warp_reach = c(15, 6), warp_steps = 12, whole_steps = 3,
                          light_points = 900, error = 3, robust_scale = 1.5,
                          along = 0.1, points = 2500, thin = 200, moved = 2, off = 2.5,
                          vague = 1.5, near = 8, about = 8, lost = 0.4, slip = 2, low = 0.5,
                          wrong = 0.6, fewest = 30, step = 7, ball = 40, proud = 0.55,
                          look_up = c(4, 15), start_turns = 16, start_points = 100,
                          start_cosine = 0.3, start_each = 3, starts = 40,
                          start_angle = 25, start_gap = 12, start_reach = 25,
                          start_scales = c(0.85, 1.15), good = c(0.45, 0.55), unlike = 0.38,
                          agree = c(0.3, 0.45), sure = 0.6, unsure = 0.4, clip = 0.15,
                          rest = 0.02, rest_steps = c(24, 100),
                          diagonals = c(200, 290, 420, 600, 870), size_apart = 1.1,
                          unit_apart = 1.3, resized = 1.2, score_apart = 0.03,
                          ball_points = 300,
                          expressive = 0.22, jaw = c(0.1, 0.2, 0.3, 0.4), jaw_gain = 0.03,
                          shared_doubt = 0.5, smile = c(0.2, 0.4), smile_gain = 0.04, placed = 10,
                          contrary = c(12, 80), ear = c(0.55, 0.8), ear_radius = 65,
                          ear_shift = 8, ear_tilt = 0.2, ear_reach = c(20, 10),
                          ear_hollow = c(12, 45, 8), ear_thin = 8) {
  sizes <- lengths(lapply(formals(find_settings)[-1], eval))
  former <- c(kept = "trim_share", kernel_length = "length_scale", kernel_sd = "length_scale_sd",
              robust = "robust_scale")
  new_settings("find_settings", function(settings) check_find_settings(settings, sizes),
               list(...), former = former)
}

check_find_settings <- function(settings, sizes) {
  may_be_none <- c("placed", "shared_doubt", "cap", "affine", "uneven", "weight", "along",
                   "left_over", "lost", "cosine", "low")
  for (name in names(settings)) {
    value <- settings[[name]]
    size <- sizes[[name]]
    low <- if (name == "agree") -1 else if (name %in% may_be_none) 0 else .Machine$double.xmin
    if (!is.numeric(value) || !is.null(dim(value)) || length(value) != size ||
        any(!is.finite(value) | value < low)) {
      crestline_abort(sprintf("`%s` is %s.", name, describe_value(value)),
                      sprintf("Give %d finite number%s %s.", size, if (size > 1) "s" else "",
                              if (low > 0) "above 0" else paste("of at least", low)),
                      stage = "arguments")
    }
  }
  settings
}

#' @export
print.find_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<find_settings> of find_landmarks()")
}

#' The settings' lengths for a template of another size
#' @noRd
scaled_settings <- function(settings, unit) {
  lengths <- c("cluster", "coarse", "bend", "feature", "apart", "reach", "saturation",
               "length_scale", "length_scale_sd", "affine", "warp_reach", "error",
               "robust_scale", "moved", "off", "vague", "near", "step", "ball", "look_up",
               "start_gap", "start_reach", "rest", "diagonals", "contrary", "ear_radius",
               "ear_shift", "ear_reach", "ear_hollow", "ear_thin")
  settings[lengths] <- lapply(settings[lengths], `*`, unit)
  settings[c("cap", "clip")] <- lapply(settings[c("cap", "clip")], `/`, unit)
  settings$weight <- settings$weight * unit^2
  settings
}
