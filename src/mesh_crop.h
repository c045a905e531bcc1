// The vertices of a mesh in a box.
#pragma once
#include <vector>

namespace crestline {

// Vertices in a box, from 0, in the order of the mesh. vb: rows x n, the first three of each column
// x, y, z.
std::vector<int> vertices_in_box(const double* vb, int rows, int n, const double* low,
                                 const double* high);

}  // namespace crestline
