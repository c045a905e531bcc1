#include "mesh_geodesic.h"

#include "interrupt.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace crestline {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-12;  // a gain below this share is none

double distance(const double* a, const double* b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

// Half edges by the vertex that they start from.
struct Corners {
  std::vector<int> start, half_edge;

  Corners(const Triangulation& mesh, int n)
      : start(n + 1, 0), half_edge(3 * static_cast<std::size_t>(mesh.m)) {
    int count = 3 * mesh.m;
    for (int h = 0; h < count; ++h) ++start[vertex_at(mesh, h) + 1];
    for (int v = 0; v < n; ++v) start[v + 1] += start[v];
    std::vector<int> at(start.begin(), start.end() - 1);
    for (int h = 0; h < count; ++h) half_edge[at[vertex_at(mesh, h)]++] = h;
  }
};

// Distance of corner c in the plane, with the source beyond the side ab; given: the distances of a
// and b, and the sides. Infinite where the straight line does not cross that side.
double unfolded(double from_a, double from_b, double ab, double ac, double bc) {
  if (!(ab > 0)) return kInfinite;
  double x = (from_a * from_a - from_b * from_b + ab * ab) / (2 * ab);
  double along = (ac * ac - bc * bc + ab * ab) / (2 * ab);
  double below = std::sqrt(std::max(0.0, from_a * from_a - x * x));
  double above = std::sqrt(std::max(0.0, ac * ac - along * along));
  if (!(below + above > 0)) return kInfinite;
  double crossing = x + (along - x) * below / (below + above);
  if (crossing < 0 || crossing > ab) return kInfinite;
  return std::hypot(along - x, below + above);
}

}  // namespace

std::vector<double> geodesic_distances(const Triangulation& mesh, int n, const SurfacePoint& source,
                                       const std::function<void()>& between) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<double> found(n, kInfinite);
  std::vector<char> settled(
      n, 0);  // has been the nearest once: before, its distance is an edge's, too long to unfold
  auto offer = [&](int vertex, double d) {
    if (!(d < found[vertex] * (1 - kRounding))) return;
    found[vertex] = d;
    queue.push({d, vertex});
  };
  double from[3];
  position(mesh, source, from);
  for (int c = 0; c < 3; ++c) {
    int vertex = vertex_at(mesh, 3 * source.face + c);
    offer(vertex, distance(corner(mesh, vertex), from));
  }
  Corners corners(mesh, n);
  Patience patience(between);
  while (!queue.empty()) {
    if (patience.over()) patience.finish();
    Entry next = queue.top();
    queue.pop();
    int a = next.second;
    if (next.first > found[a]) continue;
    settled[a] = 1;
    for (int i = corners.start[a]; i < corners.start[a + 1]; ++i) {
      int h = corners.half_edge[i], face = h / 3;
      int b = vertex_at(mesh, 3 * face + (h % 3 + 1) % 3),
          c = vertex_at(mesh, 3 * face + (h % 3 + 2) % 3);
      const double *pa = corner(mesh, a), *pb = corner(mesh, b), *pc = corner(mesh, c);
      double ab = distance(pa, pb), ac = distance(pa, pc), bc = distance(pb, pc);
      offer(b, found[a] + ab);
      offer(c, found[a] + ac);
      if (settled[b]) offer(c, unfolded(found[a], found[b], ab, ac, bc));
      if (settled[c]) offer(b, unfolded(found[a], found[c], ac, ab, bc));
    }
  }
  return found;
}

}  // namespace crestline
