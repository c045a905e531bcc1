#include "mesh_normals.h"

#include <cmath>
#include <cstddef>

#include "geometry.h"

namespace crestline {

namespace {

struct Corners {
  const double *a, *b, *c;
};

Corners corners(const double* xyz, int rows, const int* v, int first) {
  auto at = [&](int i) { return xyz + rows * static_cast<std::size_t>(v[i] - first); };
  return {at(0), at(1), at(2)};
}

}  // namespace

void face_normals(const double* xyz, int rows, const int* it, int m, int first, double* out) {
  for (int f = 0; f < m; ++f) {
    Corners t = corners(xyz, rows, it + 3 * static_cast<std::size_t>(f), first);
    double normal[3];
    triangle_normal(t.a, t.b, t.c, normal);
    for (int i = 0; i < 3; ++i) out[f + static_cast<std::size_t>(m) * i] = normal[i];
  }
}

std::vector<double> vertex_normals(const double* xyz, int rows, int n, const int* it, int m,
                                   int first) {
  std::vector<double> normals(3 * static_cast<std::size_t>(n), 0);
  for (int f = 0; f < m; ++f) {
    const int* v = it + 3 * static_cast<std::size_t>(f);
    Corners t = corners(xyz, rows, v, first);
    double normal[3];
    triangle_normal(t.a, t.b, t.c, normal);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        normals[3 * static_cast<std::size_t>(v[k] - first) + i] += normal[i];
  }
  for (int v = 0; v < n; ++v) {
    double* p = &normals[3 * static_cast<std::size_t>(v)];
    double length = std::sqrt(dot(p, p));
    for (int i = 0; i < 3; ++i) p[i] = length > 0 ? p[i] / length : 0;
  }
  return normals;
}

}  // namespace crestline
