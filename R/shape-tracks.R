# Where the curves of a scheme are expected, learnt from specimens that are measured already.

#' Learn the expected tracks of curves from measured specimens
#'
#' A ridge may compete with another feature that is nearly as strong. Measured specimens show the
#' usual track of a curve. For every ridge and valley of a scheme, `learn_tracks()` takes the median
#' place of its curve at shares of its length, and the spread of the curves across it. Both are
#' written into the scheme. [fit_shape()] with that scheme uses them twice:
#'
#' * as a weak prior on the reference path. The criterion of a plane that is z spreads off the
#'   expected places is multiplied by \eqn{1 / (1 + z^2 / 32)}{1 / (1 + z^2 / 32)} (0.67 at four
#'   spreads). The distance of the closest plane is subtracted first. The tail is that of Student's
#'   distribution with one degree of freedom: a track that does not fit the object gives way to a
#'   clear surface (O'Hagan 1979);
#' * as a flag. [quality()] grades a curve amber if it is more than four spreads off its expected
#'   track at one place (limit `track` of [quality_limits()]). If a quarter of a specimen's curves
#'   are that far off, and at least three, the tracks are of another population, or landmarks are
#'   wrong. [fit_shape()] then measures the curves without tracks, and gives a warning of class
#'   `crestline_foreign_tracks`.
#'
#' Medians and median absolute deviations are taken, so a few wrong curves do no harm. Look at the
#' specimens nevertheless ([quality()]). They should vary like the specimens that you will measure.
#' [face_scheme()] has no tracks, as we have no representative population of scans. A scheme without
#' tracks works as before.
#'
#' @param shapes List of shapes of one scheme, as [fit_shape()] returns them, with their specimens;
#'   or a `shape_batch`.
#' @param fewest Least number of shapes that have a curve; with fewer the curve gets no track (our
#'   choice).
#' @param least Least spread, in radii of the curve's curvature estimate. It avoids flags in a
#'   sample of nearly equal specimens (our choice).
#' @param places Number of places along a curve (our choice).
#' @return The scheme of the shapes, a [curve_scheme()], in its own unit, with the table `tracks`.
#'   [write_scheme()] writes it to a folder.
#' @section Errors: of class `crestline_error`:
#'   * `shapes` has no shapes, or shapes of several schemes;
#'   * a shape has no specimen;
#'   * the scheme lacks typical places (`x`, `y`, `z`) of its landmarks;
#'   * no curve is on at least `fewest` shapes.
#' @template glossary
#' @references O'Hagan A (1979) On outlier rejection phenomena in Bayes inference. *Journal of the
#'   Royal Statistical Society B* 41: 358-367.
#' @seealso [fit_shape()], [quality()], [curve_scheme()] for the table
#' @examples
#' \donttest{
#' faces <- simulate_faces(5, seed = 1)
#' shapes <- lapply(faces$specimens, fit_shape, settings = ridge_settings(error = FALSE))
#' scheme <- learn_tracks(shapes)
#' scheme
#' head(as.data.frame(scheme, "tracks"), 3)
#' }
#' @export
learn_tracks <- function(shapes, fewest = 5, least = 0.1, places = 19) {
  check_given()
  fewest <- check_count(fewest, "fewest", lower = 2)
  places <- check_count(places, "places", lower = 3)
  least <- check_number(least, "least", lower = 0, open = TRUE)
  shapes <- Filter(Negate(is.null), named_shapes(shapes, "shapes"))
  scheme <- learning_scheme(shapes)
  # A closed curve has no distance between its ends to be in units of.
  open <- scheme$curves$kind != "plane" & !closed_curves(scheme$curves)
  curves <- scheme$curves[open & scheme$curves$n > 2, ]
  tracks <- lapply(seq_len(nrow(curves)), function(i) {
    learnt_track(as.list(curves[i, ]), shapes, typical_landmarks(scheme), fewest, least, places)
  })
  tracks <- do.call(rbind, tracks)
  if (is.null(tracks)) {
    crestline_abort(sprintf("no ridge or valley is there on %d of the %s.", fewest,
                            amount(length(shapes), "shape")),
                    "Give more shapes, or a smaller `fewest`.", stage = "learning")
  }
  tables <- Filter(nrow, scheme[setdiff(names(scheme_columns), "tracks")])
  do.call(curve_scheme, c(tables, list(name = scheme$name, tracks = tracks)))
}

#' The one scheme of some shapes, in its own unit
#' @noRd
learning_scheme <- function(shapes) {
  refuse <- function(problem, remedy, id = NULL) {
    crestline_abort(problem, remedy, stage = "learning", id = id)
  }
  schemes <- lapply(shapes, function(shape) {
    scheme_in_unit(shape$scheme, 1 / c(shape$provenance$scheme$unit, 1)[1], NULL)
  })
  scheme <- schemes[[1]]
  for (i in seq_along(shapes)) {
    id <- shapes[[i]]$id
    if (!identical(scheme$points, schemes[[i]]$points)) {
      refuse(sprintf("its scheme %s is not that of the first shape, %s.", schemes[[i]]$name,
                     scheme$name),
             "Give shapes of one scheme.", id)
    }
    if (is.null(shapes[[i]]$specimen)) {
      refuse("the shape does not keep its specimen, whose surface normals are needed.",
             "Give shapes as fit_shape() returns them.", id)
    }
  }
  if (nrow(typical_landmarks(scheme)) < 3) {
    refuse(sprintf("the scheme %s does not have the places of three landmarks.", scheme$name),
           "Fill the columns x, y, z of its table landmarks.")
  }
  scheme
}

#' The track of one curve: rows of the table, NULL where too few shapes have it
#'
#' @param row Row of the curves table, a list.
#' @param typical As of [typical_landmarks()].
#' @param fewest,least,places As in [learn_tracks()].
#' @noRd
learnt_track <- function(row, shapes, typical, fewest, least, places) {
  each <- lapply(shapes, curve_in_frame, row, typical, seq_len(places) / (places + 1))
  each <- Filter(Negate(is.null), each)
  if (length(each) < fewest) return(NULL)
  middle <- function(name) apply(simplify2array(lapply(each, `[[`, name)), 1:2, stats::median)
  xyz <- middle("xyz")
  normal <- middle("normal")
  n <- nrow(xyz)
  across <- cross_rows(normal, xyz[c(2:n, n), ] - xyz[c(1, 1:(n - 1)), ])
  across <- across / row_lengths(across)
  track <- list(xyz = xyz, across = across)
  offsets <- vapply(each, function(one) track_offsets(track, one$line, !is.na(row$cut_share)),
                    numeric(n))
  centre <- apply(offsets, 1, stats::median, na.rm = TRUE)
  shift <- ifelse(is.na(centre), 0, centre)
  spread <- apply(offsets - shift, 1, stats::mad, center = 0, na.rm = TRUE)
  floor <- least * stats::median(vapply(each, function(one) row$radius / one$span, 0))
  data.frame(curve = row$curve, place = seq_len(n), s = seq_len(n) / (n + 1), xyz + shift * across,
             across, pmax(spread, floor, na.rm = TRUE)) |>
    stats::setNames(names(scheme_columns$tracks))
}

#' One shape's curve in the frame of its landmarks, as shares of the distance of its ends
#'
#' @param at Shares of the curve's length.
#' @return List: `line` (all of it, n x 3), `xyz` and `normal` (at the shares), `span` (in the unit
#'   of the scheme); NULL where the shape does not have the curve or the frame.
#' @noRd
curve_in_frame <- function(shape, row, typical, at) {
  path <- shape$paths[[row$curve]]
  frame <- if (!is.null(path)) track_frame(typical, shape$specimen$landmarks, row$from, row$to)
  if (is.null(frame)) return(NULL)
  mesh <- shape$specimen$mesh
  placed <- place_along(mesh, path, range(path$s)[1] + at * diff(range(path$s)))
  into <- function(x) x %*% t(frame$turn)
  in_frame <- function(x) into(sweep(columns_of(x, c("x", "y", "z")), 2, frame$origin)) / frame$span
  list(line = in_frame(path), xyz = in_frame(placed), normal = into(t(path_normals(mesh, placed))),
       span = frame$span * c(shape$provenance$scheme$unit, 1)[1])
}
