// A mesh as kernels see it: vertices, triangles and half edges counted from 0.
#pragma once
#include <cstddef>

#include "mesh_topology.h"

namespace crestline {

// The arrays stay where they are, so that no walk waits for a copy. What they count from, `first`,
// is 1 in R's own, 0 in those of a part of a mesh; vertex_at() and twin_of() alone know it.
struct Triangulation {
  const double* vb;  // rows x n, the first three of each column are x, y, z
  int rows, n;
  const int* it;    // 3 x m
  const int* twin;  // 3 x m, first - 1 at borders; null where nobody walks over edges
  int m;
  int first;
};

inline int vertex_at(const Triangulation& t, int half_edge) { return t.it[half_edge] - t.first; }
inline int twin_of(const Triangulation& t, int half_edge) { return t.twin[half_edge] - t.first; }

inline const double* corner(const Triangulation& t, int vertex) {
  return t.vb + t.rows * static_cast<std::size_t>(vertex);
}

}  // namespace crestline
