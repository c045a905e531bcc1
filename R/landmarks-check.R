# Landmarks at the door: named once, on the surface, in its unit, left on the left.

# As a k x 3 numeric matrix with row names, or an error.
as_landmarks <- function(x, id = NULL) {
  if (is.null(x)) return(matrix(0, 0, 3, dimnames = list(character(), c("x", "y", "z"))))
  if (is.data.frame(x)) x <- landmarks_of_table(x)
  if (!is.numeric(x) || !is.matrix(x) || ncol(x) != 3) {
    refuse_landmarks(sprintf("`landmarks` are %s, not a k x 3 numeric matrix.", describe_shape(x)),
                     "Give a matrix with one row a landmark, or a data frame name, x, y, z.", id)
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
  x[rowSums(!is.finite(x)) > 0, ] <- NA
  matrix(as.numeric(x), ncol = 3, dimnames = list(name, c("x", "y", "z")))
}

landmarks_of_table <- function(x) {
  label <- which(tolower(names(x)) %in% c("name", "landmark", "label"))
  xyz <- match(c("x", "y", "z"), tolower(names(x)))
  if (anyNA(xyz)) return(x)
  matrix <- as.matrix(x[xyz])
  rownames(matrix) <- if (length(label)) as.character(x[[label[1]]]) else
    if (is.character(attr(x, "row.names"))) row.names(x)
  matrix
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
#' @return A list: `landmarks` on the surface, `located` (see surface_points()), `report`, `size`,
#'   `slips` (of [exchanged_landmarks()]).
#' @noRd
check_landmarks <- function(landmarks, mesh, id, tolerance, midline, piece = NULL, size = NULL) {
  located <- surface_points(mesh, landmarks)
  if (is.null(size)) size <- carrying_size(mesh, piece, located)
  away <- sqrt(rowSums((as.matrix(located[c("x", "y", "z")]) - landmarks)^2))
  if (any(away > tolerance * size,
          na.rm = TRUE)) refuse_off_surface(landmarks, away, mesh, id, tolerance, size)
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

refuse_off_surface <- function(landmarks, away, mesh, id, tolerance, size) {
  off <- which(away > tolerance * size)
  off <- off[order(-away[off])]
  fit <- if (2 * length(off) > sum(!is.na(away))) fitting_change(landmarks, mesh,
                                                                 tolerance * mesh_size(mesh))
  named <- paste0(rownames(landmarks)[off], " (by ", signif(away[off], 3), ")")
  if (!is.null(fit)) {
    refuse_landmarks(
      sprintf("the landmarks are in another unit or frame than the mesh: off it are %s.",
              shorten(named)),
      sprintf("They would lie on it %s: change them so.", fit), id
    )
  }
  refuse_landmarks(
    sprintf("off the surface by more than %s: %s.", signif(tolerance * size, 3), shorten(named)),
    paste0(if (2 * length(named) > nrow(landmarks)) "Do they belong to this scan? If so, place" else
      "Place", " them anew, set them to NA, or, where they are only a little off, give a greater ",
      "`tolerance`."), id
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
  turns <- axis_turns()
  turned <- vapply(turns, function(turn) det(turn) > 0, NA)
  units <- lapply(c(factors, 1 / factors), diag, 3)
  words <- c(paste("multiplied by", factors), paste("divided by", factors))
  both <- expand.grid(unit = seq_along(units), turn = which(turned))
  kinds <- list(
    list(change = units, words = words),
    list(change = turns[turned], words = turn_words(turns[turned])),
    list(change = turns[!turned], words = turn_words(turns[!turned])),
    list(change = Map(function(i, j) units[[i]] %*% turns[[j]], both$unit, both$turn),
         words = paste(words[both$unit], "and", turn_words(turns)[both$turn]))
  )
  for (kind in kinds) {
    near <- utils::head(order(centre_misfits(kind$change, given, mesh)), tried)
    misfit <- vapply(kind$change[near], surface_misfit, 0, given, mesh, tolerance)
    if (any(is.finite(misfit))) return(kind$words[near[which.min(misfit)]])
  }
}

#' The 47 ways to exchange axes and turn their signs, as matrices for points in rows
#' @noRd
axis_turns <- function() {
  orders <- list(c(1, 2, 3), c(2, 3, 1), c(3, 1, 2), c(1, 3, 2), c(2, 1, 3), c(3, 2, 1))
  signs <- as.matrix(expand.grid(c(1, -1), c(1, -1), c(1, -1)))
  all <- unlist(lapply(orders,
                       function(order) lapply(seq_len(8),
                                              function(i) diag(3)[, order] %*% diag(signs[i, ]))),
                recursive = FALSE)
  all[-1]
}

turn_words <- function(turns) {
  vapply(turns, function(turn) {
    from <- apply(turn != 0, 2, which)
    axes <- paste0(ifelse(turn[cbind(from, 1:3)] < 0, "-", ""), c("x", "y", "z")[from],
                   collapse = ", ")
    if (axes == "-x, -y, z") return(paste("with x and y negated (read them with",
                                          "read_landmarks(file, frame = \"RAS\"))"))
    sprintf("with their axes turned, as (%s)%s", axes,
            if (det(turn) < 0) ": a mirror image" else
              if (grepl("^-?x, -?z", axes)) ": here y, there z points up" else "")
  }, "")
}

#' Median distance from the nearest centre of a triangle after each change, as a share of the spread
#' @noRd
centre_misfits <- function(changes, given, mesh) {
  moved <- lapply(changes, function(change) given %*% change)
  centre <- face_centres(mesh)
  at <- do.call(rbind, moved)
  away <- matrix(row_lengths(at - centre[nearest_centres(centre, at, 1), , drop = FALSE]),
                 nrow(given))
  apply(away, 2, stats::median) / vapply(moved, spread_of, 0)
}

spread_of <- function(xyz) sqrt(sum(apply(xyz, 2, stats::var)))

#' The same from the surface; Inf where that is too much
#' @noRd
surface_misfit <- function(change, given, mesh, tolerance) {
  moved <- given %*% change
  away <- stats::median(row_lengths(as.matrix(surface_points(mesh, moved)[1:3]) - moved))
  spread <- spread_of(moved)
  if (away <= min(tolerance, spread / 2)) away / spread else Inf
}

#' Names that end in L and R, as partners
#' @noRd
side_pairs <- function(names) {
  left <- names[endsWith(names, "L")]
  right <- sub("L$", "R", left)
  data.frame(left = left, right = right)[right %in% names, ]
}
