# The two co-ordinate frames of 3D Slicer: x to the left and y to the back (LPS), or to the right
# and the front (RAS).

# What a file says of its frame: the words, or the 0 and 1 of old files.
slicer_frame <- function(said, file) {
  frame <- c(LPS = "LPS", "1" = "LPS", RAS = "RAS", "0" = "RAS")[toupper(said)]
  if (is.na(frame)) {
    refuse_landmark_file(file, sprintf('the co-ordinate system is "%s"', said),
                         "Save it as LPS or RAS.")
  }
  unname(frame)
}

change_frame <- function(x, from, to) {
  if (to %in% c(from, "file")) x else x * rep(c(-1, -1, 1), each = nrow(x))
}
