// The closest point of a whole surface, exact, by a tree of boxes about its triangles.
#pragma once
#include <vector>

#include "mesh_closest.h"

namespace crestline {

class FaceTree {
 public:
  // leaf: faces that are tried one by one; with all of a mesh in one leaf there is no tree to
  // build, which pays for a few points. Faces without area are left out, unless there are no
  // others.
  FaceTree(const Triangulation& mesh, int leaf);

  // The closest point of all faces, as closest_on_face() finds it on each. Of faces equally near
  // the one of the lowest number.
  ClosestPoint closest(const double* to) const;

 private:
  struct Box {
    double low[3], high[3];
    int first, last;  // of its faces in face_
    int left, right;  // 0, 0 for a leaf
  };

  int build(int first, int last, const std::vector<double>& centre);
  double squared_gap(const Box& box, const double* to) const;
  bool may_hold(double gap2, const ClosestPoint& best, double rounding) const;
  void search(int box, double gap2, const double* to, double rounding, ClosestPoint& best) const;

  Triangulation mesh_;
  int leaf_;
  double largest_ = 0;  // co-ordinate
  std::vector<int> face_;
  std::vector<Box> box_;
};

}  // namespace crestline
