// Plane cuts of a mesh through two surface points.
#pragma once
#include <cmath>
#include <vector>

#include "path_resample.h"
#include "path_walk.h"

namespace crestline {

struct PlaneCut {
  WalkEnd end;
  double length;                    // NaN unless it arrived
  std::vector<Crossing> crossings;  // in order
};

struct CutRequest {
  SurfacePoint from, to;
  const double* normal;    // of the plane, which passes through `from` and `to`
  int side;                // 0: leaves `from` towards `to`, 1: the other way round
  double reach;            // distance from the segment between the ends at which a cut is given up
  bool keep_crossings;
  double longest = INFINITY;  // a cut that will be longer than this is given up
};

PlaneCut plane_cut(const Triangulation& mesh, const CutRequest& request);

// A vertex with the share of a cut's length that its value counts for.
struct WeightedVertex {
  int vertex;
  double weight;
};

// The path of a cut that arrived, repeated places left out.
Track track_of(const Triangulation& mesh, const PlaneCut& cut, const SurfacePoint& from,
               const SurfacePoint& to);

// Weights for the mean along a path of a function given at the vertices: the trapezoidal rule over
// equally spaced places no further apart than `step`.
std::vector<WeightedVertex> mean_weights(const Triangulation& mesh, const Track& track,
                                         double step);

// Axis between two ends, and the direction across it that lies in the surface: the plane at angle
// 0, which holds the mean of the surface's normals at the ends, has it as its normal.
struct CutAxis {
  double axis[3], across[3], span;  // unit vectors; span 0 where the ends are one place
};

CutAxis cut_axis(const Triangulation& mesh, const SurfacePoint& from, const SurfacePoint& to);

// The same axis with the plane at angle 0 holding the direction `out` instead.
CutAxis turned_out(const CutAxis& axis, const double* out);

// Unit normal of a triangle.
void face_normal(const Triangulation& mesh, int face, double* normal);

// Normal of the plane turned by `angle` about the axis.
void plane_normal(const CutAxis& axis, double angle, double* normal);

// The zero line of a function given at the vertices, from one triangle to another, setting out
// along the direction `towards`. NaN stands for "not here": the walk ends as at a border.
struct LevelPath {
  WalkEnd end;
  std::vector<Crossing> crossings;
};

LevelPath level_path(const Triangulation& mesh, int from_face, int to_face, const double* level,
                     const double* towards);

void position(const Triangulation& mesh, const SurfacePoint& p, double* xyz);
void position(const Triangulation& mesh, const Crossing& c, double* xyz);

}  // namespace crestline
