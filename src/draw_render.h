// A shaded picture of a triangulation, with the depth of what is seen.
#pragma once
#include <functional>
#include <vector>

namespace crestline {

struct Picture {
  std::vector<double> rgba;   // height x width x 4, column major, in [0, 1]; row 0 is the top
  // height x width: the farthest of what is seen in a pixel, -infinity where nothing is
  std::vector<double> depth;
};

// xyz: 3 x n, x to the right and y down in pixels, z towards the viewer in any unit;
// it: 3 x m corners from 0, anticlockwise where the front is seen: others are left out;
// rgb: 3 x n in [0, 1], interpolated over triangles; samples x samples of them make a pixel.
// `between`: as of curvature().
// Orthographic z-buffer; a triangle that contains no sample leaves no trace.
Picture render_mesh(const double* xyz, const double* rgb, const int* it, int m, int width,
                    int height, int samples, const std::function<void()>& between);

}  // namespace crestline
