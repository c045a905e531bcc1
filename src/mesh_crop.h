// The part of a mesh near some of its vertices, as a mesh of its own.
#pragma once
#include <vector>

namespace crestline {

// Vertices in a box, from 0, in the order of the mesh. vb: rows x n, the first three of each column
// x, y, z.
std::vector<int> vertices_in_box(const double* vb, int rows, int n, const double* low,
                                 const double* high);

struct Crop {
  std::vector<double> xyz;  // 3 x its vertices
  std::vector<int> it;      // corners from 0
  std::vector<int> vertex;  // in the whole mesh, from 0, in its order
  std::vector<int> local;   // of each of `wanted`, from 0
};

// Every triangle with a corner within `margin` of the box about the wanted vertices, along each
// axis. vb: rows x n, the first three of each column x, y, z; it: 3 x m, corners from 1; wanted:
// from 0.
Crop crop_mesh(const double* vb, int rows, int n, const int* it, int m,
               const std::vector<int>& wanted, double margin);

}  // namespace crestline
