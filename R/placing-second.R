# What another finder says of the same landmarks.

#' A second opinion on found landmarks
#'
#' Compares the landmarks of [find_landmarks()] with those of another finder. Where the two differ,
#' the landmark's confidence falls. Then `print()` names the landmark, and [quality()] grades it,
#' and the curves that end there, amber. No landmark is moved. If the two agree, the confidence does
#' not rise: two finders can make the same mistake.
#'
#' @section MediaPipe: The face landmarks of Google's MediaPipe are a matrix of 468 or 478 points.
#'   Its rows need no names, and are numbered from 0 as MediaPipe does. Give the points in the frame
#'   and unit of the scan, for example as the places on the scan that their pixels show. The table
#'   `mediapipe.csv` in `system.file("extdata", package = "crestline")` has the landmark, the number
#'   of a point, and the weight of that point in the mean that stands for the landmark. The numbers
#'   are those of the canonical face model (`canonical_face_model.obj` of MediaPipe). There is no
#'   counterpart of tL, tR, oiL and oiR. The points of n, gn, acL and acR are the nearest of the
#'   model, and 3 to 5 mm from our definitions.
#' @param specimen A [specimen()] of [find_landmarks()].
#' @param landmarks The other landmarks: a k x 3 matrix with row names, a data frame `name`, `x`,
#'   `y`, `z`, or a file that [read_landmarks()] reads. Or points of MediaPipe, see below. They are
#'   in the frame and unit of the specimen. NA: missing.
#' @param agreed Distance at which the difference alone makes the confidence 0.5, in the unit of the
#'   template (mm for a face). Landmarks of correct finders differ by up to 5 mm, by definition.
#' @param tolerance Distance from the surface up to which a point is projected onto it, as a share
#'   of the specimen's size. A point farther away has no say, and a warning names it.
#' @return The specimen. Its `placing` has the new column `apart`: the distance (in the unit of the
#'   mesh) between the landmark and the other finder's point, both projected onto the surface. It is
#'   NA if there is no other point. `confidence` is now 1 / (1 / c + (`apart` / a)^2). Here c is the
#'   former confidence (1 for a placed landmark) and a is `agreed`. `match$doubtful` is TRUE if the
#'   share of landmarks with low confidence is above the setting `wrong` of [find_settings()]. A
#'   second call replaces `apart`, and lowers the confidence again.
#' @section Errors: of class `crestline_error`: the landmarks of the specimen were not found by
#'   machine, or no name is in common.
#' @section Warnings: of class `crestline_far_opinion`: points lie far from the surface.
#' @template glossary
#' @seealso [find_landmarks()], [check_placing()]
#' @examples
#' \donttest{
#' data(humface, package = "Rvcg")
#' face <- find_landmarks(humface, id = "humface")
#' by_hand <- system.file("extdata", "humface_landmarks_2.csv", package = "crestline")
#' face <- second_opinion(face, by_hand)
#' face
#' face$placing[c("landmark", "apart", "confidence")]
#' }
#' @export
second_opinion <- function(specimen, landmarks, agreed = 6, tolerance = 0.1) {
  check_given()
  placing <- placing_of(specimen)
  agreed <- check_number(agreed, "agreed", lower = 0, open = TRUE)
  tolerance <- check_number(tolerance, "tolerance", lower = 0)
  other <- other_landmarks(landmarks, specimen$id)
  common <- intersect(placing$landmark, rownames(other)[!is.na(other[, 1])])
  if (!length(common)) {
    refuse_landmarks("the second opinion has none of its landmarks.",
                     sprintf("Name them as in %s.", shorten(placing$landmark)), specimen$id)
  }
  apart <- rep(NA_real_, nrow(placing))
  row <- match(common, placing$landmark)
  apart[row] <- gaps_on_surface(specimen, as.matrix(placing[row, c("x", "y", "z")]),
                                other[common, , drop = FALSE], tolerance)
  placing$apart <- apart
  # Confidences after a second opinion; without one they stay
  before <- placing$confidence
  compared <- !is.na(placing$apart) & placing$state %in% c("found", "placed")
  former <- ifelse(placing$state == "placed" & is.na(before), 1, before)
  now <- 1 / (1 / former + (placing$apart / (agreed / specimen$match$unit))^2)
  placing$confidence <- ifelse(compared, now, before)
  match <- specimen$match
  match$doubtful <- match$doubtful || placing_doubt(placing)$share > find_settings()$wrong
  with_fields(specimen, placing = placing, match = match)
}

#' The landmarks of another finder by name; those of MediaPipe by the table that ships
#' @noRd
other_landmarks <- function(landmarks, id) {
  if (is.character(landmarks) && length(landmarks) == 1) landmarks <- read_landmarks(landmarks)
  bare <- is.matrix(landmarks) && is.null(rownames(landmarks)) ||
    is.data.frame(landmarks) && ncol(landmarks) == 3 && is.integer(attr(landmarks, "row.names"))
  if (bare && nrow(landmarks) %in% c(468, 478)) {
    landmarks <- as.matrix(landmarks)
    rownames(landmarks) <- seq_len(nrow(landmarks)) - 1
  }
  landmarks <- as_landmarks(landmarks, id)
  if (!nrow(landmarks) || !all(grepl("^[0-9]+$", rownames(landmarks)))) return(landmarks)
  # Landmarks as means of MediaPipe's points
  file <- system.file("extdata", "mediapipe.csv", package = "crestline", mustWork = TRUE)
  table <- utils::read.csv(file)
  at <- landmarks[match(table$mediapipe, rownames(landmarks)), , drop = FALSE] * table$weight
  at <- rowsum(at, factor(table$landmark, unique(table$landmark)))
  at / drop(rowsum(table$weight, factor(table$landmark, unique(table$landmark))))
}

#' Distances between landmarks and other points, both on the surface
#' @return Lengths; NA for points that lie too far from it, which a warning names.
#' @noRd
gaps_on_surface <- function(specimen, at, other, tolerance) {
  own <- as.matrix(surface_points(specimen$mesh, at)[c("x", "y", "z")])
  on <- as.matrix(surface_points(specimen$mesh, other)[c("x", "y", "z")])
  away <- row_lengths(on - other)
  far <- away > tolerance * specimen_size(specimen)
  if (any(far)) {
    named <- sprintf("%s (by %.3g)", rownames(other)[far], away[far])
    crestline_warn(
      sprintf("points of the second opinion lie off the surface, and have no say: %s.",
              shorten(named)),
      "Are they in the frame and unit of the specimen? Else allow more (`tolerance`).",
      stage = "landmarks", id = specimen$id, class = "crestline_far_opinion"
    )
  }
  ifelse(far, NA, row_lengths(on - own))
}
