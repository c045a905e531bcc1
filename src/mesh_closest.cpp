#include "mesh_closest.h"

#include <algorithm>
#include <cmath>

#include "geometry.h"

namespace crestline {

namespace {

void measure(const Triangulation& mesh, ClosestPoint& p, const double* to) {
  position(mesh, p.at, p.xyz);
  double gap[3] = {to[0], to[1], to[2]};
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k)
      gap[k] -= p.at.w[c] * corner(mesh, vertex_at(mesh, 3 * p.at.face + c))[k];
  p.distance = std::sqrt(dot(gap, gap));
}

// The closest point of the edge from corner c on.
ClosestPoint on_edge(const Triangulation& mesh, int face, int c, const double* to) {
  const double *a = corner(mesh, vertex_at(mesh, 3 * face + c)),
               *b = corner(mesh, vertex_at(mesh, 3 * face + (c + 1) % 3));
  double edge[3], rel[3];
  for (int k = 0; k < 3; ++k) {
    edge[k] = b[k] - a[k];
    rel[k] = to[k] - a[k];
  }
  double length2 = dot(edge, edge);
  double share = length2 > 0 ? std::min(std::max(dot(rel, edge) / length2, 0.0), 1.0) : 0;
  ClosestPoint out{{face, {0, 0, 0}}, {0, 0, 0}, 0};
  out.at.w[c] = 1 - share;
  out.at.w[(c + 1) % 3] = share;
  measure(mesh, out, to);
  return out;
}

}  // namespace

ClosestPoint closest_on_face(const Triangulation& mesh, int face, const double* to) {
  const double *corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = corner(mesh, vertex_at(mesh, 3 * face + i));
  const double *a = corners[0], *b = corners[1], *c = corners[2];
  double u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = to[k] - a[k];
  }
  double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  ClosestPoint best = on_edge(mesh, face, 0, to);
  for (int e = 1; e < 3; ++e) {
    ClosestPoint here = on_edge(mesh, face, e, to);
    if (here.distance < best.distance) best = here;
  }
  double det = uu * vv - uv * uv;
  if (!(det > 0)) return best;
  double w2 = (vv * wu - uv * wv) / det, w3 = (uu * wv - uv * wu) / det, w1 = 1 - w2 - w3;
  if (!(w1 >= 0 && w2 >= 0 && w3 >= 0)) return best;
  ClosestPoint inside{{face, {w1, w2, w3}}, {0, 0, 0}, 0};
  measure(mesh, inside, to);
  // Of a needle the foot may be anywhere, by rounding: an edge that is as near stands.
  return inside.distance < best.distance ? inside : best;
}

ClosestPoint NearSearch::closest(const SurfacePoint& from, const double* to) {
  ClosestPoint best{from, {0, 0, 0}, 0};
  measure(mesh_, best, to);
  double reach = best.distance;
  ++search_;
  queue_.assign(1, from.face);
  seen_[from.face] = search_;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    int face = queue_[i];
    ClosestPoint here = closest_on_face(mesh_, face, to);
    if (here.distance < best.distance) best = here;
    if (here.distance > reach) continue;
    for (int c = 0; c < 3; ++c) {
      int across = twin_of(mesh_, 3 * face + c);
      if (across < 0 || seen_[face_of(across)] == search_) continue;
      seen_[face_of(across)] = search_;
      queue_.push_back(face_of(across));
    }
  }
  return best;
}

}  // namespace crestline
