#include "path_plane.h"

#include <algorithm>
#include <limits>

#include "geometry.h"

namespace crestline {

namespace {

constexpr double kRounding = 1e-9;  // share of a length by which a sum of its parts may be off

double distance(const double* a, const double* b) {
  double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return std::sqrt(dot(d, d));
}

void make_unit(double* a) {
  double length = std::max(std::sqrt(dot(a, a)), std::numeric_limits<double>::min());
  for (int i = 0; i < 3; ++i) a[i] /= length;
}

// Of the two ways out of the first triangle, the one that leads along `axis` (side 0) or against
// it.
template <class Value>
int way_out(const Triangulation& mesh, const int* half_edges, Value&& value, const double* axis,
            int side) {
  double along[2];
  for (int k = 0; k < 2; ++k) {
    int h = half_edges[k];
    double fa = value(vertex_at(mesh, h)), fb = value(vertex_at(mesh, next_half_edge(h))), x[3];
    position(mesh, Crossing{h, fa / (fa - fb)}, x);
    along[k] = dot(axis, x);
  }
  int towards = along[0] >= along[1] ? 0 : 1;
  return half_edges[side == 0 ? towards : 1 - towards];
}

// Faces about a corner of a face, over the edges there both ways round.
std::vector<int> faces_about(const Triangulation& mesh, int face, int vertex) {
  std::vector<int> found{face};
  for (int back = 0; back < 2; ++back) {
    int at = face;
    for (;;) {
      int c = 0;
      while (c < 2 && vertex_at(mesh, 3 * at + c) != vertex) ++c;
      int across = twin_of(mesh, 3 * at + (back ? (c + 2) % 3 : c));
      if (across < 0) break;
      at = face_of(across);
      if (std::find(found.begin(), found.end(), at) != found.end()) break;
      found.push_back(at);
    }
  }
  return found;
}

void area_normal(const Triangulation& mesh, int face, double* normal) {
  auto at = [&](int c) { return corner(mesh, vertex_at(mesh, 3 * face + c)); };
  triangle_normal(at(0), at(1), at(2), normal);
}

// Unit normal at a corner of a face: of the triangles about it, weighted by area.
void corner_normal(const Triangulation& mesh, int face, int vertex, double* normal) {
  for (int i = 0; i < 3; ++i) normal[i] = 0;
  for (int f : faces_about(mesh, face, vertex)) {
    double own[3];
    area_normal(mesh, f, own);
    for (int i = 0; i < 3; ++i) normal[i] += own[i];
  }
  make_unit(normal);
}

// Of the triangle's corners, weighted as the end is, so that an end at a corner or on an edge has
// one normal, whichever of the triangles there it was put in.
void end_normal(const Triangulation& mesh, const SurfacePoint& end, double* normal) {
  for (int i = 0; i < 3; ++i) normal[i] = 0;
  for (int c = 0; c < 3; ++c) {
    double own[3];
    corner_normal(mesh, end.face, vertex_at(mesh, 3 * end.face + c), own);
    for (int i = 0; i < 3; ++i) normal[i] += end.w[c] * own[i];
  }
  make_unit(normal);
}

}  // namespace

void position(const Triangulation& mesh, const SurfacePoint& p, double* xyz) {
  for (int a = 0; a < 3; ++a) {
    xyz[a] = 0;
    for (int c = 0; c < 3; ++c) xyz[a] += p.w[c] * corner(mesh, vertex_at(mesh, 3 * p.face + c))[a];
  }
}

void position(const Triangulation& mesh, const Crossing& c, double* xyz) {
  const double *a = corner(mesh, vertex_at(mesh, c.half_edge)),
               *b = corner(mesh, vertex_at(mesh, next_half_edge(c.half_edge)));
  for (int i = 0; i < 3; ++i) xyz[i] = a[i] + c.share * (b[i] - a[i]);
}

CutAxis cut_axis(const Triangulation& mesh, const SurfacePoint& from, const SurfacePoint& to) {
  CutAxis out;
  double a[3], b[3], out_of[3], other[3];
  position(mesh, from, a);
  position(mesh, to, b);
  for (int i = 0; i < 3; ++i) out.axis[i] = b[i] - a[i];
  out.span = std::sqrt(dot(out.axis, out.axis));
  if (!(out.span > 0) || !std::isfinite(out.span)) {
    out.span = 0;
    return out;
  }
  for (double& v : out.axis) v /= out.span;
  end_normal(mesh, from, out_of);
  end_normal(mesh, to, other);
  for (int i = 0; i < 3; ++i) out_of[i] += other[i];
  return turned_out(out, out_of);
}

CutAxis turned_out(const CutAxis& axis, const double* out) {
  CutAxis turned = axis;
  double across[3], along = dot(out, axis.axis);
  for (int i = 0; i < 3; ++i) across[i] = out[i] - along * axis.axis[i];
  if (dot(across, across) < std::numeric_limits<double>::epsilon() * dot(out, out) ||
      dot(out, out) == 0) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
      if (std::fabs(axis.axis[i]) < std::fabs(axis.axis[least])) least = i;
    for (int i = 0; i < 3; ++i) across[i] = i == least;
  }
  cross(axis.axis, across, turned.across);
  make_unit(turned.across);
  return turned;
}

void face_normal(const Triangulation& mesh, int face, double* normal) {
  area_normal(mesh, face, normal);
  make_unit(normal);
}

void plane_normal(const CutAxis& axis, double angle, double* normal) {
  double turned[3];
  cross(axis.axis, axis.across, turned);
  for (int i = 0; i < 3; ++i)
    normal[i] = axis.across[i] * std::cos(angle) + turned[i] * std::sin(angle);
}

PlaneCut plane_cut(const Triangulation& mesh, const CutRequest& r) {
  PlaneCut cut;
  double from[3], to[3], axis[3], at[3], length = 0;
  position(mesh, r.from, from);
  position(mesh, r.to, to);
  for (int a = 0; a < 3; ++a) {
    axis[a] = to[a] - from[a];
    at[a] = from[a];
  }
  double span = std::sqrt(dot(axis, axis)), offset = dot(r.normal, from);
  const double longest = r.longest * (1 + kRounding);
  for (double& v : axis) v /= span;
  auto value = [&](int v) { return dot(r.normal, corner(mesh, v)) - offset; };
  auto keep = [&](int h, int, int, double share) {
    double x[3], rel[3];
    position(mesh, Crossing{h, share}, x);
    for (int i = 0; i < 3; ++i) rel[i] = x[i] - from[i];
    double along = std::min(std::max(dot(rel, axis), 0.0), span);
    for (int i = 0; i < 3; ++i) rel[i] -= along * axis[i];
    if (dot(rel, rel) > r.reach * r.reach) return false;
    length += distance(x, at);
    if (length + distance(x, to) > longest) return false;
    for (int i = 0; i < 3; ++i) at[i] = x[i];
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
  cut.length = cut.end == WalkEnd::arrived ? length + distance(to, at)
                                           : std::numeric_limits<double>::quiet_NaN();
  return cut;
}

Track track_of(const Triangulation& mesh, const PlaneCut& cut, const SurfacePoint& from,
               const SurfacePoint& to) {
  Track track;
  double x[3];
  auto add = [&](int face) {
    double step = track.s.empty() ? 0 : distance(x, &track.xyz[track.xyz.size() - 3]);
    if (!track.s.empty() && step == 0) return;
    track.s.push_back(track.s.empty() ? 0 : track.s.back() + step);
    track.xyz.insert(track.xyz.end(), x, x + 3);
    track.face.push_back(face);
  };
  position(mesh, from, x);
  add(from.face);
  for (const Crossing& c : cut.crossings) {
    position(mesh, c, x);
    add(face_of(c.half_edge));
  }
  position(mesh, to, x);
  add(to.face);
  return track;
}

std::vector<WeightedVertex> mean_weights(const Triangulation& mesh, const Track& track,
                                         double step) {
  std::vector<WeightedVertex> weights;
  int pieces = std::max(1, static_cast<int>(std::ceil(track.s.back() / step)));
  for (int p = 0; p <= pieces; ++p) {
    double x[3], share = (p == 0 || p == pieces ? 0.5 : 1.0) / pieces;
    int segment = point_along(track, track.s.back() * p / pieces, x);
    SurfacePoint at = place_in_face(mesh, track.face[segment], x);
    for (int c = 0; c < 3; ++c)
      if (at.w[c] != 0) weights.push_back({vertex_at(mesh, 3 * at.face + c), share * at.w[c]});
  }
  return weights;
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
