# Whether the tables of a norm are those of a norm, and of the same one. Checksums prove only that
# nothing changed since they were made; a wrong program makes them as well.

refuse_norm <- function(file, problem, remedy = "Copy the whole folder again.") {
  crestline_abort(sprintf("%s cannot be read as norms: %s.", basename(file), problem), remedy,
                  stage = "reading", class = "crestline_norm_file", call = NULL)
}

#' The tables of a header, and the columns of each
#' @return List by table of names; NULL for the table of measurements, which may have more.
#' @noRd
norm_columns <- function(header) {
  numbered <- function(letter, n) paste0(letter, seq_len(n))
  columns <- list(reference = c("point", "part", "index", "x", "y", "z", "nx", "ny", "nz",
                                "partner", "side", "se_norm", "r_xy", "r_xz", "r_yz"),
                  triangles = numbered("v", 3), counts = c("sex", "from", "to", "n"),
                  ages = c("sex", "from", "to"),
                  table = c("name", "transform", "se_norm", numbered("skew_", 4), "bias_norm"),
                  healing = c("at", "radius", "base", "peak"))
  fields <- c("surface", if (!is.null(header$asymmetry)) "asymmetry")
  for (name in c("values", fields, paste0(fields, "-along"))) {
    size <- header$splines[[if (name == "values") "values" else "points"]]
    columns[[paste0("mean-", name)]] <- c("sex", "e", numbered("b", size$k))
    columns[[paste0("spread-", name)]] <- c("sex", "e", numbered("b", size$k_spread))
    columns[[paste0("basis-", name)]] <- c("sex", "of", "row", "s",
                                           numbered("t", max(size$k, size$k_spread)))
  }
  for (name in fields) {
    own <- header[[name]]
    columns[[paste0("components-", name)]] <- c("sd", numbered("v", length(own$values)))
    columns[[paste0("scan-", name)]] <- paste0(ifelse(own$both, "b", "r"), own$radii)
  }
  columns
}

#' Columns of text of a table, all others being numbers
#' @param columns All its columns: a table of measurements may have columns of its maker.
#' @noRd
norm_texts <- function(name, columns) {
  switch(name, reference = c("point", "part", "index", "side"), ages = , counts = "sex",
         table = c("name", "transform"), measurements = columns)
}

#' Names and kinds of the columns of a table that was read as text
#' @return The table with numbers.
#' @noRd
typed_norm_table <- function(table, name, columns) {
  file <- paste0(name, ".csv")
  if (length(columns) && !identical(names(table), columns)) {
    odd <- c(setdiff(names(table), columns), setdiff(columns, names(table)))
    refuse_norm(file, sprintf("its columns are not those of a norm (%s)",
                              if (length(odd)) shorten(odd) else "another order"))
  }
  for (column in setdiff(names(table), norm_texts(name, names(table)))) {
    text <- table[[column]]
    number <- suppressWarnings(as.numeric(text))
    wrong <- which(is.na(number) & !is.na(text))
    if (length(wrong)) {
      refuse_norm(file, sprintf("\"%s\" in column `%s` is no number with a decimal point",
                                text[wrong[1]], column))
    }
    table[[column]] <- if (all(is.na(text))) number else
      utils::type.convert(text, as.is = TRUE, na.strings = "")
  }
  if (name == "reference") {
    if (!all(table$side %in% c("TRUE", "FALSE"))) {
      refuse_norm(file, "`side` has values other than TRUE and FALSE")
    }
    table$side <- table$side == "TRUE"
  }
  table
}

#' Numbers of rows, and whole numbers where there are such
#' @noRd
check_norm_rows <- function(header, tables) {
  k <- nrow(tables$reference)
  l <- sum(tables$reference$side)
  sexes <- length(header$sexes)
  whole <- function(x) all(is.finite(unlist(x))) && all(unlist(x) == round(unlist(x)))
  rows <- c(values = nrow(tables$table), surface = 3 * k, `surface-along` = k, asymmetry = 3 * l,
            `asymmetry-along` = l)
  for (name in intersect(names(tables), c(outer(c("mean-", "spread-"), names(rows), paste0)))) {
    count <- rows[[sub("^[a-z]+-", "", name)]]
    if (!identical(as.integer(tables[[name]]$sex), rep(seq_len(sexes), each = count))) {
      refuse_norm(paste0(name, ".csv"), sprintf("it needs %d rows for each of %s, in this order",
                                                count, amount(sexes, "sex", "sexes")))
    }
    if (!whole(tables[[name]])) {
      refuse_norm(paste0(name, ".csv"), "it has numbers that are not finite, or not whole")
    }
  }
  plain <- list(ages = sexes, `components-surface` = 3 * k, `scan-surface` = k,
                `components-asymmetry` = 3 * l, `scan-asymmetry` = l)
  for (name in intersect(names(tables), names(plain))) {
    if (nrow(tables[[name]]) != plain[[name]]) {
      refuse_norm(paste0(name, ".csv"), sprintf("it has %s, not %d",
                                                amount(nrow(tables[[name]]), "row"), plain[[name]]))
    }
  }
}

#' Whether the tables of a norm agree with each other
#' @noRd
check_norm_agreement <- function(norms, header) {
  check_norm_reference(norms$points, norms$triangles)
  check_norm_counts(norms, header)
  for (name in names(norm_sets(norms))) check_norm_basis(norms, name)
  for (name in intersect(c("surface", "asymmetry"), names(Filter(length, unclass(norms))))) {
    check_norm_field(norms, name)
  }
  check_norm_means(norms)
}

#' Names, partners and normals of the reference
#' @param least Least cosine between a normal and that of the triangles: rounding.
#' @noRd
check_norm_reference <- function(points, triangles, least = 0.99) {
  refuse <- function(problem) refuse_norm("reference.csv", problem)
  k <- nrow(points)
  if (k < 4 || anyDuplicated(points$point) ||
        !identical(points$point, paste(points$part, points$index))) {
    refuse("`point` is not `part` and `index`, or has a name twice")
  }
  xyz <- as.matrix(points[c("x", "y", "z")])
  if (!all(is.finite(xyz), is.finite(as.matrix(points[c("nx", "ny", "nz")])))) {
    refuse("it has numbers that are not finite")
  }
  partner <- points$partner
  known <- which(!is.na(partner))
  own <- partner[known]
  if (!all(own %in% seq_len(k)) || !identical(as.integer(partner[own]), known) ||
        any(points$side[known] & (points$side[own])) || any(points$side & is.na(partner))) {
    refuse("its partners are no pairs")
  }
  if (!all(triangles %in% seq_len(k))) {
    refuse_norm("triangles.csv", "it has rows that `reference.csv` has not")
  }
  normal <- point_normals(xyz, triangles)
  turned <- rowSums(normal * as.matrix(points[c("nx", "ny", "nz")]))
  if (any(turned[is.finite(turned)] < least)) {
    refuse("its normals are not those of its points and of `triangles.csv`")
  }
}

#' Sexes, ages, counts, names of values, radii and limits
#' @noRd
check_norm_counts <- function(norms, header) {
  ages <- norms$ages
  range <- norms$values$size$range
  ordered <- all(is.finite(c(ages$from, ages$to))) && all(ages$from < ages$to) &&
    all(ages$from >= range[1] & ages$to <= range[2])
  if (!ordered || !identical(ages$sex, as.character(header$sexes))) {
    refuse_norm("ages.csv", "its sexes or ages are not those of norms.json")
  }
  counts <- norms$counts
  if (!identical(sort(unique(counts$sex)), sort(ages$sex)) || !isTRUE(sum(counts$n) == norms$n)) {
    refuse_norm("counts.csv", "its sexes or its sum are not those of norms.json")
  }
  components <- paste("component", seq_along(norms$surface$values))
  named <- c("size", norms$measurements$measurement, components)
  skew <- as.matrix(norms$table[paste0("skew_", 1:4)])
  skew <- skew[rowSums(is.na(skew)) < 4, , drop = FALSE]
  if (!identical(norms$table$name, named) || !all(norms$table$transform %in% c("log", "as is")) ||
        !isTRUE(all(norms$table$se_norm >= 0)) || !isTRUE(all(skew[, c(2, 4)] > 0)) ||
        any(is.infinite(norms$table$bias_norm))) {
    refuse_norm("table.csv", paste("its names are not size, those of measurements.csv and the",
                                   "components, or it has values that no norm has"))
  }
  same <- function(x) isTRUE(all.equal(x, unique(norms$surface$scan$radii)))
  if (!same(norms$settings$radii) || !same(unique(norms$surface$healing$radius))) {
    refuse_norm("healing.csv", "its radii are not those of norms.json")
  }
  rising <- function(x) {
    length(x) == length(limit_levels()) && all(is.finite(x), diff(x) >= 0, x[1] > 0)
  }
  limits <- c(Filter(length, norms$limits), list(norms$surface$scan$quantiles),
              if (length(norms$asymmetry)) list(norms$asymmetry$scan$quantiles))
  if (!isTRUE(all.equal(header$levels, limit_levels())) || !all(vapply(limits, rising, NA))) {
    refuse_norm("norms.json", "its limits are none")
  }
}

#' Whether a basis is one: T' P T = diag(s), and the splines of all faces sum to their number
#' @param rounding Relative.
#' @noRd
check_norm_basis <- function(norms, name, rounding = 1e-6) {
  groups <- norm_sets(norms)[[name]]$groups
  for (sex in names(groups)) {
    n <- sum(norms$counts$n[norms$counts$sex == sex])
    for (basis in groups[[sex]][c("basis", "basis_spread")]) {
      turn <- basis$turn
      k <- length(basis$s)
      square <- identical(dim(turn), c(k, k)) && all(is.finite(turn), is.finite(basis$s))
      bent <- if (square) crossprod(diff(diag(k), differences = 2) %*% turn) - diag(basis$s)
      gram <- if (square) tryCatch(solve(tcrossprod(turn)), error = function(e) NULL)
      if (is.null(gram) || any(abs(bent) > rounding * max(basis$s)) || abs(sum(gram) - n) > 0.5) {
        refuse_norm(paste0("basis-", name, ".csv"),
                    sprintf("it is no basis of the %s of counts.csv", amount(n, "face")))
      }
    }
  }
}

#' Whether the spread of co-ordinates is a mean of those of the ages, and components are axes
#' @param rounding Of loadings.
#' @noRd
check_norm_field <- function(norms, name, rounding = 1e-4) {
  field <- norms[[name]]
  unit <- norms$settings$unit / 10
  refuse <- function(problem) refuse_norm(paste0("components-", name, ".csv"), problem)
  spread <- do.call(rbind, lapply(field$columns$groups, function(one) one$spread))
  low <- exp(apply(spread, 2, min) / 2) - unit
  high <- exp(apply(spread, 2, max) / 2) + unit
  if (!all(field$sd >= low & field$sd <= high)) {
    refuse(sprintf("`sd` is no mean of the spreads in spread-%s.csv", name))
  }
  off <- crossprod(field$vectors) - diag(length(field$values))
  if (any(abs(off) > rounding * sqrt(nrow(field$vectors))) || is.unsorted(-field$values)) {
    refuse("its columns are no axes at right angles")
  }
}

#' Whether mean faces are those of their normals, and of the size of the reference
#'
#' Co-ordinates and their parts along the normals are smoothed apart and agree to 0.7 standard
#' deviations in simulated norms of 120 to 600 faces.
#'
#' @param most Largest difference, in standard deviations.
#' @param ratio Largest ratio of sizes, as in [assess()].
#' @noRd
check_norm_means <- function(norms, most = 3, ratio = 5) {
  xyz <- as.matrix(norms$points[c("x", "y", "z")])
  size <- log(sqrt(sum(sweep(xyz, 2, colMeans(xyz))^2)))
  for (i in seq_len(nrow(norms$ages))) {
    age <- seq(norms$ages$from[i], norms$ages$to[i], length.out = 10)
    sex <- rep(norms$ages$sex[i], 10)
    face <- expected_columns(norms$surface$columns, age, sex)$mean
    along <- expected_columns(norms$surface$along, age, sex)
    off <- normal_part(face, norms$surface$points, norms$surface$normal) - along$mean
    if (any(abs(off) > most * along$sd)) {
      refuse_norm("mean-surface.csv", "its means are not those of mean-surface-along.csv")
    }
    own <- expected_columns(norms$values, age, sex)$mean[, 1]
    if (any(abs(own - size) > log(ratio))) {
      refuse_norm("mean-values.csv", "the size is not that of reference.csv")
    }
  }
}
