// What may not be walked on: counted in one pass, before any kernel trusts it.
#pragma once

namespace crestline {

struct MeshFaults {
  int faces;     // that name vertices which do not exist
  int vertices;  // whose co-ordinates are not finite to the fourth power
};

// vb: rows x n, the first three of each column x, y, z; it: 3 x m, from 1, NA as the least int.
MeshFaults mesh_faults(const double* vb, int rows, int n, const int* it, int m);

// Number of half edges whose twin is not the other side of their edge, or does not lead back. it,
// twin: 3 x m, from 1, a twin of 0 at borders.
int twin_faults(const int* it, const int* twin, int m);

// Diagonal of the box that holds n points, n at least 1; NaN where a co-ordinate is.
double box_diagonal(const double* vb, int rows, int n);

}  // namespace crestline
