# The face's scheme is read and compiled when the package is installed, and kept with it, see
# once():
# no session waits for it.
if (nzchar(system.file("extdata", "face_scheme", package = "crestline"))) face_scheme()
