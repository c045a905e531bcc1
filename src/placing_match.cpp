#include "placing_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crestline {

namespace {

constexpr double most_cells = 4e6;

}  // namespace

CloudGrid::CloudGrid(const Cloud& cloud, double cell) : cloud_(cloud), cell_(cell) {
  double high[3];
  for (int k = 0; k < 3; ++k) {
    low_[k] = std::numeric_limits<double>::infinity();
    high[k] = -low_[k];
    for (int i = 0; i < cloud.n; ++i) {
      low_[k] = std::min(low_[k], cloud.xyz[3 * i + k]);
      high[k] = std::max(high[k], cloud.xyz[3 * i + k]);
    }
  }
  double total;
  do {
    total = 1;
    for (int k = 0; k < 3; ++k) total *= std::floor((high[k] - low_[k]) / cell_) + 1;
    if (total > most_cells) cell_ *= 1.5;
  } while (total > most_cells);
  for (int k = 0; k < 3; ++k)
    cells_[k] = static_cast<int>(std::floor((high[k] - low_[k]) / cell_)) + 1;
  std::vector<int> cell_of_point(cloud.n);
  start_.assign(static_cast<std::size_t>(total) + 1, 0);
  for (int i = 0; i < cloud.n; ++i) {
    const double* p = cloud.xyz + 3 * i;
    cell_of_point[i] =
        (cell_of(p[2], 2) * cells_[1] + cell_of(p[1], 1)) * cells_[0] + cell_of(p[0], 0);
    ++start_[cell_of_point[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<int> next(start_.begin(), start_.end() - 1);
  point_.resize(cloud.n);
  for (int i = 0; i < cloud.n; ++i) point_[next[cell_of_point[i]]++] = i;
}

int CloudGrid::cell_of(double x, int axis) const {
  double at = std::floor((x - low_[axis]) / cell_);
  return static_cast<int>(std::min(std::max(at, 0.0), cells_[axis] - 1.0));
}

int CloudGrid::nearest(const double* xyz, const double* normal, const double* feature, double reach,
                       double cosine, double* distance2) const {
  // Nothing beyond a ball in space is nearer than what was found within it: small balls first.
  for (double within = std::min(cell_, reach); ; within = std::min(2 * within, reach)) {
    double least = within >= reach ? std::numeric_limits<double>::infinity() : within * within;
    int found = nearest_within(xyz, normal, feature, within, cosine, least, distance2);
    if (found >= 0 || within >= reach) return found;
  }
}

int CloudGrid::nearest_within(const double* xyz, const double* normal, const double* feature,
                              double reach, double cosine, double least, double* distance2) const {
  int best = -1;
  visit(xyz, reach, [&](int p, double d2) {
    if (d2 >= least) return;
    const double* n = cloud_.normal + 3 * p;
    if (n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2] < cosine) return;
    const double* own = cloud_.feature + static_cast<std::size_t>(cloud_.features) * p;
    double all = d2 + squared_gap(own, feature, cloud_.features);
    if (all >= least) return;
    least = all;
    best = p;
    *distance2 = d2;
  });
  return best;
}

}  // namespace crestline
