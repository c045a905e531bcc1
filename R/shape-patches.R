# The patches between curves: columns of points on plane cuts from one bounding curve to another.

#' Fit the patches of a scheme
#'
#' @param scan As of [prepare_scan()]; of its fields those of [walkable()], `scheme`, `faces` and
#'   `column`.
#'   After sliding, `column$follow` says whether bounding curves of another number of points take
#'   them from their own points' places, slid ones, in place of equal chords.
#' @param fits Curves as of [fit_scheme_curves()].
#' @param store Places found so far, a matrix with row names, see [place_store()].
#' @param tick Called after every block.
#' @return List: `store`, with the places of the patches; `problems`, for each row of the patches
#'   table a list of `missing` and `n` (numbers of points) and `why` (character).
#' @noRd
fit_scheme_patches <- function(scan, fits, store, tick) {
  problems <- lapply(scheme_plan(scan$scheme)$blocks, function(block) {
    fit <- fit_block(block, list(scan = scan, fits = fits, store = store))
    lost <- block$place[which(fit$store[block$place, "face"] > scan$faces)]
    store <<- fit$store
    store[lost, ] <<- NA
    tick()
    list(missing = sum(is.na(store[block$place, "x"])), n = length(block$place),
         why = c(fit$why, if (length(lost)) sprintf("%d in a hole of the mesh", length(lost))))
  })
  list(store = store, problems = problems)
}

#' One block: its sides, its first column, and the cuts of the columns with points that are not
#' there yet
#'
#' @param block As of [scheme_plan()].
#' @param ground What it is laid on: list of `scan`, `fits` and `store`.
#' @return List: `store`, `why`.
#' @noRd
fit_block <- function(block, ground) {
  store <- ground$store
  sides <- lapply(block[c("a", "b", "first")], function(side) {
    if (!is.null(side)) side_points_on(side, side$n, ground)
  })
  a <- sides$a$points
  b <- sides$b$points
  fill <- function(some, points, at) {
    store <<- fill_store(store, block$place[some], points[at[some], , drop = FALSE])
  }
  fill(block$row == 1, a, block$column)
  if (!is.null(b)) fill(block$row == block$rows, b, block$column)
  if (!is.null(sides$first)) fill(block$column == 1, sides$first$points, block$row)
  why <- unlist(lapply(sides, `[[`, "problem"), use.names = FALSE)
  open <- is.na(store[block$place, "x"]) & block$row > 1 & block$row < block$rows
  at <- intersect(block$column[open], which(!is.na(a[, "x"]) & !is.na(b[, "x"])))
  if (!length(at)) return(list(store = store, why = why))
  outside <- vapply(at, function(i) column_outside(a, b, i, block$outward), numeric(3))
  cuts <- fit_columns(a[at, , drop = FALSE], b[at, , drop = FALSE], outside, block$rows,
                      ground$scan)
  bad <- !is.na(cuts$problem)
  open <- which(open & block$column %in% at[!bad])
  row <- (match(block$column[open], at[!bad]) - 1) * block$rows + block$row[open]
  store <- fill_store(store, block$place[open], do.call(rbind, cuts$points)[row, , drop = FALSE])
  if (any(bad)) why <- c(why, paste0("column ", at[bad], ": ", cuts$problem[bad]))
  list(store = store, why = why)
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
#' @param side As of [compiled_side()].
#' @param n How many points.
#' @param ground As in [fit_block()].
#' @return List: `points` (n x 7 matrix, rows of NA where missing), `problem` (NULL or what is
#'   missing).
#' @noRd
side_points_on <- function(side, n, ground) {
  scan <- ground$scan
  points <- ground$store[side$place, mesh_columns, drop = FALSE]
  lost <- is.na(points[, "x"])
  problem <- if (any(lost)) {
    vapply(unique(side$curve[lost]), function(curve) {
      gone <- lost[side$curve == curve]
      if (is.null(ground$fits[[curve]]$points)) paste(curve, "is missing") else
        sprintf("%d of %d points of %s are missing", sum(gone), length(gone), curve)
    }, "", USE.NAMES = FALSE)
  }
  if (n == length(side$place)) return(list(points = points, problem = problem))
  spaced <- matrix(NA_real_, n, length(mesh_columns), dimnames = list(NULL, mesh_columns))
  if (any(lost)) return(list(points = spaced, problem = problem))
  if (isTRUE(scan$column$follow) && length(unique(side$curve)) == 1) {
    # At even shares of the way from point to point, so that they go along when those slide.
    fit <- ground$fits[[side$curve[1]]]
    s <- stats::approx(seq_along(side$point), run_lengths(fit, side$point),
                       seq(1, length(side$point), length.out = n))$y
    placed <- place_along(scan, fit$path, within_path(fit$path, s))
  } else {
    path <- side_path(side, points, ground)
    if (failed(path)) return(list(points = spaced, problem = path$problem))
    placed <- resample_path(scan, path, n)
  }
  spaced[] <- columns_of(placed)
  spaced[c(1, n), ] <- points[c(1, nrow(points)), ]
  list(points = spaced, problem = NULL)
}

#' The path along a bounding curve: parts of the curves, joined by cuts where they do not meet
#' @noRd
side_path <- function(side, points, ground) {
  scan <- ground$scan
  run <- cumsum(c(TRUE, side$curve[-1] != side$curve[-length(side$curve)]))
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
      fit <- ground$fits[[side$curve[at[1]]]]
      s <- run_lengths(fit, side$point[at])[c(1, length(at))]
      pieces <- c(pieces, list(part_of_path(scan, fit$path, s[1], s[2])))
    }
  }
  path_through(do.call(rbind, lapply(pieces, columns_of)), scan)
}

#' Arc lengths of points of a curve in their order; of a closed one they go on past its seam
#'
#' @param fit Record of the curve.
#' @param point Numbers of the points.
#' @noRd
run_lengths <- function(fit, point) {
  s <- fit$points$s[point]
  if (!is_closed(fit$path)) return(s)
  step <- diff(point)
  n <- nrow(fit$points)
  across <- c(0, ifelse(step == 1 - n, 1, ifelse(step == n - 1, -1, 0)))
  s + attr(fit$path, "length") * cumsum(across)
}

#' Direction out of a patch at one of its columns, by the order of its corners
#'
#' @param a,b Points of both sides.
#' @param at The column.
#' @return Vector of 3; NA if the scheme has no `outward`, or no neighbour gives the direction along
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
  found <- cpp_fit_columns(
    scan$vb, scan$it, scan$twin, from[, at, drop = FALSE], to[, at, drop = FALSE], outside,
    rep(rows, nrow(from)), c(scan$column, inside = inside, rim = rim), chord_settings()
  )
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
  limited_cut(ends, column$angle, column$angles, column$reach)
}

#' Fill those of the places that are still empty
#' @noRd
fill_store <- function(store, place, values) {
  empty <- is.na(store[place, "x"])
  store[place[empty], colnames(values)] <- values[empty, ]
  store
}
