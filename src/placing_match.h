// Nearest points of a cloud, in space and in further features, among those near in space and alike
// in normal.
#pragma once
#include <cstddef>
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

  // Calls `see(point, squared distance)` for each point within `reach` of a place.
  template <typename See>
  void visit(const double* xyz, double reach, See see) const {
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      if (xyz[k] + reach < low_[k] || xyz[k] - reach > low_[k] + cells_[k] * cell_) return;
      from[k] = cell_of(xyz[k] - reach, k);
      to[k] = cell_of(xyz[k] + reach, k);
    }
    for (int c = from[2]; c <= to[2]; ++c)
      for (int b = from[1]; b <= to[1]; ++b) {
        std::size_t row = (static_cast<std::size_t>(c) * cells_[1] + b) * cells_[0];
        for (int i = start_[row + from[0]]; i < start_[row + to[0] + 1]; ++i) {
          double d2 = squared_gap(cloud_.xyz + 3 * static_cast<std::size_t>(point_[i]), xyz, 3);
          if (d2 <= reach * reach) see(point_[i], d2);
        }
      }
  }

  const Cloud& cloud() const { return cloud_; }

 private:
  int cell_of(double x, int axis) const;

  static double squared_gap(const double* a, const double* b, int k) {
    double sum = 0;
    for (int i = 0; i < k; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
  }

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
