# Specimens that are not independent: pairs, repeats, sites. What is exchanged, and what is tested.

#' The design of a comparison
#'
#' @param group Factor of n, named, as of [check_group()].
#' @param block As in [compare_groups()].
#' @return List: `kind` ("free": all specimens are exchanged; "within": those of a block among each
#'   other; "whole": whole blocks), `block` (factor of n, NULL where free), `group` (factor of the
#'   units: the specimens, or the blocks where these are whole), `silent` (blocks that say nothing
#'   as all their specimens are of one group).
#' @noRd
comparison_design <- function(group, block) {
  ids <- names(group)
  if (is.null(block)) return(list(kind = "free", group = group))
  block <- check_block(block, ids)
  groups <- rowSums(table(block, group) > 0)
  if (all(groups == 1)) {
    of_block <- group[match(levels(block), block)]
    units <- stats::setNames(of_block, levels(block))
    check_units(units)
    return(list(kind = "whole", block = block, group = units))
  }
  list(kind = "within", block = block, group = group, silent = names(groups)[groups == 1])
}

check_block <- function(block, ids, name = "block") {
  fail <- function(problem, remedy) crestline_abort(
    problem, remedy, stage = "comparison"
  )
  if (!is.atomic(block)) {
    fail(sprintf("`%s` is %s.", name, describe_value(block)),
         "Give a factor, one value a specimen.")
  }
  if (!is.null(names(block))) {
    absent <- setdiff(ids, names(block))
    if (length(absent)) {
      fail(sprintf("`%s` has no value for %s.", name, shorten(absent)),
           "Name its values by specimens, or not at all.")
    }
    block <- block[ids]
  }
  if (length(block) != length(ids)) {
    fail(sprintf("`%s` has %d values for %d specimens.", name, length(block), length(ids)),
         "Give one for each.")
  }
  if (anyNA(block)) {
    fail(sprintf("`%s` is missing for %s.", name, shorten(ids[is.na(block)])),
         "Leave these specimens out.")
  }
  droplevels(as.factor(unname(block)))
}

check_units <- function(group) {
  few <- names(which.min(table(group)))
  if (min(table(group)) < 2) {
    crestline_abort(sprintf("the group \"%s\" has one block.", few),
                    paste("Every block lies in one group, so that blocks are compared: give",
                          "every group two or more."),
                    stage = "comparison")
  }
}

#' An alignment of the units of a design
#'
#' Within blocks: every specimen less the mean of its block, so that what the blocks differ by is
#' taken out. Whole blocks: their means.
#' @noRd
in_design <- function(aligned, design) {
  if (design$kind == "free") return(aligned)
  if (inherits(aligned, "aligned_files")) return(units_in_files(aligned, design))
  code <- as.integer(design$block)
  count <- tabulate(code)
  flat <- t(matrix(aligned$coords, length(aligned$mean)))
  means <- rowsum(flat, code) / count
  size <- drop(rowsum(unname(aligned$size), code)) / count
  if (design$kind == "whole") {
    names <- c(dimnames(aligned$coords)[1:2], list(levels(design$block)))
    aligned$coords <- array(t(means), c(dim(aligned$mean), length(count)), names)
    aligned$size <- stats::setNames(size, levels(design$block))
    return(aligned)
  }
  about <- flat - means[code, , drop = FALSE] + rep(colMeans(flat), each = nrow(flat))
  aligned$coords[] <- t(about)
  aligned$size[] <- aligned$size - size[code] + mean(aligned$size)
  aligned
}

#' Regroupings of the units of a design
#' @return As [regroupings()].
#' @noRd
design_regroupings <- function(design, n_perm, exact, permutations, seed) {
  if (design$kind != "within") {
    return(regroupings(design$group, n_perm, exact, permutations, seed))
  }
  if (!is.null(permutations)) {
    crestline_abort("`permutations` and `block` are both given.",
                    "Give one of them: orders within blocks are drawn here.",
                    stage = "arguments")
  }
  code <- as.integer(design$group)
  members <- split(seq_along(code), design$block)
  count <- vapply(members, function(own) count_regroupings(code[own]), 0)
  if (prod(count) <= exact) return(list(labels = every_within(code, members), exact = TRUE))
  block <- as.integer(design$block)
  own <- order(block)
  deal <- function() replace(code, own, code[order(block, stats::runif(length(code)))])
  list(labels = dealt_labels(code, n_perm, seed, deal), exact = FALSE)
}

#' Every regrouping within blocks, the observed one first
#' @noRd
every_within <- function(code, members) {
  each <- lapply(members, function(own) matched_regroupings(code[own]))
  chosen <- as.matrix(expand.grid(lapply(each, function(one) seq_len(ncol(one)))))
  labels <- matrix(0L, length(code), nrow(chosen))
  for (i in seq_along(members)) labels[members[[i]], ] <- each[[i]][, chosen[, i], drop = FALSE]
  labels
}

#' As [all_regroupings()], also of units of one group only, in the numbers of the code
#' @noRd
matched_regroupings <- function(code) {
  own <- sort(unique(code))
  if (length(own) == 1) return(matrix(code, length(code)))
  found <- all_regroupings(match(code, own))
  matrix(own[found], nrow(found))
}

#' One line about a design
#' @noRd
design_line <- function(design) {
  blocks <- if (!is.null(design$block)) amount(nlevels(design$block), "block")
  switch(design$kind, free = NULL,
         within = paste0("exchanged within ", blocks, if (length(design$silent)) {
           sprintf(" (%s of one group only, which say nothing)", shorten(design$silent))
         }),
         whole = paste("the means of", blocks, "are compared: each lies in one group"))
}
