bias_setting <- "x"
run_bias <- function(n) stop("none")
