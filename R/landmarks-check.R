# Landmarks at the door: named once, on the surface, in its unit, left on the left.

# As a k x 3 numeric matrix with row names, or an error.
as_landmarks <- function(x, id = NULL) {
  if (is.null(x)) return(matrix(0, 0, 3, dimnames = list(character(), c("x", "y", "z"))))
  if (is.data.frame(x)) {
    label <- which(tolower(names(x)) %in% c("name", "landmark", "label"))
    xyz <- match(c("x", "y", "z"), tolower(names(x)))
    x <- if (anyNA(xyz)) x else {
      matrix <- as.matrix(x[xyz])
      rownames(matrix) <- if (length(label)) as.character(x[[label[1]]]) else
        if (is.character(attr(x, "row.names"))) row.names(x)
      matrix
    }
  }
  if (!is.numeric(x) || !is.matrix(x) || ncol(x) != 3) {
    refuse_landmarks(sprintf("`landmarks` are %s, not a k x 3 numeric matrix.", describe_shape(x)),
                     matrix_words(x), id)
  }
  name <- rownames(x)
  if (nrow(x) && (is.null(name) || anyNA(name) || any(!nzchar(name)))) {
    nameless <- if (is.null(name)) seq_len(nrow(x)) else which(is.na(name) | !nzchar(name))
    refuse_landmarks(sprintf("landmarks without a name: row %s.", shorten(nameless)),
                     "Name every row: rownames(landmarks) <- c(...).", id)
  }
  twice <- unique(name[duplicated(name)])
  if (length(twice)) {
    refuse_landmarks(sprintf("named twice: %s.", shorten(twice)),
                     "Give every landmark its own name.", id)
  }
  warn_partial_rows(x, id)
  x[rowSums(!is.finite(x)) > 0, ] <- NA
  matrix(as.numeric(x), ncol = 3, dimnames = list(name, c("x", "y", "z")))
}

#' What to give in place of what is no matrix of numbers
#' @noRd
matrix_words <- function(x) {
  if (length(dim(x)) == 3 && dim(x)[3] == 1) {
    return("Give the matrix of the one specimen: landmarks[, , 1].")
  }
  text <- if (is.data.frame(x)) any(vapply(x, is.character, NA)) else
    is.matrix(x) && is.character(x)
  paste0(if (text) "The co-ordinates are text: make them numbers, as by as.numeric(). ",
         "Give a matrix with one row a landmark, or a data frame name, x, y, z.")
}

#' Warn of landmarks of which only some co-ordinates are there
#' @noRd
warn_partial_rows <- function(given, id) {
  gone <- !is.finite(given)
  part <- which(rowSums(gone) %in% 1:2)
  if (!length(part)) return(invisible())
  axes <- vapply(part, function(i) paste(c("x", "y", "z")[gone[i, ]], collapse = " and "), "")
  crestline_warn(sprintf("landmarks without some co-ordinate are taken as missing: %s.",
                         shorten(sprintf("%s (no %s)", rownames(given)[part], axes))),
                 "Look at their source, and give all three numbers.", stage = "landmarks",
                 id = id, class = "crestline_partial_landmarks")
}

#' Warn of several landmarks at one place
#' @noRd
warn_same_place <- function(landmarks, id) {
  at <- landmarks[!is.na(landmarks[, 1]), , drop = FALSE]
  place <- row_text(at)
  first <- match(place, place)
  same <- which(first != seq_along(first))
  if (!length(same)) return(invisible())
  name <- rownames(at)
  crestline_warn(sprintf("landmarks at one place: %s.",
                         shorten(paste(name[first[same]], "and", name[same]))),
                 "Look whether one of them was placed twice.", stage = "landmarks", id = id,
                 class = "crestline_same_place")
}

refuse_landmarks <- function(problem, remedy, id) {
  crestline_abort(problem, remedy, stage = "landmarks", id = id, class = "crestline_landmark_error",
                  call = NULL)
}

#' Check landmarks against their mesh and put them on it
#'
#' @param landmarks k x 3 matrix of as_landmarks().
#' @param mesh A checked mesh.
#' @param id Name of the specimen.
#' @param tolerance Greatest distance from the surface, as a share of the size.
#' @param midline Names of landmarks of the midline from top to bottom.
#' @param piece Number of the piece of every triangle.
#' @param size Of [mesh_size()]; NULL: that of the pieces that carry the landmarks.
#' @param located Places of the landmarks on the mesh, where they are known.
#' @return A list: `landmarks` on the surface, `located` (see surface_points()), `report`, `size`,
#'   `slips` (of [exchanged_landmarks()]).
#' @noRd
check_landmarks <- function(landmarks, mesh, id, tolerance, midline, piece = NULL, size = NULL,
                            located = NULL) {
  if (is.null(located)) located <- surface_points(mesh, landmarks)
  if (is.null(size)) {
    # Size of the pieces of a mesh that carry its landmarks; of all where none does
    on <- unique(piece[located$face[!is.na(located$face)]])
    size <- mesh_size(mesh, if (length(on)) piece %in% on, columns_of(located, c("x", "y", "z")))
  }
  away <- row_lengths(as.matrix(located[c("x", "y", "z")]) - landmarks)
  if (any(away > tolerance * size,
          na.rm = TRUE)) refuse_off_surface(landmarks, away, mesh, id, tolerance, size)
  warn_far_landmarks(stats::setNames(away, rownames(landmarks)), size, tolerance, id)
  slips <- slips_by_name(landmarks, located, mesh, midline)
  warn_exchanged(slips, id)
  moved <- sum(away > 1e-6 * size, na.rm = TRUE)
  missing <- rownames(landmarks)[is.na(away)]
  landmarks[] <- as.matrix(located[c("x", "y", "z")])
  report <- rbind(
    report_row("landmarks missing", length(missing), paste("kept as missing:", shorten(missing))),
    report_row("landmarks beside the surface", moved, sprintf(
      "put on it, moved by %.2g at most", max(0, away, na.rm = TRUE))),
    report_row("landmarks mirrored", slips$mirrored, "kept; see the warning")
  )
  list(landmarks = landmarks, located = located, report = report, size = size, slips = slips)
}

#' What looks exchanged by names alone: sides by the endings L and R, the mid-line by its names
#' @noRd
slips_by_name <- function(landmarks, located, mesh, midline) {
  pairs <- side_pairs(as.character(rownames(landmarks)[!is.na(landmarks[, 1])]))
  row <- match(c(pairs$left, pairs$right, midline), rownames(landmarks), nomatch = 0)
  exchanged_landmarks(landmarks, mean_front(mesh, located[row, ]), pairs, midline)
}

#' @param little Share of the size up to which a landmark is only a little off its surface.
#' @noRd
refuse_off_surface <- function(landmarks, away, mesh, id, tolerance, size, little = 0.03) {
  off <- which(away > tolerance * size)
  off <- off[order(-away[off])]
  fit <- if (2 * length(off) > sum(!is.na(away))) {
    fitting_change(landmarks, mesh, tolerance * mesh_size(mesh))
  }
  named <- paste0(rownames(landmarks)[off], " (by ", signif(away[off], 3), ")")
  if (!is.null(fit)) {
    refuse_landmarks(
      sprintf("the landmarks are in another unit or frame than the mesh: off it are %s.",
              shorten(named)),
      sprintf("They would lie on it %s: change them so.", fit), id
    )
  }
  needed <- signif(max(away[off]) / size * 1.05, 2)
  refuse_landmarks(
    sprintf("off the surface by more than %s, %s of its size (`tolerance`): %s.",
            signif(tolerance * size, 3), format(signif(tolerance, 3)), shorten(named)),
    paste0(if (2 * length(named) > nrow(landmarks)) "Do they belong to this scan? If so, place" else
             "Place",
           " them anew, or set them to NA",
           if (needed <= little) sprintf("; if that is right, give `tolerance = %g`", needed),
           "."), id
  )
}

#' Warn of landmarks that a great tolerance let pass, and that now are elsewhere
#' @param usual Share of the size up to which nothing is said.
#' @noRd
warn_far_landmarks <- function(away, size, tolerance, id, usual = 0.01) {
  far <- which(away > usual * size)
  if (!length(far)) return(invisible())
  far <- far[order(-away[far])]
  crestline_warn(
    sprintf("moved onto the surface by more than %s of its size, as `tolerance` is %s: %s.", usual,
            format(signif(tolerance, 3)),
            shorten(sprintf("%s (by %.3g)", names(away)[far], away[far]))),
    "Look at them with plot(specimen); place them anew if they are wrong.", stage = "landmarks",
    id = id, class = "crestline_far_landmarks"
  )
}

#' In words the change of unit or axes after which at least half of the landmarks are on the surface
#'
#' Units first, then axes turned, then mirrored, then both; of several of a kind the nearest for its
#' size.
#' @param tolerance Greatest distance from the surface.
#' @param factors Of units; inch: 25.4 mm.
#' @param tried How many changes of a kind are looked at closely: those that come nearest to the
#'   triangles' centres.
#' @return NULL where there is none.
#' @noRd
fitting_change <- function(landmarks, mesh, tolerance, factors = c(10, 100, 1000, 25.4),
                           tried = 6) {
  given <- landmarks[!is.na(landmarks[, 1]), , drop = FALSE]
  if (nrow(given) < 2) return(NULL)
  for (kind in frame_changes(factors)) {
    # Median distance from the nearest centre of a triangle after each change, as a share of the
    # spread
    moved <- lapply(kind$change, function(change) given %*% change)
    centre <- Reduce(`+`, face_corners(mesh)) / 3
    at <- do.call(rbind, moved)
    away <- matrix(row_lengths(at - centre[nearest_centres(centre, at, 1), , drop = FALSE]),
                   nrow(given))
    near <- utils::head(order(apply(away, 2, stats::median) / vapply(moved, spread_of, 0)), tried)
    # The same from the surface; Inf where that is too much.
    misfit <- vapply(kind$change[near], function(change) {
      moved <- given %*% change
      away <- stats::median(row_lengths(as.matrix(surface_points(mesh, moved)[1:3]) - moved))
      spread <- spread_of(moved)
      if (away <= min(tolerance, spread / 2)) away / spread else Inf
    }, 0)
    if (any(is.finite(misfit))) return(kind$words[near[which.min(misfit)]])
  }
}

#' Changes of frame that landmarks may need, by kind, with words for each
#' @return List of lists: `change` (3 x 3 matrices for points in rows), `words`.
#' @noRd
frame_changes <- function(factors) {
  # The 47 ways to exchange axes and turn their signs, as matrices for points in rows
  orders <- list(c(1, 2, 3), c(2, 3, 1), c(3, 1, 2), c(1, 3, 2), c(2, 1, 3), c(3, 2, 1))
  signs <- as.matrix(expand.grid(c(1, -1), c(1, -1), c(1, -1)))
  all <- unlist(lapply(orders, function(order) lapply(
                  seq_len(8), function(i) diag(3)[, order] %*% diag(signs[i, ])
                )),
                recursive = FALSE)
  turns <- all[-1]
  turned <- vapply(turns, function(turn) det(turn) > 0, NA)
  units <- lapply(c(factors, 1 / factors), diag, 3)
  words <- c(paste("multiplied by", factors), paste("divided by", factors))
  both <- expand.grid(unit = seq_along(units), turn = which(turned))
  list(
    list(change = units, words = words),
    list(change = turns[turned], words = turn_words(turns[turned])),
    list(change = turns[!turned], words = turn_words(turns[!turned])),
    list(change = Map(function(i, j) units[[i]] %*% turns[[j]], both$unit, both$turn),
         words = paste(words[both$unit], "and", turn_words(turns)[both$turn]))
  )
}

turn_words <- function(turns) {
  vapply(turns, function(turn) {
    from <- apply(turn != 0, 2, which)
    axes <- paste0(ifelse(turn[cbind(from, 1:3)] < 0, "-", ""), c("x", "y", "z")[from],
                   collapse = ", ")
    if (axes == "-x, -y, z") {
      return("with x and y negated (read them with read_landmarks(file, frame = \"RAS\"))")
    }
    what <- if (det(turn) < 0) ": a mirror image" else
      if (grepl("^-?x, -?z", axes)) ": here y, there z points up" else ""
    sprintf("with their axes turned, as (%s)%s", axes, what)
  }, "")
}

spread_of <- function(xyz) sqrt(sum(apply(xyz, 2, stats::var)))

# Side of names that end in L or R: "left", "right", "" of others.
name_side <- function(names) {
  ifelse(endsWith(names, "L"), "left", ifelse(endsWith(names, "R"), "right", ""))
}

is_sided <- function(names) nzchar(name_side(names))

#' Names that end in L and R, as partners
#' @noRd
side_pairs <- function(names) {
  left <- names[name_side(names) == "left"]
  right <- sub("L$", "R", left)
  data.frame(left = left, right = right)[right %in% names, ]
}

#' The report of a specimen whose missing landmarks are others now
#'
#' @param landmarks k x 3, NA where one is missing.
#' @noRd
report_of_missing <- function(report, landmarks) {
  row <- which(report$check == "landmarks missing")
  missing <- rownames(landmarks)[is.na(landmarks[, 1])]
  if (length(row) != 1 || report$count[row] == length(missing)) return(report)
  report[row, ] <- report_row("landmarks missing", length(missing),
                              paste("kept as missing:", shorten(missing)))
  report
}
