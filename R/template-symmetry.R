# Left and right of a shape: its relabelled reflection, the symmetric mean of both, and how far the
# two differ.

#' Make a shape symmetric, or measure its asymmetry
#'
#' `symmetrise()` gives the mean of a shape and its reflection with left and right relabelled. The
#' reflection is first superimposed on the shape by Procrustes rotation of all places, without
#' scaling. The mean is exactly symmetric. It is a template for [slide()], not a measurement: its
#' points lie on no mesh. A missing point gets the reflection of its partner.
#'
#' `asymmetry()` measures the distances of the shape's points from this symmetric mean. They are
#' half the distances from the partners' reflections. For one specimen this is the asymmetric
#' component of object symmetry.
#'
#' @param shape A `shape`, as of [fit_shape()] or [slide()]. The table `pairs` of its scheme defines
#'   left and right.
#' @param off_middle Greatest distance of a landmark without a partner from the mid-plane, as a
#'   share of the shape's RMS radius (0.1 is about 6 mm on a face). Such a landmark counts as a
#'   midline landmark, and the symmetric mean has it on the mid-plane. Beyond this distance you get
#'   a warning.
#' @return `symmetrise()`: a `shape` in the pose of the given one. `face`, `w1`, `w2`, `w3` and `se`
#'   are NA, and it has no paths.
#' @section Errors: of class `crestline_error`: the scheme has no pairs, or fewer than three places
#'   have a partner.
#' @section Warnings: of class `crestline_unpaired`: landmarks of no pair lie off the mid-plane; the
#'   warning names them.
#' @template glossary
#' @references Klingenberg, Barluenga and Meyer (2002) Shape analysis of symmetric structures,
#'   *Evolution* 56, 1909-1920.
#' @templateVar where section 4
#' @template paper
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' shape <- fit_shape(face, face_scheme())
#' symmetrise(shape)
#' head(asymmetry(shape))
#' }
#' @export
symmetrise <- function(shape, off_middle = 0.1) {
  check_given()
  check_class(shape, "shape", "shape", "fit_shape()")
  check_class(shape, "shape", "shape", "fit_shape()")
  off_middle <- check_number(off_middle, "off_middle", lower = 0)
  xyz <- places_of(shape)
  mean <- symmetric_mean(xyz, mirror_places(shape$scheme), shape$id)
  # Landmarks without a partner that the symmetric mean moves far: they lie on a side, and are
  # missing in the pairs
  landmark <- shape$scheme$landmarks$landmark
  alone <- landmark[partner_of(landmark, shape$scheme$pairs, "landmarks") == landmark]
  points <- shape$points[shape$points$level == "landmarks", ]
  place <- shape$scheme$points$place[shape$scheme$points$level == "landmarks"][match(
    alone, points$part
  )]
  off <- row_lengths(xyz[place, , drop = FALSE] - mean[place, , drop = FALSE])
  known <- xyz[!is.na(xyz[, 1]), , drop = FALSE]
  radius <- sqrt(mean(rowSums(sweep(known, 2, colMeans(known))^2)))
  far <- which(off > off_middle * radius)
  if (length(far)) {
    said <- paste0(alone[far], " (", signif(off[far], 2), ")")
    crestline_warn(sprintf(paste("%s in no pair, but off the mid-plane: %s; the symmetric mean",
                                 "puts %s on it."),
                           if (length(far) == 1) "a landmark is" else "landmarks are",
                           shorten(said, 6), if (length(far) == 1) "it" else "them"),
                   paste("Add it with its partner to the scheme's `pairs`, or raise `off_middle`",
                         "where the object is that crooked."),
                   stage = "symmetry", id = shape$id, class = "crestline_unpaired")
  }
  template_shape(shape, mean, paste(shape$id, "symmetrised"))
}

#' @rdname symmetrise
#' @param by "part": a row for each part; "point": a row for each point.
#' @return `asymmetry()`: data frame with `level` ("overall", "landmarks", "curves", "surface"),
#'   `part`, `points` (their number; coinciding points count once), `rms` and `largest`. Both are in
#'   the unit of the mesh, and NA if no point has a partner. With `by = "point"`: `level`, `part`,
#'   `point`, `distance` and its components `dx`, `dy`, `dz` along the shape's axes, in the unit of
#'   the mesh.
#' @export
asymmetry <- function(shape, by = c("part", "point"), off_middle = 0.1) {
  check_given()
  check_class(shape, "shape", "shape", "fit_shape()")
  by <- check_choice(by, c("part", "point"), "by")
  off <- as.matrix(shape$points[c("x", "y", "z")]) -
    as.matrix(symmetrise(shape, off_middle)$points[c("x", "y", "z")])
  points <- shape$points[c("level", "part", "point")]
  distance <- sqrt(rowSums(off^2))
  if (by == "point") {
    return(cbind(points, distance = distance, dx = off[, 1], dy = off[, 2], dz = off[, 3]))
  }
  place <- shape$scheme$points$place
  row <- function(level, part, at) {
    d <- distance[at][!duplicated(place[at]) & !is.na(distance[at])]
    data.frame(level = level, part = part, points = length(d),
               rms = if (length(d)) sqrt(mean(d^2)) else NA_real_,
               largest = if (length(d)) max(d) else NA_real_)
  }
  parts <- unique(points[c("level", "part")])
  each <- Map(function(level, part) row(level, part, points$level == level & points$part == part),
              parts$level, parts$part)
  found <- rbind(row("overall", "all", rep(TRUE, length(place))), do.call(rbind, unname(each)))
  rownames(found) <- NULL
  found
}

#' Mean of a configuration and its reflection, partners exchanged; NA where a point and its partner
#' are missing
#'
#' The best orthogonal matrix between a configuration and its own relabelling is symmetric, so the
#' mean is exactly its own reflection.
#'
#' @param by Rows that the reflection is fitted by.
#' @noRd
symmetric_mean <- function(xyz, partner, id, by = rep(TRUE, nrow(xyz))) {
  known <- !is.na(xyz[, 1]) & !is.na(xyz[partner, 1])
  both <- known & by
  if (all(partner == seq_along(partner)) || sum(both) < 3) {
    crestline_abort("too little of it has a left and a right.",
                    "Give the scheme pairs (see `?curve_scheme`), or check what is missing.",
                    stage = "symmetry", id = id, call = NULL)
  }
  centre <- colMeans(xyz[both, , drop = FALSE])
  centred <- sweep(xyz, 2, centre)
  overlap <- crossprod(centred[both, , drop = FALSE], centred[partner[both], , drop = FALSE])
  axes <- eigen((overlap + t(overlap)) / 2, symmetric = TRUE)
  reflection <- axes$vectors %*% (c(1, 1, -1) * t(axes$vectors))
  mirrored <- centred[partner, , drop = FALSE] %*% reflection
  mean <- (centred + mirrored) / 2
  mean[!known, ] <- ifelse(is.na(centred[!known, ]), mirrored[!known, ], centred[!known, ])
  sweep(mean, 2, centre, `+`)
}

#' A shape of positions alone
#'
#' @param shape The shape whose scheme it has.
#' @param xyz Matrix with a row a place (row names).
#' @param se Standard errors of the places.
#' @noRd
template_shape <- function(shape, xyz, id, se = NA_real_) {
  points <- shape$points[c("level", "part", "point")]
  points[mesh_columns] <- NA_real_
  points$face <- NA_integer_
  row <- match(shape$scheme$points$place, rownames(xyz))
  points$se <- rep_len(se, nrow(xyz))[row]
  points[c("x", "y", "z")] <- as.data.frame(xyz[row, ], row.names = FALSE)
  status <- shape$status
  there <- tapply(!is.na(points$x), paste(points$level, points$part), all)
  status$ok <- as.vector(there[paste(status$level, status$part)])
  status$reason <- NA_character_
  measured <- c("length", "strength", "se", "se_max", "competing", "noise_factor")
  status[intersect(measured, names(status))] <- NA_real_
  new_shape(id, points, status, shape$scheme, provenance = shape$provenance)
}

#' Partner of every place of a scheme, in the order of its first appearance
#'
#' @return Integer vector, an involution.
#' @noRd
mirror_places <- function(scheme) {
  points <- scheme$points
  first <- !duplicated(points$place)
  match(points$place[mirror_rows(scheme)[first]], points$place[first])
}

#' The row of a scheme's points that each is mirrored to, of the same level
#' @noRd
mirror_rows <- function(scheme) {
  points <- scheme$points
  own <- partner_of(points$part[points$level == "landmarks"], scheme$pairs, "landmarks")
  # Names of the points that surface points are mirrored to. The partner's block has the same rows;
  # its columns run the other way where its bounding curve does.
  patches <- scheme$patches
  partner <- partner_of(patches$patch, scheme$pairs, "surface")
  key <- function(patch) paste(patch, patches$block, sep = "|")
  mirror_surface_rows <- unlist(lapply(seq_len(nrow(patches)), function(i) {
    other <- patches[match(key(partner)[i], key(patches$patch)), ]
    from <- block_points(patches[i, ])
    to <- block_points(other)
    # Names "curve|point" of the points that a bounding curve's points are mirrored to
    points <- scheme$points[scheme$points$level == "curves", ]
    own <- side_points(patches$curve_a[i])
    mirrored <- mirror_curve_rows(scheme)[match(
      paste(own$curve, own$point), paste(points$part, points$point)
    )]
    mirrored <- sub("^curves[|]", "", mirrored)
    own <- do.call(paste, c(side_points(other$curve_a), sep = "|"))
    last <- if (is.na(other$resample_a)) length(own) else other$resample_a
    column <- if (identical(mirrored, own)) from$column else last + 1 - from$column
    paste("surface", other$patch,
          to$point[match(paste(column, from$row), paste(to$column, to$row))], sep = "|")
  }))
  mirrored <- c(paste("landmarks", own, "1", sep = "|"), mirror_curve_rows(scheme),
                mirror_surface_rows)
  match(mirrored, paste(points$level, points$part, points$point, sep = "|"))
}

#' Names of the points that curve points are mirrored to: a curve whose ends are exchanged runs
#' backwards
#' @noRd
mirror_curve_rows <- function(scheme) {
  curves <- scheme$curves
  partner <- partner_of(curves$curve, scheme$pairs, "curves")
  backwards <- mirrored_backwards(curves, scheme$pairs)
  closed <- closed_curves(curves)
  unlist(lapply(seq_len(nrow(curves)), function(i) {
    point <- mirrored_points(curves$n[i], backwards[i], closed[i])
    paste("curves", partner[i], point, sep = "|")
  }))
}
