#include "path_coordinates.h"

#include "interrupt.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "geometry.h"

namespace crestline {

namespace {

Vec at(const double* p, int i) {
  const double* q = p + 3 * static_cast<std::size_t>(i);
  return {q[0], q[1], q[2]};
}
// Segments are held in runs with a ball about each, so that most of a long path is passed over at
// once.
constexpr int kRun = 16;

struct Polyline {
  std::vector<Vec> node, tangent;  // tangent of each segment
  std::vector<double> start;       // arc length at each node
  std::vector<Vec> centre;         // of each run's ball, and its radius
  std::vector<double> radius;
  bool closed;                     // ends where it begins
  int segments() const { return static_cast<int>(tangent.size()); }
};

Polyline make_polyline(const double* path, int k, bool closed) {
  Polyline line;
  line.closed = closed;
  line.start.push_back(0);
  for (int i = 0; i < k; ++i) line.node.push_back(at(path, i));
  for (int i = 0; i + 1 < k; ++i) {
    Vec step = line.node[i + 1] - line.node[i];
    double length = std::sqrt(dot(step, step));
    line.tangent.push_back((1 / length) * step);
    line.start.push_back(line.start[i] + length);
  }
  for (int first = 0; first + 1 < k; first += kRun) {
    int last = std::min(first + kRun, k - 1);
    Vec centre = 0.5 * (line.node[first] + line.node[last]);
    double radius = 0;
    for (int i = first; i <= last; ++i) {
      Vec off = line.node[i] - centre;
      radius = std::max(radius, std::sqrt(dot(off, off)));
    }
    line.centre.push_back(centre);
    line.radius.push_back(radius);
  }
  return line;
}

struct Nearest {
  double square = INFINITY, along = 0;
  int segment = 0;
};

// The segments of a run that are nearer than what was found before; of equally near ones the first.
void look_at_run(const Polyline& line, int run, Vec p, Nearest& best) {
  int last = std::min((run + 1) * kRun, line.segments());
  for (int j = run * kRun; j < last; ++j) {
    Vec rel = p - line.node[j];
    double length = line.start[j + 1] - line.start[j];
    double along = dot(rel, line.tangent[j]);
    // The first and last segments go on straight past the ends.
    if (along < 0 && (j > 0 || line.closed)) along = 0;
    if (along > length && (j + 1 < line.segments() || line.closed)) along = length;
    Vec off = rel - along * line.tangent[j];
    double square = dot(off, off);
    if (square < best.square || (square == best.square && j < best.segment)) {
      best.square = square;
      best.along = along;
      best.segment = j;
    }
  }
}

// The first and last run are always looked at: their straight ends reach out of their balls.
Nearest nearest_place(const Polyline& line, Vec p, int guess) {
  Nearest best;
  int runs = static_cast<int>(line.radius.size());
  look_at_run(line, guess, p, best);
  for (int run = 0; run < runs; ++run) {
    if (run == guess) continue;
    if (run > 0 && run + 1 < runs) {
      Vec off = p - line.centre[run];
      double reach = std::sqrt(best.square) + line.radius[run];
      if (dot(off, off) > reach * reach * (1 + 1e-12)) continue;
    }
    look_at_run(line, run, p, best);
  }
  return best;
}

struct Place {
  double s, d;
  Vec tangent;
};

// guess: the run to begin with; changed to that of the place.
Place place_beside(const Polyline& line, const double* normals, Vec p, int& guess) {
  Nearest best = nearest_place(line, p, guess);
  int segment = best.segment, count = line.segments();
  guess = segment / kRun;
  double length = line.start[segment + 1] - line.start[segment];
  Vec tangent = line.tangent[segment];
  if (best.along == 0 && (segment > 0 || line.closed))
    tangent = unit(tangent + line.tangent[(segment + count - 1) % count]);
  if (best.along == length && (segment + 1 < count || line.closed))
    tangent = unit(tangent + line.tangent[(segment + 1) % count]);
  double share = std::min(std::max(best.along / length, 0.0), 1.0);
  Vec normal = (1 - share) * at(normals, segment) + share * at(normals, segment + 1);
  Vec foot = line.node[segment] + best.along * line.tangent[segment];
  double side = dot(p - foot, cross(normal, tangent)), distance = std::sqrt(best.square);
  return {line.start[segment] + best.along, side < 0 ? -distance : distance, tangent};
}

void add(const Place& place, PathCoordinates& out) {
  out.s.push_back(place.s);
  out.d.push_back(place.d);
  out.tangent.insert(out.tangent.end(), {place.tangent.x, place.tangent.y, place.tangent.z});
}

}  // namespace

PathCoordinates path_coordinates(const double* points, int n, const double* path,
                                 const double* normals, int k, bool closed,
                                 const std::function<void()>& between) {
  Patience patience(between);
  Polyline line = make_polyline(path, k, closed);
  PathCoordinates out;
  int guess = 0;
  for (int i = 0; i < n; ++i) {
    if (patience.over()) patience.finish();
    add(place_beside(line, normals, at(points, i), guess), out);
  }
  return out;
}

NearPath near_path(const MeshGraph& graph, const double* path, const double* normals, int k, bool closed,
                   const std::vector<int>& faces, const PathWindow& window,
                   const std::function<void()>& between) {
  const Triangulation& mesh = graph.mesh;
  Polyline line = make_polyline(path, k, closed);
  double reach = window.width + window.margin, low[3], high[3];
  for (int a = 0; a < 3; ++a) {
    low[a] = INFINITY;
    high[a] = -INFINITY;
    for (int i = 0; i < k; ++i) {
      low[a] = std::min(low[a], path[3 * i + a] - reach);
      high[a] = std::max(high[a], path[3 * i + a] + reach);
    }
  }
  std::vector<char> seen(mesh.n, 0);
  std::vector<std::pair<int, Place>> found;
  Patience patience(between);
  int guess = 0;
  auto look = [&](int v) {
    if (seen[v]) return;
    seen[v] = 1;
    const double* p = corner(mesh, v);
    for (int a = 0; a < 3; ++a)
      if (p[a] < low[a] || p[a] > high[a]) return;
    Place place = place_beside(line, normals, {p[0], p[1], p[2]}, guess);
    if (std::fabs(place.d) <= reach && place.s >= -window.margin && place.s <= window.length + window.margin)
      found.push_back({v, place});
  };
  for (int f : faces)
    for (int c = 0; c < 3; ++c) look(vertex_at(mesh, 3 * f + c));
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (patience.over()) patience.finish();
    int v = found[i].first;
    for (int e = graph.graph.start[v]; e < graph.graph.start[v + 1]; ++e) look(graph.graph.neighbour[e]);
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  NearPath out;
  for (const auto& one : found) {
    out.vertex.push_back(one.first);
    add(one.second, out.at);
  }
  return out;
}

std::vector<char> joined_to(const Triangulation& mesh, const std::vector<char>& member,
                            const std::vector<int>& seeds) {
  // Of few among many vertices: only theirs are written.
  std::unique_ptr<int[]> parent(new int[member.size()]);
  std::vector<int> members;
  for (std::size_t v = 0; v < member.size(); ++v)
    if (member[v]) {
      parent[v] = static_cast<int>(v);
      members.push_back(static_cast<int>(v));
    }
  auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (int f = 0; f < mesh.m; ++f) {
    int corner[3];
    for (int c = 0; c < 3; ++c) corner[c] = vertex_at(mesh, 3 * f + c);
    for (int c = 0; c < 3; ++c) {
      int a = corner[c], b = corner[(c + 1) % 3];
      if (member[a] && member[b]) parent[root(a)] = root(b);
    }
  }
  std::vector<char> wanted(member.size(), 0), out(member.size(), 0);
  for (int v : seeds)
    if (member[v]) wanted[root(v)] = 1;
  for (int v : members) out[v] = wanted[root(v)];
  return out;
}

}  // namespace crestline
