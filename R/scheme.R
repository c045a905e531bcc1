# A scheme: what is measured on one kind of object, as tables.

#' A scheme: landmarks, curves, patches and pairs of one kind of object
#'
#' A scheme lists in tables what is measured on one kind of object (a face, a skull, a tooth).
#' [face_scheme()] is one. The tables are checked as a whole. An error names the table, row and
#' column of each mistake.
#'
#' @param landmarks Data frame with a row for each landmark: `landmark` (its name). Optional columns
#'   are `name` and `where` (words for the reader), and `x`, `y`, `z`: the position on a typical
#'   object, in the scheme's unit, in any pose. [fit_shape()] compares each specimen with these
#'   positions. It so detects a specimen in another unit, and landmarks that are exchanged.
#' @param curves Data frame with a row for each curve from one landmark to another:
#'   * `curve` (its name, without square brackets, plus sign or vertical bar), `from`, `to`
#'     (landmarks);
#'   * `kind`: "ridge", "valley", or "plane" for the shortest plane cut;
#'   * `n`: number of points at equal chords, both ends included;
#'   * `radius` of the curvature and half `width` of the window, in the unit of the mesh; needed for
#'     ridges and valleys;
#'   * `cut_share`, `cut_from`, `cut_to`: only the part next to the end `to` is kept. Its arc length
#'     is `cut_share` times the distance between the landmarks `cut_from` and `cut_to`. Empty: the
#'     whole curve;
#'   * `keep_away_from`, `keep_away_to`, `keep_away_radius` (0.7), `keep_away_extension` (0.2): a
#'     region where curvature is ignored, see [keep_away()];
#'   * `keep_side_from`, `keep_side_to`, `keep_side_towards`: curvature beyond the line between two
#'     landmarks, away from the third, is ignored, see [keep_side()];
#'   * `side_of`, `side`: only curvature to the "left" or "right" of another curve is used, as seen
#'     from outside along that curve from its `from` to its `to`;
#'   * `trust_from`, `trust_to` (defaults 0, 1): the part of the reference path in which curvature
#'     is used, as shares of the path's length. From there to the landmarks the path is the shortest
#'     cut;
#'   * `path`: "plane" for plane cuts (default), "crest" for a ridge or valley that bows, see
#'     [reference_path()];
#'   * `via`: landmarks on the way, separated by spaces; the path is then "crest". If `from` and
#'     `to` are one landmark, the curve is closed. It needs a `via` on its other side. It begins at
#'     its place nearest to the landmark, and its n points go once round; none of them is a
#'     landmark. With one `via` it runs anticlockwise as seen from outside, with more in their
#'     order;
#'   * `angle_limit`: greatest angle in radians (at most pi / 2) between the plane of a cut and the
#'     mean of the surface normals at the ends, see [plane_path()];
#'   * `note`, and any further columns; they are kept.
#' @param patches Data frame with a row for each patch, or for each block of a patch (`NULL`: no
#'   surface). A block lies between two bounding curves A and B. Its column c is the cut from point
#'   c of A to point c of B. Its first row lies on A, its last row on B.
#'   * `patch` (its name), `block` (1, 2, ... if a patch has several, else empty), `n` (number of
#'     points);
#'   * `columns`: the columns that are kept, such as "1,3:8"; `rows`: number of points in a column,
#'     both ends included; `rows_kept`: the rows that are kept, such as "2:6";
#'   * `curve_a`, `curve_b`: the curves A and B, such as `upper lip left[1:8]+philtrum lip left[2]`
#'     (`[14:1]` runs backwards). A block without `curve_b` is one row on A;
#'   * `resample_a`, `resample_b`: number of points at equal chords that replace the points of the
#'     curve;
#'   * `first_column`: a curve from A to B that replaces the cut of column 1, such as `nasolabial
#'     left[1:6]`. If its number of points differs from `rows`, it is resampled;
#'   * `outward`: order of the corners of a quad as seen from outside. "columns": (c, r), (c + 1,
#'     r), (c + 1, r + 1). "rows": (c, r), (c, r + 1), (c + 1, r + 1). Empty: no triangles;
#'   * `note`.
#'
#'   The points of the surface are in the order of the table's rows, then by column, then by row of
#'   the block. The index of a point is "block column row"; without blocks it is "column row", and
#'   for a patch of one row "column". Columns are numbered after those that are not kept were
#'   dropped, rows before.
#' @param pairs Data frame with a row for each left-right pair (`NULL`: none): `level` ("landmarks",
#'   "curves", or "surface" for patches), `left`, `right`. A part that is not listed is its own
#'   mirror image. A curve between the two landmarks of a pair is its own mirror image in reverse
#'   order.
#' @param strips Data frame of the triangles that join patches (`NULL`: none). Columns: `part`
#'   ("model", or the name of an optional part), `strip` (its name), `rung` (1, 2, ...), `a`, `b`
#'   (points, as "patch|index"), `outward` (order of the corners: "columns" for a, b, next b; "rows"
#'   for a, next a, next b). Two successive rungs make a quad.
#' @param definitions Data frame with the definitions that [refine_landmarks()] uses (`NULL`: none).
#'   It has a row for each landmark that is defined by curvature:
#'   * `landmark` (its name) and `kind`;
#'   * `kind` "cap" or "cup": the place where the lesser of the two principal curvatures is
#'     strongest;
#'   * `kind` "profile": the extreme of the curvature of a plane cut through the surface;
#'   * `kind` "turn": the extreme of the geodesic curvature of a curve;
#'   * `kind` "end": the place where a ridge or valley fades;
#'   * `kind` "crossing": the place where a curve crosses a mirror plane or another curve;
#'   * `radius` of the curvature, and `reach`: greatest distance of the defined place from the
#'     landmark; both in the unit of the mesh;
#'   * `bend`: "out" (a crest) or "in" (a fold) for a profile; "left" or "right" (as seen from
#'     outside) for a turn;
#'   * `mirror` (profile, crossing): left landmarks of pairs, separated by spaces. These pairs
#'     define the mirror plane of the object;
#'   * `across_from`, `across_to` (in place of `mirror`): two landmarks. For a profile, its plane
#'     contains both and stands straight on the surface. For a crossing, the crossed curve runs
#'     between them; its type is `across_type` ("ridge", "valley" or "plane");
#'   * `from`, `to`, `type`, `width` (turn, crossing, end): the curve, as in `curves`. Neither end
#'     may be the landmark itself, as the definition must not depend on its first position. The
#'     curve of an "end" starts at `from` and continues straight through the landmark; it has no
#'     `to`;
#'   * `note`, and any further columns.
#' @param name Name of the scheme, one string.
#' @param tracks Data frame of where curves are expected, as [learn_tracks()] makes it (`NULL`: no
#'   expectation). It has a row for each place along a ridge or valley:
#'   * `curve`; `place` (1, 2, ...); `s` (share of the curve's length, between 0 and 1);
#'   * `x`, `y`, `z`: the place relative to the curve's landmark `from`. The unit is the distance
#'     from there to its landmark `to`. The axes are those of `x`, `y`, `z` of `landmarks`;
#'   * `across_x`, `across_y`, `across_z`: unit vector along the surface and across the curve;
#'   * `spread`: standard deviation of the curve's offset across, in the same unit.
#' @return Object of class `curve_scheme`, a list:
#'   * `name`;
#'   * data frames `landmarks`, `curves`, `patches`, `pairs`, `strips`, `definitions` and
#'     `tracks` with all columns above; empty cells are `NA`;
#'   * `points`: data frame `level`, `part`, `point`, `place`. Points that coincide by construction
#'     have the same `place`;
#'   * `triangles`: data frame `part`, `group`, `v1`, `v2`, `v3` (rows of the surface's points, in
#'     outward order). Of coinciding points the first is used.
#'
#'   `as.data.frame(scheme, table)` gives each of these tables.
#' @section Errors: of class `crestline_scheme_error`. It lists all problems of the first table that
#'   has any; the message shows the first eight.
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
                         definitions = NULL, tracks = NULL) {
  check_given()
  tables <- list(landmarks = landmarks, curves = curves, patches = patches, pairs = pairs,
                 strips = strips, definitions = definitions, tracks = tracks)
  assembled_scheme(tables, name, labels = stats::setNames(names(tables), names(tables)))
}

#' @param tables The seven tables, `NULL` where absent.
#' @param labels What the tables are called in messages.
#' @noRd
assembled_scheme <- function(tables, name, labels) {
  scheme <- list(name = check_text(name, "name"))
  for (table in names(tables)) {
    typed <- typed_table(present_table(tables[[table]], table, labels[[table]]),
                         scheme_columns[[table]])
    rows <- scheme_rows(table, typed$table)
    refuse_table(typed$problems, labels[[table]], rows)
    check <- switch(table, landmarks = check_scheme_landmarks, curves = check_scheme_curves,
                    patches = check_scheme_patches, pairs = check_scheme_pairs,
                    strips = check_scheme_strips,
                    definitions = check_scheme_definitions, tracks = check_scheme_tracks)
    scheme_problems <- check(typed$table, scheme)
    refuse_table(scheme_problems, labels[[table]], rows)
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
#' @param tables List of the seven tables, with all their columns.
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
  # Schemes of former versions lack the last two, and the curves' routes.
  old <- setdiff(names(scheme_columns), c("definitions", "tracks"))
  wanted <- c(lapply(scheme_columns[old], names), derived)
  wanted$curves <- setdiff(wanted$curves, c("path", "via"))
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

#' What the rows of a table are called
#' @noRd
scheme_rows <- function(which, table) {
  switch(which, landmarks = , definitions = table$landmark, curves = table$curve,
         pairs = table$left,
         patches = ifelse(is.na(table$block), table$patch,
                          paste(table$patch, "block", table$block)),
         strips = paste(table$strip, "rung", table$rung),
         tracks = paste(table$curve, "place", table$place))
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
  # Routes where a table leaves them empty: plane cuts, along the crest where there is a `via`
  empty <- is.na(curves$path)
  curves$path[empty] <- ifelse(is.na(curves$via[empty]), "plane", "crest")
  curves
}

#' @rdname curve_scheme
#' @param x A scheme.
#' @param row.names,optional Ignored.
#' @param table "landmarks", "curves", "patches", "pairs", "strips", "definitions", "tracks",
#'   "points" or "triangles".
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
    crests <- sum(curves$path %in% "crest")
    if (crests) {
      line("routes: ", crests, " along a crest, of them ", sum(closed_curves(curves)), " closed")
    }
    place <- x$points$place[x$points$level == "surface"]
    model <- x$triangles$part == "model"
    surface_line <- paste0(amount(length(unique(x$patches$patch)), "patch", "patches"), " in ",
                           amount(nrow(x$patches), "block"), ", ",
                           amount(length(place), "point"), " at ", amount(length(unique(place)),
                                                                          "place"), ", ",
                           amount(sum(model), "triangle"), " and ", sum(!model), " on request")
    line("surface: ", surface_line)
    if (nrow(x$definitions)) {
      line("landmarks with a definition: ", shorten(x$definitions$landmark, 30))
    }
    if (NROW(x$tracks)) {
      line("expected tracks: of ", amount(length(unique(x$tracks$curve)), "curve"))
    }
    line("left-right pairs: ",
         paste(paired, c("of landmarks", "of curves", "of patches"), collapse = ", "))
    invisible(x)
  })
}

#' @rdname curve_scheme
#' @param i Name of a table.
#' @param value A table in its place.
#' @details `scheme$curves$radius[3] <- 8` changes a scheme. The whole scheme is checked anew, as by
#'   `curve_scheme()`, and its `points` and `triangles` follow. For a change of several tables that
#'   do not fit each other on the way, change the tables first, and give them to `curve_scheme()`.
#' @export
`$<-.curve_scheme` <- function(x, name, value) {
  own <- c("name", names(scheme_columns))
  if (!name %in% own) {
    crestline_abort(sprintf(if (name %in% names(unclass(x))) {
                      "the scheme's `%s` are worked out from its tables."
                    } else {
                      "a scheme has no table %s."
                    }, name),
                    sprintf("Change one of %s.", shorten(own, 20)), stage = "scheme",
                    class = "crestline_scheme_error", call = NULL)
  }
  fields <- unclass(x)[own]
  fields[name] <- list(value)
  # A table without rows is one that is not there
  tables <- lapply(fields[names(scheme_columns)], function(table) if (NROW(table)) table)
  names(tables) <- names(scheme_columns)
  assembled_scheme(tables, fields$name, labels = stats::setNames(names(tables), names(tables)))
}

#' @rdname curve_scheme
#' @export
`[[<-.curve_scheme` <- function(x, i, value) {
  if (is.numeric(i)) i <- names(unclass(x))[i]
  if (!is.character(i) || length(i) != 1 || is.na(i)) {
    crestline_abort("a scheme has no such table.", "Give the name of a table.", stage = "scheme",
                    class = "crestline_scheme_error", call = NULL)
  }
  `$<-.curve_scheme`(x, i, value)
}

#' A scheme with its lengths in the unit of a specimen's mesh
#'
#' @param unit As in [fit_shape()].
#' @noRd
scheme_in_unit <- function(scheme, unit, specimen) {
  if (is.null(unit)) unit <- c(specimen$match$unit, 1)[1]
  check_number(unit, "unit", 0, open = TRUE)
  if (unit == 1) return(scheme)
  scheme <- unclass(scheme)
  scheme$landmarks[c("x", "y", "z")] <- scheme$landmarks[c("x", "y", "z")] / unit
  for (table in c("curves", "definitions")) {
    lengths <- intersect(c("radius", "width", "reach"), names(scheme[[table]]))
    scheme[[table]][lengths] <- scheme[[table]][lengths] / unit
  }
  structure(scheme, class = "curve_scheme")
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
  # A scheme without expected tracks, or with plane cuts only, is what it was before there were
  # others.
  counted <- setdiff(names(scheme_columns), if (!NROW(scheme$tracks)) "tracks")
  scheme <- unclass(scheme)
  if (all(scheme$curves$path %in% "plane")) scheme$curves[c("path", "via")] <- NULL
  content_hash(lapply(unclass(scheme)[counted], function(table) {
    table <- as.list(table)
    lapply(table[order(names(table), method = "radix")], function(x) {
      if (is.factor(x)) x <- as.character(x)
      as.vector(if (is.character(x)) enc2utf8(x) else if (is.integer(x)) as.double(x) else x)
    })
  }))
}

scheme_provenance <- function(scheme) list(name = scheme$name, hash = scheme_hash(scheme))
