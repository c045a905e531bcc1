// Places where a triangulation should be joined and is not: vertices, edges and sheets that lie on
// one another.
#pragma once
#include <vector>

#include "path_walk.h"

namespace crestline {

struct Pair {
  int first, second;
};

// All pairs of points within `reach` of one another, first < second, from 0. xyz: rows x n, the
// first three of each column x, y, z. Empty where that would take more than `most` comparisons a
// point: such points differ by no rounding.
std::vector<Pair> near_pairs(const double* xyz, int rows, int n, double reach, int most);

// The least member of the group that pairs join each of n points to, from 0.
std::vector<int> pair_groups(const std::vector<Pair>& pairs, int n);

struct VertexOnEdge {
  int side;      // half edge, from 0
  int vertex;    // from 0
  double along;  // share of the edge from its start, in 0 to 1
};

// Ends of border sides that lie within `reach` of another border side, but not of its ends, and are
// no corner of its triangle. sides: half edges without twin, from 0. At most `most` comparisons a
// side, as near_pairs().
std::vector<VertexOnEdge> vertices_on_edges(const Triangulation& mesh,
                                            const std::vector<int>& sides, double reach, int most);

// For each face of `sample` (from 0) the distance from its middle to another sheet of the surface:
// a face within `reach` that cannot be walked to over edges within the ball, above or below, with a
// normal whose cosine with its own is `parallel` or more, or minus that or less if it is of another
// piece or within `hollow` times the reach. Infinite where there is none. piece: of each face.
std::vector<double> other_sheets(const Triangulation& mesh, const int* piece,
                                 const std::vector<int>& sample, double reach, double parallel,
                                 double hollow);

}  // namespace crestline
