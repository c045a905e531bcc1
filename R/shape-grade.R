# From measures to grades: every check gives a level and a sentence.

#' Grade the parts of specimens of one scheme
#'
#' @param parts As of [part_measures()], of any number of specimens, with `z`.
#' @param limits [quality_limits()].
#' @param scheme The scheme of the shapes.
#' @return Data frame with the columns of [quality()].
#' @noRd
grade_parts <- function(parts, limits, scheme) {
  judged <- judge_parts(parts, limits, scheme)
  judged <- c(judged, judge_landmarks(parts, limits, scheme))
  levels <- lapply(judged, `[[`, "level")
  level <- do.call(pmax, levels)
  # One uncertain place of a curve is no reason to look at all of a patch.
  bounds <- judge_bounds(parts, do.call(pmax, levels[names(judged) != "se_max"]), scheme)
  judged <- c(judged, list(bounds))
  level <- pmax(level, bounds$level)
  parts$grade <- factor(grades[level + 1], grades, ordered = TRUE)
  parts$why <- reasons_said(parts$reason, judged)
  parts[quality_columns]
}

#' The reason of every part: its own, and those of the checks that doubt it
#' @noRd
reasons_said <- function(reason, judged) {
  doubted <- do.call(pmax, lapply(judged, `[[`, "level")) > 0
  why <- rep(NA_character_, length(doubted))
  at <- which(doubted | !is.na(reason))
  said <- lapply(judged, function(check) ifelse(check$level[at] > 0, check$text[at], NA))
  said <- matrix(sub("[.]$", "", unlist(c(list(reason[at]), said))), length(at))
  why[at] <- vapply(seq_along(at), function(i) {
    own <- unique(said[i, !is.na(said[i, ])])
    if (length(own)) paste(own, collapse = "; ") else NA_character_
  }, "")
  why
}

#' Every check of the parts of specimens
#'
#' @return List of checks, each a list of `level` (0 green, 1 amber, 2 red) and `text`, both by
#'   part; the text is NA if the part's own reason has it.
#' @noRd
judge_parts <- function(parts, limits, scheme) {
  value <- parts
  value[c("se", "se_max")] <- parts[c("se", "se_max")] / parts$radius
  value$z <- abs(parts$z)
  said <- said_of_parts(value, parts$z, scheme)
  of_free <- c("se", "se_max", "competing", "contrast", "coarse")
  value[!parts$free %in% TRUE, of_free] <- NA
  value$coarse[!parts$kind %in% c("ridge", "valley")] <- NA
  judge <- function(name) {
    list(level = level_beyond(value[[name]], limits[[name]], name %in% small_is_bad),
         text = rep_len(as.character(c(said[[name]], NA)), nrow(parts)))
  }
  flag <- function(bad, name) {
    list(level = ifelse(bad, match(limits[[name]], grades) - 1, 0),
         text = rep(NA_character_, nrow(parts)))
  }
  measures <- c("se", "se_max", "competing", "contrast", "z", "asymmetry", "roughness", "coarse",
                "bridged", "border", "spike", "offset", "track", "cut", "faults")
  c(list(judge("missing"), flag(parts$determined %in% FALSE, "undetermined"),
         flag(parts$guessed %in% TRUE, "guessed")),
    stats::setNames(lapply(measures, judge), ifelse(measures == "se_max", measures, "")))
}

#' Reasons of parts whose measure is beyond its limit, by measure
#'
#' @param value Measures as they are judged; `z` with its sign.
#' @noRd
said_of_parts <- function(value, z, scheme) {
  its <- ifelse(value$level == "curves", "length", "extent")
  partner <- partner_of(value$part, scheme$pairs, "curves")
  mirrored <- ifelse(partner == value$part, "its own mirror image",
                     paste("the mirror image of", partner))
  list(
    se = sprintf("its standard error is %.2g radii", value$se),
    se_max = sprintf("its standard error is %.2g radii at one place", value$se_max),
    competing = sprintf("another path is %.0f %% as good", 100 * value$competing),
    contrast = sprintf("its strength is only %.2g times that beside it", value$contrast),
    z = sprintf("its length is off the others' (z = %.1f)", z),
    asymmetry = sprintf("it is off %s by %.0f %% of its length%s", mirrored, 100 * value$asymmetry,
                        ifelse(partner == value$part, "", ": look at both sides")),
    roughness = sprintf("the surface is rough there: %.0f degrees", value$roughness),
    coarse = sprintf("the mesh is coarse there: edges of %.2g radii", value$coarse),
    bridged = sprintf("it runs over a hole for %s of its length", per_cent(value$bridged)),
    border = sprintf("it runs by a border or hole, %s of its %s away", per_cent(value$border), its),
    spike = sprintf("it runs by a spike or sharp fold, %s of its %s away", per_cent(value$spike),
                    its),
    offset = sprintf("it runs beside its homologous points, %.2g radii of the template off",
                     value$offset),
    track = sprintf("it leaves its expected track by %.1f spreads", value$track)
  )
}

#' What is doubted of landmarks, and so of the curves that end there; where most are, of all parts
#'
#' @return List of checks, as of [judge_parts()].
#' @noRd
judge_landmarks <- function(parts, limits, scheme) {
  marks <- parts$level == "landmarks"
  as_level <- function(bad, name) ifelse(bad, match(limits[[name]], grades) - 1, 0)
  low <- level_beyond(parts$confidence, limits$confidence, TRUE) *
    (parts$state %in% c("found", "placed"))
  checks <- list(
    exchanged = list(level = as_level(!is.na(parts$exchanged), "exchanged"),
                     text = parts$exchanged),
    low = list(level = low,
               text = sprintf("it was %s with a confidence of %.2f only", parts$state,
                              parts$confidence)),
    predicted = list(level = as_level(parts$state %in% "predicted", "predicted"),
                     text = rep("it is predicted by the other landmarks", nrow(parts)))
  )
  ends <- lapply(checks, judge_ends, parts, scheme)
  # Counted by specimen
  specimens <- unique(parts$specimen)
  one <- match(parts$specimen, specimens)
  of <- tabulate(one[parts$state %in% c("found", "placed")], length(specimens))
  few <- tabulate(one[low > 0], length(specimens))
  all <- list(level = level_beyond(few / pmax(of, 1), limits$doubtful, FALSE)[one],
              text = sprintf("%d of %d found landmarks have little confidence", few, of)[one])
  # A landmark's own reason says already that it looks exchanged.
  checks$exchanged$text[marks] <- NA
  unname(c(checks, ends, list(all)))
}

#' A check of landmarks as it concerns the curves that end there
#' @noRd
judge_ends <- function(check, parts, scheme) {
  level <- numeric(nrow(parts))
  text <- rep(NA_character_, nrow(parts))
  marks <- which(parts$level == "landmarks" & check$level > 0)
  curves <- which(parts$level == "curves")
  row <- match(parts$part[curves], scheme$curves$curve)
  known <- paste(parts$specimen[marks], parts$part[marks], sep = "\t")
  from <- match(paste(parts$specimen[curves], scheme$curves$from[row], sep = "\t"), known)
  to <- match(paste(parts$specimen[curves], scheme$curves$to[row], sep = "\t"), known)
  for (i in which(!is.na(from) | !is.na(to))) {
    at <- marks[sort(unique(c(from[i], to[i])))]
    level[curves[i]] <- max(check$level[at])
    text[curves[i]] <- paste(sprintf("it ends on %s: %s", parts$part[at], check$text[at]),
                             collapse = "; ")
  }
  list(level = level, text = text)
}

#' 0, or 1 and 2 beyond the first and second limit; 0 where NA
#' @noRd
level_beyond <- function(value, limit, falling) {
  if (falling) {
    value <- -value
    limit <- -limit
  }
  level <- (value > limit[1]) + (value > limit[2])
  ifelse(is.na(level), 0, level)
}

#' Patches of which a bounding curve is there but not green
#' @noRd
judge_bounds <- function(parts, level, scheme) {
  doubtful <- which(parts$level == "curves" & level > 0 & !is.na(parts$length))
  doubtful <- split(doubtful, parts$specimen[doubtful])
  text <- rep(NA_character_, nrow(parts))
  patches <- which(parts$level == "surface" & parts$specimen %in% names(doubtful))
  bounds <- lapply(stats::setNames(nm = unique(parts$part[patches])), bounding_curves, scheme)
  for (i in patches) {
    found <- doubtful[[parts$specimen[i]]]
    found <- found[parts$part[found] %in% bounds[[parts$part[i]]]]
    named <- sprintf("%s (%s)", parts$part[found], grades[level[found] + 1])
    if (length(found)) text[i] <- paste("bounded by", shorten(named, 3))
  }
  list(level = as.integer(!is.na(text)), text = text)
}

bounding_curves <- function(patch, scheme) {
  sides <- unlist(scheme$patches[scheme$patches$patch == patch,
                                 c("curve_a", "curve_b", "first_column")])
  unique(unlist(lapply(stats::na.omit(sides), function(side) curve_parts(side)$curve)))
}

grade_colours <- c(green = "#1A9470", amber = "#F2A100", red = "#B00020")

quality_columns <- c("specimen", "part", "level", "kind", "length", "strength", "contrast", "se",
                     "competing", "z",
                     "asymmetry", "missing", "cut", "bridged", "faults", "roughness", "coarse",
                     "border", "spike", "offset", "track", "noise_factor",
                     "grade",
                     "why")
