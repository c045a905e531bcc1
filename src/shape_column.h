// A column of a patch: the shortest of the plane cuts near the surface's normal, divided at equal
// chords.
#pragma once
#include <vector>

#include "path_plane.h"
#include "path_resample.h"

namespace crestline {

struct ColumnSettings {
  double limit;   // greatest angle from the plane of the normals at the ends
  int angles;     // planes that are tried
  double reach;   // distance from the straight line between the ends, as a share of its length
  double rim;  // angle of the normals at the ends from a known outside above which they are dropped
  double inside;  // weight by which the ends are kept off edges and corners for the walk
  ChordSettings chords;
};

enum class ColumnEnd { arrived, border, round, too_far, no_axis };

struct Column {
  ColumnEnd end;                     // unless arrived: how the plane at angle 0 ended
  std::vector<SurfacePoint> points;  // rows of them, the ends as given
  Track track;                       // the cut that they lie on
};

// outside: direction out of the surface between the ends where it is known, else null. On a sharp
// rim the normals at the ends are those of one wall or the other: where they are far from the
// outside they are dropped for it, and each cut leaves by the side that keeps it on the outer wall.
Column fit_column(const Triangulation& mesh, const SurfacePoint& from, const SurfacePoint& to,
                  const double* outside, int rows, const ColumnSettings& settings);

}  // namespace crestline
