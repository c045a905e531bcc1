# The sample as a sample: what an alignment shows of single specimens that no specimen shows of
# itself.

#' Limits of the warnings of align()
#'
#' [align()] warns of a specimen or point that exceeds one of these limits. `Inf` switches a limit
#' off. No limit depends on the unit.
#'
#' @param far Greatest robust z-score of a specimen's distance from the median shape: the excess
#'   over the median distance, in spreads. The spread is 1.4826 MAD, and at least 0.15 times the
#'   median distance. On 23 and 11 faces of two collections the greatest value is 2.3. A face with
#'   two exchanged landmarks of a pair has 5 to 40.
#' @param point Greatest distance of a point of a specimen from its median place, as a multiple of
#'   that of other points. On those faces the greatest value is 3.7. Exchanged neighbours have 6
#'   to 29.
#' @param size Greatest ratio between the size of a specimen and the median size, or its inverse. A
#'   power of ten means another unit.
#' @param estimated Greatest share of the specimens that lack a point, and greatest share of the
#'   points that a specimen lacks.
#' @param beyond Greatest distance of an estimated point beyond all points that the specimen has, as
#'   seen from their middle. It is taken on the mean, as a share of its RMS radius. There the spline
#'   extrapolates. Half a face lacks points at a distance of 1 radius.
#' @param fewest Least number of specimens for the comparison of distances.
#' @return List of class `sample_limits`.
#' @section Errors: of class `crestline_error`: a value is not a number above 0.
#' @template glossary
#' @seealso [align()]
#' @examples
#' sample_limits(far = Inf)
#' @export
sample_limits <- function(far = 8, point = 8, size = 5, estimated = 1 / 3, beyond = 0.5,
                          fewest = 6) {
  limits <- list(far = far, point = point, size = size, estimated = estimated, beyond = beyond)
  for (name in names(limits)) {
    if (identical(limits[[name]], Inf)) next
    limits[[name]] <- check_number(limits[[name]], name, 0, open = TRUE)
  }
  structure(c(limits, list(fewest = check_count(fewest, "fewest", lower = 3))),
            class = "sample_limits")
}

#' @export
print.sample_limits <- function(x, ...) {
  printed(x, {
    cat("<sample_limits>",
        paste(names(x), vapply(x, format, "", digits = 3), sep = " = ", collapse = ", "), "\n")
    invisible(x)
  })
}

#' An alignment, after a warning of each kind of doubt about it
#' @param aligned An `aligned`.
#' @noRd
warn_of_doubts <- function(aligned, limits) {
  said <- c(said_of_twins(aligned), said_of_sizes(aligned, limits),
            said_of_distances(aligned, limits), said_of_gaps(aligned, limits))
  warn_of_said(said, aligned)
}

warn_of_said <- function(said, aligned) {
  for (kind in names(said)) {
    crestline_warn(sprintf("%s: %s", aligned$level, said[[kind]]), sample_remedies[[kind]],
                   stage = "align", class = c(paste0("crestline_", kind), "crestline_sample_doubt"))
  }
  aligned
}

sample_remedies <- c(
  twin = paste("One scan may be there twice, and counts twice in every test. Leave one out,",
                "x[names(x) != \"id\"], unless that is meant."),
  size = paste("Are they in another unit? Read them with `rescale`, see read_specimen():",
               "fit_shapes(reading = list(rescale = c(id = 1000)))."),
  far = "Look at them: are landmarks exchanged, or is it another object? Leave out what is wrong.",
  point = "Look at these points on these specimens: are two landmarks exchanged, or one misplaced?",
  estimated = paste("Use missing = \"drop\", or leave such specimens out: estimates follow the",
                    "others' mean."),
  beyond = "Use missing = \"drop\", or leave them out: so far out, an estimate is the others' mean."
)

#' @param alike Co-ordinates that differ by less than this share of the shapes' size are equal.
#' @noRd
said_of_twins <- function(aligned, alike = 1e-9) {
  x <- aligned$coords
  like <- apply(round(x / (alike * sqrt(sum(aligned$mean^2)))) + 0, 3, rlang::hash)
  ids <- dimnames(x)[[3]]
  groups <- Filter(function(same) length(same) > 1, split(ids, factor(like, unique(like))))
  # All alike: copies that were made on purpose
  if (!length(groups) || length(unique(like)) == 1) return(NULL)
  list(twin = sprintf("the same shape under two names: %s.",
                       shorten(vapply(groups, paste, "", collapse = " and "), 5)))
}

said_of_sizes <- function(aligned, limits) {
  ratio <- aligned$size / stats::median(aligned$size)
  off <- which(ratio > limits$size | ratio < 1 / limits$size)
  if (!length(off)) return(NULL)
  named <- sprintf("%s (%.2g times)", names(aligned$size)[off], ratio[off])
  list(size = sprintf("sizes differ as units do; from the median is off %s.", shorten(named)))
}

#' @param floor Least spread, as a share of the median distance.
#' @param alike Distances below this share of the shapes' size are those of copies, of which
#'   nothing is said.
#' @noRd
said_of_distances <- function(aligned, limits, floor = 0.15, alike = 1e-6) {
  n <- dim(aligned$coords)[3]
  if (n < limits$fewest) return(NULL)
  off <- aligned$coords - as.vector(apply(aligned$coords, 1:2, stats::median))
  apart <- sqrt(apply(off^2 * aligned$weights, c(1, 3), sum))
  least <- alike * sqrt(sum(aligned$mean^2))
  whole <- sqrt(colSums(apart^2))
  middle <- stats::median(whole)
  score <- (whole - middle) / max(stats::mad(whole), floor * middle, least)
  far <- which(score > limits$far)
  ids <- dimnames(aligned$coords)[[3]]
  said <- list()
  if (length(far)) {
    named <- sprintf("%s (%.3g times as far)", ids[far], whole[far] / middle)
    said$far <- sprintf("far from the others: %s.", shorten(named))
  }
  usual <- pmax(apply(apart, 1, stats::median), least)
  ratio <- apart / usual
  near <- setdiff(which(apply(ratio, 2, max) > limits$point), far)
  names <- rownames(aligned$mean)
  each <- vapply(near, function(i) {
    sprintf("%s of %s", shorten(names[ratio[, i] > limits$point], 3), ids[i])
  }, "")
  if (length(near)) said$point <- sprintf("points far from those of the others: %s.", shorten(each))
  said
}

said_of_gaps <- function(aligned, limits) {
  gone <- aligned$missing[aligned$missing$action == "estimated", ]
  if (!nrow(gone)) return(NULL)
  ids <- intersect(names(aligned), gone$id)
  names <- rownames(aligned$mean)
  gap <- matrix(FALSE, length(names), length(ids))
  gap[cbind(match(gone$point, names), match(gone$id, ids))] <- TRUE
  c(said_of_shares(gap, ids, names, limits$estimated, length(aligned)),
    said_of_reach(aligned$mean, gap, ids, limits$beyond))
}

#' @param gap Points x specimens that lack some; of `n` in all.
#' @noRd
said_of_shares <- function(gap, ids, names, limit, n) {
  few <- names[rowSums(gap) / n > limit]
  poor <- ids[colMeans(gap) > limit]
  share <- sprintf("more than %.0f %%", 100 * limit)
  of_points <- sprintf("estimated for %s of the specimens: %s (%s)", share, shorten(few),
                       amount(length(few), "point"))
  of_specimens <- sprintf("%s of the points are estimated of %s", share, shorten(poor))
  said <- c(if (length(few)) of_points, if (length(poor)) of_specimens)
  if (length(said)) list(estimated = paste0(paste(said, collapse = "; "), "."))
}

said_of_reach <- function(mean, gap, ids, limit) {
  radius <- sqrt(mean(rowSums(sweep(mean, 2, colMeans(mean))^2)))
  reach <- vapply(which(colSums(gap) > 0), function(i) {
    reach_beyond(mean[!gap[, i], , drop = FALSE], mean[gap[, i], , drop = FALSE])
  }, 0) / radius
  far <- reach > limit
  if (!any(far)) return(NULL)
  named <- sprintf("%s (%.2g radii)", ids[colSums(gap) > 0][far], reach[far])
  list(beyond = sprintf("points are estimated far from those that are there: of %s.",
                        shorten(named)))
}

#' How far the farthest of some points lies beyond all others, in its direction from their middle; 0
#' within
#' @noRd
reach_beyond <- function(known, gone) {
  middle <- colMeans(known)
  out <- sweep(gone, 2, middle)
  length <- sqrt(rowSums(out^2))
  extent <- apply(tcrossprod(sweep(known, 2, middle), out / pmax(length, .Machine$double.xmin)), 2,
                  max)
  max(0, length - extent)
}

#' How many points of whom were estimated or dropped, as lines of text
#' @param missing Of an `aligned`.
#' @noRd
missing_lines <- function(missing, most = 8) {
  vapply(split(missing, factor(missing$action, unique(missing$action))), function(gone) {
    count <- table(factor(gone$id, unique(gone$id)))
    paste0(sprintf("missing and %s: %s of %s", gone$action[1], amount(nrow(gone), "point"),
                   shorten(names(count), most)),
           if (length(count) > 1) sprintf("; most, %d, of %s", max(count),
                                          names(count)[which.max(count)]))
  }, "", USE.NAMES = FALSE)
}
