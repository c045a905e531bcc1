#include "mesh_crop.h"

#include <algorithm>
#include <cmath>

namespace crestline {

std::vector<int> vertices_in_box(const double* vb, int rows, int n, const double* low,
                                 const double* high) {
  std::vector<int> inside;
  for (int v = 0; v < n; ++v) {
    const double* p = vb + rows * static_cast<std::size_t>(v);
    if (p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] && p[1] <= high[1] && p[2] >= low[2] &&
        p[2] <= high[2])
      inside.push_back(v);
  }
  return inside;
}

Crop crop_mesh(const Triangulation& mesh, const std::vector<int>& wanted, double margin) {
  const int n = mesh.n;
  auto at = [&](int v) { return corner(mesh, v); };
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int v : wanted)
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], at(v)[a] - margin);
      high[a] = std::max(high[a], at(v)[a] + margin);
    }
  constexpr int kOutside = -2, kInside = -1;
  std::vector<int> local(n, kOutside);
  for (int v : vertices_in_box(mesh.vb, mesh.rows, n, low, high)) local[v] = kInside;
  std::vector<char> member(n, 0);
  std::vector<int> faces;
  for (int f = 0; f < mesh.m; ++f) {
    int v[3];
    for (int c = 0; c < 3; ++c) v[c] = vertex_at(mesh, 3 * f + c);
    if (local[v[0]] == kOutside && local[v[1]] == kOutside && local[v[2]] == kOutside) continue;
    faces.push_back(f);
    for (int c = 0; c < 3; ++c) member[v[c]] = 1;
  }
  for (int v : wanted) member[v] = 1;
  Crop out;
  for (int v = 0; v < n; ++v) {
    if (!member[v]) continue;
    local[v] = static_cast<int>(out.vertex.size());
    out.vertex.push_back(v);
    out.xyz.insert(out.xyz.end(), at(v), at(v) + 3);
  }
  out.it.reserve(3 * faces.size());
  for (int f : faces)
    for (int c = 0; c < 3; ++c) out.it.push_back(local[vertex_at(mesh, 3 * f + c)]);
  out.local.reserve(wanted.size());
  for (int v : wanted) out.local.push_back(local[v]);
  return out;
}

Triangulation view_of(const Crop& crop) {
  return {crop.xyz.data(), 3, static_cast<int>(crop.vertex.size()), crop.it.data(), nullptr,
          static_cast<int>(crop.it.size() / 3), 0};
}

}  // namespace crestline
