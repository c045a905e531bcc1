// The part of a mesh near some of its vertices, as a mesh of its own.
#pragma once
#include <vector>

#include "mesh_view.h"

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
// axis.
Crop crop_mesh(const Triangulation& mesh, const std::vector<int>& wanted, double margin);

// The part as a mesh; it holds as long as the crop does.
Triangulation view_of(const Crop& crop);

}  // namespace crestline
