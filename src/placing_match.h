// Nearest points of a cloud, in space and in further features, among those near in space and alike
// in normal.
#pragma once
#include <vector>

namespace crestline {

// xyz, normal: 3 x n; feature: features x n, in the unit of xyz.
struct Cloud {
  const double* xyz;
  const double* normal;
  const double* feature;
  int n;
  int features;
};

// The points of a cloud by cells of a box.
class CloudGrid {
 public:
  // cell: edge of the cells; made larger where there would be too many.
  CloudGrid(const Cloud& cloud, double cell);

  // Index of the point nearest in (xyz, feature) among those within `reach` in xyz whose normal has
  // at least this cosine with `normal`; -1 where there is none. distance2: in xyz alone.
  int nearest(const double* xyz, const double* normal, const double* feature, double reach,
              double cosine, double* distance2) const;

  const Cloud& cloud() const { return cloud_; }

 private:
  int cell_of(double x, int axis) const;

  // The same among what is nearer than the root of `least` in (xyz, feature).
  int nearest_within(const double* xyz, const double* normal, const double* feature, double reach,
                     double cosine, double least, double* distance2) const;

  Cloud cloud_;
  double cell_;
  double low_[3];
  int cells_[3];
  std::vector<int> start_;  // of every cell in point_
  std::vector<int> point_;
};

}  // namespace crestline
