# The patches between curves: columns of points on plane cuts from one bounding curve to another.

#' Fit the patches of a scheme
#'
#' @param scan As of [prepare_scan()]; of its fields those of [walkable()], `faces` and `column`.
#'   After sliding, `column$follow` says whether bounding curves of another number of points take
#'   them from their own points' places, slid ones, in place of equal chords.
#' @param scheme As in [fit_shape()].
#' @param fits Curves as of [fit_scheme_curves()].
#' @param store Places found so far, a matrix with row names, see [place_store()].
#' @param tick Called after every block.
#' @return List: `store`, with the places of the patches; `problems`, for each row of the patches
#'   table a list of `missing` and `n` (numbers of points) and `why` (character).
#' @noRd
fit_scheme_patches <- function(scan, scheme, fits, store, tick) {
  points <- scheme$points[scheme$points$level == "surface", ]
  block_of <- rep(seq_len(nrow(scheme$patches)), scheme$patches$n)
  problems <- vector("list", nrow(scheme$patches))
  for (i in seq_len(nrow(scheme$patches))) {
    block <- scheme$patches[i, ]
    grid <- block_points(block)
    grid$place <- points$place[block_of == i]
    fit <- fit_block(block, grid, scan, scheme$curves, fits, store)
    store <- fit$store
    lost <- grid$place[which(store[grid$place, "face"] > scan$faces)]
    store[lost, ] <- NA
    why <- c(fit$why, if (length(lost)) sprintf("%d in a hole of the mesh", length(lost)))
    problems[[i]] <- list(missing = sum(is.na(store[grid$place, "x"])), n = nrow(grid), why = why)
    tick()
  }
  list(store = store, problems = problems)
}

#' One block: its sides, its first column, and the cuts of the columns with points that are not
#' there yet
#' @noRd
fit_block <- function(block, grid, scan, curves, fits, store) {
  side <- function(text, resample) block_side(text, resample, scan, curves, fits, store)
  a <- side(block$curve_a, block$resample_a)
  b <- if (!is.na(block$curve_b)) side(block$curve_b, block$resample_b)
  store <- fill_store(store, grid$place[grid$row == 1],
                      a$points[grid$column[grid$row == 1], , drop = FALSE])
  why <- a$problem
  if (!is.null(b)) {
    last <- grid$row == block$rows
    store <- fill_store(store, grid$place[last], b$points[grid$column[last], , drop = FALSE])
    why <- c(why, b$problem)
  }
  if (!is.na(block$first_column)) {
    first <- side(block$first_column, block$rows)
    inside <- grid$column == 1
    store <- fill_store(store, grid$place[inside], first$points[grid$row[inside], , drop = FALSE])
    why <- c(why, first$problem)
  }
  open <- grid[is.na(store[grid$place, "x"]) & grid$row > 1 & grid$row < block$rows, ]
  whole <- which(!is.na(a$points[, "x"]) & !is.na(b$points[, "x"]))
  at <- intersect(open$column, whole)
  if (!length(at)) return(list(store = store, why = why))
  outside <- vapply(at, function(i) column_outside(a$points, b$points, i, block$outward),
                    numeric(3))
  cuts <- fit_columns(a$points[at, , drop = FALSE], b$points[at, , drop = FALSE], outside,
                      block$rows, scan)
  failed <- !is.na(cuts$problem)
  rows <- open[open$column %in% at[!failed], ]
  values <- do.call(rbind,
                    cuts$points)[(match(rows$column, at[!failed]) - 1) * block$rows + rows$row, ,
                                 drop = FALSE]
  store <- fill_store(store, rows$place, values)
  list(store = store, why = c(why,
                              if (any(failed)) paste0("column ", at[failed], ": ",
                                                      cuts$problem[failed])))
}

#' Why a patch, of one or more blocks, has points missing; NA where it has none
#'
#' @param most Number of reasons that are written out.
#' @noRd
patch_reason <- function(problems, most = 3) {
  total <- function(name) sum(vapply(problems, `[[`, 0L, name))
  if (total("missing") == 0) return(NA_character_)
  why <- unique(unlist(lapply(problems, `[[`, "why")))
  more <- if (length(why) > most) sprintf("and %d more", length(why) - most)
  paste0(total("missing"), " of ", total("n"), " points missing: ",
         paste(c(utils::head(why, most), more), collapse = "; "))
}

#' Points of one bounding curve: its own, or spaced at equal chords
#'
#' @return List: `points` (K x 7 matrix, rows of NA where missing), `problem` (NULL or what is
#'   missing).
#' @noRd
block_side <- function(text, resample, scan, curves, fits, store) {
  knots <- side_points(text)
  points <- store[curve_places(knots$curve, knots$point, curves), mesh_columns, drop = FALSE]
  lost <- is.na(points[, "x"])
  problem <- if (any(lost)) lost_points(knots, lost, fits)
  if (is.na(resample) || resample == nrow(knots)) return(list(points = points, problem = problem))
  spaced <- matrix(NA_real_, resample, length(mesh_columns), dimnames = list(NULL, mesh_columns))
  if (any(lost)) return(list(points = spaced, problem = problem))
  if (isTRUE(scan$column$follow) && length(unique(knots$curve)) == 1) {
    placed <- follow_points(knots$point, fits[[knots$curve[1]]], resample, scan)
  } else {
    path <- side_path(knots, points, scan, fits)
    if (failed(path)) return(list(points = spaced, problem = path$problem))
    placed <- resample_path(scan, path, resample)
  }
  spaced[] <- columns_of(placed)
  spaced[c(1, resample), ] <- points[c(1, nrow(points)), ]
  list(points = spaced, problem = NULL)
}

#' What is missing of the curves of a side, in words
#' @noRd
lost_points <- function(knots, lost, fits) {
  vapply(unique(knots$curve[lost]), function(curve) {
    gone <- lost[knots$curve == curve]
    if (is.null(fits[[curve]]$points)) paste(curve, "is missing") else
      sprintf("%d of %d points of %s are missing", sum(gone), length(gone), curve)
  }, "", USE.NAMES = FALSE)
}

#' Places along a curve at even shares of the way from point to point, so that they go along when
#' those slide
#' @noRd
follow_points <- function(point, fit, n, mesh) {
  s <- stats::approx(seq_along(point), fit$points$s[point], seq(1, length(point), length.out = n))$y
  place_along(mesh, fit$path, s)
}

#' The path along a bounding curve: parts of the curves, joined by cuts where they do not meet
#' @noRd
side_path <- function(knots, points, scan, fits) {
  run <- cumsum(c(TRUE, knots$curve[-1] != knots$curve[-nrow(knots)]))
  pieces <- list()
  for (r in unique(run)) {
    at <- which(run == r)
    before <- at[1] - 1
    if (before > 0 && any(points[before, 1:3] != points[at[1], 1:3])) {
      joint <- cut_between(points[before, ], points[at[1], ], scan)
      if (failed(joint)) return(joint)
      pieces <- c(pieces, list(joint))
    }
    if (length(at) > 1) {
      fit <- fits[[knots$curve[at[1]]]]
      s <- fit$points$s[knots$point[range(at)]]
      if (at[1] > at[length(at)]) s <- rev(s)
      pieces <- c(pieces, list(part_of_path(scan, fit$path, s[1], s[2])))
    }
  }
  path_through(do.call(rbind, lapply(pieces, columns_of)), scan)
}

#' Direction out of a patch at one of its columns, by the order of its corners
#'
#' @param a,b Points of both sides.
#' @param at The column.
#' @return Vector of 3; NA where the scheme does not say, or no neighbour tells the direction along
#'   the sides.
#' @noRd
column_outside <- function(a, b, at, outward) {
  near <- intersect(at + -1:1, which(!is.na(a[, "x"]) & !is.na(b[, "x"])))
  if (is.na(outward) || length(near) < 2) return(rep(NA_real_, 3))
  step <- function(x) x[max(near), 1:3] - x[min(near), 1:3]
  out <- cross_product(step(a) + step(b), b[at, 1:3] - a[at, 1:3])
  if (all(out == 0)) return(rep(NA_real_, 3))
  unname(if (outward == "columns") out else -out)
}

#' Columns: the shortest cut between two places of each, divided at equal chords
#'
#' @param from,to k x 7 matrices, a row a column.
#' @param outside 3 x k: direction out of the surface, NA where it is not known.
#' @param rows Points of a column, the ends among them.
#' @param inside As in [path_ends()].
#' @param rim Angle in radians between the normals at the ends and the outside above which the ends
#'   lie on a sharp rim.
#' @return List: `points` (list of rows x 7 matrices), `cuts` (list of matrices s, x, y, z, face:
#'   what the points lie on), `problem` (NA where the column is there).
#' @noRd
fit_columns <- function(from, to, outside, rows, scan, inside = 1e-6, rim = pi / 4) {
  at <- c("face", "w1", "w2", "w3")
  same <- rowSums((from[, 1:3, drop = FALSE] - to[, 1:3, drop = FALSE])^2) == 0
  apart <- scan$piece[from[, "face"]] != scan$piece[to[, "face"]]
  found <- cpp_fit_columns(scan$vb, scan$it, scan$twin, from[, at, drop = FALSE],
                           to[, at, drop = FALSE],
                           outside, rep(rows, nrow(from)),
                           c(scan$column, inside = inside, rim = rim),
                           chord_settings())
  why <- unname(column_problems[found$end])
  why[apart] <- "its ends lie on different pieces of the mesh"
  why[same] <- "its ends are the same point"
  list(points = lapply(found$points, `colnames<-`, mesh_columns), cuts = found$cuts, problem = why)
}

column_problems <- c(
  arrived = NA, border = "the plane cut meets a border of the mesh",
  round = "the plane cut does not come to the second point",
  "too far" = "the plane cut strays too far from the axis",
  "no axis" = "its ends are too near to each other"
)

cut_between <- function(from, to, scan) {
  ends <- path_ends(scan, rbind(from[mesh_columns], to[mesh_columns]),
                    c(end_name(from), end_name(to)))
  column <- scan$column
  limited_cut(scan, ends, column$angle, column$angles, column$reach)
}

#' Fill those of the places that are still empty
#' @noRd
fill_store <- function(store, place, values) {
  empty <- is.na(store[place, "x"])
  store[place[empty], colnames(values)] <- values[empty, ]
  store
}
