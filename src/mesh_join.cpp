#include "mesh_join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh_closest.h"
#include "mesh_topology.h"
#include "path_plane.h"

namespace crestline {

namespace {

// A direction that no scan's planes are square to: points are sorted along it.
constexpr double sweep_along[3] = {0.5321, 0.6180, 0.5788};

double place(const double* p) {
  return sweep_along[0] * p[0] + sweep_along[1] * p[1] + sweep_along[2] * p[2];
}

double distance2(const double* p, const double* q) {
  double total = 0;
  for (int k = 0; k < 3; ++k) total += (p[k] - q[k]) * (p[k] - q[k]);
  return total;
}

struct Placed {
  double at;
  int vertex;
};

std::vector<Placed> placed(const double* xyz, int rows, const std::vector<int>& vertices) {
  std::vector<Placed> out;
  out.reserve(vertices.size());
  for (int v : vertices) out.push_back({place(xyz + static_cast<std::size_t>(rows) * v), v});
  std::sort(out.begin(), out.end(), [](const Placed& a, const Placed& b) {
    return a.at != b.at ? a.at < b.at : a.vertex < b.vertex;
  });
  return out;
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Whether v is within reach of the inner part of the edge from a to b, and where along it.
bool on_edge(const double* a, const double* b, const double* v, double reach, double& along) {
  double edge2 = distance2(a, b), product = 0;
  for (int k = 0; k < 3; ++k) product += (v[k] - a[k]) * (b[k] - a[k]);
  along = edge2 > 0 ? product / edge2 : 0;
  if (!(along > 0 && along < 1)) return false;
  double foot[3];
  for (int k = 0; k < 3; ++k) foot[k] = a[k] + along * (b[k] - a[k]);
  double r2 = reach * reach;
  return distance2(foot, v) <= r2 && distance2(a, v) > r2 && distance2(b, v) > r2;
}

// Faces that can be walked to from `face` within the ball get the mark.
void mark_reached(const Triangulation& mesh, int face, const double* middle, double reach, int mark,
                  std::vector<int>& seen, std::vector<int>& queue) {
  queue.assign(1, face);
  seen[face] = mark;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      int across = twin_of(mesh, 3 * queue[i] + c);
      if (across < 0 || seen[face_of(across)] == mark) continue;
      if (closest_on_face(mesh, face_of(across), middle).distance > reach) continue;
      seen[face_of(across)] = mark;
      queue.push_back(face_of(across));
    }
}

// Single precision, not beyond `x` on the side opposite to `towards`.
float rounded(double x, int towards) {
  return std::nextafter(static_cast<float>(x), towards * std::numeric_limits<float>::infinity());
}

// The part of the sweep that each face takes: read in a row, faster than corners.
void spans(const Triangulation& mesh, std::vector<float>& low, std::vector<float>& high) {
  low.resize(mesh.m);
  high.resize(mesh.m);
  for (int g = 0; g < mesh.m; ++g) {
    double a = place(corner(mesh, vertex_at(mesh, 3 * g))),
           b = place(corner(mesh, vertex_at(mesh, 3 * g + 1))),
           c = place(corner(mesh, vertex_at(mesh, 3 * g + 2)));
    low[g] = rounded(std::min(std::min(a, b), c), -1);
    high[g] = rounded(std::max(std::max(a, b), c), 1);
  }
}

bool beside_box(const Triangulation& mesh, int face, const double* middle, double reach) {
  const double* a = corner(mesh, vertex_at(mesh, 3 * face));
  const double* b = corner(mesh, vertex_at(mesh, 3 * face + 1));
  const double* c = corner(mesh, vertex_at(mesh, 3 * face + 2));
  for (int k = 0; k < 3; ++k) {
    if (std::min(std::min(a[k], b[k]), c[k]) > middle[k] + reach) return true;
    if (std::max(std::max(a[k], b[k]), c[k]) < middle[k] - reach) return true;
  }
  return false;
}

}  // namespace

std::vector<Pair> near_pairs(const double* xyz, int rows, int n, double reach, int most) {
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  std::vector<Placed> sorted = placed(xyz, rows, all);
  std::vector<Pair> out;
  double left = static_cast<double>(most) * n;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].at - sorted[i].at <= reach; ++j) {
      if (--left < 0) return {};
      int v = sorted[i].vertex, w = sorted[j].vertex;
      if (distance2(xyz + static_cast<std::size_t>(rows) * v,
                    xyz + static_cast<std::size_t>(rows) * w) <= reach * reach)
        out.push_back({std::min(v, w), std::max(v, w)});
    }
  return out;
}

std::vector<int> pair_groups(const std::vector<Pair>& pairs, int n) {
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  for (const Pair& p : pairs) {
    int a = root(parent, p.first), b = root(parent, p.second);
    parent[std::max(a, b)] = std::min(a, b);
  }
  for (int i = 0; i < n; ++i) parent[i] = root(parent, i);
  return parent;
}

std::vector<VertexOnEdge> vertices_on_edges(const Triangulation& mesh,
                                            const std::vector<int>& sides, double reach, int most) {
  std::vector<int> ends;
  for (int h : sides) {
    ends.push_back(vertex_at(mesh, h));
    ends.push_back(vertex_at(mesh, next_half_edge(h)));
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Placed> sorted = placed(mesh.vb, mesh.rows, ends);
  std::vector<VertexOnEdge> out;
  double left = static_cast<double>(most) * sides.size();
  for (int h : sides) {
    const double *a = corner(mesh, vertex_at(mesh, h)),
                 *b = corner(mesh, vertex_at(mesh, next_half_edge(h)));
    int third = vertex_at(mesh, next_half_edge(next_half_edge(h)));
    double low = std::min(place(a), place(b)) - reach, high = std::max(place(a), place(b)) + reach;
    auto p = std::lower_bound(sorted.begin(), sorted.end(), low,
                              [](const Placed& x, double at) { return x.at < at; });
    for (; p != sorted.end() && p->at <= high; ++p) {
      if (--left < 0) return {};
      double along;
      if (p->vertex != third && on_edge(a, b, corner(mesh, p->vertex), reach, along))
        out.push_back({h, p->vertex, along});
    }
  }
  return out;
}

std::vector<double> other_sheets(const Triangulation& mesh, const int* piece,
                                 const std::vector<int>& sample, double reach, double parallel,
                                 double hollow) {
  std::vector<double> out;
  std::vector<int> seen(mesh.m, -1), queue;
  std::vector<float> low, high;
  spans(mesh, low, high);
  for (std::size_t s = 0; s < sample.size(); ++s) {
    int face = sample[s], mark = static_cast<int>(s);
    double middle[3], normal[3], other[3], nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      middle[k] = 0;
      for (int c = 0; c < 3; ++c) middle[k] += corner(mesh, vertex_at(mesh, 3 * face + c))[k] / 3;
    }
    face_normal(mesh, face, normal);
    mark_reached(mesh, face, middle, reach, mark, seen, queue);
    float from = rounded(place(middle) - reach, -1), to = rounded(place(middle) + reach, 1);
    for (int g = 0; g < mesh.m; ++g) {
      if (low[g] > to || high[g] < from || seen[g] == mark || beside_box(mesh, g, middle, reach))
        continue;
      ClosestPoint there = closest_on_face(mesh, g, middle);
      double away = there.distance, height = 0;
      if (away > reach || away >= nearest) continue;
      // Above or below, not beside.
      for (int k = 0; k < 3; ++k) height += normal[k] * (there.xyz[k] - middle[k]);
      if (std::abs(height) < parallel * away) continue;
      face_normal(mesh, g, other);
      double cosine = normal[0] * other[0] + normal[1] * other[1] + normal[2] * other[2];
      bool apart = piece[g] != piece[face] || away <= hollow * reach;
      if (cosine >= parallel || (cosine <= -parallel && apart)) nearest = away;
    }
    out.push_back(nearest);
  }
  return out;
}

}  // namespace crestline
