# The face's scheme is read and compiled when the package is installed, and kept with it, see
# once():
# no session waits for it.
if (nzchar(system.file("extdata", "face_scheme", package = "crestline"))) face_scheme()

# Where there is no display rgl would warn twice that it has none; the other engines need none.
.onLoad <- function(libname, pkgname) {
  display <- nzchar(Sys.getenv("DISPLAY")) || .Platform$OS.type == "windows"
  if (!display && is.null(getOption("rgl.useNULL"))) options(rgl.useNULL = TRUE)
}
