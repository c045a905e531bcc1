// Principal curvatures at chosen vertices of a triangulation.
#pragma once
#include <functional>
#include <vector>

#include "curvature_fit.h"
#include "mesh_neighbours.h"

namespace crestline {

struct Curvature {  // one entry (or three) a target; NaN where there is no fit
  std::vector<double> k1, k2, direction1, direction2, normal, sigma;
  std::vector<int> order, neighbours;
};

// `between` is called on the calling thread every tenth of a second: it may throw to interrupt.
Curvature curvature(const MeshGraph& mesh, const std::vector<int>& targets,
                    const FitSettings& settings, int threads,
                    const std::function<void()>& between);

// Errors of the vertices along the normal: independent with standard deviation sigma (n values), and besides smooth
// in space with standard deviation `smooth` and correlation exp(-(distance / range)^2 / 2). With an axis (a unit vector,
// else null) errors are along it: less of them along the normal of a slope, and distances are seen along the axis.
struct HeightNoise {
  const double* sigma;
  double smooth, range;
  const double* axis;
};

struct CurvatureCovariance {
  std::vector<double> matrix;  // of the functions, square
  double trace;                // sum of the variances of the curvatures themselves, of the independent errors alone
};

// Covariance of linear functions X' k of the normal curvatures k at the targets, when the vertices have errors:
// curvatures of near targets share vertices. directions: 3 x targets, the tangent directions of the normal
// curvatures; design: functions x targets, column major, mostly zeros.
CurvatureCovariance curvature_covariance(const MeshGraph& mesh, const std::vector<int>& targets,
                                         const double* directions, const double* design,
                                         int functions, const HeightNoise& noise,
                                         const FitSettings& settings,
                                         const std::function<void()>& between);

}  // namespace crestline
