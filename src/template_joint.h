// Points of curves and patches slid together over a mesh: one form of all, curve points drawn to the lines measured.
#pragma once
#include <functional>
#include <vector>

#include "mesh_closest.h"
#include "template_slide.h"

namespace crestline {

// A point that slides. Its place on the mesh is kept beside.
struct JointPoint {
  int point;          // row of the configuration
  int before, after;  // rows of its neighbours on its curve; -1: none
  // Wanted steps to the point from its neighbours, and on: each over its squared length, so that the product with a step is
  // that step's share of the wanted one.
  double from_before[3], to_after[3];
  // A line through `anchor` draws it, square to the unit vector `across`; `error` is the line's standard error, NaN: no line.
  double anchor[3], across[3], error;
};

struct JointSettings {
  double scale;       // of the form: what a squared offset of one standard error adds to the sum
  double reach;       // offset, in standard errors, at which a line lets go (Tukey's biweight)
  double relaxation;  // factor on steps to a minimiser
  double gap;         // share of a wanted step that neighbours keep
  double tolerance;   // root mean square step of a sweep below which all are at rest, a length
  int halvings;       // how often a step that is not allowed is halved before it is left out
  int sweeps;         // most sweeps
};

// Minimises trace(x' b x) + scale sum of loss(offset / error) over the sliding points, each on the mesh; b: n x n, symmetric,
// positive semi-definite; x: n x 3, column major; x and the places `at` change in place. normals: 3 x number of
// vertices, unit vectors. Loss is Tukey's, u^2 near 0. Each step goes towards the minimiser over one point, then to the place closest
// to it that the point can reach (see NearSearch); it is taken only if it does not raise the sum and keeps the
// gap to both neighbours, or at least makes one that is missed no smaller. The trace's `strain` is the second term.
SlideTrace slide_jointly(const Triangulation& mesh, const double* normals, const double* b, int n, double* x,
                         const std::vector<JointPoint>& points, std::vector<SurfacePoint>& at,
                         const JointSettings& settings, const std::function<void()>& pause);

}  // namespace crestline
