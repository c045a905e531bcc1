# The points that a scheme defines, and which of them are the same place.

#' Parts of a bounding curve: "upper lip left[1:8]+philtrum lip left[2]"
#'
#' @param text One string.
#' @return Data frame `curve`, `from`, `to` (first and last point), one row a part; `NULL` where the
#'   text cannot be read.
#' @noRd
curve_parts <- function(text) {
  pattern <- "^([^][+|]+)\\[([0-9]{1,6})(:([0-9]{1,6}))?\\]$"
  pieces <- trimws(strsplit(text, "+", fixed = TRUE)[[1]])
  parts <- regmatches(pieces, regexec(pattern, pieces))
  if (!length(parts) || any(lengths(parts) == 0)) return(NULL)
  parts <- do.call(rbind, parts)
  frame_of(list(curve = trimws(parts[, 2]), from = as.integer(parts[, 3]),
                to = as.integer(ifelse(parts[, 5] == "", parts[, 3], parts[, 5]))))
}

#' The points of a bounding curve in order
#' @return Data frame `curve`, `point`.
#' @noRd
side_points <- function(text) {
  parts <- curve_parts(text)
  point <- Map(seq, parts$from, parts$to)
  frame_of(list(curve = rep(parts$curve, lengths(point)), point = unlist(point)))
}

#' Whole numbers written as "1,3:8"
#' @return Integer vector; `NULL` where the text cannot be read.
#' @noRd
number_list <- function(text) {
  parts <- strsplit(trimws(strsplit(text, ",", fixed = TRUE)[[1]]), ":", fixed = TRUE)
  if (!all(lengths(parts) %in% 1:2) || !all(grepl("^[0-9]{1,6}$", unlist(parts)))) return(NULL)
  unlist(lapply(parts, function(ends) do.call(seq, as.list(as.integer(ends[c(1, length(ends))])))))
}

#' The surface points of one row of the patches table: by column, then by row
#'
#' @param block One row of the table.
#' @return Data frame `part`, `point` (the index: block where there are several, column, row where
#'   there are several), `column` (position along the bounding curves), `row`.
#' @noRd
block_points <- function(block) {
  columns <- number_list(block$columns)
  at <- expand.grid(row = number_list(block$rows_kept), column = seq_along(columns))
  index <- if (!is.na(block$block)) {
    paste(block$block, at$column, at$row)
  } else if (block$rows > 1) {
    paste(at$column, at$row)
  } else {
    as.character(at$column)
  }
  frame_of(list(part = rep(block$patch, length(index)), point = index, column = columns[at$column],
                row = at$row))
}

#' Where the points of a block that lie on points of a bounding curve lie
#'
#' @param column Position along the curve.
#' @param text,resample The bounding curve and its number of points if it is resampled (then only
#'   its ends are points of the curves).
#' @return Character: the place (as of [curve_places()]), NA where the point is no point of a curve.
#' @noRd
side_places <- function(column, text, resample, curves) {
  points <- side_points(text)
  count <- nrow(points)
  if (!is.na(resample)) {
    column <- ifelse(column == 1, 1, ifelse(column == resample, count, NA))
  }
  curve_places(points$curve, points$point, curves)[column]
}

#' Name of the place of a curve's point: its landmark at an end that is not cut off, or its own;
#' those of a closed curve are all its own
#' @noRd
curve_places <- function(curve, point, curves) {
  row <- match(curve, curves$curve)
  end <- ifelse(point == 1 & is.na(curves$cut_share[row]), curves$from[row],
                ifelse(point == curves$n[row], curves$to[row], NA))
  end[closed_curves(curves)[row]] <- NA
  ifelse(is.na(end), paste("curves", curve, point, sep = "|"), paste("landmarks", end, sep = "|"))
}

#' How many surface points a scheme loses with curves and landmarks: those on them, and the columns
#' that end on them
#'
#' @param curves,landmarks Names of those that are not there.
#' @noRd
surface_without <- function(scheme, curves, landmarks) {
  gone <- function(place) {
    startsWith(place, "landmarks|") & sub("^landmarks\\|", "", place) %in% landmarks |
      startsWith(place, "curves|") & sub("^curves\\|(.*)\\|[0-9]+$", "\\1", place) %in% curves
  }
  end_gone <- function(column, text, resample) {
    if (is.na(text)) return(rep(FALSE, length(column)))
    place <- side_places(column, text, resample, scheme$curves)
    # A point of a resampled side lies between points of its curves
    ifelse(is.na(place), any(side_points(text)$curve %in% curves), gone(place))
  }
  open <- unlist(lapply(seq_len(nrow(scheme$patches)), function(i) {
    block <- scheme$patches[i, ]
    column <- block_points(block)$column
    end_gone(column, block$curve_a, block$resample_a) |
      end_gone(column, block$curve_b, block$resample_b)
  }))
  plan <- scheme_plan(scheme)
  place <- plan$places[plan$at[scheme$points$level == "surface"]]
  sum(ifelse(startsWith(place, "surface|"), open, gone(place)))
}

#' Every point of a scheme
#'
#' @return Data frame `level`, `part`, `point`, `place`: points of one place have one name of it.
#' @noRd
scheme_points <- function(landmarks, curves, patches) {
  on_curve <- data.frame(
    part = rep(curves$curve, curves$n), point = unlist(lapply(curves$n, seq_len))
  )
  surface <- lapply(seq_len(nrow(patches)), function(i) {
    block <- patches[i, ]
    points <- block_points(block)
    place <- paste("surface", points$part, points$point, sep = "|")
    on_a <- ifelse(points$row == 1,
                   side_places(points$column, block$curve_a, block$resample_a, curves), NA)
    place <- first_not_na(on_a, place)
    if (!is.na(block$curve_b)) {
      on_b <- ifelse(points$row == block$rows,
                     side_places(points$column, block$curve_b, block$resample_b, curves), NA)
      place <- first_not_na(on_b, place)
    }
    if (!is.na(block$first_column)) {
      resample <- if (nrow(side_points(block$first_column)) != block$rows) block$rows else NA
      inside <- points$column == 1 & !points$row %in% c(1, block$rows)
      place[inside] <- first_not_na(side_places(points$row, block$first_column, resample, curves),
                                    place)[inside]
    }
    data.frame(level = "surface", part = points$part, point = points$point, place = place)
  })
  rbind(
    data.frame(level = rep("landmarks", nrow(landmarks)), part = landmarks$landmark,
               point = rep("1", nrow(landmarks)),
               place = paste("landmarks", landmarks$landmark, sep = "|")),
    data.frame(level = rep("curves", nrow(on_curve)), part = on_curve$part,
               point = as.character(on_curve$point),
               place = curve_places(on_curve$part, on_curve$point, curves)),
    do.call(rbind, surface)
  )
}

first_not_na <- function(x, otherwise) ifelse(is.na(x), otherwise, x)

#' A scheme's tables as a fit takes them: nothing in them needs to be read again
#'
#' Made once for each scheme, and known again by the columns that it depends on.
#'
#' @param scheme A scheme, whole.
#' @param most Number of schemes that are remembered.
#' @return List: `order`, rows of the curves table, each after the one whose side it keeps to;
#'   `places`, names of the places; `at`, for every point of the scheme the number of its place;
#'   `blocks`, for every row of the patches table a list of `part`, `rows`, `outward`, `place`,
#'   `column`, `row` (of its points), and `a`, `b`, `first`: its bounding curves as of
#'   [compiled_side()], NULL where it has none.
#' @noRd
scheme_plan <- function(scheme, most = 4) {
  structure <- c("curve", "from", "to", "n", "cut_share", "side_of")
  of <- list(unclass(scheme$curves)[structure], unclass(scheme$patches), scheme$points$place)
  for (known in session_values$plans) if (identical(known$of, of)) return(known)
  curves <- scheme$curves
  places <- unique(scheme$points$place)
  at <- match(scheme$points$place, places)
  surface <- at[scheme$points$level == "surface"]
  last <- cumsum(scheme$patches$n)
  blocks <- lapply(seq_len(nrow(scheme$patches)), function(i) {
    block <- scheme$patches[i, ]
    grid <- block_points(block)
    side <- function(text, resample) if (!is.na(text)) compiled_side(text, resample, curves, places)
    list(part = block$patch, rows = block$rows, outward = block$outward,
         place = surface[last[i] - block$n + seq_len(block$n)], column = grid$column,
         row = grid$row, a = side(block$curve_a, block$resample_a),
         b = side(block$curve_b, block$resample_b), first = side(block$first_column, block$rows))
  })
  plan <- list(of = of, order = fitting_order(curves), places = places, at = at, blocks = blocks)
  session_values$plans <- utils::head(c(list(plan), session_values$plans), most)
  plan
}

#' A bounding curve, read
#'
#' @return List: `curve`, `point`, `place` (number of its place) of its points; `n`, how many points
#'   it is to have.
#' @noRd
compiled_side <- function(text, resample, curves, places) {
  points <- side_points(text)
  list(curve = points$curve, point = points$point,
       place = match(curve_places(points$curve, points$point, curves), places),
       n = if (is.na(resample)) nrow(points) else resample)
}

#' A curve comes after the one whose side it keeps to
#' @noRd
fitting_order <- function(curves) {
  before <- match(curves$side_of, curves$curve)
  depth <- integer(nrow(curves))
  at <- before
  while (!all(is.na(at))) {
    depth <- depth + !is.na(at)
    at <- before[at]
  }
  order(depth)
}
