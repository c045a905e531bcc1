// Normals of triangles and vertices.
#pragma once
#include <vector>

#include "mesh_view.h"

namespace crestline {

// m x 3, column by column: normals of the triangles, twice their areas long.
void face_normals(const Triangulation& mesh, double* out);

// 3 x n: unit normals, area-weighted means of those of the triangles about each vertex; 0 where
// these have no area.
std::vector<double> vertex_normals(const Triangulation& mesh);

}  // namespace crestline
