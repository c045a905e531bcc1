// Lengths of shortest paths over a mesh from one place to all vertices.
#pragma once
#include <functional>
#include <vector>

#include "path_plane.h"

namespace crestline {

// Approximate geodesic distances (Novotni and Klein 2002): a corner of a triangle takes its
// distance from the two others by unfolding the source into the triangle's plane, or from one of
// them along the edge; corners are corrected until none gets nearer. Exact on a plane wherever the
// straight line stays on it. n: vertices; infinite where there is no way over edges. `between`: as
// of curvature().
std::vector<double> geodesic_distances(const Triangulation& mesh, int n, const SurfacePoint& source,
                                       const std::function<void()>& between);

}  // namespace crestline
