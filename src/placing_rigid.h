// A cloud laid on another by rotation, translation and bounded scale, from many starts.
#pragma once
#include <vector>

#include "placing_match.h"

namespace crestline {

// x -> scale * rotation x + shift.
struct Pose {
  double rotation[9];  // column major
  double shift[3];
  double scale;
};

struct RigidSettings {
  double reach[2];       // of the matches, at the first step and at the last
  int steps;
  double cosine;         // least cosine between matched normals
  double kept;           // share of the matches, nearest first, that count
  double scale[2];       // bounds
  double saturation;  // distance from which on a point counts as not matched at all, in the score
  int more;           // most further steps at the last reach, until the pose rests
  double rest;        // root mean square by which a pose at rest moves the points in a step
  double spacing;     // of the fixed points: so far along the surface a match may be at no cost, in
                      // the score
};

// Trimmed iterated closest points from one pose. moving: the points that are moved. rests: whether
// the pose came to rest; with no further steps it is not asked.
Pose fit_pose(const Cloud& moving, const CloudGrid& fixed, Pose pose,
              const RigidSettings& settings, bool* rests);

// Mean over the moved points of min(distance / saturation, 1), 1 where there is no match; the
// distance is that across the fixed surface and, beyond the spacing of its points, along it.
double pose_score(const Cloud& moving, const CloudGrid& fixed, const Pose& pose,
                  const RigidSettings& settings);

}  // namespace crestline
