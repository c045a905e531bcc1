# A norm from a folder: every table is compared with its checksum before it is used.

#' @rdname write_norms
#' @export
read_norms <- function(dir) {
  check_given()
  check_norm_dir(dir)
  header <- read_norm_header(dir)
  tables <- lapply(stats::setNames(nm = names(header$tables)), function(file) {
    read_norm_table(file.path(dir, file), header$tables[[file]])
  })
  names(tables) <- sub("[.]csv$", "", names(tables))
  norms <- tryCatch(checked_norms(header, tables), error = function(e) {
    if (inherits(e, "crestline_error")) rlang::cnd_signal(e)
    refuse_norm("norms.json", "its tables do not fit each other")
  })
  for (name in intersect(c("surface", "asymmetry"), names(Filter(Negate(is.null), norms)))) {
    tryCatch(prepared_field(norms, name), error = function(e) {
      refuse_norm("norms.json", "its kernel is not positive definite")
    })
  }
  norms
}

#' A norm whose tables were compared with its header and with each other
#' @noRd
checked_norms <- function(header, tables) {
  columns <- norm_columns(header)
  lacking <- setdiff(names(columns), names(tables))
  strange <- setdiff(names(tables), c(names(columns), "measurements"))
  if (length(lacking)) refuse_norm("norms.json", sprintf("it names no %s.csv", lacking[1]))
  if (length(strange)) refuse_norm("norms.json", sprintf("no norm has a %s.csv", strange[1]))
  for (name in names(tables)) {
    tables[[name]] <- typed_norm_table(tables[[name]], name, columns[[name]])
  }
  check_norm_rows(header, tables)
  norms <- norms_from_tables(header, tables)
  check_norm_numbers(norms)
  validate_shape_norms(norms)
  check_norm_agreement(norms, header)
  norms
}

check_norm_dir <- function(dir) {
  if (is_path(dir) && dir.exists(dir)) return(invisible())
  file <- is_path(dir) && file.exists(dir)
  crestline_abort(
    sprintf("`dir`: %s %s.", if (file) "this is no folder:" else "there is no folder",
            describe_value(dir)),
    if (file && grepl("[.]zip$", dir, ignore.case = TRUE)) "Unpack it, and give the folder." else
      if (file) "Give the folder that it is in." else
        sprintf("Check the path; the working directory is %s.", getwd()),
    stage = "reading", call = NULL
  )
}

#' What is wrong with a file whose checksum does not fit
#' @noRd
refuse_changed <- function(file) {
  bytes <- readBin(file, "raw", file.size(file))
  if (identical(utils::head(bytes, 3), as.raw(c(0xef, 0xbb, 0xbf)))) {
    refuse_norm(file, "a byte order mark was put before it", "Copy the folder without changes.")
  }
  if (any(bytes == as.raw(13))) {
    refuse_norm(file, "its line ends were changed to those of Windows",
                "Copy the folder as a zip, or as binary files.")
  }
  refuse_norm(file, "it was changed: its checksum does not fit")
}

read_norm_header <- function(dir) {
  file <- file.path(dir, "norms.json")
  if (!file.exists(file)) refuse_norm(dir, "it has no norms.json", "Give the folder of a norm.")
  text <- paste(readLines(file, warn = FALSE, encoding = "UTF-8"), collapse = "\n")
  header <- tryCatch(jsonlite::fromJSON(text), error = function(e) {
    refuse_norm(file, "it is no JSON, or cut short")
  })
  if (!is.list(header) || !identical(header$format, "crestline-norms")) {
    refuse_norm(file, "it is no norm of crestline", "Give the folder of a norm.")
  }
  version <- header$version
  if (!is.numeric(version) || length(version) != 1 || version != norm_version()) {
    old <- is.numeric(version) && isTRUE(version < norm_version())
    refuse_norm(file, sprintf("it is of version %s, this crestline reads %d",
                              describe_value(version), norm_version()),
                if (old) "Fit and write it again." else "Update crestline.")
  }
  # The checksum is of the text without its own line.
  plain <- sub(",\n  \"checksum\": \"[0-9a-f]*\"", "", text)
  if (!identical(cli::hash_sha256(plain), header$checksum)) {
    refuse_norm(file, "it was changed: its checksum does not fit")
  }
  header
}

read_norm_table <- function(file, checksum) {
  if (!grepl("^[a-z-]+[.]csv$", basename(file))) refuse_norm(file, "it has a strange name")
  if (!file.exists(file)) refuse_norm(file, "it is missing")
  if (!identical(cli::hash_file_sha256(file), checksum)) refuse_changed(file)
  # A row that is too long would move all columns, one that is too short end with empty cells.
  tryCatch(
    utils::read.table(file, header = TRUE, sep = ",", quote = "\"", comment.char = "",
                      fill = FALSE, encoding = "UTF-8", na.strings = "", colClasses = "character",
                      check.names = FALSE, row.names = NULL),
    error = function(e) {
      refuse_norm(file, "its rows have different numbers of cells, or it is empty")
    }
  )
}

#' @return A `shape_norms`.
#' @noRd
norms_from_tables <- function(header, tables) {
  points <- tables$reference
  points$index <- as.character(points$index)
  sexes <- as.character(header$sexes)
  # A setting that is newer than the file has its default.
  settings <- utils::modifyList(unclass(norm_settings()), header$settings)
  field <- function(name) {
    if (is.null(header[[name]])) return(NULL)
    own <- header[[name]]
    side <- if (name == "surface") rep(TRUE, nrow(points)) else points$side
    unit <- header$units$points
    xyz <- as.matrix(points[side, c("x", "y", "z")])
    off <- if (name == "surface") round(as.vector(xyz) / unit) else 0
    loadings <- as.matrix(tables[[paste0("components-", name)]])
    size <- header$splines$points
    by_age <- lapply(own$by_age, function(x) matrix(x, ncol = length(own$radii)))
    list(points = xyz, normal = as.matrix(points[side, c("nx", "ny", "nz")]),
         columns = splines_from_tables(name, size, unit, off, tables, sexes),
         along = splines_from_tables(paste0(name, "-along"), size, unit, 0, tables, sexes),
         sd = unname(loadings[, 1]) * header$units$sd,
         vectors = unname(loadings[, -1, drop = FALSE]) * 1e-4,
         values = own$values, kernel = own$kernel, mirrored = own$mirrored, ranges = own$ranges,
         partner = if (name == "surface" && length(header$asymmetry)) points$partner,
         scan = list(radii = own$radii, both = own$both,
                     s = unname(as.matrix(tables[[paste0("scan-", name)]])), by_age = by_age,
                     size = own$age_splines, quantiles = own$quantiles),
         rough = own$rough, healing = if (name == "surface") tables$healing)
  }
  structure(
    list(points = points, triangles = unname(t(as.matrix(tables$triangles))), n = header$n,
         ages = tables$ages, counts = tables$counts, names = unlist(header$names),
         measurements = tables$measurements, table = tables$table,
         values = splines_from_tables("values", header$splines$values, 1e-6, 0, tables, sexes),
         surface = field("surface"), asymmetry = field("asymmetry"), limits = header$limits,
         privacy = header$privacy, settings = settings, scheme = header$scheme,
         about = header$about, cache = new.env(parent = emptyenv())),
    class = "shape_norms"
  )
}

splines_from_tables <- function(name, size, unit, off, tables, sexes) {
  table <- function(what) tables[[paste0(what, "-", name)]]
  groups <- lapply(seq_along(sexes), function(i) {
    rows <- function(what) table(what)[table(what)$sex == i, ]
    coefficients <- function(what) unname(as.matrix(rows(what)[-(1:2)]))
    basis <- function(of, k) {
      own <- rows("basis")
      own <- own[own$of == of, ]
      list(turn = unname(as.matrix(own[paste0("t", seq_len(k))])), s = own$s)
    }
    list(n = NA_integer_, mean = t((coefficients("mean") + off) * unit),
         lambda = 10^(rows("mean")$e / 100), basis = basis(1, size$k),
         spread = t(coefficients("spread") * 1e-3), lambda_spread = 10^(rows("spread")$e / 100),
         basis_spread = basis(2, size$k_spread))
  })
  list(size = size, groups = stats::setNames(groups, sexes))
}

#' Numbers that no norm has
#' @noRd
check_norm_numbers <- function(norms) {
  sets <- norm_sets(norms)
  for (name in names(sets)) {
    for (one in sets[[name]]$groups) {
      numbers <- unlist(one[c("mean", "lambda", "spread", "lambda_spread", "basis",
                              "basis_spread")])
      if (!all(is.finite(numbers))) {
        refuse_norm(paste0("mean-", name, ".csv"), "it has numbers that are not finite")
      }
    }
  }
  healing <- norms$surface$healing[c("at", "radius", "base", "peak")]
  if (!all(is.finite(unlist(healing)), healing$at %in% seq_len(nrow(norms$points)))) {
    refuse_norm("healing.csv", "it has numbers that are not finite, or no points of this norm")
  }
  r <- norms$points[c("r_xy", "r_xz", "r_yz")]
  if (!all(is.finite(unlist(r)), 1 - rowSums(r^2) + 2 * r[[1]] * r[[2]] * r[[3]] > 0)) {
    refuse_norm("reference.csv", "its correlations of co-ordinates are none")
  }
  for (name in c("surface", "asymmetry")) {
    field <- norms[[name]]
    if (is.null(field)) next
    positive <- c(field$sd, field$values, field$scan$s, field$kernel[1], field$ranges)
    if (!all(is.finite(positive) & positive > 0)) {
      refuse_norm(paste0("components-", name, ".csv"), "a spread is not above 0")
    }
    if (!is_kernel(field)) refuse_norm("norms.json", "its kernel is none")
  }
}
