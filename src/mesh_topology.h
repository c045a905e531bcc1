// Which triangle lies across each edge of a triangulation.
#pragma once
#include <vector>

namespace crestline {

// Half edge h = 3 f + c is the side of triangle f from its corner c to corner (c + 1) % 3.
struct Topology {
  std::vector<int> twin;    // 3 m: the half edge across, -1 at a border or where it cannot be told
  std::vector<int> piece;   // m: index of the edge-connected piece of each triangle, from 0
  int pieces = 0;
  int border_edges = 0;      // edges of one triangle
  int nonmanifold_edges = 0; // edges of three or more triangles, or of two that disagree in winding
};

// it: 3 x m, corners of each triangle, from 0, column major; n: number of vertices.
// Half edges of non-manifold edges have no twin: walks stop there as at a border.
Topology mesh_topology(const int* it, int m, int n);

// The border half edges of each loop of the border, in the order in which they follow one another.
std::vector<std::vector<int>> border_loops(const std::vector<int>& twin);

inline int face_of(int half_edge) { return half_edge / 3; }
inline int next_half_edge(int h) { return h % 3 == 2 ? h - 2 : h + 1; }

}  // namespace crestline
