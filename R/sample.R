# A sample: shapes of many specimens made homologous.

#' A sample from its parts
#'
#' The sample is the list of its shapes, so that loops run over specimens; what they have in common
#' are attributes, which `$` gives as fields.
#'
#' @param shapes Named list of slid shapes, without their specimens.
#' @param template The `shape` that they were slid against.
#' @param convergence Of [homologise()], NULL where the template was given.
#' @param provenance List: what came from where.
#' @noRd
new_shape_sample <- function(shapes, template, convergence = NULL, provenance = list()) {
  # Points that are missing, by specimen and part
  each <- lapply(unname(shapes), function(shape) {
    absent <- shape$points[is.na(shape$points$x), ]
    parts <- unique(absent[c("level", "part")])
    count <- mapply(function(level, part) sum(absent$level == level & absent$part == part),
                    parts$level, parts$part)
    data.frame(id = rep(shape$id, nrow(parts)), parts, points = as.integer(count))
  })
  none <- data.frame(id = character(), level = character(), part = character(), points = integer())
  each <- do.call(rbind, c(list(none), each))
  rownames(each) <- NULL
  missing_parts <- each
  structure(shapes, template = template, convergence = convergence,
            missing = missing_parts, provenance = provenance, class = "shape_sample")
}

sample_fields <- c("shapes", "template", "convergence", "missing", "provenance")

#' @param settings Arguments of [homologise()].
#' @noRd
sample_provenance <- function(template, plan, settings) {
  scheme <- template$provenance$scheme
  if (is.null(scheme)) scheme <- scheme_provenance(template$scheme)
  slide <- lapply(unclass(plan$settings), identity)
  c(made_with(), list(scheme = scheme, template = plan$template,
                      settings = list(slide = slide, homologise = settings)))
}

#' What is known of a sample and of its specimens
#' @noRd
whole_provenance <- function(x) {
  known <- x$provenance
  measured <- shapes_provenance(x$shapes)
  known$settings <- utils::modifyList(as.list(measured$settings), as.list(known$settings))
  known$specimens <- specimens_provenance(x$shapes)
  known
}

#' @rdname provenance
#' @export
summary.shape_sample <- function(object, ...) {
  validate(object)
  new_summary(printed_lines(object), whole_provenance(object))
}

#' The rules of a sample
#' @noRd
validate_shape_sample <- function(x) {
  refuse <- function(wrong, problem, remedy = "Make a sample with homologise().") {
    if (wrong) crestline_abort(problem, remedy, stage = "sample")
  }
  refuse(is.null(attr(x, "template")) && "shapes" %in% names(x),
         "the sample was made by an older version.", "Make it again with homologise().")
  shapes <- x$shapes
  check_class(x$template, "shape", "template", "symmetrise() or homologise()")
  refuse(!all(vapply(shapes, inherits, NA, "shape")), "some of its members are no shapes.")
  named <- function(shape) is.character(unclass(shape)$id) && length(shape$id) == 1
  refuse(!all(vapply(shapes, named, NA)), "some of its shapes have no id.")
  for (shape in shapes) validate(shape)
  ids <- vapply(shapes, `[[`, "", "id")
  refuse(!identical(unname(ids), as.character(names(shapes))),
         "its names are not the ids of its shapes.", "Rename specimens by `names(sample) <- ...`.")
  refuse(anyDuplicated(ids) > 0,
         sprintf("two specimens have the id \"%s\".", ids[anyDuplicated(ids)]),
         "Give every specimen an `id` of its own.")
  bare <- vapply(shapes, function(shape) is.null(shape$specimen), NA)
  refuse(!all(bare), "its shapes keep their specimens.")
  for (shape in shapes) check_same_scheme(shape, x$template)
  refuse(!is.null(x$convergence) && !is.data.frame(x$convergence), "its convergence is no table.")
  x
}

#' @exportS3Method
validate.shape_sample <- function(x) validate_shape_sample(x)

#' The specimens of a sample
#'
#' A `shape_sample` is a list of its slid shapes. `length()` is their number, `names()` are their
#' ids. `sample[ids]`, `sample[-3]` and `sample[logical]` give a sample of some specimens.
#' `sample[["id"]]` gives one shape. `for`, `lapply()`, `split()` and `as.list()` go through the
#' shapes. `c()` joins samples that were slid against the same template.
#'
#' Nothing is slid again: points, template and convergence do not change, and `missing` has the
#' remaining specimens. A sample without some specimens therefore still has the template of all. If
#' a wrong specimen has affected the template, run [homologise()] without it.
#'
#' @param x,... A `shape_sample`, as [homologise()] returns it. `c()` takes several.
#' @param i Ids, numbers (negative: all but these), or a logical value for each specimen. Logical
#'   values with names are matched by name. For `[[`: one id or number.
#' @param name "shapes", "template", "convergence", "missing" or "provenance": see [homologise()].
#' @param value For `names<-`: new ids. For `$<-`: the new value of the field.
#' @return A `shape_sample`. `[[` gives a `shape`, `as.list()` a list of shapes by id.
#' @section Errors: of class `crestline_error`: an unknown specimen, or one specimen twice (the
#'   error lists the ids). For `c()`: different schemes, templates or settings of sliding, or ids
#'   that both samples have.
#' @template glossary
#' @seealso [homologise()], [as.array.shape_sample()]
#' @examples
#' \donttest{
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "triangle")
#' shapes <- lapply(c(1, 1.1, 1.2, 1.3), function(width) {
#'   ball <- Rvcg::vcgSphere(4)
#'   ball$vb[1, ] <- width * ball$vb[1, ]
#'   wide <- specimen(ball, corners %*% diag(c(width, 1, 1)), id = paste("ball", width))
#'   fit_shape(wide, scheme, progress = FALSE)
#' })
#' sample <- homologise(shapes[1:3], progress = FALSE)
#' sample[-1]
#' sample[["ball 1.2"]]
#' # One more, against the same template:
#' more <- homologise(shapes[4], template = sample$template, rounds = 0, progress = FALSE)
#' names(c(sample, more))
#' }
#' @name shape_sample
NULL

#' @rdname shape_sample
#' @export
`[.shape_sample` <- function(x, i, ...) {
  if (...length()) refuse_dimensions("the sample", "as.array(sample, level) has points and axes.")
  validate(x)
  if (missing(i)) return(x)
  new_shape_sample(x$shapes[chosen_members(i, names(x), "the sample")], x$template, x$convergence,
                   x$provenance)
}

#' @rdname shape_sample
#' @export
`[[.shape_sample` <- function(x, i, ...) {
  x$shapes[[one_member(i, names(x), "the sample")]]
}

#' @rdname shape_sample
#' @export
`$.shape_sample` <- function(x, name) {
  if (!name %in% sample_fields) {
    refuse_member(sprintf("a sample has no field `%s`.", name),
                  sprintf("Fields are %s; specimens are x[[\"id\"]].",
                          paste(sample_fields, collapse = ", ")))
  }
  sample_field(x, name)
}

sample_field <- function(x, name) if (name == "shapes") as.list(x) else attr(x, name, exact = TRUE)

#' @rdname shape_sample
#' @export
`$<-.shape_sample` <- function(x, name, value) {
  if (!name %in% setdiff(sample_fields, "missing")) {
    refuse_member(sprintf("`%s` of a sample cannot be set.", name),
                  "Make a sample with homologise().")
  }
  fields <- lapply(stats::setNames(nm = setdiff(sample_fields, "missing")),
                   function(field) sample_field(x, field))
  fields[name] <- list(value)
  validate_shape_sample(do.call(new_shape_sample, fields))
}

#' @rdname shape_sample
#' @export
`[<-.shape_sample` <- function(x, i, ..., value) {
  refuse_member("specimens of a sample cannot be replaced: it would not be homologous.",
                "Slide it against the template, homologise(rounds = 0, template = ), and c() both.")
}

#' @rdname shape_sample
#' @export
`[[<-.shape_sample` <- `[<-.shape_sample`

#' @rdname shape_sample
#' @export
`names<-.shape_sample` <- function(x, value) {
  value <- check_member_names(value, length(x))
  shapes <- Map(function(shape, id) {
    shape$id <- id
    shape
  }, x$shapes, value)
  validate_shape_sample(new_shape_sample(
    stats::setNames(shapes, value), x$template, x$convergence, x$provenance
  ))
}

#' @rdname shape_sample
#' @export
as.list.shape_sample <- function(x, ...) {
  attributes(x) <- list(names = names(x))
  x
}

#' @rdname shape_sample
#' @export
c.shape_sample <- function(...) {
  samples <- Filter(Negate(is.null), list(...))
  maker <- "homologise(rounds = 0, template = sample$template)"
  for (one in samples) check_class(one, "shape_sample", "...", maker)
  first <- samples[[1]]
  for (one in samples[-1]) check_joinable(first, one)
  shapes <- do.call(c, unname(lapply(samples, as.list)))
  twice <- unique(names(shapes)[duplicated(names(shapes))])
  if (length(twice)) {
    refuse_member(sprintf("%s in more than one of the samples: %s.",
                          if (length(twice) == 1) "a specimen is" else "specimens are",
                          shorten(twice)),
                  "Drop them from one, sample[-i], or rename: names(sample) <- ...")
  }
  warn_cut_scales(shapes, "sample")
  rounds <- Filter(Negate(is.null), lapply(samples, sample_field, "convergence"))
  joined <- new_shape_sample(
    shapes, first$template, if (length(rounds)) rounds[[1]], first$provenance
  )
  validate_shape_sample(joined)
}

#' Whether the points of two samples are homologous: of one scheme, one template, one way of sliding
#' @noRd
check_joinable <- function(a, b) {
  remedy <- paste("Slide the one's shapes against the other's template:",
                  "homologise(shapes, rounds = 0, template = sample$template).")
  fail <- function(problem) crestline_abort(problem, remedy, stage = "sample")
  schemes <- c(a$template$scheme$name, b$template$scheme$name)
  if (!identical(scheme_hash(a$template$scheme), scheme_hash(b$template$scheme))) {
    alike <- schemes[1] == schemes[2]
    named <- if (alike) ", both named " else ": "
    named <- paste0(named, paste(unique(schemes), collapse = ", "))
    fail(sprintf("the samples have different schemes%s.", named))
  }
  if (!identical(a$template$points[c("x", "y", "z")], b$template$points[c("x", "y", "z")])) {
    fail("the samples were slid against different templates: their points are not homologous.")
  }
  if (!identical(a$template$energy_scale, b$template$energy_scale)) {
    fail("the samples were slid with different scales of the energy.")
  }
  settings <- lapply(list(a, b), function(x) x$provenance$settings$slide)
  if (!any(vapply(settings, is.null, NA)) && !identical(settings[[1]], settings[[2]])) {
    fail("the samples were slid with different settings.")
  }
}

#' Co-ordinates of a sample
#'
#' @param x A `shape_sample`, as [homologise()] returns it, or one `shape` (n = 1).
#' @param level Kind of points: "landmarks" (the default, as of [align()] and [as_geomorph()]),
#'   "curves", "surface", or "model": every point of the model once, also where several curves and
#'   patches share it. In "curves" an end that several curves share is there once for each of them;
#'   `align(weights = "places")` counts it once. [coords()] of one shape gives "curves" by default.
#' @param ... Ignored.
#' @return k x 3 x n array in the unit of the meshes; each specimen keeps its position. The
#'   dimension names are the points ("part point", or the names of landmarks), `x`, `y`, `z`, and
#'   the ids of the specimens. Missing points are NA.
#' @section Errors: of class `crestline_error`: there is no such level.
#' @template glossary
#' @seealso [homologise()]
#' @examples
#' \donttest{
#' corners <- rbind(a = c(-1, -1, 2), b = c(1, -1, 2), c = c(0, 1.5, 2)) / sqrt(6)
#' curves <- data.frame(curve = c("ab", "bc", "ac"), from = c("a", "b", "a"),
#'                      to = c("b", "c", "c"), kind = "plane", n = 5)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b", "c")), curves, name = "triangle")
#' shapes <- lapply(c(1, 1.1, 1.2), function(width) {
#'   ball <- Rvcg::vcgSphere(4)
#'   ball$vb[1, ] <- width * ball$vb[1, ]
#'   wide <- specimen(ball, corners %*% diag(c(width, 1, 1)), id = paste("ball", width))
#'   fit_shape(wide, scheme, progress = FALSE)
#' })
#' sample <- homologise(shapes, progress = FALSE)
#' dim(as.array(sample, "curves"))
#' }
#' @exportS3Method
as.array.shape_sample <- function(x, level = c("landmarks", "curves", "surface", "model"), ...) {
  check_method_dots(..., known = "level")
  level <- check_choice(level, sample_levels, "level")
  like <- level_places(x$template, level)
  each <- lapply(x$shapes, level_places, level)
  array(as.numeric(unlist(each)), c(dim(like), length(each)), c(dimnames(like), list(names(each))))
}

#' @rdname as.array.shape_sample
#' @exportS3Method
as.array.shape <- function(x, level = c("landmarks", "curves", "surface", "model"), ...) {
  check_method_dots(..., known = "level")
  check_class(x, "shape", "x", "fit_shape()")
  own <- level_places(x, check_choice(level, sample_levels, "level"))
  array(own, c(dim(own), 1), c(dimnames(own), list(x$id)))
}

sample_levels <- c("landmarks", "curves", "surface", "model")

#' The points of one level, or of the whole model: points that several parts share once
#' @noRd
level_places <- function(shape, level) {
  if (level == "model") places_of(shape) else coords(shape, level)
}

#' @rdname as.array.shape_sample
#' @param row.names,optional Ignored.
#' @return `as.data.frame()`: data frame with a row for each specimen and point: `id`, and the
#'   columns of a shape's `points`.
#' @export
as.data.frame.shape_sample <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  like <- if (length(x)) x[[1]] else x$template
  none <- cbind(id = character(), like$points[0, ])
  each <- lapply(x$shapes, function(shape) cbind(id = shape$id, shape$points))
  each <- do.call(rbind, c(list(none), unname(each)))
  rownames(each) <- NULL
  each
}

#' @export
print.shape_sample <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    points <- x$template$points
    count <- vapply(c("landmarks", "curves", "surface"), function(level) sum(points$level == level),
                    0L)
    cat("<shape_sample> ", amount(length(x), "specimen"), ", by the scheme ",
        x$template$scheme$name,
        "\n", sep = "")
    cat("  ", count[["landmarks"]], " landmarks, ", count[["curves"]], " curve points, ",
        count[["surface"]],
        " surface points\n", sep = "")
    if (!is.null(x$convergence)) {
      last <- x$convergence[nrow(x$convergence), ]
      cat(sprintf("  template: mean after %s, moved by %.2g in the last (%.2g at most)\n",
                  amount(last$round, "round"),
                  last$movement, last$largest))
    }
    if (nrow(x$missing)) {
      cat(strwrap(paste0("missing: ", amount(sum(x$missing$points), "point"), " of ",
                         shorten(unique(x$missing$id), 8)),
                  indent = 2, exdent = 4), sep = "\n")
    }
    invisible(x)
  })
}
