// One number for what a mesh is: its vertices and triangles, bit by bit.
#pragma once
#include <cstddef>
#include <cstdint>

namespace crestline {

struct MeshKey {
  std::uint64_t high, low;
};

// vb: rows x n, the first three of each column x, y, z (-0 counts as 0, every NaN as one); it:
// corners, in the order of the triangles. Not for secrets: 128 bits that differ by chance for every
// mesh that anyone has.
MeshKey mesh_key(const double* vb, int rows, int n, const int* it, std::size_t corners);

}  // namespace crestline
