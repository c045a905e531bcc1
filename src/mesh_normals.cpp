#include "mesh_normals.h"

#include <cmath>
#include <cstddef>

#include "geometry.h"

namespace crestline {

namespace {

void normal_of(const Triangulation& mesh, int face, double* out) {
  triangle_normal(corner(mesh, vertex_at(mesh, 3 * face)),
                  corner(mesh, vertex_at(mesh, 3 * face + 1)),
                  corner(mesh, vertex_at(mesh, 3 * face + 2)), out);
}

}  // namespace

void face_normals(const Triangulation& mesh, double* out) {
  for (int f = 0; f < mesh.m; ++f) {
    double normal[3];
    normal_of(mesh, f, normal);
    for (int i = 0; i < 3; ++i) out[f + static_cast<std::size_t>(mesh.m) * i] = normal[i];
  }
}

std::vector<double> vertex_normals(const Triangulation& mesh) {
  std::vector<double> normals(3 * static_cast<std::size_t>(mesh.n), 0);
  for (int f = 0; f < mesh.m; ++f) {
    double normal[3];
    normal_of(mesh, f, normal);
    for (int c = 0; c < 3; ++c) {
      double* at = &normals[3 * static_cast<std::size_t>(vertex_at(mesh, 3 * f + c))];
      for (int i = 0; i < 3; ++i) at[i] += normal[i];
    }
  }
  for (int v = 0; v < mesh.n; ++v) {
    double* p = &normals[3 * static_cast<std::size_t>(v)];
    double length = std::sqrt(dot(p, p));
    for (int i = 0; i < 3; ++i) p[i] = length > 0 ? p[i] / length : 0;
  }
  return normals;
}

}  // namespace crestline
