# The population that a simulated cohort is drawn from: its mean by age and sex, and its people.

#' The fields of a population at the places of a template
#'
#' @param rows Names of the places that are drawn, all by default.
#' @return List: `template`; `places` (k x 3, with the mid-plane x = 0), `normal`, `partner`; `root`
#'   (k x q, root of the covariance of a co-ordinate), `growth`, `sexes`, `directional`, `skew`
#'   (k x 3); `centres` (rows that a lesion may have), `surface_names` and their rows `surface`.
#' @noRd
cohort_model <- function(template, settings) {
  # Of the population alone: errors, poses and holes are drawn later.
  own <- c("variation", "growth", "dimorphism", "directional", "population")
  key <- rlang::hash(list(places_of(template), scheme_hash(template$scheme), settings[own]))
  once(paste("cohort", key), function() make_cohort_model(template, settings))
}

make_cohort_model <- function(template, settings) {
  scheme <- template$scheme
  partner <- mirror_places(scheme)
  # Places turned and moved so that x = 0 is the plane of symmetry
  xyz <- places_of(template)
  off <- xyz - xyz[partner, ]
  known <- !is.na(off[, 1])
  axis <- main_direction(off[known, ])
  axis <- axis * sign(axis[which.max(abs(axis))])
  turn <- qr.Q(qr(cbind(axis, diag(3)[, order(abs(axis))[1:2]])))
  turn[, 1] <- axis
  # The rotation with this first axis that turns least
  parts <- svd(crossprod(turn[, 2:3], diag(3)[, 2:3]))
  nearest_flat <- parts$u %*% t(parts$v)
  rest <- turn[, 2:3] %*% nearest_flat
  turned <- sweep(xyz, 2, colMeans(xyz[known, ])) %*% cbind(axis, rest)
  colnames(turned) <- colnames(xyz)
  places <- turned
  surface <- coords(template, "surface")
  if (!nrow(surface) || anyNA(places)) {
    crestline_abort("the template has no surface, or missing points.",
                    "Give a whole `template` whose scheme has patches.", stage = "simulation")
  }
  normal <- unname(place_normals(places, scheme))
  mirrored <- function(field) field[partner, , drop = FALSE] * rep(c(-1, 1, 1), each = nrow(field))
  fields <- with_seed(settings$population, lapply(
    list(c(40, settings$growth), c(30, settings$dimorphism), c(35, settings$directional)),
    function(one) random_field(one[1], one[2])(places)
  ))
  surface_rows <- match(scheme$points$place[scheme$points$level == "surface"], rownames(places))
  apart <- as.matrix(stats::dist(places[surface_rows, ]))
  tip <- places[which.max(places[, 3]), ]
  list(template = template, places = places, normal = normal, partner = partner,
       root = field_root(places, settings$variation), surface = surface_rows,
       growth = (fields[[1]] + mirrored(fields[[1]])) / sqrt(2),
       sexes = (fields[[2]] + mirrored(fields[[2]])) / sqrt(2),
       directional = (fields[[3]] - mirrored(fields[[3]])) / 2,
       skew = normal * exp(-rowSums(sweep(places, 2, tip)^2) / (2 * 45^2)),
       centres = surface_rows[colSums(apart < 15) >= 20], surface_names = rownames(surface))
}

#' k x q root of the covariance of a sum of fields at places, but for a share of its variance
#' @param lost The share.
#' @noRd
field_root <- function(places, variation, lost = 5e-4) {
  squares <- as.matrix(stats::dist(places))^2
  parts <- Map(function(range, sd) sd^2 * exp(-squares / (2 * range^2)), variation$range,
               variation$sd)
  axes <- eigen(Reduce(`+`, parts, matrix(0, nrow(places), nrow(places))), symmetric = TRUE)
  value <- pmax(axes$values, 0)
  kept <- seq_len(max(1, which(cumsum(value) >= (1 - lost) * sum(value))[1]))
  axes$vectors[, kept, drop = FALSE] * rep(sqrt(value[kept]), each = nrow(places))
}

#' Mean size at an age, without unit: fast growth in early childhood, a spurt at puberty
#' @noRd
mean_size <- function(age, male) {
  early <- 1 - 0.30 * exp(-(age - 3) / 6)
  spurt <- 0.06 * stats::plogis((age - ifelse(male, 14, 12)) / 1.2) * ifelse(male, 1.25, 0.8)
  (early + spurt) / 1.05
}

#' Spread of log size and of shape at an age, of which the settings give the child's
#' @noRd
size_spread <- function(age, settings) {
  settings$size_sd * (1 + stats::plogis((age - 12) / 2) / 3)
}

shape_spread <- function(age, male) {
  (0.70 + 0.35 * stats::plogis((age - 12) / 3)) * ifelse(male, 1.08, 1)
}

#' Mean shape at one age and sex, k x 3, at the size of the template
#' @noRd
mean_face <- function(model, age, male) {
  model$places - exp(-(age - 3) / 8) * model$growth +
    (male - 0.5) * stats::plogis((age - 14) / 1.5) * model$sexes + model$directional
}

#' People and their visits
#' @return List: `data`, `lesions` (with points), `visits` (list of k x 3 x n).
#' @noRd
draw_people <- function(model, n, ages, data, lesions, settings, visits) {
  if (is.null(data)) {
    data <- data.frame(age = draw_ages(n, range(ages), settings$young),
                       sex = ifelse(stats::runif(n) < 0.5, "female", "male"))
  }
  # Random shapes, (3 k) x n, symmetric and asymmetric parts in the share that is set
  k <- nrow(model$places)
  field <- matrix(model$root %*% matrix(stats::rnorm(ncol(model$root) * 3 * n), ncol(model$root)),
                  3 * k)
  partner <- c(model$partner, k + model$partner, 2 * k + model$partner)
  mirrored <- field[partner, , drop = FALSE] * rep(c(-1, 1, 1), each = k)
  drawn_fields <- sqrt(settings$symmetric / 2) * (field + mirrored) +
    sqrt((1 - settings$symmetric) / 2) * (field - mirrored)
  own <- list(log_size = stats::rnorm(n), skew = (stats::rgamma(n, 3) - 3) / sqrt(3),
              shape = drawn_fields)
  at <- ifelse(is.na(lesions$point), NA, model$surface[match(lesions$point, model$surface_names)])
  free <- which(is.na(at) & lesions$height != 0)
  if (length(free) && length(model$centres)) {
    at[free] <- model$centres[sample.int(length(model$centres), length(free), TRUE)]
  }
  lesions$point <- model$surface_names[match(at, model$surface)]
  lesions$height[is.na(at)] <- 0
  seeds <- sample.int(.Machine$integer.max, visits)
  each <- lapply(seq_len(visits), function(visit) {
    later <- data
    later$age <- data$age + (visit - 1) * settings$gap
    with_seed(seeds[visit], visit_faces(model, later, own, list(
      at = at, height = lesions$height * (lesions$visit <= visit), radius = lesions$radius
    ), settings))
  })
  data$size <- person_size(data, own, settings)
  data$sex <- factor(data$sex, c("female", "male"))
  id <- paste("person", formatC(seq_len(n), width = nchar(n), flag = "0"))
  list(data = cbind(id = id, data), lesions = lesions, visits = each)
}

draw_ages <- function(n, range, young) {
  if (range[1] >= 18 || range[2] <= 18) return(stats::runif(n, range[1], range[2]))
  child <- stats::runif(n) < young
  ifelse(child, stats::runif(n, range[1], 18), stats::runif(n, 18, range[2]))
}

person_size <- function(data, own, settings) {
  male <- data$sex == "male"
  exp(log(mean_size(data$age, male)) + own$log_size * size_spread(data$age, settings))
}

#' The faces of one visit, with pose, errors and holes: k x 3 x n
#' @noRd
visit_faces <- function(model, data, own, lesion, settings) {
  n <- nrow(data)
  k <- nrow(model$places)
  male <- data$sex == "male"
  size <- person_size(data, own, settings)
  spread <- shape_spread(data$age, male)
  xyz <- array(0, c(k, 3, n))
  for (i in seq_len(n)) {
    face <- mean_face(model, data$age[i], male[i]) + spread[i] * matrix(own$shape[, i], k) +
      settings$skew * own$skew[i] * model$skew
    face <- size[i] * face
    if (lesion$height[i] != 0) {
      distance <- row_lengths(sweep(model$places, 2, model$places[lesion$at[i], ]))
      face <- face + lesion$height[i] * bump(distance, lesion$radius[i]) * model$normal
    }
    xyz[, , i] <- face
  }
  posed <- posed_faces(xyz, settings)
  noisy <- posed + measurement_noise(model, n, settings)
  xyz <- noisy
  for (i in rep(seq_len(dim(xyz)[3]), each = settings$holes)) {
    centre <- model$places[model$surface[sample.int(length(model$surface), 1)], ]
    xyz[row_lengths(sweep(model$places, 2, centre)) < settings$hole_radius, , i] <- NA
  }
  xyz
}

posed_faces <- function(xyz, settings) {
  for (i in seq_len(dim(xyz)[3])) {
    turn <- rotation_about(stats::rnorm(3, 0, settings$turn))
    xyz[, , i] <- sweep(xyz[, , i] %*% turn, 2, stats::rnorm(3, 0, settings$shift), `+`)
  }
  xyz
}

#' Errors of one range, of the same variance at any range
#' @noRd
measurement_noise <- function(model, n, settings) {
  k <- nrow(model$places)
  if (settings$noise == 0) return(array(0, c(k, 3, n)))
  if (settings$noise_range == 0) {
    return(array(stats::rnorm(3 * k * n, 0, settings$noise), c(k, 3, n)))
  }
  each <- lapply(seq_len(n), function(i) {
    random_field(settings$noise_range, settings$noise)(model$places)
  })
  array(unlist(each), c(k, 3, n))
}
