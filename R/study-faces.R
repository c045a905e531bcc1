# Section 6 on faces whose every point is known: a template under smooth random deformations, and a
# difference of groups.

#' Simulate faces with known correspondence
#'
#' Each face is the template under a smooth deformation of space. The deformation has a random field
#' for each face, the difference between two groups, and a size. The true place of every point of
#' the template is therefore known on every face, see [true_points()]. The true difference of the
#' groups is known too, see [true_effect()]. The faces are then scanned ([scan_settings()]). Each
#' gets its own vertices and triangles, noise, holes, and landmarks placed by an observer.
#'
#' A point x of the template becomes \eqn{s (x + v(x) + g e(x) - c) + c}, rotated and translated by
#' the settings `turn` and `shift` of `scan`. Here v is the random field of the face. Its values
#' have the covariance \eqn{sd^2 \exp(-r^2 / (2 range^2))} at distance r, summed over the rows of
#' `variation`, see [population_settings()]. e is the effect, and g is -1/2 in the first group and
#' 1/2 in the second. c is the centre of the template's vertices, and s the size: \eqn{\log s} has
#' mean \eqn{g \log(1 + size\_effect)} and standard deviation `size_sd`. The effect e is a sum of
#' bumps, each along one direction and 0 beyond its radius. The default bumps, at brow and cheek
#' ([face_effect()]), reach no landmark. With the same `seed`, faces with another effect, size or
#' scan have the same random fields. With a larger `n`, the first faces are the same.
#'
#' @param n Number of faces. They belong to the first and the second group in turn.
#' @param effect Difference of the groups' means in the middle of each place, in the unit of the
#'   template (mm for the default one); it is multiplied by the place's `share`. One number, or a
#'   named number for each `part`. 0: no difference of shape.
#' @param size_effect Difference of the groups' sizes as a share: 0.03 makes the second group 3 %
#'   larger.
#' @param places Data frame with a row for each bump. Columns are `part` (name), `x`, `y`, `z`
#'   (centre, moved to the closest place of the template), `radius` (unit of the template), and
#'   `share` (factor of `effect`, with sign). Optional columns are `dx`, `dy`, `dz` (direction;
#'   without them outward along the template's normal).
#' @param template A [specimen()] with landmarks; `NULL`: `humface` of the package Rvcg with the
#'   landmarks of this package (left is the subject's own left). Another template needs `places` of
#'   its own.
#' @param scan [scan_settings()]. `NULL`: no specimens, only the truth, which takes milliseconds.
#' @template seed
#' @template progress
#' @param population Names of the groups, and variation within them: as of [population_settings()].
#' @param ... Fields of [population_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return Object of class `simulated_faces`, a list:
#'   * `specimens`: the [specimen()]s, named by id, for [fit_shapes()];
#'   * `covariates`: data frame with a row for each face: `id`, `group` (factor), `size` (s);
#'   * `vertices`: list with an n x 3 matrix for each specimen: the place of each vertex in the
#'     template. `true_points()` of it gives the vertices without noise;
#'   * `template`, `places`, `effect` (by part), `size_effect`, and `deformations`, a function for
#'     each face (k x 3 places of the template to k x 3 places of the face).
#' @section Errors: of class `crestline_error`: an argument is out of its range; `places` lacks a
#'   column; `effect` names an unknown part.
#' @template glossary
#' @template experimental
#' @templateVar where section 6
#' @template paper
#' @references Rahimi and Recht (2007) Random features for large-scale
#'   kernel machines, for the random fields.
#' @seealso [true_points()], [face_effect()], [fit_shapes()], [compare_groups()]
#' @examples
#' faces <- simulate_faces(2, effect = 2, seed = 1)
#' faces
#' faces$covariates
#' true_points(faces)["pn", , ] # the tip of the nose on each face
#' \donttest{
#' plot(faces$specimens[[1]], engine = "picture")
#' }
#' @export
simulate_faces <- function(n, effect = 2, size_effect = 0.03, places = NULL, template = NULL,
                           scan = scan_settings(), seed = NULL, progress = interactive(),
                           population = population_settings(), ...) {
  check_given()
  check_flags(progress)
  seed <- check_seed(seed)
  n <- check_count(n, "n")
  if (is.null(places)) places <- if (is.null(template)) face_effect() else no_places()
  if (is.null(template)) template <- humface_specimen()
  check_class(template, "specimen", "template", "specimen() or read_specimen()")
  if (!is.null(scan)) check_class(scan, "scan_settings", "scan", "scan_settings()")
  check_class(population, "population_settings", "population", "population_settings()")
  check_dots(..., known = names(population))
  population <- with_former(list(population = population), list(population = names(population)),
                            list(...))$population
  groups <- population$groups
  places <- effect_places(places, template)
  effect <- effect_by_part(effect, unique(places$part))
  size_effect <- check_number(size_effect, "size_effect", -1, open = TRUE)
  seeds <- with_seed(seed, matrix(sample.int(.Machine$integer.max, 2 * n), 2))
  side <- rep_len(c(-1 / 2, 1 / 2), n)
  mean <- list(centre = rowMeans(template$mesh$vb[1:3, ]), effect = effect_field(places, effect))
  drawn <- lapply(seq_len(n), function(i) {
    with_seed(seeds[1, i], face_deformation(
      mean, side[i], log(1 + size_effect), population, if (!is.null(scan)) scan
    ))
  })
  id <- paste("face", formatC(seq_len(n), width = nchar(n), flag = "0"))
  deformations <- stats::setNames(lapply(drawn, `[[`, "map"), id)
  scanned <- scan_faces(template, deformations, scan, seeds[2, ], progress)
  structure(list(specimens = lapply(scanned, `[[`, "specimen"),
                 covariates = data.frame(id = id, group = factor(groups[side + 3 / 2], groups),
                                         size = vapply(drawn, `[[`, 0, "size")),
                 vertices = lapply(scanned, `[[`, "vertices"), template = template, places = places,
                 effect = effect, size_effect = size_effect, deformations = deformations,
                 scan = scan),
            class = "simulated_faces")
}

#' Groups of simulated faces, and the variation within them
#'
#' For [simulate_faces()].
#'
#' @template setting-names
#' @param groups Names of the two groups.
#' @param variation Random fields, which are summed: data frame with a row for each, and columns
#'   `range` and `sd` (unit of the template). Without rows: no variation of shape.
#' @param size_sd Standard deviation of log size within groups.
#' @param waves Number of waves whose sum is a random field.
#' @return List of class `population_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @template experimental
#' @examples
#' population_settings(size_sd = 0.05)
#' @export
population_settings <- function(..., groups = c("female", "male"),
                                variation = data.frame(range = c(60, 20), sd = c(1.5, 0.5)),
                                size_sd = 0.03, waves = 200) {
  new_settings("population_settings", check_population, list(...))
}

check_population <- function(settings) {
  settings$groups <- check_groups(settings$groups)
  settings$variation <- check_variation(settings$variation)
  check_number(settings$size_sd, "size_sd", 0)
  check_count(settings$waves, "waves")
  settings
}

#' @export
print.population_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<population_settings> of simulate_faces()")
}

#' One face: its size and its deformation, a function of a k x 3 matrix
#' @noRd
face_deformation <- function(mean, side, log_size, random, scan) {
  size <- exp(side * log_size + stats::rnorm(1, 0, random$size_sd))
  field <- random_fields(random$variation, random$waves)
  pose <- identity
  if (!is.null(scan)) {
    # A rotation by a normal angle about a random axis through the centre, and a shift
    axis <- unit_vector(stats::rnorm(3))
    angle <- stats::rnorm(1, 0, scan$turn)
    shift <- stats::rnorm(3, 0, scan$shift)
    cross <- matrix(c(0, axis[3], -axis[2], -axis[3], 0, axis[1], axis[2], -axis[1], 0), 3)
    turn <- diag(3) + sin(angle) * cross + (1 - cos(angle)) * cross %*% cross
    pose <- function(xyz) {
      sweep(sweep(xyz, 2, mean$centre) %*% t(turn), 2, mean$centre + shift, `+`)
    }
  }
  map <- function(xyz) {
    moved <- xyz + field(xyz) + side * mean$effect(xyz)
    pose(sweep(sweep(moved, 2, mean$centre) * size, 2, mean$centre, `+`))
  }
  list(size = size, map = map)
}

scan_faces <- function(template, deformations, scan, seeds, progress) {
  if (is.null(scan)) return(list())
  if (progress) cli::cli_progress_bar("Scanning faces", total = length(deformations))
  faces <- list()
  for (i in seq_along(deformations)) {
    id <- names(deformations)[i]
    faces[[id]] <- with_seed(seeds[i], scan_face(template, deformations[[i]], scan, id))
    if (progress) cli::cli_progress_update()
  }
  faces
}

#' One face as a scanner and an observer give it
#' @return List: `specimen`, and `vertices`, where in the template its vertices are.
#' @noRd
scan_face <- function(template, map, scan, id) {
  own <- template$mesh[c("vb", "it")]
  class(own) <- "mesh3d"
  if (scan$remesh) {
    # The same surface by other vertices, triangles and order
    edge <- if (is.null(scan$edge)) {
      corner <- face_corners(own)
      mean(vapply(1:3, function(i) mean(row_lengths(corner[[i]] - corner[[i %% 3 + 1]])), 0))
    } else scan$edge
    new <- Rvcg::vcgIsotropicRemeshing(
      own, TargetLen = edge * exp(stats::rnorm(1, 0, scan$edge_sd)), FeatureAngleDeg = scan$crease,
      iterations = scan$rounds
    )
    order <- sample(ncol(new$vb))
    it <- matrix(match(new$it, order), 3)[, sample(ncol(new$it)), drop = FALSE]
    own <- structure(list(vb = new$vb[, order, drop = FALSE], it = it), class = "mesh3d")
  }
  it <- own$it[, outside_holes(own, known_rows(template$landmarks), scan), drop = FALSE]
  vertex <- sort(unique(as.vector(it)))
  own <- structure(list(vb = own$vb[, vertex, drop = FALSE], it = matrix(match(it, vertex), 3)),
                   class = "mesh3d")
  places <- t(own$vb[1:3, ])
  own$vb[1:3, ] <- t(map(places))
  mesh <- with_noise(own, places, scan)
  landmarks <- template$landmarks
  landmarks[] <- map(landmarks)
  # Landmarks as an observer places them: beside the true ones, on the mesh
  beside <- landmarks + stats::rnorm(length(landmarks), 0, scan$landmark_error)
  landmarks <- if (scan$landmark_error == 0) landmarks else {
    structure(as.matrix(surface_points(mesh, beside)[c("x", "y", "z")]),
              dimnames = dimnames(landmarks))
  }
  made <- specimen(mesh, landmarks, id, outward = "keep", midline = character())
  key <- function(vb) paste(vb[1, ], vb[2, ], vb[3, ])
  list(specimen = made, vertices = places[match(key(made$mesh$vb), key(mesh$vb)), , drop = FALSE])
}

humface_specimen <- function() {
  found <- new.env()
  utils::data("humface", package = "Rvcg", envir = found)
  file <- system.file("extdata", "humface_landmarks.csv", package = "crestline", mustWork = TRUE)
  specimen(found$humface, read_landmarks(file), id = "humface")
}

check_variation <- function(variation) {
  ok <- is.data.frame(variation) && all(c("range", "sd") %in% names(variation)) &&
    all(variation$range > 0) && all(variation$sd >= 0)
  if (!isTRUE(ok)) {
    crestline_abort("`variation` has no ranges above 0 with standard deviations.",
                    "Give data.frame(range = , sd = ), in the unit of the template.",
                    stage = "arguments")
  }
  variation
}

check_groups <- function(groups) {
  if (!is.character(groups) || length(groups) != 2 || anyNA(groups) || groups[1] == groups[2]) {
    crestline_abort(sprintf("`groups` is %s.", describe_value(groups)),
                    "Give the names of two groups.",
                    stage = "arguments")
  }
  groups
}

#' @export
print.simulated_faces <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    count <- table(x$covariates$group)
    cat("<simulated_faces> ", nrow(x$covariates), ": ", paste(count, names(count), collapse = ", "),
        ", from the template ",
        x$template$id, "\n", sep = "")
    share <- split(x$places$share, factor(x$places$part, names(x$effect)))
    step <- vapply(share, function(own) own[which.max(abs(own))], 0) * x$effect
    cat(sprintf("  %s is %+.3g %% in size", names(count)[2], 100 * x$size_effect),
        if (length(step)) {
          paste0(", ", paste(sprintf("%s %+.3g", names(step), step), collapse = ", "))
        },
        "\n", sep = "")
    cat("  size ", paste(format(range(x$covariates$size), digits = 3), collapse = " to "), "\n",
        sep = "")
    if (is.null(x$scan)) cat("  the truth only, no specimens\n") else {
      vertices <- range(vapply(x$specimens, function(s) ncol(s$mesh$vb), 0L))
      cat("  scanned with noise ", x$scan$noise, ", ", x$scan$holes, " holes each, ",
          paste(unique(vertices), collapse = " to "), " vertices",
          if (x$scan$remesh) " of their own", "\n", sep = "")
    }
    invisible(x)
  })
}

#' @export
as.data.frame.simulated_faces <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$covariates
}
