// How large a mesh is, by where most of its surface lies.
#pragma once
#include "mesh_view.h"

namespace crestline {

// Distance from the middle of the surface within which half of its area lies; 0 where there is no
// area. The middle is the place with the least sum of distances from the area (Weiszfeld's
// algorithm, `steps` steps from the centroid): less than half of it, wherever that lies, does not
// move it far. A triangle counts with its area, but no more than `cap` times the median of them: a
// long needle that leads to a stray vertex, or a platform of two triangles, then counts for little.
// used: m, whether a triangle counts.
double half_area_radius(const Triangulation& mesh, const int* used, double cap, int steps);

}  // namespace crestline
