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

// A triangulation as it comes from R, counted from 0.
struct MeshView {
  const double* xyz;  // 3 x n
  int n;
  const int* it;      // 3 x m
  int m;
};

// `between` is called on the calling thread every tenth of a second: it may throw to interrupt.
Curvature curvature(const MeshView& mesh, const std::vector<int>& targets,
                    const FitSettings& settings, int threads,
                    const std::function<void()>& between);

// Variance of linear functions J k of the normal curvatures k at the targets, when every vertex has
// an independent error of standard deviation sigma along the normal; curvatures of near targets
// share vertices. directions: 3 x targets, the tangent directions of the normal curvatures;
// jacobian: functions x targets, column major; sigma: n. Returns one variance a function.
std::vector<double> curvature_variance(const MeshView& mesh, const std::vector<int>& targets,
                                       const double* directions, const double* jacobian,
                                       int functions, const double* sigma,
                                       const FitSettings& settings,
                                       const std::function<void()>& between);

}  // namespace crestline
