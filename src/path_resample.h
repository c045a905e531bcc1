// Points along a path of a mesh: at equal chords, and as places in the triangles that it runs
// through.
#pragma once
#include <vector>

#include "path_walk.h"

namespace crestline {

// A path of k points: positions, arc lengths, and the face that holds the segment ending at each.
struct Track {
  std::vector<double> xyz, s;  // 3 k, k
  std::vector<int> face;       // k
};

struct ChordSettings {
  double tolerance;  // relative difference of the chords at which to stop
  int iterations;    // most rounds of correction
  double slowest;    // least share of a correction that is carried out
};

struct Spacing {
  std::vector<double> s;
  bool converged;
};

// Arc lengths of n points, both ends counted, whose straight distances are equal.
Spacing equal_chords(const Track& track, int n, const ChordSettings& settings);

// Position at an arc length; returns the segment, by the index of its end.
int point_along(const Track& track, double s, double* xyz);

// Barycentric weights of a point that lies in a face, clamped to it.
SurfacePoint place_in_face(const Triangulation& mesh, int face, const double* xyz);

}  // namespace crestline
