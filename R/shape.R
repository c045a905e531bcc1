# What a shape gives: its points by level, its surface as a mesh, a summary.

#' A shape from its parts: all its fields are declared here, NULL until they are filled
#'
#' @param id,points,status,checks,paths,scheme,tracks,column,specimen As in the value of
#'   [fit_shape()].
#' @param key Of [mesh_key()]: of the mesh that the faces of its points and paths are numbers of;
#'   NULL of a template, whose points lie on no mesh.
#' @param placing Of its specimen; NULL where landmarks were placed by hand.
#' @param warnings Data frame `stage`, `class`, `problem`, `remedy`: what was warned of.
#' @param provenance List: what came from where.
#' @param sliding,trace Of [slide()].
#' @param energy_scale Of a template: the scale of the energy in the sample that it is the mean of.
#' @noRd
new_shape <- function(id, points, status, scheme, checks = NULL, paths = list(), tracks = NULL,
                      column = NULL,
                      specimen = NULL, key = if (!is.null(specimen)) specimen_key(specimen),
                      placing = specimen$placing, warnings = no_warnings(),
                      provenance = list(), sliding = NULL, trace = NULL, energy_scale = NULL) {
  structure(
    list(id = id, points = points, status = status, checks = checks, paths = paths, scheme = scheme,
         tracks = tracks,
         column = column, specimen = specimen, key = key, placing = placing, warnings = warnings,
         provenance = provenance,
         sliding = sliding, trace = trace, energy_scale = energy_scale),
    class = "shape"
  )
}

#' Refuse a shape that lacks fields, or whose points are not those of its scheme
#' @noRd
validate_shape <- function(x) {
  refuse <- function(problem) {
    crestline_abort(problem, "Give a shape as fit_shape() or slide() returns it, whole.",
                    stage = "shape",
                    id = if (is.list(x) && is.character(x$id) && length(x$id) == 1) x$id,
                    call = NULL)
  }
  fields <- c("id", "points", "status", "paths", "scheme")
  if (!is.list(x) || !all(fields %in% names(x))) {
    refuse(sprintf("a shape has the fields %s.", shorten(fields)))
  }
  if (!inherits(x$scheme, "curve_scheme")) refuse("the shape's `scheme` is none.")
  validate(x$scheme)
  points <- x$points
  named <- c("level", "part", "point")
  table <- function(value) is.data.frame(value) &&
    all(vapply(value, is.atomic, NA) & lengths(value) == nrow(value))
  own <- table(points) && !is.null(place_columns(points)) && is_error(points$se) &&
    all(vapply(named,
               function(name) identical(
                 as.vector(points[[name]]), as.vector(x$scheme$points[[name]])
               ),
               NA))
  if (!own) {
    refuse(paste0("its `points` are not those of its scheme: a row was added or lost, or ",
                  "a column changed."))
  }
  if (!is.list(x$paths) ||
      !is.data.frame(x$status)) refuse("its `paths` or `status` are not what they were.")
  kept <- function(name, is) is.null(x[[name]]) || is(x[[name]])
  right <- kept("checks", table) && kept("placing", table) && kept("warnings", table) &&
    kept("provenance", is.list) && (is.null(x$checks) || nrow(x$checks) == nrow(x$status))
  if (!right) refuse("its `checks`, `placing`, `warnings` or `provenance` are not what they were.")
  invisible(x)
}

#' @exportS3Method
validate.shape <- function(x) validate_shape(x)

#' Key of the mesh of a shape; of one that an older version kept worked out from its specimen, where
#' it has that
#' @noRd
shape_key <- function(x) {
  if (!is.null(x$key)) return(x$key)
  if (inherits(x$specimen, "specimen")) specimen_key(x$specimen)
}

#' Refuse a shape that was not measured on a specimen's mesh, or that was changed since
#'
#' @noRd
check_shape_on <- function(shape, specimen) {
  if (is.null(shape_key(shape)) && all(is.na(shape$points$face))) {
    crestline_abort("its points lie on no mesh.",
                    "Give a shape that fit_shape() measured, not a template or a mean.",
                    stage = "shape", id = shape$id, class = "crestline_wrong_mesh")
  }
  name <- paste("the shape", shape$id)
  check_same_mesh(shape, specimen, name)
  known <- passed_mesh(specimen$mesh, specimen$id)
  check_places(shape$points, known, name, specimen$id)
  for (path in Filter(Negate(is.null), shape$paths)) {
    validate(path)
    check_places(path, known, name, specimen$id)
  }
  invisible(shape)
}

#' Co-ordinates of a shape
#'
#' Gives the points of one level as a matrix, or those of a `curve` of [ridge_curve()].
#' `subset(as.data.frame(x), level == "curves" & part == "philtrum ridge left")` gives the points of
#' one curve, with their standard errors.
#'
#' @template shape
#' @param level Kind of points: "curves", "landmarks" or "surface".
#' @param part Names of curves, landmarks or patches of that level. NULL: all.
#' @param ... Ignored.
#' @return k x 3 matrix with columns `x`, `y`, `z`, in the unit of the mesh. Row names are "part
#'   point", or the names of landmarks. Missing points are NA.
#' @section Errors: of class `crestline_error`: `x` is not a shape, or there is no such level or
#'   part.
#' @template glossary
#' @seealso [fit_shape()]
#' @examples
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "triangle")
#' shape <- fit_shape(specimen(Rvcg::vcgSphere(4), corners, id = "ball"), scheme, progress = FALSE)
#' coords(shape, "landmarks")
#' head(coords(shape), 3)
#' coords(shape, part = "bc")
#' @export
coords <- function(x, level = "curves", ...) {
  check_given()
  if (inherits(x, "specimen")) {
    refuse_argument("x", x, paste("The landmarks of a specimen are `specimen$landmarks`. Points of",
                                  "curves come from fit_shape()."))
  }
  if (!inherits(x, "curve")) check_class(x, "shape", "x", "fit_shape()")
  UseMethod("coords")
}

#' @rdname coords
#' @export
coords.shape <- function(x, level = "curves", part = NULL, ...) {
  check_method_dots(..., known = c("level", "part"))
  level <- check_choice(level, c("landmarks", "curves", "surface"), "level")
  points <- x$points[x$points$level == level, ]
  if (!is.null(part)) {
    points <- points[points$part %in% check_choices(part, unique(points$part), "part"), ]
  }
  names <- if (level == "landmarks") points$part else paste(points$part, points$point)
  structure(as.matrix(points[c("x", "y", "z")]), dimnames = list(names, c("x", "y", "z")))
}

#' @rdname coords
#' @export
coords.curve <- function(x, ...) {
  check_method_dots(...)
  as.matrix(as.data.frame(x)[c("x", "y", "z")])
}

#' @export
as.data.frame.shape <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$points
}

#' @export
print.shape <- function(x, most = 8, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  printed(x, {
    cat("<shape> ", x$id, ", by the scheme ", x$scheme$name, "\n", sep = "")
    for (level in c("landmarks", "curves", "surface")) {
      points <- x$points[x$points$level == level, ]
      status <- x$status[x$status$level == level, ]
      what <- switch(level, surface = "patches", level)
      if (nrow(status)) cat("  ", sum(status$ok), " of ", nrow(status), " ", what,
                            if (level != "landmarks") {
        sprintf(" with %d of %d points", sum(!is.na(points$x)), nrow(points))
      }, "\n", sep = "")
    }
    print_placing(x$placing)
    noise <- specimen_noise(x$status$noise_factor)
    if (!is.na(noise)) {
      cat(strwrap(noise_text(noise), width = 80, indent = 2, exdent = 4), sep = "\n")
    }
    said <- x$status[!is.na(x$status$reason), ]
    for (i in utils::head(seq_len(nrow(said)), most)) {
      cat(strwrap(paste0("- ", said$part[i], ": ", said$reason[i]), width = 80, exdent = 4),
          sep = "\n")
    }
    if (nrow(said) > most) cat("- and", nrow(said) - most, "more in shape$status\n")
    unused <- if (!is.null(x$specimen)) unused_names(x$specimen$landmarks, x$scheme)
    cat(absent_lines(x), sep = "")
    if (!is.null(unused)) unused <- strwrap(paste0("- landmarks ", unused), width = 80, exdent = 4)
    if (length(unused)) cat(unused, sep = "\n")
    invisible(x)
  })
}

#' What to do about landmarks that the specimen of a shape has not, as lines; none if it has all
#' @noRd
absent_lines <- function(x) {
  if (!inherits(x$specimen, "specimen")) return(character())
  absent <- setdiff(x$scheme$landmarks$landmark, rownames(x$specimen$landmarks))
  if (!length(absent)) return(character())
  said <- paste0("- the specimen has no ", shorten(absent), ". To add one: specimen$landmarks <- ",
                 "rbind(specimen$landmarks, ", absent[1], " = c(x, y, z)). On a face: rbind(..., ",
                 "find_landmarks(specimen)$landmarks[\"", absent[1], "\", , drop = FALSE])")
  paste0(strwrap(said, width = 80, exdent = 4), "\n")
}

#' @exportS3Method
mesh_of.shape <- function(x) list(key = shape_key(x), id = x$id)

#' @exportS3Method
written_landmarks.shape <- function(x) {
  check_class(x, "shape", "x", "fit_shape()")
  # The curves of a shape as read_landmarks() has them
  points <- x$points[x$points$level == "curves", ]
  closed <- x$scheme$curves$curve[closed_curves(x$scheme$curves)]
  curves <- lapply(stats::setNames(nm = unique(points$part)), function(name) {
    landmark_curve(as.matrix(points[points$part == name, c("x", "y", "z")]), name %in% closed)
  })
  list(landmarks = coords(x, "landmarks"), curves = curves)
}

#' @param points As in the value of [fit_shape()].
#' @noRd
triangles_there <- function(triangles, points, parts) {
  there <- !is.na(points$x[points$level == "surface"])
  triangles <- triangles[triangles$part %in% parts, ]
  triangles[there[triangles$v1] & there[triangles$v2] & there[triangles$v3], ]
}

# The noise of one scan: the noise factor of its curves together.

#' The noise factor of a specimen: the median over its ridges and valleys; NA without any
#'
#' @param factor Of its parts, NULL in shapes of former versions.
#' @noRd
specimen_noise <- function(factor) {
  if (is.null(factor) || all(is.na(factor))) NA_real_ else stats::median(factor, na.rm = TRUE)
}

#' What the noise factor of a specimen means, in a sentence
#'
#' @param factor One number.
#' @param plain Up to this factor the noise may be independent: the band is at most sqrt(2) as wide.
#' @noRd
noise_text <- function(factor, plain = 2) {
  if (factor <= plain) {
    return(sprintf("noise: independent from vertex to vertex, or known (F = %.2g)", factor))
  }
  sprintf(paste("noise: this scan's noise is correlated, or its relief is fine: F = %.2g;",
                "standard errors are %.2g times those of independent noise (no fault: F is 3 to 79",
                "on good faces)"), factor, sqrt(factor))
}
