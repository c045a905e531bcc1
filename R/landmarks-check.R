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
    refuse_landmarks(sprintf("named twice: %s.", shorten(twice)), "Give every landmark its own name.", id)
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

describe_shape <- function(x) {
  if (is.null(dim(x))) describe_value(x) else sprintf("%s %s", paste(dim(x), collapse = " x "), typeof(x))
}

shorten <- function(x, most = 5) {
  more <- if (length(x) > most) sprintf(" and %d more", length(x) - most)
  paste0(paste(utils::head(x, most), collapse = ", "), more)
}

refuse_landmarks <- function(problem, remedy, id) {
  crestline_abort(problem, remedy, stage = "landmarks", id = id, class = "crestline_landmark_error", call = NULL)
}

#' Check landmarks against their mesh and put them on it
#'
#' @param landmarks k x 3 matrix of as_landmarks().
#' @param mesh A checked mesh.
#' @param id Name of the specimen.
#' @param tolerance Greatest distance from the surface, in the mesh's unit.
#' @param midline Names of landmarks of the midline from top to bottom.
#' @return A list: `landmarks` on the surface, `located` (see surface_points()), `report`.
#' @noRd
check_landmarks <- function(landmarks, mesh, id, tolerance, midline) {
  located <- surface_points(mesh, landmarks)
  away <- sqrt(rowSums((as.matrix(located[c("x", "y", "z")]) - landmarks)^2))
  if (any(away > tolerance, na.rm = TRUE)) refuse_off_surface(landmarks, away, mesh, id, tolerance)
  mirrored <- handedness(landmarks, located, mesh, midline)
  if (mirrored < 0) warn_mirrored(id)
  moved <- sum(away > 1e-6 * mesh_diagonal(mesh), na.rm = TRUE)
  missing <- rownames(landmarks)[is.na(away)]
  landmarks[] <- as.matrix(located[c("x", "y", "z")])
  report <- rbind(
    report_row("landmarks missing", length(missing), paste("kept as missing:", shorten(missing))),
    report_row("landmarks beside the surface", moved, sprintf(
      "put on it, moved by %.2g at most", max(0, away, na.rm = TRUE))),
    report_row("landmarks mirrored", mirrored < 0, "kept; see the warning")
  )
  list(landmarks = landmarks, located = located, report = report)
}

refuse_off_surface <- function(landmarks, away, mesh, id, tolerance) {
  off <- which(away > tolerance)
  off <- off[order(-away[off])]
  fit <- if (2 * length(off) > sum(!is.na(away))) fitting_change(landmarks, mesh, tolerance)
  named <- paste0(rownames(landmarks)[off], " (by ", signif(away[off], 3), ")")
  if (!is.null(fit)) {
    refuse_landmarks(
      sprintf("the landmarks are in another unit or frame than the mesh: off it are %s.", shorten(named)),
      sprintf("They would lie on it %s: change them so.", fit), id
    )
  }
  refuse_landmarks(
    sprintf("off the surface by more than %s: %s.", signif(tolerance, 3), shorten(named)),
    paste0(if (2 * length(named) > nrow(landmarks)) "Do they belong to this scan? If so, place" else "Place",
           " them anew, set them to NA, or, where they are only a little off, give a greater `tolerance`."), id
  )
}

# In words the change of unit or axes after which at least half of the landmarks are on the surface
# (of several, the nearest fit for its size), or NULL. `inch`: 25.4 mm.
fitting_change <- function(landmarks, mesh, tolerance, factors = c(10, 100, 1000, 25.4)) {
  changes <- c(lapply(c(factors, 1 / factors), rep, 3), list(c(-1, -1, 1)))
  words <- c(paste("multiplied by", factors), paste("divided by", factors),
             "with x and y negated (read them with read_landmarks(file, frame = \"RAS\"))")
  given <- landmarks[!is.na(landmarks[, 1]), , drop = FALSE]
  if (nrow(given) < 2) return(NULL)
  misfit <- vapply(changes, function(change) {
    moved <- sweep(given, 2, change, "*")
    away <- sqrt(rowSums((as.matrix(surface_points(mesh, moved)[1:3]) - moved)^2))
    spread <- sqrt(sum(apply(moved, 2, stats::var)))
    if (stats::median(away) <= min(tolerance, spread / 2)) stats::median(away) / spread else Inf
  }, 0)
  if (any(is.finite(misfit))) words[which.min(misfit)]
}

# Positive where (left, up, front) is right-handed, as in life; negative where mirrored; 0 where it
# cannot be told. Left: from names ...R to names ...L; up: along the midline; front: the normals there.
handedness <- function(landmarks, located, mesh, midline) {
  name <- rownames(landmarks)[!is.na(landmarks[, 1])]
  left <- name[grepl("L$", name) & sub("L$", "R", name) %in% name]
  middle <- midline[midline %in% name]
  if (!length(left) || length(middle) < 2) return(0)
  across <- colSums(landmarks[left, , drop = FALSE] - landmarks[sub("L$", "R", left), , drop = FALSE])
  up <- landmarks[middle[1], ] - landmarks[middle[length(middle)], ]
  face <- located$face[match(c(left, sub("L$", "R", left), middle), rownames(landmarks))]
  front <- colSums(t(mesh$normals[1:3, mesh$it[, face]]))
  sides <- cbind(across, up, front)
  sign(det(sweep(sides, 2, pmax(sqrt(colSums(sides^2)), .Machine$double.xmin), "/")))
}

warn_mirrored <- function(id) {
  crestline_warn(
    paste("left and right look mirrored: seen from the front, head up, the landmarks ending in L",
          "should be on the viewer's right (the subject's own left)."),
    paste("Swap the endings L and R of the names, or, if the scan itself is mirrored,",
          "change the sign of x of mesh and landmarks."),
    stage = "landmarks", id = id, class = "crestline_mirrored"
  )
}

mesh_diagonal <- function(mesh) box_diagonal(mesh$vb)
