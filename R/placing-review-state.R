# What a review knows and does, without a page: which landmark is meant, where it goes, what
# follows, and the way back.

#' Begin a review
#'
#' @param specimen,scheme,least,settings,bridge,threads As in [review_landmarks()].
#' @return List: `specimen`; `fitting` as of [begin_fitting()], NULL without a scheme; `about` (data
#'   frame: `landmark`, `name`, `where`); `state` by landmark ("found", "predicted", "given",
#'   "placed", "absent", or "missing": neither placed nor said to be absent); `selected` (name, or
#'   none: `character()`); `drawn` (list by curve of [joined_line()]s); `pen` (name of the curve
#'   that is drawn now, or none); `observer`; `log` as of [no_steps()]; `history` and `future`
#'   (lists of earlier and undone reviews); `said` (text).
#' @noRd
begin_review <- function(specimen, scheme, least, settings, bridge, threads, observer = "") {
  specimen <- with_located(specimen)
  # The landmarks of a scheme, in its order, and those that only the specimen has, with words for
  # the reader Where a table says "as enL" the words are those of enL.
  known <- scheme$landmarks
  names <- union(known$landmark, rownames(specimen$landmarks))
  words <- function(column) {
    text <- if (is.null(known[[column]])) NA_character_ else
      known[[column]][match(names, known$landmark)]
    ifelse(is.na(text), "", text)
  }
  where <- words("where")
  same <- match(sub("^as ", "", where), names)
  alike <- startsWith(where, "as ") & !is.na(same)
  where[alike] <- where[same[alike]]
  about <- data.frame(landmark = names, name = words("name"), where = with_plain_words(where))
  fitting <- if (!is.null(scheme)) begin_fitting(specimen, scheme, settings, bridge, threads)
  there <- about$landmark %in% rownames(specimen$landmarks)[!is.na(specimen$landmarks[, 1])]
  said <- specimen$placing$state[match(about$landmark, specimen$placing$landmark)]
  state <- if (is.null(said)) rep(NA_character_, length(about$landmark)) else said
  state[is.na(state)] <- ifelse(there, "given", "missing")[is.na(state)]
  list(specimen = specimen, fitting = fitting, about = about,
       state = stats::setNames(state, about$landmark), least = least, selected = character(),
       drawn = list(), pen = character(), observer = observer, log = no_steps(), history = list(),
       future = list(), said = "")
}

#' Definitions with plain words for those that are easily misread; a scheme that defines a landmark
#' otherwise keeps its own words
#' @noRd
with_plain_words <- function(where) {
  plain <- c(
    "midline point level with the nasal root at the brow ridge" = paste(
      "from the side: on the brow ridge, more than 1 cm above the deepest point of the nose's root"
    ),
    "deepest midline point of the nasofrontal angle" = paste(
      "from the side: the deepest point between forehead and nose, about 1 cm above the inner",
      "corners of the eyes"
    ),
    "most lateral point of the curved base line of the nasal ala" = paste(
      "where the wing of the nose is widest: in its groove to the cheek, not on the outline from",
      "the front"
    )
  )
  more <- unname(plain[where])
  ifelse(is.na(more), where, paste0(where, " (", more, ")"))
}

#' Which landmarks were found with too little confidence
#' @noRd
is_doubtful <- function(review) {
  placing <- review$specimen$placing
  if (is.null(placing)) return(rep(FALSE, nrow(review$about)))
  confidence <- placing$confidence[match(review$about$landmark, placing$landmark)]
  review$state == "found" & !is.na(confidence) & confidence < review$least
}

select_landmark <- function(review, name) {
  if (!name %in% review$about$landmark) return(review)
  review$selected <- name
  review$pen <- character()
  with_said(review, "")
}

#' Which landmarks wait for the person: missing or doubtful
#' @noRd
is_open <- function(review) stats::setNames(
  review$state == "missing" | is_doubtful(review), review$about$landmark
)

#' Put the selected landmark on a place of the mesh, and fit its curves anew
#'
#' @param point As in [move_landmark()]; NULL says that it is not on this specimen.
#' @param progress As in [refit_curves()].
#' @noRd
place_selected <- function(review, point, progress = function(n) function() NULL) {
  name <- review$selected
  if (!length(name)) return(with_said(review, "Choose a landmark or a curve first."))
  # A landmark that waited is followed by the next that waits
  before <- review$state[[name]]
  action <- if (is.null(point)) "absent" else if (same_place(review, name, point)) "confirmed" else
    if (before %in% c("missing", "absent")) "placed" else "moved"
  after <- review_step(review, name, "landmarks", action)
  after$specimen <- move_landmark(review$specimen, name, point)
  after$state[[name]] <- if (is.null(point)) "absent" else "placed"
  if (is_open(review)[[name]]) after$selected <- next_open(after)
  if (!is.null(after$fitting)) {
    after$fitting <- refit_curves(after$fitting, after$specimen, name, progress)
    after <- follow_lines(after, name)
  }
  after
}

#' Whether a landmark is at a place already
#' @noRd
same_place <- function(review, name, point) {
  at <- review$specimen$landmarks
  row <- match(name, rownames(at))
  isTRUE(all(at[row, ] == unlist(point[c("x", "y", "z")])))
}

#' Say that the selected landmark is right where it is; one that is not on the mesh (predicted)
#' stays what it was
#' @noRd
keep_selected <- function(review, progress = function(n) function() NULL) {
  point <- if (length(review$selected)) {
    as_value(landmark_point(review$specimen, review$selected)[mesh_columns])
  }
  if (is.null(point) || failed(point)) review else place_selected(review, point, progress)
}

#' The next landmark after the selected one, round the list, that waits; the selected one where none
#' does
#' @noRd
next_open <- function(review) {
  open <- is_open(review)
  at <- c(match(review$selected, names(open)), 0)[1]
  waiting <- names(which(open[c(seq_along(open)[seq_along(open) > at], seq_len(at))]))
  if (length(waiting)) waiting[1] else review$selected
}

#' What a ray means: a landmark other than the selected one whose ball it meets, else a place on the
#' surface
#'
#' @param from,towards As in [mesh_on_ray()].
#' @param reach Radius of the landmarks' balls, in the unit of the mesh.
#' @return List with `landmark` (name) or `point` (one row, as of [mesh_on_ray()]); empty where the
#'   ray misses.
#' @noRd
aimed_at <- function(review, from, towards, reach) {
  point <- mesh_on_ray(review$specimen$mesh, from, towards)
  along <- unit_vector(towards - from)
  at <- review$specimen$landmarks
  at <- at[!is.na(at[, 1]) & !rownames(at) %in% review$selected, , drop = FALSE]
  away <- sweep(at, 2, from)
  depth <- as.vector(away %*% along)
  beside <- row_lengths(away - outer(depth, along))
  end <- if (is.null(point)) Inf else sum((unlist(point[c("x", "y", "z")]) - from) * along)
  met <- which(beside <= reach & depth <= end + reach)
  if (length(met)) return(list(landmark = rownames(at)[met[which.min(beside[met])]]))
  if (is.null(point)) list() else list(point = point)
}

#' The next or previous landmark or curve of the list
#'
#' @param by 1 or -1.
#' @noRd
choose_next <- function(review, by) {
  curves <- review$fitting$scheme$curves$curve
  rows <- c(paste("landmark", review$about$landmark), paste("curve", curves, recycle0 = TRUE))
  now <- c(paste("landmark", review$selected, recycle0 = TRUE),
           paste("curve", review$pen, recycle0 = TRUE), NA)[1]
  at <- match(now, rows, if (by > 0) 0 else length(rows) + 1) + by
  at <- (at - 1) %% length(rows) + 1
  name <- sub("^[a-z]+ ", "", rows[at])
  if (at <= nrow(review$about)) select_landmark(review, name) else choose_curve(review, name)
}

#' The side that a landmark or curve belongs to, in words: the subject's own
#' @noRd
side_words <- function(review, name, level) {
  pairs <- review$fitting$scheme$pairs
  pairs <- pairs[pairs$level %in% level, ]
  side <- if (name %in% pairs$left) "left" else if (name %in% pairs$right) "right"
  if (!length(side)) return(NULL)
  sprintf("the subject's own %s: from the front, on the %s of the picture", side,
          if (side == "left") "right" else "left")
}
