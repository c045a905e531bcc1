// Local polynomial fit of a surface about one point, and the principal curvatures of that fit.
// Method: the paper, section 2, with constant and linear terms kept, one refit in the frame of the
// first fit, and nested orders combined by shrinkage (inst/doc, "The method, step by step").
#pragma once
#include <vector>

namespace crestline {

struct FitSettings {
  double radius;           // of the ball; lengths are divided by it inside
  int lowest, highest;     // orders of the nested fits, 2 to 4; equal for a plain fit
  bool forced;             // quadratic terms only: the surface through the vertex, level there
  double shrinkage;        // factor of the variance in the shrinkage weight
  double points_per_term;  // fewest neighbours a coefficient
  double one_sided;        // a neighbourhood whose centroid lies further off than this share of the
                           // radius is fitted with order 3 at most
  double widen, growth;    // where the ball has too few points its radius grows by this factor, up to `widen` times
};

struct Frame {
  double origin[3], t1[3], t2[3], normal[3];
};

constexpr int kTerms = 15;       // of the quartic
constexpr int kDegrees = 9;      // powers 0 to 8

struct LocalFit {
  bool ok = false;
  Frame frame;
  int order = 0;                 // highest order with weight
  int neighbours = 0;
  double slope[2];               // gradient at the point in the frame
  double hessian[3];             // xx, xy, yy, in 1 / length
  double sigma = 0;              // residual standard deviation, in length
  // For the derivative by the neighbours' heights: weights of the orders 2, 3, 4 and the factor.
  double weight[3];
  double factor[kTerms][kTerms]; // lower Cholesky factor of the moment matrix
};

struct PrincipalCurvature {
  double k1, k2, direction1[3], direction2[3], normal[3];
};

// Neighbours' co-ordinates relative to the frame in units of the radius, padded blocks.
struct FitBuffer {
  std::vector<double> x, y, z;
};

// Frame with the given unit normal and two arbitrary tangents.
Frame make_frame(const double* origin, const double* normal);

// Fits about `origin` to the points (x, y, z)[index[0 ... count - 1]]; `normal` starts the frame.
LocalFit fit_surface(const double* origin, const double* normal, const double* x, const double* y,
                     const double* z, const int* index, int count, const FitSettings& settings,
                     FitBuffer& buffer);

PrincipalCurvature principal_curvature(const LocalFit& fit);

// Derivative of (1, 0) H-form along the tangent direction `direction` (3-D, unit), that is of the
// normal curvature there, by the height of each of the points of `buffer` (left by fit_surface).
void curvature_derivative(const LocalFit& fit, const double* direction, const FitSettings& settings,
                          const FitBuffer& buffer, double* derivative);

}  // namespace crestline
