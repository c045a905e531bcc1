#' crestline: ridge and valley curves of surfaces
#'
#' From a triangulated surface and a few landmarks to the ridge and valley
#' curves that carry most of its shape. Start with [read_specimen()] or
#' [specimen()], look at it with `plot()`, then [ridge_curve()].
#'
#' # Options
#' * `crestline.threads`: number of threads of the loops over vertices, 1 unless set.
#'
#' # Units
#' Every length is in the unit of the mesh (mm for faces by custom); curvatures
#' are in 1 / that unit; angles are in radians; the shape index, strengths' ratios
#' and barycentric weights have no unit.
#'
#' @references
#' Vittert, L., Bowman, A. W. and Katina, S. (2019) A hierarchical curve-based
#' approach to the analysis of manifold data. *Annals of Applied Statistics*
#' 13(4), 2539-2563. \doi{10.1214/19-AOAS1267}. Called "the paper" in these pages;
#' its preprint is titled "Statistical models for manifold data with
#' applications to the human face".
#'
#' @keywords internal
#' @useDynLib crestline, .registration = TRUE
#' @importFrom Rcpp evalCpp
"_PACKAGE"
