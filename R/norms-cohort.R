# A cohort of simulated faces of known growth, sexes, asymmetry and lesions.

#' Settings of a simulated cohort
#'
#' Lengths are in the unit of the template (mm for the default one). A field is a smooth random
#' displacement of space; each of its co-ordinates has the standard deviation that is given.
#'
#' @param variation Data frame with a row for each field of a person's own shape: `range` (distance
#'   over which values go together) and `sd`. They are summed.
#' @param symmetric Share of that variance that is symmetric, 0 to 1. 0.5: left and right vary
#'   independently.
#' @param growth,dimorphism Standard deviations of the fields (range 40 and 30) by which the mean
#'   face of a child of 3 years, and the difference of the mean faces of adult men and women, differ
#'   from the template.
#' @param directional Standard deviation of the field (range 35) that makes the mean face
#'   asymmetric, before its symmetric half is taken off.
#' @param skew Standard deviation of a component with a skew distribution (a gamma distribution,
#'   skewness 1.15): the whole face becomes fuller or thinner.
#' @param size_sd Standard deviation of log size of children. It is a third larger in adults.
#' @param young Share of people below 18 years, where the range of ages includes 18.
#' @param noise,noise_range Standard deviation of each co-ordinate's error of measurement, and the
#'   distance over which errors go together (0: independent).
#' @param turn,shift Standard deviations of the pose: three angles in radians, and the position.
#' @param holes,hole_radius Number of holes in every scan, and their radius. Points in a hole are
#'   missing.
#' @param gap Years between two visits.
#' @param population Seed of the fields of growth, sex and directional asymmetry. Cohorts with the
#'   same value are of one population.
#' @param ... Nothing: an unknown name is an error.
#' @return A list of these settings, of class `cohort_settings`.
#' @section Errors: of class `crestline_error`: a value is out of its range.
#' @template glossary
#' @template experimental
#' @seealso [simulate_cohort()]
#' @examples
#' cohort_settings(noise = 0.3, gap = 1)
#' @export
cohort_settings <- function(variation = data.frame(range = c(60, 25, 12, 5),
                                                   sd = c(1.5, 0.8, 0.5, 0.3)),
                            symmetric = 0.85, growth = 3.5, dimorphism = 2.4, directional = 0.6,
                            skew = 1.2, size_sd = 0.03, young = 0.6, noise = 0.1, noise_range = 0,
                            turn = 0.05, shift = 5, holes = 0L, hole_radius = 5, gap = 0,
                            population = 11L, ...) {
  new_settings("cohort_settings", check_cohort_settings, list(...))
}

check_cohort_settings <- function(settings) {
  settings$variation <- check_variation(settings$variation)
  for (name in c("symmetric", "young")) {
    settings[[name]] <- check_number(settings[[name]], name, 0, 1)
  }
  for (name in c("growth", "dimorphism", "directional", "skew", "size_sd", "noise", "noise_range",
                 "turn", "shift", "gap")) {
    settings[[name]] <- check_number(settings[[name]], name, 0)
  }
  settings$holes <- check_count(settings$holes, "holes", lower = 0)
  settings$hole_radius <- check_number(settings$hole_radius, "hole_radius", 0, open = TRUE)
  settings$population <- check_count(settings$population, "population", lower = 0)
  settings
}

#' @export
print.cohort_settings <- function(x, ...) {
  check_method_dots(...)
  shown <- unclass(x)
  shown$variation <- NULL
  printed(x, {
    print_settings(structure(shown, class = class(x)), sprintf(
      "<cohort_settings> fields of range %s and sd %s", toString(x$variation$range),
      toString(x$variation$sd)
    ))
    invisible(x)
  })
}

#' Simulate a cohort of faces of all ages
#'
#' Draws faces of a population whose mean and spread by age and sex are known, directly as a
#' `shape_sample`: no scan is made, no curve is estimated, and points correspond exactly. It is made
#' to test [fit_norms()] and [assess()]. **The faces are simulated. They are not data of people, and
#' nothing about people can be learnt from them.**
#'
#' A face is \eqn{s (m + v) + l}, turned and moved. s is its size: it grows fast in early childhood
#' and again at puberty, two years earlier in girls, and log size varies between people. m is the
#' mean shape at that age and sex: the template, a field of growth that decays with age, a
#' difference of the sexes that sets in at about 14 years, and a directional asymmetry. v is the
#' person's own shape: random fields whose standard deviation grows with age by a half and is 8 %
#' larger in men, and a skew component. l is a lesion: a bump along the normal, of height
#' \eqn{h (1 - (d / radius)^2)^3} at distance d from its centre.
#'
#' Each co-ordinate then gets an error of measurement, whose standard deviation is the `se` of the
#' points. With the same `seed` and `noise = 0` you get the same faces without error.
#'
#' @param n Number of people.
#' @param ages Two numbers: the range of ages, in years, from which ages are drawn.
#' @param data Data frame with n rows and columns `age` and `sex` ("female", "male"): the people
#'   themselves. `NULL`: they are drawn.
#' @param lesions `NULL` (none), or a data frame whose rows are given to the people in turn:
#'   `height` (0: none) and `radius`, in the unit of the template; perhaps `point`, the name of a
#'   surface point as in `rownames(coords(template, "surface"))` (NA: one of those with at least 20
#'   surface points within 15 units, at random), and `visit` (1: from the first visit on, which is
#'   the default; 2: new at the second).
#' @param visits 1, or 2: everybody is measured again, `gap` years later.
#' @param template A `shape` with left-right pairs in its scheme. `NULL`: `humface` of the package
#'   Rvcg, by [face_scheme()].
#' @param settings [cohort_settings()].
#' @template seed
#' @return Object of class `simulated_cohort`, a list:
#'   * `sample`: the faces of the first visit, a `shape_sample`; `second`: those of the second
#'     visit, or `NULL`;
#'   * `data`: data frame with a row for each person: `id`, `age`, `sex`, `size` (s);
#'   * `lesions`: data frame with a row for each person: `id`, `height`, `radius`, `point`, `visit`;
#'     height 0 where there is none;
#'   * `expected`: function of an age and a sex that gives the mean face, a k x 3 matrix of places;
#'   * `settings`.
#'
#'   `as.data.frame()` gives `data`.
#' @section Errors: of class `crestline_error`: an argument is out of its range; the scheme has no
#'   pairs or no surface; `lesions` names an unknown point.
#' @template glossary
#' @template experimental
#' @seealso [fit_norms()], [simulate_faces()] for scans of simulated faces
#' @examples
#' \donttest{
#' cohort <- simulate_cohort(20, ages = c(5, 20), seed = 1)
#' cohort
#' head(as.data.frame(cohort))
#' }
#' @export
simulate_cohort <- function(n, ages = c(3, 40), data = NULL, lesions = NULL, visits = 1,
                            template = NULL, settings = cohort_settings(), seed = NULL) {
  check_given()
  n <- check_count(n, "n")
  ages <- check_numbers(ages, "ages", 2, lower = 0)
  visits <- check_count(visits, "visits", upper = 2)
  check_class(settings, "cohort_settings", "settings", "cohort_settings()")
  seed <- check_seed(seed)
  if (is.null(template)) template <- cohort_template()
  check_class(template, "shape", "template", "fit_shape()")
  data <- check_people(data, n)
  model <- cohort_model(template, settings)
  lesions <- check_lesions(lesions, n, model)
  drawn <- with_seed(seed, draw_people(model, n, ages, data, lesions, settings, visits))
  samples <- lapply(drawn$visits, function(xyz) {
    cohort_sample(model, xyz, drawn$data$id, settings)
  })
  drawn$lesions$id <- drawn$data$id
  structure(list(sample = samples[[1]], second = if (visits == 2) samples[[2]], data = drawn$data,
                 lesions = drawn$lesions[c("id", "height", "radius", "point", "visit")],
                 expected = function(age, sex) {
                   age <- check_number(age, "age", lower = 0)
                   male <- check_choice(sex, c("female", "male"), "sex") == "male"
                   mean_size(age, male) * mean_face(model, age, male)
                 },
                 settings = settings),
            class = "simulated_cohort")
}

cohort_template <- function() {
  once("cohort template", function() {
    scheme <- face_scheme()
    shape <- fit_shape(humface_specimen(), scheme, progress = FALSE)
    symmetrise(shape)
  })
}

check_people <- function(data, n) {
  if (is.null(data)) return(NULL)
  check_table(data, "data")
  ok <- nrow(data) == n && is.numeric(data$age) && all(is.finite(data$age) & data$age >= 0) &&
    all(as.character(data$sex) %in% c("female", "male")) && length(data$sex) == n
  if (!isTRUE(ok)) {
    refuse_argument("data", data,
                    sprintf("Give `age` and `sex` (\"female\", \"male\") of %d people.", n))
  }
  data.frame(age = as.numeric(data$age), sex = as.character(data$sex))
}

check_lesions <- function(lesions, n, model) {
  if (is.null(lesions)) lesions <- data.frame(height = 0, radius = 1)
  check_table(lesions, "lesions")
  if (is.null(lesions$point)) lesions$point <- rep(NA_character_, nrow(lesions))
  if (is.null(lesions$visit)) lesions$visit <- rep(1, nrow(lesions))
  lesions$point <- as.character(lesions$point)
  ok <- nrow(lesions) > 0 && is.numeric(lesions$height) && all(is.finite(lesions$height)) &&
    is.numeric(lesions$radius) && all(is.finite(lesions$radius) & lesions$radius > 0) &&
    all(lesions$visit %in% 1:2) && all(lesions$point %in% c(NA, model$surface_names))
  if (!isTRUE(ok)) {
    refuse_argument("lesions", lesions,
                    paste("Give columns `height` and `radius` (above 0), perhaps `point` (of the",
                          "surface) and `visit` (1 or 2)."))
  }
  lesions[rep_len(seq_len(nrow(lesions)), n), c("height", "radius", "point", "visit")]
}

#' A sample of places, as shapes that lie on no mesh
#' @param xyz k x 3 x n, NA where missing.
#' @noRd
cohort_sample <- function(model, xyz, ids, settings) {
  template <- model$template
  noisy <- template_shape(template, model$places, "simulated", settings$noise)
  noisy$provenance <- c(made_with(), list(scheme = scheme_provenance(template$scheme),
                                          settings = list(simulate_cohort = unclass(settings))))
  row <- match(template$scheme$points$place, rownames(model$places))
  shapes <- lapply(seq_along(ids), function(i) {
    own <- xyz[, , i]
    if (anyNA(own)) {
      rownames(own) <- rownames(model$places)
      shape <- template_shape(noisy, own, ids[i], settings$noise)
    } else {
      shape <- noisy
      shape$id <- ids[i]
      for (d in 1:3) shape$points[[c("x", "y", "z")[d]]] <- own[row, d]
    }
    shape$points$se[is.na(shape$points$x)] <- NA
    shape
  })
  new_shape_sample(stats::setNames(shapes, ids), template, provenance = noisy$provenance)
}

#' @export
print.simulated_cohort <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    count <- table(x$data$sex)
    cat("<simulated_cohort> ", amount(nrow(x$data), "simulated face"), ", no data of people: ",
        paste(count, names(count), collapse = ", "), "\n", sep = "")
    cat(sprintf("  ages %.3g to %.3g, noise %g, %s\n", min(x$data$age), max(x$data$age),
                x$settings$noise, if (is.null(x$second)) "one visit" else "two visits"))
    with <- sum(x$lesions$height != 0)
    if (with) cat("  lesions in", with, "of them\n")
    invisible(x)
  })
}

#' @export
as.data.frame.simulated_cohort <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$data
}
