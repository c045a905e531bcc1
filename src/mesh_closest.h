// The closest point of a surface, among what can be reached without leaving a ball.
#pragma once
#include <vector>

#include "path_plane.h"

namespace crestline {

struct ClosestPoint {
  SurfacePoint at;
  double xyz[3];
  double distance;
};

// On one triangle; one without area is taken for its edges.
ClosestPoint closest_on_face(const Triangulation& mesh, int face, const double* to);

// Searches of one mesh, with the marks that they share.
class NearSearch {
 public:
  explicit NearSearch(const Triangulation& mesh) : mesh_(mesh), seen_(mesh.m, 0) {}

  // The point closest to `to` on the faces that are joined over edges to that of `from` and meet
  // the ball about `to` through `from`: never farther from it than `from`.
  ClosestPoint closest(const SurfacePoint& from, const double* to);

 private:
  Triangulation mesh_;
  std::vector<int> seen_;  // number of the search that saw a face
  std::vector<int> queue_;
  int search_ = 0;
};

}  // namespace crestline
