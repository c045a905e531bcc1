// Generalised Procrustes alignment of complete configurations.
#pragma once
#include <functional>
#include <vector>

namespace crestline {

enum class Scaling { kNone, kUnit, kFull };

struct AlignSettings {
  Scaling scaling;
  // greatest move of a mean point between two rounds, as a share of the mean's size
  double tolerance;
  int rounds;
};

struct Aligned {
  std::vector<double> mean;   // k x dim, column major, in the pose of the reference
  // n: square root of the weighted sum of squares about the weighted centre
  std::vector<double> size;
  std::vector<double> moved;  // by round
  bool converged;
};

// The proper rotation r (dim x dim, column major) that makes the trace of r' h greatest: x r is
// nearest to y where h = x' y. dim 2 or 3. Horn (1987): for dim 3 the largest eigenvector of a 4 x
// 4 matrix, so that flat configurations need no case.
void nearest_rotation(const double* h, int dim, double* r);

// x: k x dim x n, column major, replaced by the aligned configurations: centred; of unit size
// (kUnit), of unit size times the cosine of their angle to the mean (kFull), or of their own
// (kNone). weight: k. reference: k x dim, start and pose. `between`: as of curvature().
Aligned align_configurations(std::vector<double>& x, int k, int dim, int n, const double* weight,
                             const double* reference, const AlignSettings& settings,
                             const std::function<void()>& between);

// x: k x dim x n, replaced by the configurations centred, scaled as above, and each turned onto
// `mean` (k x dim, centred; of unit size if scaled). Returns their sizes before.
std::vector<double> lay_onto(std::vector<double>& x, int k, int dim, int n, const double* weight,
                             const double* mean, Scaling scaling,
                             const std::function<void()>& between);

}  // namespace crestline
