// Plane cuts of a mesh through two surface points.
#pragma once
#include <functional>
#include <vector>

#include "path_walk.h"

namespace crestline {

// One cut: its crossings in order, its length, and the length-weighted mean of `strength` along it.
struct PlaneCut {
  WalkEnd end;
  double length, strength;
  std::vector<Crossing> crossings;
};

struct CutRequest {
  SurfacePoint from, to;
  const double* normal;    // of the plane, which passes through `from` and `to`
  int side;                // 0: leaves `from` towards `to`, 1: the other way round
  double reach;            // distance from the segment between the ends at which a cut is given up
  const double* strength;  // n, or null
  bool keep_crossings;
};

PlaneCut plane_cut(const Triangulation& mesh, const CutRequest& request);

// The zero line of a function given at the vertices, from one triangle to another, setting out along
// the direction `towards`. NaN stands for "not here": the walk ends as at a border.
struct LevelPath {
  WalkEnd end;
  std::vector<Crossing> crossings;
};

LevelPath level_path(const Triangulation& mesh, int from_face, int to_face, const double* level,
                     const double* towards);

void position(const Triangulation& mesh, const SurfacePoint& p, double* xyz);

}  // namespace crestline
