// Points slid along their own paths to the least of a quadratic form, one point at a time.
#pragma once
#include <functional>
#include <vector>

#include "path_resample.h"

namespace crestline {

// Which point slides where. The neighbours on its path are other sliders or fixed places.
struct Slider {
  int point;           // row of the configuration
  int track;           // the path that it lies on; segments whose face is negative are no part of the mesh
  double s;            // its place there
  int before, after;   // sliders next to it; -1: none
  double low, high;    // places next to it where there is no slider
  double rest_before, rest_after;  // spacings at which the strain is 0; NaN: a free end, neither strain nor gap
  double gap;          // spacing that neighbours keep
  double tolerance;    // slide below which it counts as at rest
  // On a closed path: its length where the slider before, after, is across the seam, else 0.
  double turn_before, turn_after;
};

struct SlideSettings {
  double strain;  // weight of the squared excess of a spacing over its rest, in the form's unit
  int sweeps;     // most sweeps
};

// One value a sweep, and one for the start.
struct SlideTrace {
  std::vector<double> energy;   // of the form alone
  std::vector<double> strain;
  std::vector<double> longest;  // longest slide of the sweep (0 at the start)
  bool converged = false;
};

// Minimises trace(x' b x) + strain over the sliders' places, cyclically, until all are at rest; b: n x n, symmetric,
// positive semi-definite; x: n x 3, column major, changed in place. Each step is the exact minimiser over one point between its
// neighbours, and is taken only if it lowers the sum. A point that is nearer to a neighbour than the gap at the start may
// stay there, but comes no nearer.
SlideTrace slide_on_tracks(const double* b, int n, double* x, const std::vector<Track>& tracks,
                           std::vector<Slider>& sliders, const SlideSettings& settings,
                           const std::function<void()>& pause);

}  // namespace crestline
