#' @references Vittert, L., Bowman, A. W. and Katina, S. (2019) A hierarchical curve-based approach
#'   to the analysis of manifold data. *Annals of Applied Statistics* 13(4), 2539-2563,
#'   \doi{10.1214/19-AOAS1267} ("the paper"), <%= where %>.
