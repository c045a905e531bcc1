# Left and right: partners of landmarks, curves and patches, and whether what belongs together is
# alike.

check_scheme_pairs <- function(pairs, scheme) {
  sides <- data.frame(row = rep(seq_len(nrow(pairs)), 2),
                      side = rep(c("left", "right"), each = nrow(pairs)),
                      level = rep(pairs$level, 2), name = c(pairs$left, pairs$right))
  sides <- sides[order(sides$row), ]
  known <- list(landmark = scheme$landmarks$landmark, curve = scheme$curves$curve,
                patch = scheme$patches$patch)
  level <- c(landmark = "landmarks", curve = "curves", patch = "surface")
  problems <- lapply(names(known), function(what) {
    here <- sides[sides$level == level[[what]], ]
    found <- unknown_names(here$name, known[[what]], "name", what)
    problem(here$row[found$row], here$side[found$row], found$text)
  })
  twice <- sides[duplicated(sides[c("level", "name")]), ]
  problems <- rbind(do.call(rbind, problems), problem(
    twice$row, twice$side, sprintf("\"%s\" has a partner already", twice$name)
  ))
  if (nrow(problems) || !nrow(pairs)) return(problems)
  rbind(unlike_curves(pairs, scheme$curves), unlike_patches(pairs, scheme$patches, scheme$curves))
}

#' Pairs of curves that are no mirror images, and curves without a partner that are not their own
#' @noRd
unlike_curves <- function(pairs, curves) {
  swap <- function(x, level) partner_of(x, pairs, level)
  mirror <- curves
  landmark_columns <- c("from", "to", "cut_from", "cut_to", "keep_away_from", "keep_away_to",
                        "keep_side_from",
                        "keep_side_to", "keep_side_towards")
  for (column in landmark_columns) {
    mirror[[column]] <- swap(curves[[column]], "landmarks")
  }
  mirror$via <- vapply(seq_len(nrow(curves)), function(i) {
    # A cell of `via` with partners in place, in the order of the partner's curve
    cell <- curves$via[i]
    if (is.na(cell)) return(NA_character_)
    stops <- partner_of(via_names(cell), pairs, "landmarks")
    paste(if (mirrored_backwards(curves, pairs)[i]) rev(stops) else stops, collapse = " ")
  }, "")
  mirror$side_of <- swap(curves$side_of, "curves")
  mirror$side <- unname(c(left = "right", right = "left")[curves$side])
  columns <- c("from", "to", "kind", "radius", "width", "n", "cut_share", "keep_away_radius",
               "keep_away_extension",
               "keep_side_towards", "side_of", "side", "trust_from", "trust_to", "angle_limit",
               "path", "via")
  found <- unlike_pairs(pairs, "curves", curves$curve, curves, mirror, columns)
  for (axis in c("cut", "keep_away", "keep_side")) {
    ends <- paste0(axis, c("_from", "_to"))
    found <- rbind(found, unlike_pairs(
      pairs, "curves", curves$curve, unordered(curves, ends), unordered(mirror, ends), axis
    ))
  }
  ends <- c("from", "to")
  unlike <- unordered(curves, ends)[[1]] != unordered(mirror, ends)[[1]]
  alone <- curves$curve[swap(curves$curve, "curves") == curves$curve & unlike]
  rbind(found, problem(rep(NA, length(alone)), "left",
                       sprintf("the curve \"%s\" has no partner, but its ends have", alone)))
}

# The ends of an axis, whichever comes first.
unordered <- function(table, ends) {
  a <- table[[ends[1]]]
  b <- table[[ends[2]]]
  stats::setNames(data.frame(paste(pmin(a, b), pmax(a, b))), sub("_from$", "", ends[1]))
}

unlike_patches <- function(pairs, patches, curves) {
  mirror <- patches
  sides <- c("curve_a", "curve_b", "first_column")
  mirror[sides] <- lapply(patches[sides], mirrored_side, pairs = pairs)
  mirror$outward <- unname(c(columns = "rows", rows = "columns")[patches$outward])
  patches[sides] <- lapply(patches[sides], mirrored_side, pairs = pairs[0, ])
  columns <- c("block", "n", "columns", "rows", "rows_kept", "curve_a", "resample_a", "curve_b",
               "resample_b",
               "first_column", "outward")
  own <- partner_of(patches$patch, pairs, "surface") == patches$patch
  alike <- Reduce(`&`, lapply(sides, function(side) same(patches[[side]], mirror[[side]])))
  alone <- patches$patch[own & !alike]
  turned_loops <- curves$curve[closed_curves(curves) & mirrored_backwards(curves, pairs)]
  # Patches with one of some curves among their bounding curves
  turned <- if (!length(turned_loops)) character() else {
    sides <- c("curve_a", "curve_b", "first_column")
    bounded <- vapply(seq_len(nrow(patches)), function(i) {
      texts <- unlist(patches[i, sides])
      named <- lapply(texts[!is.na(texts)], function(text) curve_parts(text)$curve)
      any(unlist(named) %in% turned_loops)
    }, NA)
    unique(patches$patch[bounded])
  }
  block <- ifelse(is.na(patches$block), "", paste0("|", patches$block))
  rbind(unlike_pairs(pairs, "surface", paste0(patches$patch, block), patches, mirror, columns),
        problem(rep(NA, length(alone)), "left",
                sprintf("the patch \"%s\" has no partner, but its curves have", alone)),
        problem(rep(NA, length(turned)), "left", sprintf(
          paste("the patch \"%s\" is bounded by a closed curve that runs backwards in the mirror",
                "image: give that curve and its partner two `via`, partners in one order"), turned
        )))
}

#' A bounding curve with every curve's partner in its place, written in one way
#' @noRd
mirrored_side <- function(text, pairs) {
  vapply(text, function(x) {
    if (is.na(x)) return(NA_character_)
    parts <- curve_parts(x)
    paste0(partner_of(parts$curve, pairs, "curves"), "[", parts$from, ":", parts$to, "]",
           collapse = "+")
  }, "", USE.NAMES = FALSE)
}

#' Columns in which the right member differs from the mirror image of the left
#'
#' @param name Names of the rows, "patch|block" for blocks.
#' @param table,mirror The rows, and their mirror images.
#' @noRd
unlike_pairs <- function(pairs, level, name, table, mirror, columns) {
  owner <- sub("[|].*", "", name)
  rows <- which(pairs$level == level)
  each <- lapply(rows, function(row) {
    left <- which(owner == pairs$left[row])
    right <- which(owner == pairs$right[row])
    if (length(left) != length(right)) {
      return(problem(row, "right",
                     sprintf("has %d blocks, its partner %d", length(right), length(left))))
    }
    unlike <- Filter(function(column) !all(same(mirror[[column]][left], table[[column]][right])),
                     columns)
    cells <- function(table, rows) vapply(
      unlike, function(column) toString(table[[column]][rows]), ""
    )
    problem(rep(row, length(unlike)), "right", sprintf(
      "is no mirror image: %s is %s, the partner's %s", unlike, cells(table, right),
      cells(mirror, left)
    ))
  })
  do.call(rbind, c(list(problem(integer())), each))
}

same <- function(a, b) ifelse(is.na(a) | is.na(b), is.na(a) & is.na(b), a == b)
