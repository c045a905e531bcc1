# A norm as a folder of text: tables of whole numbers, and a header with their units.

#' Write norms to a folder, and read them
#'
#' The folder has text only, which any program can read: a header `norms.json` and tables of
#' comma-separated values. Coefficients are whole numbers; the header has their units. They were
#' rounded when the norm was fitted, so that z is the same wherever the norm is read.
#'
#' All files are UTF-8 without a byte order mark. Lines end with LF. The decimal mark is a point, an
#' empty cell is a missing value, and text with commas or quotes is in double quotes. Rows and
#' columns of numbers count from 1. Ages and lengths are in the units of the sample: years and mm
#' for faces.
#'
#' [read_norms()] compares every file with its checksum. It also compares the tables with each
#' other: a norm that a wrong program wrote is refused where they do not agree. A digit that leaves
#' all tables in agreement cannot be seen. Files that `norms.json` does not name are not read.
#'
#' `norms.json` has
#' * `format` ("crestline-norms"), `version`, `about` (name, licence, citation, population, device,
#'   and the versions of crestline and R), `scheme`, `n`, `names` (columns of the sample's data);
#' * `sexes`: their names. The column `sex` of `mean-*`, `spread-*` and `basis-*` is the number of
#'   one of them;
#' * `units`: what a whole number is worth. `values`: in `mean-values.csv`; `points`: in all other
#'   `mean-*`; `spread`: in `spread-*`; `loadings` and `sd`: in `components-*`;
#' * `splines`: `k`, `k_spread` and `range` of the splines. `values` are for `mean-values.csv` and
#'   `spread-values.csv`, `points` for all others;
#' * `surface` and `asymmetry` (absent without left-right pairs): the variances of the components as
#'   `values`; the `kernel`: nugget and a weight for each of the `ranges`; `mirrored`: a weight for
#'   each range for the distance to the mirror image of the other point; `rough` (the median
#'   roughness of held-out faces), and the scan's limits;
#' * `limits` of held-out faces by family at the probabilities `levels`, `privacy`, `settings`;
#' * `tables`: the SHA-256 checksum of the bytes of each table. `checksum`: that of `norms.json`
#'   without the line of `checksum`, the comma before it, and the last line end.
#'
#' The tables are:
#' * `reference.csv`: the surface points, see `points` of [fit_norms()]. `point` is `part` and
#'   `index`; `partner` is the row of the point on the other side, `side` is TRUE on the side that
#'   the asymmetry has;
#' * `triangles.csv`: rows of `reference.csv`;
#' * `counts.csv`, `ages.csv`: numbers of faces and range of ages, by sex;
#' * `table.csv`, `measurements.csv`: size, measurements and components, and their definitions (see
#'   [face_measurements()]);
#' * `mean-*.csv`, `spread-*.csv`: a row for each sex and column, with the coefficients `b1` ... of
#'   the splines, and `e`, 100 times the logarithm (base 10) of the smoothing parameter. Within a
#'   sex, rows are in the order of
#'   * `table.csv` for `values`;
#'   * x of all points of `reference.csv`, then y, then z, for `surface`, less the reference itself;
#'   * the points of `reference.csv` for `surface-along`: the part along the normals;
#'   * the same of the points with `side` for `asymmetry` and `asymmetry-along` (the latter of the
#'     asymmetry less the reference; [assess()] does not use it);
#' * `basis-*.csv`: for each sex the bases in which leverages are computed, of means (`of` 1) and of
#'   spreads (`of` 2);
#' * `components-*.csv`: `sd`, the spread of each co-ordinate averaged over the sample, and the
#'   loadings of components, in the order of `mean-surface.csv`;
#' * `healing.csv`: by centre and radius how much more faces vary in a disc than the field makes
#'   expected;
#' * `scan-*.csv`: the spread of the scan's statistic by point and bump: its radius after `r` for
#'   one side, after `b` for both.
#'
#' @section From the tables to z:
#' For an age within the range of the sex in `ages.csv`, and a face that lacks no point:
#' * *Splines*. With k splines over `range` from a to b, the knots are \eqn{a + i d} for i from -3
#'   to k, with \eqn{d = (b - a) / (k - 3)}. The i-th cubic B-spline (i from 1 to k) is
#'   \eqn{B_i = C((age - a) / d + 4 - i)}. For t from 0 to 4,
#'   \eqn{C(t) = (p(t) - 4 p(t - 1) + 6 p(t - 2) - 4 p(t - 3)) / 6}, \eqn{p(t) = \max(t, 0)^3};
#'   otherwise C is 0. At any age the splines sum to 1. Means have `k` splines, spreads `k_spread`.
#' * *Expected value* E of a column: the sum of \eqn{b_i B_i} by its row of `mean-*`, times the
#'   unit. For `surface` add the co-ordinate in `reference.csv`.
#' * *Standard deviation* S of a column: \eqn{\exp(s / 2)}, s being the sum of \eqn{b_i B_i} by its
#'   row of `spread-*`, times the unit.
#' * *Leverage* h of E. Take the rows of `basis-*` of the sex with `of` 1. T is the matrix of their
#'   first k columns `t1` ..., and \eqn{s_j} is the column `s`; `row` counts the rows of both. With
#'   \eqn{g_j}, the sum of \eqn{B_i T_{ij}} over i, h is the sum of
#'   \eqn{g_j^2 / (1 + L s_j)} over j, where \eqn{L = 10^{e / 100}} by `e` of the column's row of
#'   `mean-*`. The leverage \eqn{h_s} of S is the same of the rows with `of` 2, with `k_spread`
#'   splines and `e` of the row of `spread-*`.
#' * *Effective number* of faces: \eqn{1 / \max(h_1, h_2)}, \eqn{h_1} being h of size, \eqn{h_2} the
#'   median of h over all rows of `surface`. [assess()] refuses below `least` of `settings`.
#' * *z* of a value y: of \eqn{q = (y - E) / (S \sqrt{1 + h})} the normal deviate that has the same
#'   probability as q in Student's distribution with \eqn{\max(3, 1 / h_s)} degrees of freedom (in
#'   R `qnorm(pt(q, df))`). If the row of `table.csv` has `skew_1` to `skew_4`, called p, z is then
#'   replaced by \eqn{\sinh(p_4 asinh((z - p_1) / p_2) - p_3)}. The norm's own standard error of z
#'   is \eqn{1.25 \sqrt{h + z^2 h_s / 2}}.
#' * *Values*. Size is the centroid size of the face's points that are in `reference.csv`: the root
#'   of the sum of their squared distances from their mean. Where `transform` is "log", y is the
#'   natural logarithm of the value, and the expected value is \eqn{\exp(E)}. Angles are in degrees.
#'   What errors add is first taken off the value: the `bias` of [measurements()]; of the squared
#'   size 3 times the sum of the squared standard errors of its points. Where errors are not known,
#'   `bias_norm` of `table.csv` is taken off y in place of that. Where `bias_norm` is empty,
#'   nothing is taken off.
#' * *Registration*. The points x of the face (a row each) are laid on the points m of
#'   `reference.csv` by least squares, with scale: they become \eqn{w = f (x - c) R + c_m}, c and
#'   \eqn{c_m} being the means of x and m. With the singular value decomposition \eqn{U D V'} of
#'   \eqn{(x - c)' (m - c_m)}, D from the largest, the rotation R is \eqn{U V'}, and f is the sum
#'   of D over the squared centroid size. If the determinant of \eqn{U V'} is -1, the last column
#'   of U and the last number of D first change their signs, so that no face is mirrored.
#' * *Components*. y of a component is the sum over all rows of `components-surface.csv` of its
#'   loading times \eqn{(w - E) / S} of the co-ordinate, with E and S of `surface`.
#' * *Map*. y of a point is the scalar product of \eqn{w - m} and its normal `nx`, `ny`, `nz` in
#'   `reference.csv`. Its row is that of `surface-along`. `distance` of [assess()] is
#'   \eqn{(y - E) / f}.
#' * *A worse scan*. `z_map` and `z_widened` of [assess()] have \eqn{\sqrt{S^2 + v}} in place of S.
#'   If the points have standard errors se, \eqn{v = \max(0, (f se)^2 - n^2)} for a point, n being
#'   `se_norm` of `reference.csv` (0 if empty). For a value f is 1, se is that of y, and n is
#'   `se_norm` of `table.csv`. Otherwise v depends on `rough`, and needs the field.
#'
#' The scan, the healed face and missing points need the correlation of the whole field. Use
#' [assess()] for them.
#'
#' @param norms A `shape_norms`, as of [fit_norms()].
#' @param dir Path of a folder. [write_norms()] creates it; it must not have other files than those
#'   of a norm.
#' @param share TRUE: the norm must keep the rules of privacy of [fit_norms()], and counts below 5
#'   are merged.
#' @return `write_norms()`: `dir`, invisibly. `read_norms()`: a `shape_norms`. [assess()] gives the
#'   same z as with the norm that was written, to 1e-10.
#' @section Errors: of class `crestline_error`: the folder cannot be written, or has other files;
#'   it is no norm, of another version, damaged, or its tables do not agree (the error names the
#'   file); with `share`, a rule of privacy is not kept, or numbers of the norm were changed.
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
  if (share) norms <- shared_norms(norms)
  tables <- norm_tables(norms)
  check_norm_folder(dir, paste0(names(tables), ".csv"))
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

#' A norm that keeps the rules of privacy, its small counts merged
#'
#' What can be computed from the norm itself is not believed: the number of faces is what the
#' splines of a basis sum to.
#' @noRd
shared_norms <- function(norms) {
  own <- vapply(norms$surface$columns$groups, function(one) {
    sum(solve(tcrossprod(one$basis$turn)))
  }, 0)
  counted <- vapply(names(own), function(sex) sum(norms$counts$n[norms$counts$sex == sex]), 0)
  if (!isTRUE(norms$n == sum(counted)) || any(abs(own - counted) > 0.5)) {
    crestline_abort(sprintf("`norms`: its numbers of faces were changed (it was fitted to %.0f).",
                            sum(own)),
                    "Give the norm as fit_norms() or read_norms() made it.", stage = "norms",
                    class = "crestline_privacy")
  }
  check_shared_components(list(components = length(norms$surface$values)), norms$n)
  check_copies(norms$privacy$closest)
  check_shared(norms)
  check_shared_ages(norms)
  norms$counts <- merged_counts(norms$counts)
  norms
}

#' A folder that has no other files than those that are written over
#' @param files Names of the tables that will be written.
#' @noRd
check_norm_folder <- function(dir, files) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "writing")
  }
  if (!dir.exists(dir) && !suppressWarnings(dir.create(dir, recursive = TRUE))) {
    fail(sprintf("`dir`: %s cannot be made.", dir), "Check the path and the right to write there.")
  }
  # Tables of another norm, if it had more of them, would stay beside those of this one.
  found <- list.files(dir, all.files = TRUE, no.. = TRUE)
  strange <- setdiff(found, c(files, "norms.json"))
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
    loadings <- data.frame(sd = round(field$sd / (norms$settings$unit / 10)),
                           round(field$vectors * 1e4) + 0)
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
       units = list(values = 1e-6, points = norms$settings$unit, spread = 1e-3, loadings = 1e-4,
                    sd = norms$settings$unit / 10),
       splines = list(values = norms$values$size, points = norms$surface$columns$size),
       surface = field(norms$surface), asymmetry = field(norms$asymmetry),
       levels = limit_levels(), limits = norms$limits, privacy = norms$privacy,
       settings = norms$settings)
}

norm_version <- function() 3L
