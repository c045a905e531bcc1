#include "mesh_crop.h"

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

}  // namespace crestline
