# A scheme: what is measured on one kind of object, as tables.

#' A scheme: landmarks, curves, patches and pairs of one kind of object
#'
#' A scheme lists in tables what is measured on one kind of object (a face, a skull, a tooth).
#' [face_scheme()] is one. The tables are checked as a whole. An error names the table, row and
#' column of each mistake.
#'
#' @param landmarks Data frame, a row a landmark: `landmark` (its name); if wanted `name` and
#'   `where` (words for the reader), and `x`, `y`, `z`: where it lies on a typical object, in the
#'   scheme's unit, in any pose. By them [fit_shape()] sees that a specimen is in another unit, and
#'   which landmarks are exchanged.
#' @param curves Data frame, a row a curve from one landmark to another:
#'   * `curve` (its name, without `[ ] + |`), `from`, `to` (landmarks), `kind` ("ridge", "valley" or
#'     "plane": the shortest plane cut), `n` (points at equal chords, both ends counted);
#'   * `radius` of the curvature and half `width` of the window, in the unit of the mesh; needed for
#'     ridges and valleys;
#'   * `cut_share`, `cut_from`, `cut_to`: only the part next to the end `to` is kept, as long as
#'     this share of the distance between two landmarks (arc length; empty: the whole curve);
#'   * `keep_away_from`, `keep_away_to`, `keep_away_radius` (0.7), `keep_away_extension` (0.2): a
#'     region where curvature is ignored, see [keep_away()];
#'   * `keep_side_from`, `keep_side_to`, `keep_side_towards`: curvature is ignored beyond the line
#'     between two landmarks,
#'     away from the third, see [keep_side()];
#'   * `side_of`, `side`: curvature is ignored unless it lies to the "left" or "right" of another
#'     curve (walked from
#'     its `from` to its `to`, seen from outside);
#'   * `trust_from`, `trust_to` (0, 1): the part of the reference path, as shares of its length,
#'     where it and curvature are believed; from there to the landmarks the path is the shortest
#'     cut;
#'   * `angle_limit`: greatest angle in radians (at most pi / 2) between the plane of a cut and the
#'     mean of the surface normals at the ends, see [plane_path()];
#'   * `note`, and any further columns, which are kept.
#' @param patches Data frame, a row a patch, or a block of one (`NULL`: no surface). Column c of a
#'   block is the cut from point c of a bounding curve A to point c of another, B; row 1 lies on A,
#'   the last on B.
#'   * `patch` (its name), `block` (1, 2, ... where a patch has several, else empty), `n` (its
#'     points);
#'   * `columns`: those that are kept, such as "1,3:8"; `rows`: the points a column is divided into,
#'     both ends counted; `rows_kept`, such as "2:6";
#'   * `curve_a`, `curve_b`: such as `upper lip left[1:8]+philtrum lip left[2]` (`[14:1]` runs
#'     backwards); `resample_a`, `resample_b`: the number of points at equal chords that replace the
#'     curve's own; a block without `curve_b` is one row on A;
#'   * `first_column`: the curve from A to B that column 1 follows in place of a cut, such as
#'     `nasolabial left[1:6]`; its own points where it has as many as `rows`, else resampled to
#'     them;
#'   * `outward`: the order of the corners of a quad seen from outside, "columns" ((c, r), (c + 1,
#'     r), (c + 1, r + 1)) or "rows" ((c, r), (c, r + 1), (c + 1, r + 1)); empty: no triangles;
#'     `note`.
#'
#'   The points of the surface are in the order of the rows, then by column, then by row; the index
#'   of a point is "block column row", "column row" or, where a patch is one row of one block,
#'   "column"; columns are counted as kept, rows as made.
#' @param pairs Data frame, a row a pair (`NULL`: none): `level` ("landmarks", "curves" or
#'   "surface": patches), `left`, `right`. What is not listed is its own mirror image (a curve
#'   between the two landmarks of a pair: run backwards).
#' @param strips Data frame of the triangles that join patches (`NULL`: none): `part` ("model", or
#'   the name of an optional part), `strip` (its name), `rung` (1, 2, ...), `a`, `b` (points, as
#'   "patch|index"), `outward` ("columns": a, b, next b; "rows": a, next a, next b). Each two rungs
#'   are a quad.
#' @param definitions Data frame of what [refine_landmarks()] goes by (`NULL`: none), a row a
#'   landmark that has a definition by shape:
#'   * `landmark`; `kind`: "cap" or "cup" (strongest: the lesser of its two curvatures is greatest),
#'     "profile" (extreme of the curvature of the surface's cut with a plane), "turn" (extreme of
#'     the geodesic curvature of a curve), "end" (where a ridge or valley has faded), "crossing" (of
#'     a curve with a mirror plane or with another curve);
#'   * `radius` of the curvature; `reach`: how far from the landmark its place is looked for; both
#'     in the unit of the mesh;
#'   * `bend`: "out" or "in" of a profile (a crest or a fold), "left" or "right" of a turn (seen
#'     from outside);
#'   * `mirror` (profile, crossing): left landmarks of pairs, with spaces between, that span the
#'     mirror plane of the object; or `across_from`, `across_to`: two landmarks, through which the
#'     plane of a profile stands straight into the surface, or between which the crossed curve runs
#'     (`across_type`: "ridge", "valley" or "plane");
#'   * `from`, `to`, `type`, `width` (turn, crossing, end): the curve, as in `curves`, but neither
#'     end the landmark itself, since its place may not depend on where it was put. The curve of an
#'     end comes from `from` and goes on straight through the landmark (no `to`);
#'   * `note`, and any further columns.
#' @param name Name of the scheme, one string.
#' @return Object of class `curve_scheme`, a list: `name`; data frames `landmarks`, `curves`,
#'   `patches`, `pairs`, `strips`, `definitions` with all columns above (`NA` where empty); `points`
#'   (`level`, `part`, `point`, `place`: points that coincide by construction have the same
#'   `place`); `triangles` (`part`, `group`, `v1`, `v2`, `v3`: rows of the surface's points,
#'   outward; coinciding points by the first). `as.data.frame(scheme, table)` gives any of them.
#' @section Errors: of class `crestline_scheme_error`, with all problems of the first table that has
#'   any (the message shows eight).
#' @template glossary
#' @seealso [read_scheme()], [face_scheme()], [refine_landmarks()]
#' @examples
#' landmarks <- data.frame(landmark = c("tip", "left", "right"))
#' curves <- data.frame(curve = c("edge left", "edge right"), from = "tip", to = c("left", "right"),
#'                      kind = "ridge", radius = 2, width = 3, n = 10)
#' pairs <- data.frame(level = c("landmarks", "curves"), left = c("left", "edge left"),
#'                     right = c("right", "edge right"))
#' curve_scheme(landmarks, curves, pairs = pairs, name = "tooth")
#' @export
curve_scheme <- function(landmarks, curves, patches = NULL, pairs = NULL, strips = NULL,
                         name = "scheme",
                         definitions = NULL) {
  check_given()
  tables <- list(landmarks = landmarks, curves = curves, patches = patches, pairs = pairs,
                 strips = strips,
                 definitions = definitions)
  build_scheme(tables, name, labels = stats::setNames(names(tables), names(tables)))
}

#' @param tables The six tables, `NULL` where absent.
#' @param labels What the tables are called in messages.
#' @noRd
build_scheme <- function(tables, name, labels) {
  scheme <- list(name = check_text(name, "name"))
  for (table in names(tables)) {
    typed <- typed_table(present_table(tables[[table]], table, labels[[table]]),
                         scheme_columns[[table]])
    rows <- scheme_rows(table, typed$table)
    refuse_table(typed$problems, labels[[table]], rows)
    refuse_table(scheme_problems(table, typed$table, scheme), labels[[table]], rows)
    scheme[[table]] <- typed$table
  }
  scheme$curves <- with_defaults(scheme$curves)
  points <- scheme_points(scheme$landmarks, scheme$curves, scheme$patches)
  scheme <- new_curve_scheme(
    scheme$name, scheme[names(scheme_columns)], points,
    scheme_triangles(scheme$patches, scheme$strips, points)
  )
  scheme_plan(scheme)
  scheme
}

#' A scheme from its parts: all its fields are declared here
#'
#' @param tables List of the six tables, with all their columns.
#' @param points,triangles As in the value of [curve_scheme()].
#' @noRd
new_curve_scheme <- function(name, tables, points, triangles) {
  structure(c(list(name = name), tables[names(scheme_columns)],
              list(points = points, triangles = triangles)),
            class = "curve_scheme")
}

#' Refuse a scheme whose tables lack columns, or do not fit each other
#' @noRd
validate_curve_scheme <- function(x) {
  if (passed_lately(x, "curve_scheme")) return(invisible(x))
  refuse <- function(problem) {
    crestline_abort(problem,
                    "Make it anew: curve_scheme() of its tables, as.data.frame(scheme, table).",
                    stage = "scheme",
                    class = "crestline_scheme_error", call = NULL)
  }
  if (!is.list(x) || !is.character(x$name) || length(x$name) != 1) refuse("the scheme has no name.")
  derived <- list(points = c("level", "part", "point", "place"),
                  triangles = c("part", "group", "v1", "v2", "v3"))
  wanted <- c(lapply(scheme_columns[setdiff(names(scheme_columns), "definitions")], names), derived)
  for (table in names(wanted)) {
    lacking <- if (is.data.frame(x[[table]])) setdiff(wanted[[table]], names(x[[table]])) else
      "all its columns"
    if (length(lacking)) refuse(sprintf("the scheme's table %s lacks %s.", table, shorten(lacking)))
  }
  count <- c(landmarks = nrow(x$landmarks), curves = sum(x$curves$n), surface = sum(x$patches$n))
  if (!identical(as.vector(table(factor(x$points$level, names(count)))), as.integer(count))) {
    refuse("the scheme's `points` are not those of its landmarks, curves and patches.")
  }
  corner <- unlist(x$triangles[c("v1", "v2", "v3")])
  if (anyNA(corner) || any(corner < 1 | corner > count[["surface"]])) {
    refuse("the scheme's `triangles` name points that it does not have.")
  }
  remember_passed(x, "curve_scheme")
}

#' @exportS3Method
validate.curve_scheme <- function(x) validate_curve_scheme(x)

scheme_problems <- function(which, table, scheme) {
  check <- switch(which, landmarks = check_scheme_landmarks, curves = check_scheme_curves,
                  patches = check_scheme_patches, pairs = check_scheme_pairs,
                  strips = check_scheme_strips,
                  definitions = check_scheme_definitions)
  check(table, scheme)
}

#' What the rows of a table are called
#' @noRd
scheme_rows <- function(which, table) {
  switch(which, landmarks = , definitions = table$landmark, curves = table$curve,
         pairs = table$left,
         patches = ifelse(is.na(table$block), table$patch,
                          paste(table$patch, "block", table$block)),
         strips = paste(table$strip, "rung", table$rung))
}

present_table <- function(table, which, label) {
  if (is.null(table) && !which %in% c("landmarks", "curves")) {
    names <- names(scheme_columns[[which]])
    return(as.data.frame(stats::setNames(rep(list(character()), length(names)), names)))
  }
  if (!is.data.frame(table) || nrow(table) == 0) {
    crestline_abort(sprintf("table %s is %s.", label, if (is.data.frame(table)) {
                      "empty"
                    } else {
                      describe_value(table)
                    }),
                    "Give a data frame, see `?curve_scheme`.", stage = "scheme",
                    class = "crestline_scheme_error", call = NULL)
  }
  as.data.frame(table)
}

#' The defaults of [keep_away()] and of trust where a table leaves them empty
#' @noRd
with_defaults <- function(curves) {
  fill <- function(x, value, where = TRUE) ifelse(is.na(x) & where, value, x)
  away <- !is.na(curves$keep_away_from)
  region <- formals(keep_away)
  curves$keep_away_radius <- fill(curves$keep_away_radius, region$radius, away)
  curves$keep_away_extension <- fill(curves$keep_away_extension, region$extension, away)
  curves$trust_from <- fill(curves$trust_from, 0)
  curves$trust_to <- fill(curves$trust_to, 1)
  curves
}

#' @rdname curve_scheme
#' @param x A scheme.
#' @param row.names,optional Ignored.
#' @param table "landmarks", "curves", "patches", "pairs", "strips", "definitions", "points" or
#'   "triangles".
#' @param ... Ignored.
#' @export
as.data.frame.curve_scheme <- function(x, row.names = NULL, optional = FALSE, table = "curves",
                                       ...) {
  check_method_dots(..., known = "table")
  if (is.character(row.names)) table <- row.names
  x[[check_choice(table, c(names(scheme_columns), "points", "triangles"), "table")]]
}

#' @export
print.curve_scheme <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    line <- function(...) cat(strwrap(paste0(...), width = 80, exdent = 2), sep = "\n")
    curves <- x$curves
    kinds <- table(factor(curves$kind, c("ridge", "valley", "plane")))
    paired <- table(factor(x$pairs$level, c("landmarks", "curves", "surface")))
    line("<curve_scheme> ", x$name, ": ", amount(nrow(x$landmarks), "landmark"), ", ",
         amount(nrow(curves), "curve"), " with ", amount(sum(curves$n), "point"))
    line("landmarks: ", shorten(x$landmarks$landmark, 30))
    line("curves: ", paste(kinds, names(kinds), collapse = ", "))
    line("constraints: ", sum(!is.na(curves$cut_share)), " cut off, ",
         sum(!is.na(curves$keep_away_from)),
         " kept away from a region, ",
         sum(!is.na(curves$side_of) | !is.na(curves$keep_side_from)), " held to a side, ",
         sum(curves$trust_from > 0 | curves$trust_to < 1), " trusted in part, ",
         sum(!is.na(curves$angle_limit)), " limited in angle")
    line("surface: ", surface_line(x))
    if (nrow(x$definitions)) {
      line("landmarks with a definition: ", shorten(x$definitions$landmark, 30))
    }
    line("left-right pairs: ",
         paste(paired, c("of landmarks", "of curves", "of patches"), collapse = ", "))
    invisible(x)
  })
}

surface_line <- function(x) {
  place <- x$points$place[x$points$level == "surface"]
  model <- x$triangles$part == "model"
  paste0(amount(length(unique(x$patches$patch)), "patch", "patches"), " in ",
         amount(nrow(x$patches), "block"), ", ",
         amount(length(place), "point"), " at ", amount(length(unique(place)), "place"), ", ",
         amount(sum(model), "triangle"), " and ", sum(!model), " on request")
}

#' A scheme with its lengths in the unit of a specimen's mesh
#'
#' @param unit As in [fit_shape()].
#' @noRd
scheme_in_unit <- function(scheme, unit, specimen) {
  if (is.null(unit)) unit <- c(specimen$match$unit, 1)[1]
  check_number(unit, "unit", 0, open = TRUE)
  if (unit == 1) return(scheme)
  scheme$landmarks[c("x", "y", "z")] <- scheme$landmarks[c("x", "y", "z")] / unit
  for (table in c("curves", "definitions")) {
    lengths <- intersect(c("radius", "width", "reach"), names(scheme[[table]]))
    scheme[[table]][lengths] <- scheme[[table]][lengths] / unit
  }
  scheme
}

# What a scheme is, in one string.

#' Hash of a scheme's tables
#'
#' Names of rows, the order of columns, the scheme's own name, and whether numbers are integers do
#' not count.
#'
#' @return One string of 32 characters.
#' @noRd
scheme_hash <- function(scheme) {
  rlang::hash(lapply(unclass(scheme)[names(scheme_columns)], function(table) {
    table <- as.list(table)
    lapply(table[order(names(table), method = "radix")], plain_values)
  }))
}

plain_values <- function(x) {
  if (is.factor(x)) x <- as.character(x)
  as.vector(if (is.character(x)) enc2utf8(x) else if (is.integer(x)) as.double(x) else x)
}

scheme_provenance <- function(scheme) list(name = scheme$name, hash = scheme_hash(scheme))
