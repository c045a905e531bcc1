// Points slid along their own polylines to the least of a quadratic form, one point at a time.
#pragma once
#include <functional>
#include <vector>

#include "path_resample.h"

namespace crestline {

struct Slider {
  int point;          // row of the configuration
  int path;           // the track that it lies on
  double s;           // its place there
  int before, after;  // sliders next to it on its path; -1: the path's own end
  double rest;        // spacing at which the strain is 0
};

struct SlideSettings {
  double strain;     // weight of the squared excess of a spacing over its rest, in the form's unit
  double gap;        // neighbours keep this share of the rest spacing between them
  double tolerance;  // done when the longest slide of a sweep is below this share of its rest spacing
  int sweeps;        // most sweeps
};

// One value a sweep, and one for the start.
struct SlideTrace {
  std::vector<double> energy;   // of the form alone
  std::vector<double> strain;
  std::vector<double> longest;  // longest slide of the sweep (0 at the start)
  bool converged = false;
};

// Minimises trace(x' b x) + strain over the sliders' places, cyclically; b: n x n, symmetric, positive semi-definite; x: n x 3,
// column major, changed in place. Each step is the exact minimiser over one point between its neighbours, and is taken only if it
// lowers the sum. A point that is nearer to a neighbour than the gap at the start may stay there, but comes no nearer.
SlideTrace slide_on_paths(const double* b, int n, double* x, const std::vector<Track>& paths,
                          std::vector<Slider>& sliders, const SlideSettings& settings,
                          const std::function<void()>& pause);

}  // namespace crestline
