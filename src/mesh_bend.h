// How far the triangles of a mesh are from lying in the surface that the normals of its vertices
// make.
#pragma once
#include <vector>

#include "mesh_view.h"

namespace crestline {

// Angle in degrees between every triangle's normal and the mean of those at its corners; 0 where
// either has no length. normals: as the mesh's vb.
std::vector<double> face_bend(const Triangulation& mesh, const double* normals);

}  // namespace crestline
