// Points slid freely on a mesh to the least of a quadratic form, one point at a time.
#pragma once
#include <functional>
#include <vector>

#include "mesh_closest.h"
#include "template_slide.h"

namespace crestline {

// Minimises trace(x' b x) + 2 trace(x' held) over the n points of x, each on the mesh; b: n x n, symmetric, positive
// semi-definite; x and held: n x 3, column major; x and the points' places `at` change in place. Each step takes a point to the place
// closest to its free minimiser that it can reach without getting farther from it (see NearSearch), so the sum never rises.
// Done when the longest step of a sweep is below `tolerance`, a length. The trace's energy leaves out what
// depends on held points alone.
SlideTrace slide_on_mesh(const Triangulation& mesh, const double* b, int n, double* x, const double* held,
                         std::vector<SurfacePoint>& at, double tolerance, int sweeps,
                         const std::function<void()>& pause);

}  // namespace crestline
