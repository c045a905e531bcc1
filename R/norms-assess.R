# One face against a norm: z, centiles, maps, the scan, the healed face, and verdicts by family.

#' Compare a face with norms of its age and sex
#'
#' Gives z and centile of size, measurements and components of shape. Maps compare every surface
#' point with the norm, and search for places that do not fit the rest of the face. Every z has two
#' errors: that of the scan and that of the norm.
#'
#' There are two maps. The *marginal map* compares each point with that of all faces of this age and
#' sex. The *scan* asks whether a place fits the rest of this face: it takes what the rest makes
#' expected there, and looks for bumps of several radii, on one side or on both at once. Each side
#' tells what to expect of the other. The scan finds small lesions that the marginal map cannot see.
#' Where it finds something, the *healed face* shows what a face with these surroundings would have
#' there, with its standard deviation. The *asymmetry scan* compares the asymmetry of the face with
#' that of the norm, not with zero, since the mean face is not symmetric.
#'
#' Deviations along the surface (`tangential`, `d2`) are correspondence as much as anatomy: points
#' of patches can be placed only so well along it. They are given for each point, and no verdict
#' uses them.
#'
#' Six families have a verdict each: size, measurements, components, map, scan, asymmetry. Their p
#' come from faces that were held out when the norm was made, and are corrected by Holm's method.
#'
#' A scan that is worse than those of the norm is judged on a wider scale: its additional variance
#' is added. The variance comes from the `se` of the points if at least half of the surface points
#' have one; otherwise from the roughness of the face (`errors` names it).
#'
#' @section What a norm must not be used for:
#' The result is no diagnosis. "real" means that the face differs from the norm by more than chance,
#' errors of the scan and of the norm; such faces also occur among healthy people, by construction
#' in up to 5 % of them. See [fit_norms()].
#'
#' @param shape A `shape` that was slid against the template of the norm's sample ([slide()]), or a
#'   face of [simulate_cohort()].
#' @param norms A `shape_norms`, as of [fit_norms()] or [read_norms()].
#' @param age Age in the unit of the norm's ages (years).
#' @param sex A level of the norm's sexes. `NULL` for a norm without sexes.
#' @param error Standard error of landmarks, as in [measurements()].
#' @param alpha Level of the verdicts.
#' @return Object of class `assessment`, a list:
#'   * `values`: data frame with a row for size, each measurement and each component: `name`,
#'     `value` (less the `bias` of [measurements()]) and `expected` in `unit` ("mm", "mm^2", "mm^3"
#'     for [face_scheme()], otherwise "unit" and its powers; "degrees"; "1": none), `lower` and
#'     `upper` (value -+ 1.96 standard errors of the scan, NA where unknown), `z`, `se_scan`,
#'     `se_norm` (standard errors of z), `centile`, `z_widened` (on the wider scale), `reason` (why
#'     it was not assessed; NA otherwise);
#'   * `points`: data frame with a row for each surface point: `point`, `x`, `y`, `z` (laid on the
#'     norm), `distance` (along the normal from what is expected at this age and sex, in the unit
#'     of the mesh), `z_map`, `se_scan`, `se_norm`, `z_scan` (the radius that gives most),
#'     `z_asymmetry` (NA on the other side), `healed` (distance along the normal that healing took
#'     away, in the unit of the mesh), `healed_sd`, `tangential` (distance along the surface from
#'     what is expected, in the unit of the mesh), `d2` (the same squared, against what varies
#'     there: 95 % of faces are below 6, with a large norm), `p_tangential`, `assessed` (FALSE: the
#'     point is missing in the scan, and its place is made up by its surroundings), `se` (standard
#'     error of a co-ordinate, in the unit of the mesh; NA where unknown), `part` (patch);
#'   * `verdicts`: data frame with a row for each family: `family`, `statistic`, `p`, `p_holm`,
#'     `verdict` ("real", "not distinguishable", "not assessable"), `where`;
#'   * `findings`: data frame with a row for each disc that was healed: `point`, `radius`, `both`
#'     (TRUE: found on both sides at once, the other side has a row of its own), `z`, `height` and
#'     `sd` at its centre, `volume`, in the unit of the mesh;
#'   * `healed`: k x 3 matrix, the face laid on the norm with the discs replaced;
#'   * `chart`: data frame of the growth curves of size and measurements: `name`, `age`, `centile`,
#'     `value`; NA at ages that are refused;
#'   * `id`, `age`, `sex`, `effective` (number of faces behind the mean at this age), `errors`,
#'     `rough` (variance of the roughness over the norm's), `unit` (of lengths), `front` (3 x 3
#'     rotation that shows the laid face from its front), `norms` (number of faces, and what its
#'     makers say of it), `provenance` of the shape.
#'
#'   `as.data.frame()` gives `values`.
#' @section Errors: of class `crestline_error`: another scheme; an age outside the norm's range for
#'   the sex, or where fewer than 10 faces are effective; more than half of the points are missing;
#'   a size more than 5 times that of the norm's mean face, or its inverse, which is another unit; a
#'   mirror image (class `crestline_mirrored`).
#' @section Warnings: of class `crestline_norm_doubt`: fewer than 30 faces are effective at this
#'   age. Of class `crestline_not_slid`: a measured shape was not slid. Of class
#'   `crestline_other_template`: it was slid against another template than the norm's faces. Of
#'   class `crestline_red_parts`: parts of the shape are red.
#' @template glossary
#' @template experimental
#' @seealso [fit_norms()], [plot.assessment()]
#' @references Hammond et al. (2005) Discriminating power of localized three-dimensional facial
#'   morphology, *American Journal of Human Genetics* 77, 999-1010; Claes et al. (2012)
#'   Dysmorphometrics, *Theoretical Biology and Medical Modelling* 9, 5; Holm (1979) A simple
#'   sequentially rejective multiple test procedure, *Scandinavian Journal of Statistics* 6, 65-70.
#' @examples
#' \donttest{
#' cohort <- simulate_cohort(120, ages = c(5, 15), seed = 1)
#' norms <- fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data,
#'                    settings = norm_settings(folds = 2))
#' people <- data.frame(age = 10, sex = "female")
#' patient <- simulate_cohort(1, data = people, lesions = data.frame(height = 6, radius = 15),
#'                            seed = 2)
#' assess(patient$sample[[1]], norms, age = 10, sex = "female")
#' }
#' @export
assess <- function(shape, norms, age, sex = NULL, error = NULL, alpha = 0.05) {
  check_given()
  check_class(shape, "shape", "shape", "slide()")
  check_class(norms, "shape_norms", "norms", "fit_norms() or read_norms()")
  age <- check_number(age, "age")
  alpha <- check_number(alpha, "alpha", 0, 1, open = TRUE)
  error <- if (!is.null(error)) check_landmark_error(error, shape$scheme)
  sex <- check_norm_sex(sex, norms)
  check_norm_scheme(shape, norms)
  effective <- check_norm_age(age, sex, norms, shape$id)
  warn_unready(shape, "norms")
  warn_other_template(shape, norms)
  patient <- patient_surface(shape, norms, age, sex)
  mirror <- patient_asymmetry(patient, norms, age, sex)
  healed <- heal_face(prepared_field(norms, "surface"), patient, age, sex, patient$missing, alpha)
  other <- if (!is.null(mirror)) {
    scanned_face(prepared_field(norms, "asymmetry"), mirror, age, sex, mirror$missing)
  }
  values <- assessed_values(shape, norms, patient, age, sex, error)
  points <- assessed_points(norms, patient, healed, other, age, sex)
  structure(
    list(id = shape$id, age = age, sex = sex, effective = effective, values = values,
         points = points, verdicts = verdict_table(norms, values, points, healed, other, alpha),
         findings = healed_discs(norms, patient, healed, points),
         healed = matrix(as.vector(patient$expected$mean) + healed$u * patient$spread, ncol = 3),
         triangles = norms$triangles, front = own_pose(coords(shape, "landmarks"), shape$scheme) %*%
           patient$turn, chart = growth_chart(norms, sex), errors = patient$errors,
         rough = patient$rough, scale = patient$scale, unit = length_unit(norms$scheme$hash),
         limits = map_limits(norms), alpha = alpha, finished = healed$finished,
         norms = c(list(n = norms$n, few = norms$settings$few), norms$about),
         provenance = shape$provenance),
    class = "assessment"
  )
}

#' Limits of the maps at 5 %
#' @noRd
map_limits <- function(norms) {
  at <- limit_levels() == 0.95
  scan <- function(name) norms[[name]]$scan$quantiles[at]
  map <- norms$limits$map[at]
  if (norms$n < norms$settings$bonferroni_below) {
    map <- stats::qnorm(1 - 0.05 / (2 * nrow(norms$points)))
  }
  c(map = map, scan = scan("surface"),
    if (!is.null(norms$asymmetry)) c(asymmetry = scan("asymmetry")))
}

check_norm_scheme <- function(shape, norms) {
  if (identical(scheme_hash(shape$scheme), norms$scheme$hash)) return(invisible())
  crestline_abort(sprintf("the shape has another scheme than the norm (%s).", norms$scheme$name),
                  "Measure it by the scheme of the norm.", stage = "norms", id = shape$id)
}

check_norm_sex <- function(sex, norms) {
  known <- norms$ages$sex
  if (is.null(sex) && identical(known, "all")) return("all")
  check_choice(if (is.factor(sex)) as.character(sex) else sex, known, "sex")
}

#' Effective number of faces at an age, which must be within the norm's
#' @noRd
check_norm_age <- function(age, sex, norms, id) {
  range <- unlist(norms$ages[norms$ages$sex == sex, c("from", "to")])
  refuse <- function(problem) {
    crestline_abort(problem, "Use a norm that has people of this age; none is extended.",
                    stage = "norms", id = id, class = "crestline_norm_range")
  }
  if (age < range[1] || age > range[2]) {
    refuse(sprintf("`age` %.4g is outside the norm's range for %s, %.4g to %.4g.", age, sex,
                   range[1], range[2]))
  }
  effective <- effective_faces(norms, age, sex)
  if (effective < norms$settings$least) {
    refuse(sprintf("at this `age` only %.2g faces are effective (least %g).", effective,
                   norms$settings$least))
  }
  if (effective < norms$settings$few) {
    crestline_warn(sprintf("only %.2g faces are effective at this age.", effective),
                   "Read z with the norm's own error.", stage = "norms", id = id,
                   class = "crestline_norm_doubt")
  }
  effective
}

#' z of size, measurements and components
#' @noRd
assessed_values <- function(shape, norms, patient, age, sex, error) {
  table <- norms$table
  own <- own_errors(shape, norms, error)
  field <- norms$surface
  u <- (patient$y - as.vector(patient$expected$mean)) / as.vector(patient$expected$sd)
  scores <- as.vector(crossprod(field$vectors, u))
  count <- length(scores)
  y <- c(own$value, scores)
  # Of a component: the errors of all co-ordinates, taken as independent
  noise <- sqrt(as.vector(crossprod(field$vectors^2, patient$excess)))
  se <- c(own$se, noise)
  expected <- expected_columns(norms$values, age, sex)
  extra <- pmax(0, ifelse(is.na(se), 0, se)^2 - table$se_norm^2)
  z <- straightened(predicted_z(matrix(y, 1), expected), table)
  widened <- straightened(predicted_z(matrix(y, 1), expected, extra), table)
  back <- function(x) ifelse(table$transform == "log", exp(x), x)
  data.frame(name = table$name, value = back(y), unit = value_units(norms),
             expected = back(as.vector(expected$mean)), lower = back(y - 1.96 * se),
             upper = back(y + 1.96 * se), z = as.vector(z), se_scan = se / as.vector(expected$sd),
             se_norm = as.vector(norm_error(z, expected)), centile = 100 * stats::pnorm(z[1, ]),
             z_widened = as.vector(widened),
             reason = c(own$reason, rep(NA_character_, count)))
}

#' z of every surface point, in both maps
#' @noRd
assessed_points <- function(norms, patient, healed, other, age, sex) {
  field <- norms$surface
  expected <- expected_columns(field$along, age, sex)
  along <- normal_part(matrix(patient$y, 1), field$points, field$normal)
  base <- ifelse(is.na(norms$points$se_norm), 0, norms$points$se_norm)
  known <- !is.na(patient$se)
  extra <- if (patient$errors == "given") pmax(0, ifelse(known, patient$se, 0)^2 - base^2) else
    variance_along(field$normal, patient$excess * as.vector(patient$expected$sd)^2)
  z <- as.vector(predicted_z(along, expected, extra))
  plain <- predicted_z(along, expected)
  took <- matrix((patient$u - healed$u) * patient$spread, ncol = 3)
  best <- max.col(abs(healed$scan$z), "first")
  asymmetry <- rep(NA_real_, nrow(norms$points))
  if (!is.null(other)) {
    asymmetry[norms$points$side] <- other$z[cbind(seq_len(nrow(other$z)),
                                                  max.col(abs(other$z), "first"))]
  }
  tangential <- tangential_parts(norms$points, matrix(patient$y, 1), patient$expected,
                                 patient$excess * as.vector(patient$expected$sd)^2)
  lost <- patient$missing
  found <- data.frame(
    point = norms$points$point, stats::setNames(as.data.frame(patient$xyz), c("x", "y", "z")),
    distance = as.vector(along - expected$mean) / patient$scale, z_map = z,
    se_scan = patient$se / as.vector(expected$sd),
    se_norm = as.vector(norm_error(plain, expected)),
    z_scan = healed$scan$z[cbind(seq_along(best), best)], z_asymmetry = asymmetry,
    healed = row_products(took, field$normal) / patient$scale,
    healed_sd = sqrt(variance_along(field$normal, healed$variance * patient$spread^2)) /
      patient$scale, tangential = as.vector(tangential$off) / patient$scale,
    d2 = as.vector(tangential$d2), p_tangential = as.vector(tangential$p), assessed = !lost,
    se = patient$se / patient$scale, part = norms$points$part
  )
  columns <- c("distance", "z_map", "se_scan", "se_norm", "z_scan", "z_asymmetry", "tangential",
               "d2", "p_tangential")
  found[lost, columns] <- NA
  rownames(found) <- NULL
  found
}

#' Variance along the normals of variances of co-ordinates, 3k
#' @noRd
variance_along <- function(normal, variance) rowSums(normal^2 * matrix(variance, ncol = 3))

#' The discs that were healed
#' @noRd
healed_discs <- function(norms, patient, healed, points) {
  hits <- healed$found
  area <- point_areas(patient$xyz, norms$triangles) / patient$scale^2
  inside <- function(i) {
    centre <- norms$surface$points[hits$at[i], ]
    row_lengths(sweep(norms$surface$points, 2, centre)) <= hits$radius[i]
  }
  volume <- vapply(seq_len(nrow(hits)), function(i) {
    own <- inside(i)
    sum(area[own] * points$healed[own])
  }, 0)
  data.frame(point = points$point[hits$at], radius = hits$radius / patient$scale,
             both = hits$both, z = hits$z, height = points$healed[hits$at],
             sd = points$healed_sd[hits$at], volume = volume)
}

#' Verdicts by family, Holm over the families
#' @noRd
verdict_table <- function(norms, values, points, healed, other, alpha) {
  component <- grepl("^component ", values$name)
  measured <- !component & values$name != "size"
  z <- abs(values$z_widened)
  largest <- function(x) if (all(is.na(x))) NA_real_ else max(x, na.rm = TRUE)
  at <- function(x, names) if (all(is.na(x))) NA_character_ else names[which.max(x)]
  map <- abs(points$z_map)
  scan <- healed$scan
  scan_at <- unique(c(scan$at, if (scan$both) norms$points$partner[scan$at]))
  p_map <- if (norms$n < norms$settings$bonferroni_below) {
    min(1, 2 * sum(!is.na(map)) * stats::pnorm(-largest(map)))
  } else tail_p(largest(map), norms$limits$map)
  rows <- data.frame(
    family = c("size", "measurements", "components", "map", "scan", "asymmetry"),
    statistic = c(z[1], largest(z[measured]), sqrt(sum(z[component]^2)), largest(map),
                  scan$largest, if (is.null(other)) NA else other$largest),
    p = c(2 * stats::pnorm(-z[1]),
          if (any(measured)) tail_p(largest(z[measured]), norms$limits$measurements) else NA,
          tail_p(sum(z[component]^2), norms$limits$components), p_map, scan$p,
          if (is.null(other)) NA else other$p),
    where = c(NA, at(z[measured], values$name[measured]), NA, at(map, points$point),
              paste(points$point[scan_at], collapse = " and "),
              if (is.null(other)) NA else points$point[norms$points$side][other$at])
  )
  rows$p_holm <- stats::p.adjust(rows$p, "holm")
  rows$verdict <- ifelse(is.na(rows$p), "not assessable",
                         ifelse(rows$p_holm <= alpha, "real", "not distinguishable"))
  rows[c("family", "statistic", "p", "p_holm", "verdict", "where")]
}

#' @export
as.data.frame.assessment <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$values
}

#' @export
print.assessment <- function(x, most = 6, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  printed(x, {
    who <- if (x$sex == "all") "" else paste0(x$sex, ", ")
    cat(sprintf("<assessment> %s, %s%.3g years, against %s%s (%.3g effective at this age)\n", x$id,
                who, x$age, if (length(x$norms$name)) paste0(x$norms$name, ", ") else "",
                amount(x$norms$n, "face"), x$effective))
    cat("  no diagnosis: what is rare in the norm's sample is not therefore ill\n",
        "  +- are standard errors\n", sep = "")
    rows <- x$verdicts
    cat(sprintf("  %-13s %-20s p %.3g (Holm %.3g)%s\n", rows$family, rows$verdict, rows$p,
                rows$p_holm, ifelse(is.na(rows$where), "", paste0(", ", rows$where))), sep = "")
    values <- x$values[!grepl("^component ", x$values$name) & !is.na(x$values$z), ]
    values <- values[order(values$name != "size", -abs(values$z)), ]
    for (i in seq_len(min(most, nrow(values)))) cat("  ", value_words(values[i, ]), "\n", sep = "")
    for (i in seq_len(nrow(x$findings))) {
      cat("  ", finding_words(x$findings[i, ], x$unit), "\n", sep = "")
    }
    if (!isTRUE(x$finished)) cat("  the rest of the face still differs after healing\n")
    cat("  errors of the scan: ", x$errors, if (x$errors == "estimated") {
      sprintf(" from its roughness, %.2g of the norm's", x$rough)
    }, if (wider_scale(x)) "; p are on a wider scale, as they are larger than the norm's", "\n",
    sep = "")
    cat(sprintf("  along the surface %.2g %% of points are beyond their 95 %% (not judged)\n",
                100 * mean(x$points$p_tangential < 0.05, na.rm = TRUE)))
    lost <- c(sum(!x$points$assessed), sum(!is.na(x$values$reason)))
    if (any(lost > 0)) {
      why <- toString(unique(x$values$reason[!is.na(x$values$reason)]))
      cat(sprintf("  not assessed: %s (missing), %s%s\n", amount(lost[1], "surface point"),
                  amount(lost[2], "value"), if (lost[2]) sprintf(" (%s)", why) else ""))
      if (lost[1]) cat("    of ", lost_words(x$points$part, !x$points$assessed), "\n", sep = "")
    }
    invisible(x)
  })
}

value_words <- function(row) {
  scan <- if (is.na(row$se_scan)) "unknown" else sprintf("%.2g", row$se_scan)
  sprintf("%s %.4g%s (expected %.4g): z %.2f +- %s (scan) +- %.2g (norm), centile %.3g", row$name,
          row$value, if (row$unit == "1") "" else paste0(" ", row$unit), row$expected, row$z, scan,
          row$se_norm, row$centile)
}

finding_words <- function(row, unit) {
  sprintf("found at %s%s: height %.2g +- %.2g %s, radius %.3g %s, volume %.3g %s^3 (z %.2g)",
          row$point, if (row$both) " (both sides)" else "", row$height, row$sd, unit, row$radius,
          unit, row$volume, unit, row$z)
}

#' Whether a larger error of the scan changes a z that is shown
#' @param worth Change of z that is worth saying: half of a tenth.
#' @noRd
wider_scale <- function(x, worth = 0.05) {
  any(abs(x$values$z) - abs(x$values$z_widened) > worth, na.rm = TRUE) ||
    (x$errors == "estimated" && x$rough > 1 + worth)
}

#' Which parts lost how much, the largest loss first
#' @param part Of each point; `lost`, of each.
#' @param most Number of parts that are named.
#' @noRd
lost_words <- function(part, lost, most = 6) {
  count <- tapply(lost, part, sum)
  whole <- tapply(lost, part, length)
  named <- names(count)[order(-count)]
  named <- named[count[named] > 0]
  first <- utils::head(named, most)
  paste(c(sprintf("%s (%d of %d)", first, count[first], whole[first]),
          if (length(named) > most) amount(length(named) - most, "more part")),
        collapse = ", ")
}

#' @export
summary.assessment <- function(object, ...) {
  check_method_dots(...)
  structure(list(lines = printed_lines(object, most = Inf), counts = object$findings),
            class = "norms_summary")
}
