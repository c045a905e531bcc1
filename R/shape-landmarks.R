# The landmarks of a specimen held against those of a scheme: names, unit, and what looks exchanged.

#' Names that are all foreign, and lengths in another unit, would give a shape of nothing
#' @noRd
check_fits_scheme <- function(specimen, scheme, unit = NULL) {
  wanted <- scheme$landmarks$landmark
  if (!NROW(specimen$landmarks)) {
    crestline_abort("it has no landmarks.",
                    paste("On a face find them: find_landmarks(). Else place them by hand,",
                          "place_landmarks(), or read them: read_specimen(file, landmarks)."),
                    stage = "landmarks", id = specimen$id, class = "crestline_landmark_error")
  }
  if (!any(wanted %in% rownames(specimen$landmarks))) {
    near <- attr(unused_names(specimen$landmarks, scheme), "near")
    crestline_abort(
      sprintf("it has none of the landmarks of the scheme %s (%s), but %s%s.", scheme$name,
              shorten(wanted), shorten(rownames(specimen$landmarks)),
              if (length(near)) paste("; near:", shorten(near)) else ""),
      paste("Rename them: rownames(specimen$landmarks) <- ...; or find_landmarks(), or",
            "place_landmarks()."),
      stage = "landmarks",
      id = specimen$id, class = "crestline_landmark_error"
    )
  }
  check_scale(specimen, scheme, unit)
  size <- specimen_size(specimen)
  radius <- max(scheme$curves$radius, 0, na.rm = TRUE)
  if (radius > size / 2) {
    crestline_abort(sprintf(paste0("the scheme's radius of %.4g is as large as the mesh, whose ",
                                   "size is %.4g."),
                            radius, size),
                    paste0("Is the mesh in another unit? For a scan in metres and a scheme in mm ",
                           "give `unit = 1000`."),
                    stage = "curvature", id = specimen$id)
  }
}

#' The landmarks must be about as far apart as those of the scheme
#'
#' @param scheme With its lengths in what should be the specimen's unit.
#' @param unit As given to [fit_shape()].
#' @param apart Greatest factor between them, either way. On 45 faces of adults it is 1.15; a
#'   child of a year has 0.7 of an adult's face. Centimetres are 10, inches 25.4.
#' @param units Factors between units.
#' @noRd
check_scale <- function(specimen, scheme, unit = NULL, apart = 2.5,
                        units = c(10, 25.4, 100, 1000)) {
  scale <- landmark_scale(specimen$landmarks, typical_landmarks(scheme))
  if (is.na(scale) || (scale >= 1 / apart && scale <= apart)) return(invisible())
  known <- c(units, 1 / units)
  nearest <- known[which.min(abs(log(known * scale)))]
  asked <- if (abs(log(nearest * scale)) < log(2)) nearest else signif(1 / scale, 2)
  crestline_abort(
    sprintf("its landmarks are %.3g times as far apart as those of the scheme %s: another unit.",
            scale,
            scheme$name),
    unit_remedy(specimen$id, asked * c(unit, specimen$match$unit, 1)[1]),
    stage = "landmarks", id = specimen$id,
    class = c("crestline_unit_error", "crestline_landmark_error")
  )
}

#' How a specimen comes to the unit of the others
#' @noRd
unit_remedy <- function(id, factor) {
  sprintf(paste("Read it with `rescale = %.4g`, in a batch fit_shapes(reading = list(rescale =",
                "c(\"%s\" = %.4g))): then all specimens have one unit. With `unit = %.4g` it is",
                "measured as it is, and its co-ordinates stay in the mesh's unit."),
          factor, id, factor, factor)
}

#' How many times as far apart landmarks are as those of a reference: the median over their
#' distances
#' @param fewest Landmarks without which nothing is said.
#' @noRd
landmark_scale <- function(at, reference, fewest = 4) {
  at <- at[!is.na(at[, 1]), , drop = FALSE]
  both <- intersect(rownames(at), rownames(reference))
  if (length(both) < fewest) return(NA_real_)
  apart <- as.vector(stats::dist(at[both, ])) / as.vector(stats::dist(reference[both, ]))
  stats::median(apart[is.finite(apart)])
}

#' What looks exchanged among the landmarks of a specimen; a warning unless specimen() gave it
#' @return As [exchanged_landmarks()].
#' @noRd
scheme_slips <- function(specimen, scheme) {
  pairs <- scheme$pairs[scheme$pairs$level == "landmarks", c("left", "right")]
  own <- intersect(rownames(specimen$landmarks), scheme$landmarks$landmark)
  midline <- setdiff(eval(formals(crestline::specimen)$midline), unlist(pairs))
  located <- specimen$geometry$located[match(own, rownames(specimen$geometry$landmarks),
                                             nomatch = 0), ]
  slips <- exchanged_landmarks(
    specimen$landmarks[own, , drop = FALSE], mean_front(specimen$mesh, located), pairs, midline,
    typical_landmarks(scheme)
  )
  if (!is_told(slips, specimen$geometry$slips)) warn_exchanged(slips, specimen$id)
  # Reasons of landmarks that look exchanged; NA of the others
  said <- stats::setNames(rep(NA_character_, length(own)), own)
  if (slips$mirrored) said[own %in% unlist(pairs)] <- "left and right look mirrored"
  for (group in slips$groups) said[group] <- paste(word_list(group), "look exchanged")
  for (two in slips$either) {
    said[unlist(two)] <- paste(
      paste(vapply(two, word_list, ""), collapse = " or "), "look exchanged"
    )
  }
  slips$said <- said[own]
  slips
}

#' Whether specimen() has warned of everything that looks exchanged
#' @param before Its findings, NULL if they are not known.
#' @noRd
is_told <- function(slips, before) {
  named <- function(found) unlist(found[c("groups", "either")])
  isTRUE(before$mirrored) || !slips$mirrored && all(named(slips) %in% named(before))
}

#' The status with what looks exchanged
#' @noRd
note_slips <- function(shape, slips) {
  said <- slips$said[!is.na(slips$said)]
  row <- match(names(said), ifelse(shape$status$level == "landmarks", shape$status$part, NA))
  before <- shape$status$reason[row]
  shape$status$reason[row] <- ifelse(is.na(before), said, paste(before, said, sep = "; "))
  shape
}

#' What is known of every landmark of a shape, a row a part
#' @param placing Of the specimen, NULL where its landmarks were given.
#' @return Data frame `state`, `confidence`, `exchanged`, NA but for landmarks.
#' @noRd
landmark_checks <- function(shape, placing, slips) {
  name <- ifelse(shape$status$level == "landmarks", shape$status$part, NA)
  row <- match(name, placing$landmark, incomparables = NA)
  of <- function(values, none) if (is.null(values)) rep(none, length(name)) else values[row]
  data.frame(state = of(placing$state, NA_character_),
             confidence = of(placing$confidence, NA_real_),
             exchanged = unname(slips$said[name]))
}

#' Why a landmark that was found is not used
#' @return Text, NULL where that is not so.
#' @noRd
left_out_reason <- function(specimen, name) {
  row <- match(name, specimen$placing$landmark)
  if (is.na(row) || !anyNA(specimen$landmarks[name, ])) return(NULL)
  found <- specimen$placing[row, ]
  low <- found$state == "found" && found$confidence < find_settings()$low
  said <- "landmark %s was found with a confidence of %.2f only: left out"
  if (isTRUE(low)) sprintf(said, name, found$confidence)
}

#' A scan as the steps of a fit take it
#'
#' @param specimen As of [with_located()].
#' @param scheme In the unit of the specimen.
#' @param settings [ridge_settings()].
#' @param passes As in [ridge_curve()].
#' @param column List of `angle`, `angles`, `reach` as the arguments of [fit_shape()], and `bridge`.
#' @return List: the fields of [walkable()] of the mesh with its holes bridged; `faces`, how many of
#'   its triangles are no bridges; `specimen`; `bridged`, the same with its holes bridged; `scheme`,
#'   `settings`, `passes`, `column`; `sources`, curvature by radius, as of [curvature_source()]; and
#'   what [scan_landmarks()] gives.
#' @noRd
prepare_scan <- function(specimen, scheme, settings, column, threads) {
  bridged <- bridge_holes(specimen, column$bridge)
  curves <- scheme$curves
  radius <- unique(curves$radius[curves$kind != "plane"])
  sources <- lapply(radius, function(r) {
    curvature_source(specimen$mesh, kernel_settings(r, settings$order), threads)
  })
  scan <- c(walkable(bridged),
            list(faces = ncol(specimen$mesh$it), specimen = specimen, bridged = bridged,
                 scheme = scheme, settings = settings, column = column,
                 sources = stats::setNames(sources, radius)))
  c(scan, scan_landmarks(scan))
}

#' The landmarks of a scheme on a scan
#'
#' @param scan With `specimen`, `bridged` and `scheme`.
#' @return List: `landmarks`, k x 3, of the specimen; `points`, a row a landmark of the scheme with
#'   columns as `mesh_columns`, NA where it is not on the mesh; `reason`, why not, NA where it is;
#'   `ends`, as `points`, but on bridges too; `lost`, failures by name of those that are not there.
#' @noRd
scan_landmarks <- function(scan) {
  specimen <- scan$specimen
  names <- scan$scheme$landmarks$landmark
  points <- matrix(NA_real_, length(names), length(mesh_columns),
                   dimnames = list(names, mesh_columns))
  reason <- stats::setNames(rep(NA_character_, length(names)), names)
  ends <- points
  lost <- list()
  for (name in names) {
    found <- as_value(found_landmark(specimen, name))
    if (!failed(found)) {
      points[name, ] <- ends[name, ] <- unlist(found[mesh_columns])
      next
    }
    reason[name] <- c(left_out_reason(specimen, name), sub("\\.$", "", found$problem))[1]
    on_bridge <- as_value(found_landmark(scan$bridged, name))
    if (failed(on_bridge)) lost[[name]] <- on_bridge else
      ends[name, ] <- unlist(on_bridge[mesh_columns])
  }
  near <- attr(unused_names(specimen$landmarks, scan$scheme), "near")
  reason[near] <- sprintf("%s; near: %s", reason[near], names(near))
  list(landmarks = specimen$landmarks, points = points, reason = reason, ends = ends, lost = lost)
}

#' The place of a landmark of the scheme: its row of `ends`, or a failure
#' @noRd
scan_place <- function(scan, name) {
  if (is.null(scan$lost[[name]])) scan$ends[name, ] else scan$lost[[name]]
}
