// Normals of triangles and vertices.
#pragma once
#include <vector>

namespace crestline {

// m x 3, column by column: normals of the triangles, twice their areas long.
// xyz: rows x n, the first three of each column are x, y, z; it: 3 x m, corners counted from
// `first`.
void face_normals(const double* xyz, int rows, const int* it, int m, int first, double* out);

// 3 x n: unit normals, area-weighted means of those of the triangles about each vertex; 0 where
// these have no area.
std::vector<double> vertex_normals(const double* xyz, int rows, int n, const int* it, int m,
                                   int first);

}  // namespace crestline
