#include "path_plane.h"

#include <algorithm>
#include <limits>

namespace crestline {

namespace {

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double value_at(const Triangulation& mesh, const SurfacePoint& p, const double* values) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += p.w[c] * values[mesh.it[3 * p.face + c]];
  return sum;
}

// Length and mean strength of the polyline met so far.
struct Sum {
  double at[3], strength, length = 0, integral = 0;
  void step(const double* to, double next) {
    double d[3] = {to[0] - at[0], to[1] - at[1], to[2] - at[2]};
    double ds = std::sqrt(dot(d, d));
    length += ds;
    integral += ds * (strength + next) / 2;
    for (int a = 0; a < 3; ++a) at[a] = to[a];
    strength = next;
  }
};

// Of the two ways out of the first triangle, the one that leads along `axis` (side 0) or against it.
template <class Value>
int way_out(const Triangulation& mesh, const int* half_edges, Value&& value, const double* axis,
            int side) {
  double along[2];
  for (int k = 0; k < 2; ++k) {
    int h = half_edges[k];
    double fa = value(mesh.it[h]), fb = value(mesh.it[next_half_edge(h)]), share = fa / (fa - fb);
    const double *a = corner(mesh, mesh.it[h]), *b = corner(mesh, mesh.it[next_half_edge(h)]);
    along[k] = 0;
    for (int i = 0; i < 3; ++i) along[k] += axis[i] * (a[i] + share * (b[i] - a[i]));
  }
  int towards = along[0] >= along[1] ? 0 : 1;
  return half_edges[side == 0 ? towards : 1 - towards];
}

}  // namespace

void position(const Triangulation& mesh, const SurfacePoint& p, double* xyz) {
  for (int a = 0; a < 3; ++a) {
    xyz[a] = 0;
    for (int c = 0; c < 3; ++c) xyz[a] += p.w[c] * corner(mesh, mesh.it[3 * p.face + c])[a];
  }
}

PlaneCut plane_cut(const Triangulation& mesh, const CutRequest& r) {
  PlaneCut cut;
  double from[3], to[3], axis[3];
  position(mesh, r.from, from);
  position(mesh, r.to, to);
  for (int a = 0; a < 3; ++a) axis[a] = to[a] - from[a];
  double span = std::sqrt(dot(axis, axis)), offset = dot(r.normal, from);
  for (double& v : axis) v /= span;
  auto value = [&](int v) { return dot(r.normal, corner(mesh, v)) - offset; };
  Sum sum;
  for (int a = 0; a < 3; ++a) sum.at[a] = from[a];
  sum.strength = r.strength ? value_at(mesh, r.from, r.strength) : 0;
  auto keep = [&](int h, int a, int b, double share) {
    const double *p = corner(mesh, a), *q = corner(mesh, b);
    double x[3], rel[3];
    for (int i = 0; i < 3; ++i) {
      x[i] = p[i] + share * (q[i] - p[i]);
      rel[i] = x[i] - from[i];
    }
    double along = std::min(std::max(dot(rel, axis), 0.0), span);
    for (int i = 0; i < 3; ++i) rel[i] -= along * axis[i];
    if (dot(rel, rel) > r.reach * r.reach) return false;
    sum.step(x, r.strength ? r.strength[a] + share * (r.strength[b] - r.strength[a]) : 0);
    if (r.keep_crossings) cut.crossings.push_back({h, share});
    return true;
  };
  int out[3];
  if (r.from.face == r.to.face) {
    cut.end = r.side == 0 ? WalkEnd::arrived : WalkEnd::round;
  } else if (exits(mesh, r.from.face, value, out) == 2) {
    cut.end = walk(mesh, way_out(mesh, out, value, axis, r.side), r.to.face, value, keep);
  } else {
    cut.end = WalkEnd::border;
  }
  cut.length = cut.strength = std::numeric_limits<double>::quiet_NaN();
  if (cut.end == WalkEnd::arrived) {
    sum.step(to, r.strength ? value_at(mesh, r.to, r.strength) : 0);
    cut.length = sum.length;
    cut.strength = sum.integral / sum.length;
  }
  return cut;
}

LevelPath level_path(const Triangulation& mesh, int from_face, int to_face, const double* level,
                     const double* towards) {
  LevelPath path{WalkEnd::border, {}};
  auto value = [&](int v) { return level[v]; };
  int out[3];
  if (from_face == to_face) {
    path.end = WalkEnd::arrived;
  } else if (exits(mesh, from_face, value, out) == 2) {
    auto keep = [&](int h, int, int, double share) {
      if (std::isnan(share)) return false;
      path.crossings.push_back({h, share});
      return true;
    };
    path.end = walk(mesh, way_out(mesh, out, value, towards, 0), to_face, value, keep);
  }
  return path;
}

}  // namespace crestline
