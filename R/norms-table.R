# The table of measurements: which distances, angles, ratios, lengths, areas, depths and volumes
# there are, in words of a scheme.

#' Measurements of a face
#'
#' Gives the table of measurements that [measurements()] takes by default: standard anthropometric
#' ones as far as the landmarks, curves and patches of [face_scheme()] define them. You can change
#' it, or make one for another scheme.
#'
#' The landmark n of [face_scheme()] lies above the nasion of anthropometry. Measurements that start
#' at nasion are therefore taken from sellion (se) here, and are shorter than published ones. Do not
#' compare them with published norms.
#'
#' @return Data frame with a row for each measurement:
#'   * `measurement`: its name;
#'   * `kind`: "distance", "angle", "ratio", "length", "area", "depth" or "volume";
#'   * `of`: names, joined by " + ". A distance has two landmarks, an angle three (its vertex is the
#'     second), a depth one. A ratio has two measurements of the table. A length has curves. An area
#'     or a volume has groups of triangles of the scheme (patches, or "strip" and a strip's name,
#'     see the table `triangles` of [curve_scheme()]);
#'   * `base`: of a depth the two landmarks of a line, of a volume the three landmarks of a plane,
#'     joined by " + ". Otherwise empty;
#'   * `definition`, `source`: text.
#' @template glossary
#' @references Farkas (1994) *Anthropometry of the Head and Face*, Raven Press; Farkas and Munro
#'   (1987) *Anthropometric Facial Proportions in Medicine*, Thomas.
#' @seealso [measurements()]
#' @examples
#' table <- face_measurements()
#' table[table$kind == "angle", c("measurement", "of", "definition")]
#' @export
face_measurements <- function() {
  once("face measurements", function() {
    file <- system.file("extdata", "measurements.csv", package = "crestline", mustWork = TRUE)
    utils::read.csv(file, encoding = "UTF-8", na.strings = "")
  })
}

measurement_kinds <- function() {
  data.frame(
    kind = c("distance", "angle", "ratio", "length", "area", "depth", "volume"),
    of = c(2, 3, 2, NA, NA, 1, NA), base = c(0, 0, 0, 0, 0, 2, 3),
    unit = c("unit", "degrees", "1", "unit", "unit^2", "unit", "unit^3"),
    named = c("landmark", "landmark", "measurement", "curve", "group of triangles", "landmark",
              "group of triangles")
  )
}

#' A table of measurements as a plan: which places each needs
#'
#' @return List by measurement: `kind`, `unit`, and what there is of `at` (landmarks, rows of
#'   places), `base`, `lines` (list of rows of places), `triangles` (3 x m rows of places), `of`
#'   (numbers of two measurements).
#' @noRd
measurement_plan <- function(table, scheme) {
  table <- check_measurement_table(table)
  refuse <- function(row, problem) {
    crestline_abort(sprintf("`table`: measurement \"%s\": %s.", table$measurement[row], problem),
                    "See `?face_measurements`.", stage = "measurements")
  }
  # Rows of places of landmarks, curves and groups of triangles, each a named list
  points <- scheme$points
  place <- match(points$place, unique(points$place))
  at <- function(level) {
    own <- which(points$level == level)
    split(place[own], factor(points$part[own], unique(points$part[own])))
  }
  triangles <- scheme$triangles
  surface <- place[points$level == "surface"]
  corner <- rbind(surface[triangles$v1], surface[triangles$v2], surface[triangles$v3])
  groups <- lapply(split(seq_len(nrow(triangles)), factor(triangles$group)),
                   function(own) corner[, own, drop = FALSE])
  places <- list(landmarks = at("landmarks"), curves = at("curves"), groups = groups)
  kinds <- measurement_kinds()
  each <- lapply(seq_len(nrow(table)), function(row) {
    kind <- kinds[match(table$kind[row], kinds$kind), ]
    known <- switch(kind$named, landmark = places$landmarks, curve = places$curves,
                    measurement = stats::setNames(nm = table$measurement), places$groups)
    of <- known_parts(table$of[row], known, kind$of, kind$named, function(p) refuse(row, p))
    base <- known_parts(table$base[row], places$landmarks, kind$base, "landmark of `base`",
                        function(p) refuse(row, p))
    step <- list(kind = kind$kind, unit = kind$unit, base = unlist(places$landmarks[base]))
    switch(kind$named, landmark = step$at <- unlist(known[of]), curve = step$lines <- known[of],
           measurement = step$of <- match(of, table$measurement),
           step$triangles <- do.call(cbind, unname(known[of])))
    if (kind$kind == "ratio" && any(step$of >= row)) {
      refuse(row, "its two measurements must stand above it")
    }
    step
  })
  stats::setNames(each, table$measurement)
}

#' The parts of "a + b", each of which must be known
#' @noRd
known_parts <- function(text, known, n, what, refuse) {
  parts <- if (is.na(text)) character() else trimws(strsplit(text, " + ", fixed = TRUE)[[1]])
  strange <- setdiff(parts, names(known))
  if (length(strange)) {
    refuse(sprintf("the scheme has no %s \"%s\"", sub("^measurement$", "measurement above", what),
                   strange[1]))
  }
  wrong <- if (is.na(n)) !length(parts) else length(parts) != n
  many <- if (is.na(n)) "one name or more" else amount(n, "name")
  if (wrong) refuse(sprintf("it needs %s (%s)", many, what))
  parts
}

check_measurement_table <- function(table) {
  check_table(table, "table")
  refuse <- function(said, remedy) refuse_argument("table", table, remedy, said)
  lacking <- setdiff(c("measurement", "kind", "of"), names(table))
  if (length(lacking)) {
    refuse(sprintf("a data frame without %s", toString(paste0("`", lacking, "`"))),
           "See `?face_measurements`.")
  }
  if (is.null(table$base)) table$base <- rep(NA_character_, nrow(table))
  columns <- c("measurement", "kind", "of", "base")
  table[columns] <- lapply(table[columns], as.character)
  table$base[!nzchar(table$base)] <- NA
  if (!nrow(table) || anyNA(table[columns[1:3]]) || anyDuplicated(table$measurement)) {
    refuse("without rows, with empty cells, or with a name twice", "Give each measurement a row.")
  }
  strange <- setdiff(table$kind, measurement_kinds()$kind)
  if (length(strange)) {
    refuse(sprintf("with the kind \"%s\"", strange[1]),
           sprintf("Kinds are %s.", toString(measurement_kinds()$kind)))
  }
  table
}
