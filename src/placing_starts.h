// Starts for a rigid fit: the template set down on every place of a cloud that stands proud, in
// many turns, scored by one look-up a point.
#pragma once
#include <vector>

#include "placing_match.h"
#include "placing_rigid.h"

namespace crestline {

// How a place lies in the ball about it; points of the cloud weigh 1 - (distance / radius)^2.
struct Mound {
  double normal[3];  // mean, unit; 0 where the normals cancel or the ball is empty
  double height;     // of the place over the centroid of the ball, along that normal
};

// at: 3 x m places.
std::vector<Mound> mounds(const Cloud& cloud, const double* at, int m, double radius);

struct StartSettings {
  int turns;            // about the normal
  std::vector<double> scales;
  double voxel;         // edge of the cells of the look-up; made larger where there would be many
  double reach;         // distance from which on a point counts as not matched
  double spacing;       // of the cloud: half of it costs nothing
  double cosine;        // least cosine between matched normals
  int each;             // most starts of one place
};

struct Start {
  Pose pose;
  double score;  // mean over the template's points of their distance / reach, at most 1
  int place;     // from 0
};

// Template: points, with their normals, given in a frame whose origin is the anchor and whose third
// axis is the anchor's mean normal. cloud: about its centroid, in its own axes; mirrored axes give
// the same starts, as the cells lie evenly about the centroid. at, mound: of the places. The best
// starts first; of equal ones that of the earlier place.
std::vector<Start> search_starts(const Cloud& points, const Cloud& cloud, const double* at,
                                 const std::vector<Mound>& mound, const StartSettings& settings,
                                 void (*between)());

}  // namespace crestline
