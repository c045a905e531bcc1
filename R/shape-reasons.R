# The reasons of grades by kind: what print() counts, and what the table of ?quality explains.

#' Kinds of reasons, the first that fits counts
#'
#' @return Named character: words for a kind, by a pattern of its sentences.
#' @noRd
reason_kinds <- c(
  "^it was not measured" = "not measured",
  "exchanged" = "a landmark looks exchanged with another",
  "confidence|predicted" = "a landmark was found with doubt, or predicted",
  "^bounded by" = "a curve that bounds the patch is not green",
  "off the surface" = "a landmark is off the surface",
  "^cut at|of the scheme's share" = "cut short",
  "missing|not there|no landmark" = "points or landmarks are missing",
  "standard error" = "uncertain across the curve",
  "curvature|determined" = "no clear ridge or valley",
  "another path" = "another path is nearly as good",
  "strength is only" = "hardly stronger than beside it",
  "off the others'" = "length unlike the others'",
  "mirror image" = "unlike the other side",
  "rough" = "the surface is rough",
  "coarse" = "the mesh is coarse",
  "over a hole" = "runs over a hole",
  "border or hole" = "beside a border or hole",
  "spike" = "beside a spike or fold",
  "homologous points" = "along another feature than in the sample",
  "expected track" = "off its expected track",
  "triangle" = "flipped, doubled or crossing triangles"
)

#' The kind of each sentence; a sentence of no kind stands for itself, without its numbers
#' @noRd
reason_kind <- function(text) {
  kind <- rep(NA_character_, length(text))
  for (pattern in names(reason_kinds)) {
    fits <- is.na(kind) & grepl(pattern, text)
    kind[fits] <- reason_kinds[[pattern]]
  }
  ifelse(is.na(kind), gsub("[0-9.]+", "...", text), kind)
}

#' Names of parts, patches as such: a curve may have the same name
#' @noRd
titled_parts <- function(parts) ifelse(parts$level == "surface", paste("patch", parts$part),
                                       parts$part)

#' Lines that count the parts that are not green, one for each grade and kind of reason
#'
#' @param table Rows of [quality()], none of level "specimen".
#' @return Character; each line has an example.
#' @noRd
reason_lines <- function(table) {
  table <- as.data.frame(table)
  table <- table[table$grade > "green" & !is.na(table$why), ]
  each <- strsplit(table$why, "; ", fixed = TRUE)
  row <- rep(seq_along(each), lengths(each))
  kind <- reason_kind(unlist(each))
  group <- paste(table$grade[row], kind, sep = ": ")
  first <- !duplicated(paste(row, kind))
  groups <- split(which(first), factor(group[first], unique(group[first])))
  worst <- vapply(groups, function(at) as.integer(table$grade[row[at[1]]]), 0L)
  lines <- vapply(groups, function(at) {
    own <- table[row[at], ]
    sprintf("%s: %s of %s, such as %s of %s: %s", group[at[1]], amount(nrow(own), "part"),
            amount(length(unique(own$specimen)), "specimen"), titled_parts(own)[1], own$specimen[1],
            unlist(each)[at[1]])
  }, "")
  unname(lines[order(-worst, -lengths(groups))])
}
