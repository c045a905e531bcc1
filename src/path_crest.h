// Paths of least cost over a mesh.
#pragma once
#include <functional>
#include <vector>

#include "path_walk.h"

namespace crestline {

struct CrestRequest {
  SurfacePoint from, to;
  const double* cost;   // per unit of length, at the vertices, positive
  // Null, or at the vertices an angle in [0, 2 pi], NaN where the path may not go: no step changes
  // it by more than pi.
  const double* angle;
  bool round;  // the path sets out at angles up to pi and arrives from larger ones: once round
};

struct CrestPath {
  bool arrived;
  double cost;
  std::vector<SurfacePoint> places;  // in order, each in the face of the segment that ends there
};

// Dijkstra with the straight distance as its heuristic (Hart, Nilsson and Raphael 1968) over the
// vertices and the middles of the edges; steps run straight through triangles, at the mean of the
// costs at both ends. `between`: as of curvature().
CrestPath crest_path(const Triangulation& mesh, const CrestRequest& request,
                     const std::function<void()>& between);

}  // namespace crestline
