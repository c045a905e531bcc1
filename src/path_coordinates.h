// Arc length along a path and signed distance from it, of points near the path.
#pragma once
#include <functional>
#include <vector>

#include "mesh_neighbours.h"

namespace crestline {

struct PathCoordinates {       // one entry (tangent: three) a point
  std::vector<double> s, d;    // s < 0 or > length where the point lies past an end
  std::vector<double> tangent; // of the path at the nearest place, unit
};

// points: 3 x n; path: 3 x k, k >= 2, no repeated neighbours; normals: 3 x k, the surface's normals
// along the path. d > 0 on the side of normal x tangent. Past the ends the path goes on straight; a
// closed one, whose last node is its first, has none.
// `between`: as of curvature().
PathCoordinates path_coordinates(const double* points, int n, const double* path,
                                 const double* normals, int k, bool closed,
                                 const std::function<void()>& between);

struct PathWindow {
  double width, margin;  // the window reaches so far to both sides; the margin lies round it
  double length;         // of the path
};

struct NearPath {
  std::vector<int> vertex;  // ascending
  PathCoordinates at;
};

// Vertices in the window and its margin that are joined over edges between such to the path, which runs through
// `faces`. The others as of path_coordinates().
NearPath near_path(const MeshGraph& graph, const double* path, const double* normals, int k, bool closed,
                   const std::vector<int>& faces, const PathWindow& window,
                   const std::function<void()>& between);

// Vertices that `member` marks and that are joined over edges between members to those in `seeds`.
std::vector<char> joined_to(const Triangulation& mesh, const std::vector<char>& member,
                            const std::vector<int>& seeds);

}  // namespace crestline
