# Prints, one a line, R packages that DESCRIPTION asks for and this R lacks.
#   Rscript tools/packages.R missing   those named in DESCRIPTION
#   Rscript tools/packages.R closure   those, and what they need in turn (asks CRAN)
#   Rscript tools/packages.R install installs them from CRAN into the first library that can be
#   written
# With CRESTLINE_NEEDS=demo only those that crestline does not work without.

# Suggested packages whose current versions ask for a newer R than crestline does.
needs_r <- c(geomorph = "4.4.0", RRPP = "4.4.0")

demo_only <- identical(Sys.getenv("CRESTLINE_NEEDS"), "demo")

read_requirements <- function(kinds = c("Imports", "LinkingTo", if (!demo_only) "Suggests")) {
  fields <- read.dcf("DESCRIPTION", kinds)
  entry <- trimws(unlist(strsplit(fields[!is.na(fields)], ",")))
  entry <- unique(entry[nzchar(entry)])
  version <- ifelse(grepl(">=", entry), sub(".*>=\\s*([0-9.-]+).*", "\\1", entry), "0")
  data.frame(package = trimws(sub("\\(.*", "", entry)), version = version)
}

is_offered <- function(package) {
  package <- package[!package %in% rownames(utils::installed.packages(priority = "base"))]
  package[vapply(package, function(p) {
    is.na(needs_r[p]) || getRversion() >= needs_r[p]
  }, logical(1))]
}

is_missing <- function(package, version) {
  here <- nzchar(system.file(package = package))
  !here || utils::packageVersion(package) < version
}

missing_packages <- function() {
  wanted <- read_requirements()
  wanted <- wanted[wanted$package %in% is_offered(wanted$package), ]
  wanted$package[mapply(is_missing, wanted$package, wanted$version)]
}

with_cran <- function() {
  repos <- getOption("repos")
  if ("@CRAN@" %in% repos) options(repos = c(CRAN = "https://cloud.r-project.org"))
  index <- utils::available.packages()
  if (nrow(index) == 0) stop("CRAN cannot be reached: ", getOption("repos")[[1]])
  index
}

closure <- function(package, index) {
  needs <- tools::package_dependencies(
    package, index, which = c("Depends", "Imports", "LinkingTo"), recursive = TRUE
  )
  found <- unique(c(package, unlist(needs, use.names = FALSE)))
  found <- found[!found %in% rownames(utils::installed.packages(priority = "base"))]
  found[!nzchar(vapply(found, function(p) system.file(package = p), ""))]
}

writable_library <- function() {
  first <- c(.libPaths()[file.access(.libPaths(), 2) == 0], Sys.getenv("R_LIBS_USER"))[[1]]
  library_path <- path.expand(first)
  dir.create(library_path, recursive = TRUE, showWarnings = FALSE)
  library_path
}

# Fails where a package that crestline imports cannot be had, or one that CRAN offers cannot be
# installed.
install_missing <- function(package) {
  offered <- intersect(package, rownames(with_cran()))
  lib <- writable_library()
  .libPaths(c(lib, .libPaths()))
  utils::install.packages(offered, lib = lib, INSTALL_opts = "--strip")
  needed <- c(offered, read_requirements(c("Imports", "LinkingTo"))$package)
  failed <- intersect(missing_packages(), needed)
  if (length(failed)) stop("could not be installed: ", paste(failed, collapse = ", "))
}

mode <- commandArgs(TRUE)[1]
package <- missing_packages()
switch(mode,
  missing = writeLines(package),
  closure = writeLines(closure(package, with_cran())),
  install = install_missing(package),
  stop("say missing, closure or install")
)
