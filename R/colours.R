# Colours: checked, and along a ramp.

check_colours <- function(colour, n, call = rlang::caller_env()) {
  check_colour(colour, "colour", call = call)
  if (!length(colour) %in% c(1L, n)) {
    crestline_abort(sprintf("`colour` has %d values for %d vertices.", length(colour), n),
                    "Give one colour, or one for each vertex.", stage = "picture", call = call)
  }
  rep_len(colour, n)
}

# Colours at shares x of the way through `anchors`.
ramp_colours <- function(x, anchors, missing) {
  out <- rep(missing, length(x))
  known <- !is.na(x)
  out[known] <- grDevices::rgb(grDevices::colorRamp(anchors)(x[known]), maxColorValue = 255)
  out
}
