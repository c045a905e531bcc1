#include "path_coordinates.h"

#include <algorithm>
#include <cmath>

namespace crestline {

namespace {

struct Vec {
  double x, y, z;
};

Vec at(const double* p, int i) {
  const double* q = p + 3 * static_cast<std::size_t>(i);
  return {q[0], q[1], q[2]};
}
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator*(double f, Vec a) { return {f * a.x, f * a.y, f * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec unit(Vec a) { return (1 / std::sqrt(dot(a, a))) * a; }

struct Polyline {
  std::vector<Vec> node, tangent;  // tangent of each segment
  std::vector<double> start;       // arc length at each node
};

Polyline make_polyline(const double* path, int k) {
  Polyline line;
  line.start.push_back(0);
  for (int i = 0; i < k; ++i) line.node.push_back(at(path, i));
  for (int i = 0; i + 1 < k; ++i) {
    Vec step = line.node[i + 1] - line.node[i];
    double length = std::sqrt(dot(step, step));
    line.tangent.push_back((1 / length) * step);
    line.start.push_back(line.start[i] + length);
  }
  return line;
}

}  // namespace

PathCoordinates path_coordinates(const double* points, int n, const double* path,
                                 const double* normals, int k) {
  Polyline line = make_polyline(path, k);
  PathCoordinates out;
  out.s.resize(n);
  out.d.resize(n);
  out.tangent.resize(3 * static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    Vec p = at(points, i);
    double best = INFINITY, best_along = 0;
    int segment = 0;
    for (int j = 0; j + 1 < k; ++j) {
      Vec rel = p - line.node[j];
      double length = line.start[j + 1] - line.start[j];
      double along = dot(rel, line.tangent[j]);
      // The first and last segments go on straight past the ends.
      if (along < 0 && j > 0) along = 0;
      if (along > length && j + 2 < k) along = length;
      Vec off = rel - along * line.tangent[j];
      double d2 = dot(off, off);
      if (d2 < best) {
        best = d2;
        best_along = along;
        segment = j;
      }
    }
    double length = line.start[segment + 1] - line.start[segment];
    Vec tangent = line.tangent[segment];
    if (best_along == 0 && segment > 0) tangent = unit(tangent + line.tangent[segment - 1]);
    if (best_along == length && segment + 2 < k) tangent = unit(tangent + line.tangent[segment + 1]);
    double share = std::min(std::max(best_along / length, 0.0), 1.0);
    Vec normal = (1 - share) * at(normals, segment) + share * at(normals, segment + 1);
    Vec foot = line.node[segment] + best_along * line.tangent[segment];
    double side = dot(p - foot, cross(normal, tangent));
    out.s[i] = line.start[segment] + best_along;
    out.d[i] = side < 0 ? -std::sqrt(best) : std::sqrt(best);
    out.tangent[3 * i] = tangent.x;
    out.tangent[3 * i + 1] = tangent.y;
    out.tangent[3 * i + 2] = tangent.z;
  }
  return out;
}

std::vector<char> joined_to(const int* it, int m, const std::vector<char>& member,
                            const std::vector<int>& seeds) {
  std::vector<int> parent(member.size());
  for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = static_cast<int>(v);
  auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (int f = 0; f < m; ++f)
    for (int c = 0; c < 3; ++c) {
      int a = it[3 * f + c] - 1, b = it[3 * f + (c + 1) % 3] - 1;
      if (member[a] && member[b]) parent[root(a)] = root(b);
    }
  std::vector<char> wanted(member.size(), 0), out(member.size(), 0);
  for (int v : seeds)
    if (member[v]) wanted[root(v)] = 1;
  for (std::size_t v = 0; v < out.size(); ++v)
    out[v] = member[v] && wanted[root(static_cast<int>(v))];
  return out;
}

}  // namespace crestline
