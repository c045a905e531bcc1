# A norm as a folder of text: tables of whole numbers, and a header with their units.

#' Write norms to a folder, and read them
#'
#' The folder has text only, which any program can read: a header `norms.json` and tables of
#' comma-separated values. Coefficients are whole numbers; the header has their units. They were
#' rounded when the norm was fitted, so that z is the same wherever the norm is read. To compute a
#' mean, multiply cubic B-splines of age (equidistant knots over `range`) by the coefficients; a
#' standard deviation is the exponential of half the sum for the spread.
#'
#' `norms.json` has `format`, `version`, `about` (name, licence, citation, population, device, and
#' the version of crestline), `scheme`, `n`, `sexes`, `units`, `splines`, `surface` and `asymmetry`
#' (of each the variances of the components as `values`, the `kernel`: nugget and a weight a range,
#' `mirrored`: a weight a range for the distance to the mirror image of the other point, and the
#' scan's limits), `limits`, `privacy`, `settings`, `tables` (the SHA-256 checksum of each), and its
#' own `checksum`. The tables are:
#' * `reference.csv`: the surface points, see `points` of [fit_norms()];
#' * `triangles.csv`: rows of `reference.csv`;
#' * `counts.csv`, `ages.csv`: numbers of faces and range of ages, by sex;
#' * `table.csv`, `measurements.csv`: size, measurements and components, and their definitions;
#' * `mean-*.csv`, `spread-*.csv`: coefficients of splines by column and sex, with `e`, the
#'   logarithm (base 10, in hundredths) of the smoothing parameter. Means of points are relative to
#'   the reference. The sets are `values`, `surface`, `surface-along` (along the normals),
#'   `asymmetry` and `asymmetry-along`;
#' * `basis-*.csv`: the bases in which leverages are computed;
#' * `components-*.csv`: mean spread and loadings of co-ordinates (all x first), in 0.0001;
#' * `healing.csv`: by centre and radius how much more faces vary in a disc than the field makes
#'   expected;
#' * `scan-*.csv`: the spread of the scan's statistic by point and bump: its radius after `r` for
#'   one side, after `b` for both.
#'
#' @param norms A `shape_norms`, as of [fit_norms()].
#' @param dir Path of a folder. [write_norms()] creates it; it must not have other files than those
#'   of a norm.
#' @param share TRUE: the norm must keep the rules of privacy of [fit_norms()], and counts below 5
#'   are merged.
#' @return `write_norms()`: `dir`, invisibly. `read_norms()`: a `shape_norms`. [assess()] gives the
#'   same z as with the norm that was written, to 1e-10.
#' @section Errors: of class `crestline_error`: the folder cannot be written, or has other files;
#'   it is no norm, of a newer version, or damaged (the error names the file); with `share`, a rule
#'   of privacy is not kept.
#' @inheritSection fit_norms Privacy
#' @template glossary
#' @template experimental
#' @seealso [fit_norms()], [assess()]
#' @examples
#' \donttest{
#' cohort <- simulate_cohort(120, ages = c(5, 15), seed = 1)
#' norms <- fit_norms(cohort$sample, ~ s(age, by = sex), cohort$data,
#'                    about = list(name = "simulated", licence = "CC0"),
#'                    settings = norm_settings(folds = 2))
#' dir <- tempfile()
#' write_norms(norms, dir)
#' list.files(dir)
#' read_norms(dir)
#' }
#' @export
write_norms <- function(norms, dir, share = FALSE) {
  check_given()
  check_class(norms, "shape_norms", "norms", "fit_norms() or read_norms()")
  check_flags(share)
  if (!is_path(dir)) {
    refuse_argument("dir", dir, "Give the path of one folder.")
  }
  if (share) {
    check_shared_components(list(components = length(norms$surface$values)), norms$n)
    check_shared(norms)
    norms$counts <- merged_counts(norms$counts)
  }
  check_norm_folder(dir)
  tables <- norm_tables(norms)
  for (name in names(tables)) {
    write_content(csv_table(tables[[name]]), file.path(dir, paste0(name, ".csv")))
  }
  files <- paste0(names(tables), ".csv")
  header <- norm_header(norms)
  header$tables <- stats::setNames(as.list(cli::hash_file_sha256(file.path(dir, files))), files)
  header$checksum <- header_checksum(header)
  write_content(header_text(header), file.path(dir, "norms.json"))
  invisible(dir)
}

check_norm_folder <- function(dir) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "writing")
  }
  if (!dir.exists(dir) && !suppressWarnings(dir.create(dir, recursive = TRUE))) {
    fail(sprintf("`dir`: %s cannot be made.", dir), "Check the path and the right to write there.")
  }
  known <- paste0("^(reference|triangles|counts|ages|table|measurements|healing)[.]csv$|",
                  "^(mean|spread|basis|components|scan)-[a-z-]+[.]csv$|^norms[.]json$")
  found <- list.files(dir, all.files = TRUE, no.. = TRUE)
  strange <- found[!grepl(known, found)]
  if (length(strange)) {
    fail(sprintf("`dir`: %s has other files: %s.", dir, shorten(strange)), "Give a new folder.")
  }
}

header_text <- function(header) {
  as.character(jsonlite::toJSON(header, auto_unbox = TRUE, digits = NA, pretty = TRUE,
                                null = "null", na = "null"))
}

#' SHA-256 of the header's text without its own checksum
#' @noRd
header_checksum <- function(header) {
  header$checksum <- NULL
  cli::hash_sha256(header_text(header))
}

#' The sets of splines of a norm: where they are, and the unit of their coefficients
#' @noRd
norm_sets <- function(norms) {
  sets <- list(values = norms$values, surface = norms$surface$columns,
               `surface-along` = norms$surface$along)
  if (!is.null(norms$asymmetry)) {
    sets <- c(sets, list(asymmetry = norms$asymmetry$columns,
                         `asymmetry-along` = norms$asymmetry$along))
  }
  sets
}

#' All tables of a norm, a list of data frames by name of the file
#' @noRd
norm_tables <- function(norms) {
  triangles <- as.data.frame(t(norms$triangles))
  names(triangles) <- c("v1", "v2", "v3")
  tables <- list(reference = norms$points, triangles = triangles, counts = norms$counts,
                 ages = norms$ages, table = norms$table, healing = norms$surface$healing)
  if (NROW(norms$measurements)) tables$measurements <- norms$measurements
  sets <- norm_sets(norms)
  centre <- as.vector(as.matrix(norms$points[c("x", "y", "z")]))
  for (name in names(sets)) {
    unit <- if (name == "values") 1e-6 else norms$settings$unit
    off <- if (name == "surface") round(centre / unit) else 0
    parts <- spline_tables(sets[[name]], unit, off)
    tables[paste0(c("mean-", "spread-", "basis-"), name)] <- parts
  }
  for (name in intersect(c("surface", "asymmetry"), names(sets))) {
    field <- norms[[name]]
    # + 0: no negative zeros
    loadings <- data.frame(sd = round(field$sd * 1e4), round(field$vectors * 1e4) + 0)
    tables[[paste0("components-", name)]] <- stats::setNames(
      loadings, c("sd", paste0("v", seq_len(ncol(field$vectors))))
    )
    s <- as.data.frame(field$scan$s)
    names(s) <- paste0(ifelse(field$scan$both, "b", "r"), field$scan$radii)
    tables[[paste0("scan-", name)]] <- s
  }
  tables
}

#' Coefficients and bases of a set of splines as three tables
#' @param off q: whole numbers that are taken off the means.
#' @noRd
spline_tables <- function(fit, unit, off) {
  stack <- function(make) {
    each <- lapply(seq_along(fit$groups), function(i) cbind(sex = i, make(fit$groups[[i]])))
    do.call(rbind, each)
  }
  numbered <- function(x, letter) {
    x <- as.data.frame(x)
    stats::setNames(x, paste0(letter, seq_along(x)))
  }
  coefficients <- function(coef, lambda, unit, off) {
    cbind(e = round(100 * log10(lambda)), numbered(t(round(coef / unit)) - off + 0, "b"))
  }
  basis <- function(one) {
    rbind(cbind(of = 1, row = seq_along(one$basis$s), s = one$basis$s,
                padded(one$basis$turn, fit$size$k)),
          cbind(of = 2, row = seq_along(one$basis_spread$s), s = one$basis_spread$s,
                padded(one$basis_spread$turn, fit$size$k)))
  }
  list(stack(function(one) coefficients(one$mean, one$lambda, unit, off)),
       stack(function(one) coefficients(one$spread, one$lambda_spread, 1e-3, 0)),
       stack(function(one) as.data.frame(basis(one))))
}

#' A matrix with columns t1 ... of the widest
#' @noRd
padded <- function(x, columns) {
  wide <- matrix(NA_real_, nrow(x), max(columns, ncol(x)))
  wide[, seq_len(ncol(x))] <- x
  colnames(wide) <- paste0("t", seq_len(ncol(wide)))
  wide
}

#' The header of a norm, without checksums
#' @noRd
norm_header <- function(norms) {
  field <- function(one) {
    if (is.null(one)) return(NULL)
    list(values = I(one$values), kernel = I(one$kernel), mirrored = I(one$mirrored),
         ranges = I(one$ranges), rough = one$rough, radii = I(one$scan$radii),
         both = I(one$scan$both), quantiles = I(one$scan$quantiles),
         by_age = lapply(one$scan$by_age, function(x) x), age_splines = one$scan$size)
  }
  list(format = "crestline-norms", version = norm_version(), about = norms$about,
       scheme = norms$scheme, n = norms$n, sexes = I(norms$ages$sex), names = as.list(norms$names),
       units = list(values = 1e-6, points = norms$settings$unit, spread = 1e-3, loadings = 1e-4),
       splines = list(values = norms$values$size, points = norms$surface$columns$size),
       surface = field(norms$surface), asymmetry = field(norms$asymmetry),
       levels = limit_levels(), limits = norms$limits, privacy = norms$privacy,
       settings = norms$settings)
}

norm_version <- function() 3L
