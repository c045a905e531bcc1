#include "shape_column.h"

#include <algorithm>
#include <cmath>

#include "geometry.h"

namespace crestline {

namespace {

// Inside its triangle, so that a plane through it always crosses that triangle.
SurfacePoint moved_inside(SurfacePoint p, double inside) {
  double total = 0;
  for (double& w : p.w) total += w += inside;
  for (double& w : p.w) w /= total;
  return p;
}

ColumnEnd column_end(WalkEnd end) {
  switch (end) {
    case WalkEnd::arrived: return ColumnEnd::arrived;
    case WalkEnd::border: return ColumnEnd::border;
    case WalkEnd::round: return ColumnEnd::round;
    default: return ColumnEnd::too_far;
  }
}

// The side by which a cut in a plane leaves its first triangle with the outside on its left.
int outer_side(const Triangulation& mesh, int face, const double* axis, const double* plane) {
  double normal[3], left[3];
  face_normal(mesh, face, normal);
  cross(plane, axis, left);
  return dot(left, normal) < 0;
}

}  // namespace

Column fit_column(const Triangulation& mesh, const SurfacePoint& from, const SurfacePoint& to,
                  const double* outside, int rows, const ColumnSettings& settings) {
  Column column{ColumnEnd::no_axis, {}, {}};
  SurfacePoint a = moved_inside(from, settings.inside), b = moved_inside(to, settings.inside);
  CutAxis axis = cut_axis(mesh, a, b);
  if (axis.span == 0) return column;
  if (outside) {
    CutAxis outward = turned_out(axis, outside);
    if (dot(axis.across, outward.across) < std::cos(settings.rim)) axis = outward;
  }
  auto side = [&](const double* plane) {
    return outside ? outer_side(mesh, a.face, axis.axis, plane) : 0;
  };
  PlaneCut best{WalkEnd::border, INFINITY, {}}, middle = best;
  double normal[3], best_angle = 0;
  for (int i = 0; i < settings.angles; ++i) {
    double angle = settings.angles == 1 ? -settings.limit
                                        : settings.limit * (2.0 * i / (settings.angles - 1) - 1);
    plane_normal(axis, angle, normal);
    PlaneCut cut = plane_cut(mesh, {a, b, normal, side(normal), settings.reach * axis.span, false, best.length});
    if (i == (settings.angles - 1) / 2) middle = cut;
    if (!(cut.length < best.length)) continue;
    best = cut;
    best_angle = angle;
  }
  if (!std::isfinite(best.length)) {
    column.end = column_end(middle.end);
    return column;
  }
  plane_normal(axis, best_angle, normal);
  best = plane_cut(mesh, {a, b, normal, side(normal), settings.reach * axis.span, true});
  column.track = track_of(mesh, best, from, to);
  const Track& track = column.track;
  column.end = ColumnEnd::arrived;
  column.points.push_back(from);
  std::vector<double> s = equal_chords(track, rows, settings.chords).s;
  for (int r = 1; r + 1 < rows; ++r) {
    double x[3];
    int segment = point_along(track, s[r], x);
    column.points.push_back(place_in_face(mesh, track.face[segment], x));
  }
  column.points.push_back(to);
  return column;
}

}  // namespace crestline
