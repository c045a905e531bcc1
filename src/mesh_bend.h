// How far the triangles of a mesh are from lying in the surface that the normals of its vertices
// make.
#pragma once
#include <vector>

namespace crestline {

// Angle in degrees between every triangle's normal and the mean of those at its corners; 0 where
// either has no length. vb, normals: rows x n, the first three of each column x, y, z; it: 3 x m,
// from 1.
std::vector<double> face_bend(const double* vb, const double* normals, int rows, const int* it,
                              int m);

}  // namespace crestline
