# A norm from a sample: fitted, its limits by held-out faces, and what its makers say of it.

#' Settings of a norm
#'
#' Lengths are in the unit of the meshes; the defaults are for faces in mm.
#'
#' @param components Number of components. `NULL`: a hundredth of the number of faces, at least 5
#'   and at most 20. More of them find no more lesions, and tell more of the people in the sample.
#' @param radii Radii of the lesions that the scan of [assess()] looks for.
#' @param ranges Ranges of the Gaussian kernels for what the components leave.
#' @param bins Edges of the distances between points by which the kernels are weighted. The first
#'   bin is for points with themselves.
#' @param nugget Least variance that a point has of its own, as a share of its variance.
#' @param k,k_spread Numbers of splines in age, for means and for spreads, of size, measurements and
#'   components. `NULL`: 10 and 6, from 1,000 faces on 20 and 10 (puberty). Points always have 10
#'   and 6.
#' @param folds Number of parts that are held out in turn for the limits. `NULL`: 20 below 500
#'   faces, 10 below 1,000, else 5.
#' @param smooth_below Below this number of faces the scan's spread by place is smoothed over
#'   neighbours.
#' @param bonferroni_below Below this number of faces the marginal map is judged by Bonferroni's
#'   limit, as the quantile of the largest z of held-out faces is too uncertain.
#' @param least,few Effective numbers of faces at an age: below `least` [assess()] refuses, below
#'   `few` it warns.
#' @param unit What coefficients of points are rounded to when fitted.
#' @param ... Nothing: an unknown name is an error.
#' @return A list of these settings, of class `norm_settings`.
#' @section Errors: of class `crestline_error`: a value is out of its range.
#' @template glossary
#' @template experimental
#' @seealso [fit_norms()]
#' @examples
#' norm_settings(components = 10, folds = 5)
#' @export
norm_settings <- function(components = NULL, radii = c(12, 18, 30, 45), ranges = c(3, 6, 12, 24),
                          bins = c(0, 0.01, 2, 4, 6, 9, 12, 16, 20, 26, 34, 44), nugget = 0.003,
                          k = NULL, k_spread = NULL, folds = NULL, smooth_below = 500,
                          bonferroni_below = 200, least = 10, few = 30, unit = 1e-3, ...) {
  new_settings("norm_settings", check_norm_settings, list(...))
}

check_norm_settings <- function(settings) {
  for (name in c("components", "k", "k_spread", "folds")) {
    least <- c(components = 1, k = 5, k_spread = 5, folds = 2)[[name]]
    if (!is.null(settings[[name]])) {
      settings[[name]] <- check_count(settings[[name]], name, lower = least)
    }
  }
  for (name in c("radii", "ranges", "bins")) {
    settings[[name]] <- sort(check_numbers(settings[[name]], name, lower = 0))
  }
  if (settings$radii[1] == 0 || settings$ranges[1] == 0 || length(settings$bins) < 3) {
    refuse_argument("radii", settings$radii, "Give `radii`, `ranges` above 0 and 3 `bins` or more.")
  }
  for (name in c("nugget", "smooth_below", "bonferroni_below", "least", "few")) {
    settings[[name]] <- check_number(settings[[name]], name, lower = 0)
  }
  settings$unit <- check_number(settings$unit, "unit", lower = 0, open = TRUE)
  settings
}

#' @export
print.norm_settings <- function(x, ...) {
  check_method_dots(...)
  shown <- lapply(x, function(value) if (is.null(value)) "NULL" else value)
  print_settings(structure(shown, class = class(x)), "<norm_settings> of fit_norms()")
}

#' Norms of size, measurements and shape by age and sex
#'
#' Fits the mean and the spread of a sample by age, for each sex apart: of size, of measurements, of
#' components of shape, of every surface point, and of the asymmetry of every point. [assess()]
#' compares a new face with it. A norm holds no face of the sample.
#'
#' Size is kept apart from shape. Every face is laid on the norm's reference (the Procrustes mean at
#' mean size) alone, by least squares with scale. All means and spreads are penalised splines of age
#' on one basis. The smoothing is chosen for each by restricted maximum likelihood. Deviations of
#' all points together are described by few components and by a kernel of the distance between
#' points. Where the scheme has left-right pairs, the kernel also has the distance between a point
#' and the mirror image of another, so that each side of a face tells what to expect of the other.
#' Limits come from faces that were held out in turn, in parts alike in age and sex.
#'
#' @section What a norm must not be used for:
#' A norm describes the people and the scanner that it was made of. It does not describe other
#' populations, other devices or other schemes. It gives no diagnosis: a face beyond a limit is rare
#' in the sample, not ill. All sensitivities that are known of the method are from simulation
#' ([simulate_cohort()]), on Gaussian fields without expression and without errors of
#' correspondence; on real faces they are lower.
#'
#' @section Privacy:
#' With `share = TRUE` a norm is refused that would reveal its people: more components
#' than a fiftieth of the faces; a person who decides more than a fifth of the mean at his or her
#' age; two faces that are copies, or scans of one person (they differ by less than 0.15 of the
#' difference below which 90 % of all pairs of faces are); a norm whose components fit its members
#' better than strangers (ratio of residuals below 0.95, or area under the curve of membership above
#' 0.60, both by held-out faces). The error names the faces to leave out, or the number of
#' components that keeps the rule. Ages at the ends at which one person decides more than a tenth of
#' the mean are cut from the norm's range, and this is reported. In a gap between ages that cannot
#' be done: there the norm is refused. Counts below 5 are merged.
#'
#' What the rules do not cover:
#' * This is no formal (differential) privacy. Two norms whose samples differ by one person give
#'   that person's face by subtraction: publish rarely, and never "all but one".
#' * Faces of one person at several ages or with several expressions differ too much to be
#'   recognised. They count as several people in every rule: give one face of each person.
#' * The share of a person in the mean is that in size and in the median point. In some points it
#'   is larger: in a simulated norm of 600 one ninth, where the rule saw one fourteenth.
#' * Cut ages are refused by [assess()], but the coefficients go on beyond them. Whoever computes a
#'   mean there by another program gets one of at least 5 faces.
#' * Membership is tested by the residuals from the components. Other attacks were not tried.
#' * The range of ages of the whole sample, to a tenth of a year, the names of columns of `data` and
#'   the texts of `about` are written as they are.
#' * [write_norms()] computes the rules of components and ages again. Ratio, area and copies are
#'   those of the fit, as they need the faces.
#'
#' @param sample A `shape_sample`, as of [homologise()], whose scheme has patches. At least 20 faces
#'   of each sex.
#' @param formula `~ s(age, by = sex)` with names of columns of `data`, or `~ s(age)` for one norm
#'   of all.
#' @param data Data frame with a row for each face: its age (a number), its sex, and its `id`.
#' @param table Data frame of measurements, as [face_measurements()]. `NULL`: that one if the scheme
#'   is [face_scheme()], otherwise none.
#' @param about List of texts that are kept with the norm: `name`, `licence`, `citation`,
#'   `population`, `device`.
#' @param share TRUE: enforce the rules of privacy, see below.
#' @param settings [norm_settings()].
#' @template progress
#' @return Object of class `shape_norms`, a list:
#'   * `points`: data frame of the reference: `point`, its `part` and `index`, `x`, `y`, `z` (in the
#'     unit of the meshes; with left-right pairs its plane of symmetry is x = 0), normal `nx`, `ny`,
#'     `nz`, `partner` (row of the same point of the other side), `side` (TRUE for one of both, on
#'     which asymmetry is kept), `se_norm` (standard error of the sample's points), `r_xy`, `r_xz`,
#'     `r_yz` (correlations of a point's standardised co-ordinates);
#'   * `counts`: data frame with the number of faces by sex and year of age; `ages`: range of ages
#'     by sex; `n`;
#'   * `table`: data frame of size, measurements and components: `name`, `transform` ("log" or "as
#'     is"), `se_norm` (of the transformed value), `skew_1` to `skew_4` (of the transformation of
#'     z, NA for none), `bias_norm` (mean of what errors of points added to the transformed values
#'     and was taken off, see [measurements()]; NA where unknown);
#'   * `values`, `surface`, `asymmetry`: the fitted splines and fields;
#'   * `limits`: quantiles of held-out faces (`levels`), by family;
#'   * `privacy`: `ratio`, `auc`, `least` (smallest effective number at the ages of the sample, with
#'     `share` at those that are kept), `closest` (difference of the two faces that are most alike
#'     over the difference below which 90 % of all pairs are);
#'   * `about`, `scheme`, `settings`.
#' @section Errors: of class `crestline_error`: too few faces, a formula of another form, a column
#'   that is missing, radii of `settings` in another unit than the meshes, a face whose errors are
#'   as large as it is, or (with `share`) a rule of privacy that is not kept; the error gives the
#'   figures.
#' @section Warnings: of class `crestline_norm_doubt`: measurements that some face lacks are left
#'   out; points were estimated; the points of some faces have no `se` and those of others have, so
#'   that what errors add to measurements is not taken off all.
#' @template glossary
#' @template experimental
#' @seealso [assess()], [write_norms()], [simulate_cohort()]
#' @references Cole and Green (1992) Smoothing reference centile curves, *Statistics in Medicine*
#'   11, 1305-1319; Rigby and Stasinopoulos (2005) Generalized additive models for location, scale
#'   and shape, *Applied Statistics* 54, 507-554; Matthews et al. (2021) Pitfalls and promise of
#'   3-dimensional image comparison for craniofacial surgical assessment, *Scientific Reports* 11,
#'   12175.
#' @examples
#' \donttest{
#' cohort <- simulate_cohort(120, ages = c(5, 15), seed = 1)
#' norms <- fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data,
#'                    settings = norm_settings(folds = 2))
#' norms
#' }
#' @export
fit_norms <- function(sample, formula = ~ s(age, by = sex), data, table = NULL, about = list(),
                      share = FALSE, settings = norm_settings(), progress = interactive()) {
  check_given()
  check_class(sample, "shape_sample", "sample", "homologise()")
  check_flags(share, progress)
  check_class(settings, "norm_settings", "settings", "norm_settings()")
  about <- check_about(about)
  # Folds, and choices of some faces, go by the order: by one that is not that of the sample.
  sample <- sample[order(names(sample), method = "radix")]
  scheme <- sample$template$scheme
  table <- norm_measurements(table, scheme)
  people <- norm_people(formula, data, names(sample))
  made <- norm_data(sample, if (!is.null(table)) measurement_plan(table, scheme),
                    settings$unit)
  check_norm_lengths(as.matrix(made$points[c("x", "y", "z")]), settings)
  made$people <- people
  made$table <- table
  made <- transformed_values(made, names(sample))
  plan <- norm_plan(settings, people)
  if (share) check_shared_components(plan, length(people$age))
  parts <- fit_parts(made, seq_along(people$age), plan)
  if (share) {
    check_lone(parts, people, names(sample))
    check_copies(closest_faces(made$y), names(sample))
  }
  scales <- lapply(parts[c("surface", "asymmetry")], function(field) {
    if (!is.null(field)) scan_scale(field, plan$radii)
  })
  held <- cross_validated(made, plan, scales, progress)
  norms <- new_shape_norms(made, parts, held, plan, settings)
  norms$scheme <- scheme_provenance(scheme)
  # Against which template the faces were slid, if it is one
  templates <- unique(lapply(unname(sample$shapes), function(x) x$provenance$template$hash))
  if (length(templates) == 1) norms$scheme$template <- templates[[1]]
  norms$about <- c(about, made_with())
  norms$table <- with_value_errors(norms, sample)
  if (!share) return(norms)
  norms <- keep_shared_ages(norms, people)
  check_shared(norms, privacy_figures(held$privacy))
  check_shared_ages(norms)
  norms$counts <- merged_counts(norms$counts)
  norms
}

#' Whether the lengths of the settings are those of a surface of this size, and not of another unit
#' @noRd
check_norm_lengths <- function(xyz, settings) {
  apart <- as.matrix(stats::dist(xyz))
  diag(apart) <- Inf
  step <- stats::median(apply(apart, 1, min))
  size <- sqrt(mean(rowSums(sweep(xyz, 2, colMeans(xyz))^2)))
  if (min(settings$radii) < size && max(settings$radii) > step) return(invisible())
  crestline_abort(
    sprintf("`settings`: radii of %s do not fit points %.2g apart and %.2g from their centre.",
            toString(signif(settings$radii, 3)), step, size),
    paste("Give `radii`, `ranges`, `bins` and `unit` of norm_settings() in the unit of the meshes;",
          "the defaults are for faces in mm."), stage = "norms"
  )
}

#' The table of measurements: that of the face for its scheme, where none is given
#' @noRd
norm_measurements <- function(table, scheme) {
  if (!is.null(table)) return(check_measurement_table(table))
  if (identical(scheme_hash(scheme), scheme_hash(face_scheme()))) face_measurements()
}

#' Splines, components and folds for a number of faces
#' @noRd
norm_plan <- function(settings, people) {
  n <- length(people$age)
  or <- function(value, default) if (is.null(value)) default else value
  # No exact age of a person is kept.
  range <- c(floor(10 * min(people$age)), ceiling(10 * max(people$age))) / 10
  large <- n >= 1000
  list(size = list(k = 10, k_spread = 6, range = range),
       size_values = list(k = or(settings$k, if (large) 20 else 10),
                          k_spread = or(settings$k_spread, if (large) 10 else 6), range = range),
       components = min(or(settings$components, min(20, max(5, n %/% 100))), n - 12),
       folds = min(or(settings$folds, if (n < 500) 20 else if (n < 1000) 10 else 5),
                   min(table(people$group)) %/% 2),
       radii = settings$radii, ranges = settings$ranges, bins = settings$bins,
       nugget = settings$nugget, unit = settings$unit, smooth_below = settings$smooth_below)
}

#' Measurements on the scale on which they are smoothed; those that some face lacks are left out
#' @noRd
transformed_values <- function(made, ids) {
  small <- ids[!is.finite(made$values[, 1])]
  if (length(small)) {
    crestline_abort(sprintf("the size of %s: %s.", shorten(small, 8), not_above_errors()),
                    "Leave these faces out, or correct the `se` of their points.", stage = "norms")
  }
  whole <- colSums(!is.finite(made$values)) == 0
  lost <- colnames(made$values)[!whole]
  if (length(lost)) {
    crestline_warn(sprintf("measurements that some face lacks are left out: %s.", shorten(lost, 8)),
                   "Leave these faces out, or accept it.", stage = "norms",
                   class = "crestline_norm_doubt")
  }
  if (nrow(made$estimated)) {
    crestline_warn(sprintf("%s estimated or dropped before the fit.",
                           amount(nrow(made$estimated), "missing point")),
                   "See `missing` of align(sample, \"surface\").", stage = "norms",
                   class = "crestline_norm_doubt")
  }
  made$values <- made$values[, whole, drop = FALSE]
  made$table <- made$table[made$table$measurement %in% colnames(made$values), , drop = FALSE]
  kind <- made$table$kind[match(colnames(made$values), made$table$measurement)]
  positive <- apply(made$values > 0, 2, all)
  made$transform <- ifelse(!is.na(kind) & kind != "angle" & positive, "log", "as is")
  made$transform[1] <- "log"
  logs <- which(made$transform == "log" & seq_along(kind) > 1)
  made$values[, logs] <- log(made$values[, logs])
  made
}

check_about <- function(about) {
  known <- c("name", "licence", "citation", "population", "device")
  ok <- is.list(about) && !is.object(about) && all(names(about) %in% known) &&
    length(names(about)) == length(about) &&
    all(vapply(about, function(x) is.character(x) && length(x) == 1 && !is.na(x), NA))
  if (!ok) {
    refuse_argument("about", about, sprintf("Give a list of texts: %s.", toString(known)))
  }
  about
}

#' Ages and groups of a sample by a formula
#' @return List: `age`, `group` (factor), `names` (columns of both).
#' @noRd
norm_people <- function(formula, data, ids, least = 20) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "norms")
  }
  form <- "Write ~ s(age, by = sex) or ~ s(age), with names of columns of `data`."
  term <- if (inherits(formula, "formula") && length(formula) == 2) formula[[2]]
  ok <- is.call(term) && identical(term[[1]], as.name("s")) && is.name(term[[2]]) &&
    (length(term) == 2 || (length(term) == 3 && identical(names(term)[3], "by") &&
                             is.name(term[[3]])))
  if (!isTRUE(ok)) fail("`formula` is of another form.", form)
  names <- c(age = as.character(term[[2]]), sex = if (length(term) == 3) as.character(term[[3]]))
  check_table(data, "data")
  absent <- setdiff(names, names(data))
  if (length(absent)) {
    fail(sprintf("`data` has no column `%s`.", absent[1]),
         sprintf("Its columns are %s.", shorten(names(data), 10)))
  }
  row <- rows_of_specimens(data, ids, "data", fail)
  age <- data[[names[["age"]]]][row]
  if (!is.numeric(age) || !all(is.finite(age))) {
    fail(sprintf("`%s` has values that are no finite numbers.", names[["age"]]),
         "Leave these faces out: sample[ids].")
  }
  group <- if (length(names) == 2) data[[names[["sex"]]]][row] else rep("all", length(age))
  if (anyNA(group)) fail(sprintf("`%s` has missing values.", names[["sex"]]), "Leave them out.")
  group <- factor(group)
  if (any(table(group) < least)) {
    fail(sprintf("there are %s.", toString(paste(table(group), "faces of", levels(group)))),
         sprintf("A norm needs at least %d of each.", least))
  }
  if (any(vapply(split(age, group), function(x) diff(range(x)), 0) <= 0)) {
    fail("all faces of one sex have the same age.", "Give a sample of several ages.")
  }
  list(age = as.numeric(age), group = group, names = names)
}
