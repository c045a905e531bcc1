#include "mesh_bend.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace crestline {

std::vector<double> face_bend(const double* vb, const double* normals, int rows, const int* it, int m) {
  const double degrees = 180 / std::acos(-1.0);
  std::vector<double> bend(m, 0.0);
  for (int f = 0; f < m; ++f) {
    const int* v = it + 3 * static_cast<std::size_t>(f);
    std::size_t at[3];
    for (int c = 0; c < 3; ++c) at[c] = rows * static_cast<std::size_t>(v[c] - 1);
    double a[3], b[3], mean[3], own2 = 0, mean2 = 0, product = 0;
    for (int i = 0; i < 3; ++i) {
      a[i] = vb[at[1] + i] - vb[at[0] + i];
      b[i] = vb[at[2] + i] - vb[at[0] + i];
      mean[i] = normals[at[0] + i] + normals[at[1] + i] + normals[at[2] + i];
    }
    double own[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    for (int i = 0; i < 3; ++i) {
      own2 += own[i] * own[i];
      mean2 += mean[i] * mean[i];
      product += own[i] * mean[i];
    }
    if (!(own2 > 0) || !(mean2 > 0)) continue;
    double cosine = product / std::sqrt(own2) / std::sqrt(mean2);
    bend[f] = std::acos(std::min(std::max(cosine, -1.0), 1.0)) * degrees;
  }
  return bend;
}

}  // namespace crestline
