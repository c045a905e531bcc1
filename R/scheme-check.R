# What the cells of a scheme's tables must be to one another: each check takes its table and the
# scheme so far, and gives problems.

check_scheme_landmarks <- function(landmarks, scheme) named_once(landmarks$landmark, "landmark")

check_scheme_curves <- function(curves, scheme) {
  known <- scheme$landmarks$landmark
  side <- c("keep_side_from", "keep_side_to", "keep_side_towards")
  landmark_columns <- c("from", "to", "cut_from", "cut_to", "keep_away_from", "keep_away_to", side)
  by_curvature <- curves$kind != "plane"
  empty <- function(column, where, why) problem(
    which(where & is.na(curves[[column]])), column, paste("is empty:", why)
  )
  one <- function(a, b) problem(
    which(curves[[a]] == curves[[b]]), b, sprintf("is the same landmark as %s", a)
  )
  rbind(named_once(curves$curve, "curve"),
        problem(grep("[][+|]", curves$curve), "curve", "a name may not hold [ ] + or |"),
        do.call(rbind, lapply(landmark_columns, function(column) unknown_names(
          curves[[column]], known, column, "landmark"
        ))),
        one("cut_from", "cut_to"), one("keep_away_from", "keep_away_to"),
        one(side[1], side[2]), one(side[1], side[3]), one(side[2], side[3]),
        whole_group(curves, side), empty("radius", by_curvature, "a ridge or valley needs it"),
        empty("width", by_curvature, "a ridge or valley needs it"),
        whole_group(curves, c("cut_share", "cut_from", "cut_to")),
        whole_group(curves, c("keep_away_from", "keep_away_to")),
        whole_group(curves, c("side_of", "side")),
        needs(curves, "keep_away_radius", "keep_away_from"),
        needs(curves, "keep_away_extension", "keep_away_from"), check_trust(curves),
        check_side_of(curves), check_routes(curves, known))
}

check_trust <- function(curves) {
  from <- ifelse(is.na(curves$trust_from), 0, curves$trust_from)
  to <- ifelse(is.na(curves$trust_to), 1, curves$trust_to)
  problem(which(from >= to), "trust_to", "is not above trust_from")
}

# A curve is found after the one whose side it keeps to, so that these may not go round in a ring.
check_side_of <- function(curves) {
  before <- match(curves$side_of, curves$curve)
  reached <- before
  ring <- rep(FALSE, nrow(curves))
  for (step in seq_len(nrow(curves))) {
    ring <- ring | (!is.na(reached) & reached == seq_along(reached))
    reached <- before[reached]
  }
  rbind(unknown_names(curves$side_of, curves$curve, "side_of", "curve"),
        problem(which(ring), "side_of", "leads back to the curve itself"))
}

check_scheme_patches <- function(patches, scheme) {
  blocks <- ifelse(is.na(patches$block), patches$patch, paste0(patches$patch, "|", patches$block))
  both <- patches$patch %in% patches$patch[is.na(patches$block)] & duplicated(patches$patch) &
    !duplicated(blocks)
  unreadable <- function(column) which(vapply(
    patches[[column]], function(text) is.null(number_list(text)), NA
  ))
  problems <- rbind(
    named_once(blocks, "patch"),
    problem(which(both), "block", "is empty in one row of the patch and not in another"),
    problem(grep("|", patches$patch, fixed = TRUE), "patch", "a name may not hold |"),
    problem(unreadable("columns"), "columns", "cannot be read: write whole numbers as 1,3:8"),
    problem(unreadable("rows_kept"), "rows_kept", "cannot be read: write whole numbers as 2:6"),
    side_problems(patches, "curve_a", scheme$curves),
    side_problems(patches, "curve_b", scheme$curves),
    side_problems(patches, "first_column", scheme$curves),
    needs(patches, "resample_b", "curve_b"), needs(patches, "first_column", "curve_b"),
    problem(which(is.na(patches$curve_b) & patches$rows != 1), "rows",
            "is not 1, and there is no curve_b"),
    problem(which(!is.na(patches$curve_b) & patches$rows < 2), "rows",
            "is not 2 at least, and there is a curve_b")
  )
  if (nrow(problems)) problems else block_problems(patches)
}

#' Ranges, counts and ends of blocks that can be read
#' @noRd
block_problems <- function(patches) {
  own <- function(text) vapply(
    text, function(x) if (is.na(x)) NA_integer_ else nrow(side_points(x)), 1L
  )
  length_of <- function(text, resample) ifelse(is.na(resample), own(text), resample)
  a <- length_of(patches$curve_a, patches$resample_a)
  b <- length_of(patches$curve_b, patches$resample_b)
  columns <- lapply(patches$columns, number_list)
  rows <- lapply(patches$rows_kept, number_list)
  outside <- function(numbers, most) {
    wrong <- function(i) min(numbers[[i]]) < 1 || max(numbers[[i]]) > most[i] ||
      anyDuplicated(numbers[[i]]) > 0
    which(vapply(seq_along(numbers), wrong, NA))
  }
  n <- lengths(columns) * lengths(rows)
  wrong <- which(n != patches$n)
  apart <- which(!is.na(b) & a != b)
  wide <- outside(columns, a)
  high <- outside(rows, patches$rows)
  rbind(problem(apart, "curve_b", sprintf(
          "gives %d columns where curve_a gives %d", b[apart], a[apart]
        )),
        problem(wide, "columns", sprintf(
          "%s does not lie within 1 to %d, each once", patches$columns[wide], a[wide]
        )),
        problem(high, "rows_kept", sprintf(
          "%s does not lie within 1 to %d, each once", patches$rows_kept[high], patches$rows[high]
        )),
        problem(wrong, "n", sprintf(
          "is %d, but %d columns times %d rows are kept", patches$n[wrong], lengths(columns)[wrong],
          lengths(rows)[wrong]
        )))
}

#' Bounding curves that cannot be read, are unknown, or have fewer points
#' @noRd
side_problems <- function(patches, column, curves) {
  each <- lapply(which(!is.na(patches[[column]])), function(row) {
    parts <- curve_parts(patches[[column]][row])
    if (is.null(parts)) {
      return(problem(row, column, "cannot be read: write curve[1:8], joined by +"))
    }
    unknown <- unknown_names(parts$curve, curves$curve, column, "curve")
    n <- curves$n[match(parts$curve, curves$curve)]
    beyond <- which(!is.na(n) & (pmin(parts$from, parts$to) < 1 | pmax(parts$from, parts$to) > n))
    text <- c(unknown$text, sprintf(
      "%s has points 1 to %d, not %d:%d", parts$curve[beyond], n[beyond], parts$from[beyond],
      parts$to[beyond]
    ))
    problem(rep(row, length(text)), column, text)
  })
  do.call(rbind, c(list(problem(integer())), each))
}

check_scheme_strips <- function(strips, scheme) {
  points <- scheme_points(scheme$landmarks, scheme$curves, scheme$patches)
  surface <- points[points$level == "surface", ]
  known <- paste(surface$part, surface$point, sep = "|")
  first <- match(strips$strip, strips$strip)
  rung <- stats::ave(seq_along(first), first, FUN = seq_along)
  differs <- function(column) which(strips[[column]] != strips[[column]][first])
  rbind(
    unknown_names(strips$a, known, "a", "surface point"),
    unknown_names(strips$b, known, "b", "surface point"),
    problem(which(strips$rung != rung), "rung",
            "the rungs of a strip are not 1, 2, 3, ... in order"),
    problem(differs("outward"), "outward", "differs from the strip's first row"),
    problem(differs("part"), "part", "differs from the strip's first row")
  )
}

# What each kind of definition needs, and what it cannot use.
check_scheme_definitions <- function(definitions, scheme) {
  known <- scheme$landmarks$landmark
  kind <- definitions$kind
  line <- c("from", "to", "type", "width")
  names <- c("landmark", "from", "to", "across_from", "across_to")
  on_curve <- kind %in% c("turn", "end", "crossing")
  other <- !is.na(definitions$across_from)
  wants <- function(column, where, why) problem(
    which(where & is.na(definitions[[column]])), column, paste("is empty:", why)
  )
  bends <- list(profile = c("out", "in"), turn = c("left", "right"))
  wrong_bend <- which(kind %in% names(bends) &
                      !mapply(function(k, bend) bend %in% bends[[k]], kind, definitions$bend))
  both <- which(kind %in% c("profile", "crossing") & is.na(definitions$mirror) == !other)
  rbind(
    named_once(definitions$landmark, "landmark"),
    do.call(rbind, lapply(names,
                          function(column) unknown_names(definitions[[column]], known, column,
                                                         "landmark"))),
    do.call(rbind, lapply(setdiff(line, "to"), wants, on_curve, "this kind is taken on a curve")),
    wants("to", kind %in% c("turn", "crossing"), "this kind is taken on a curve"),
    problem(which(kind == "end" & definitions$type %in% "plane"), "type",
            "is plane, which has no end"),
    problem(wrong_bend, "bend",
            sprintf("is not %s", vapply(bends[kind[wrong_bend]], paste, "", collapse = " or "))),
    problem(both, "mirror", "this kind needs either mirror or across_from and across_to"),
    whole_group(definitions, c("across_from", "across_to")),
    needs(definitions, "across_type", "across_from"),
    wants("across_type", kind == "crossing" & other, "the curve that is crossed has a type"),
    problem(which(definitions$from == definitions$landmark |
                  definitions$to == definitions$landmark), "landmark",
            "is an end of its own curve"),
    check_mirrors(definitions$mirror, scheme$pairs)
  )
}

# An expected track lies in the frame of the scheme's landmarks, and belongs to what is looked for.
check_scheme_tracks <- function(tracks, scheme) {
  row <- match(tracks$curve, scheme$curves$curve)
  known <- rownames(typical_landmarks(scheme))
  ends <- scheme$curves[row, c("from", "to")]
  lacking <- !is.na(row) & !(ends$from %in% known & ends$to %in% known)
  twice <- duplicated(tracks[c("curve", "place")])
  rbind(
    unknown_names(tracks$curve, scheme$curves$curve, "curve", "curve"),
    problem(which(scheme$curves$kind[row] == "plane"), "curve",
            "is a plane cut, which is not looked for"),
    problem(which(lacking), "curve", "has an end without x, y, z in the table landmarks"),
    problem(which(twice), "place", "is there twice")
  )
}

check_mirrors <- function(mirror, pairs) {
  left <- pairs$left[pairs$level == "landmarks"]
  each <- lapply(which(!is.na(mirror)), function(row) {
    unknown <- unknown_names(mirror_names(mirror[row]), left, "mirror", "left landmark of a pair")
    problem(rep(row, nrow(unknown)), "mirror", unknown$text)
  })
  do.call(rbind, c(list(problem(integer())), each))
}

named_once <- function(x, column) {
  twice <- which(duplicated(x))
  problem(twice, column,
          sprintf("\"%s\" is named twice, before in row %d", x[twice], match(x[twice], x)))
}

# Columns that are filled all together or not at all.
whole_group <- function(table, columns) {
  filled <- !is.na(table[columns])
  partly <- rowSums(filled) > 0 & rowSums(filled) < length(columns)
  each <- lapply(columns, function(column) {
    problem(which(partly & is.na(table[[column]])), column,
            sprintf("is empty: %s go together", toString(columns)))
  })
  do.call(rbind, each)
}

needs <- function(table, column, other) {
  problem(which(!is.na(table[[column]]) & is.na(table[[other]])), column,
          sprintf("is given, but %s is not", other))
}
