#include "mesh_bend.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry.h"

namespace crestline {

std::vector<double> face_bend(const Triangulation& mesh, const double* normals) {
  const double degrees = 180 / std::acos(-1.0);
  const double* vb = mesh.vb;
  std::vector<double> bend(mesh.m, 0.0);
  for (int f = 0; f < mesh.m; ++f) {
    std::size_t at[3];
    for (int c = 0; c < 3; ++c)
      at[c] = mesh.rows * static_cast<std::size_t>(vertex_at(mesh, 3 * f + c));
    double own[3], mean[3];
    triangle_normal(vb + at[0], vb + at[1], vb + at[2], own);
    for (int i = 0; i < 3; ++i)
      mean[i] = normals[at[0] + i] + normals[at[1] + i] + normals[at[2] + i];
    double own2 = dot(own, own), mean2 = dot(mean, mean);
    if (!(own2 > 0) || !(mean2 > 0)) continue;
    double cosine = dot(own, mean) / std::sqrt(own2) / std::sqrt(mean2);
    bend[f] = std::acos(std::min(std::max(cosine, -1.0), 1.0)) * degrees;
  }
  return bend;
}

}  // namespace crestline
