#include "mesh_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "geometry.h"

namespace crestline {

namespace {

struct Patch {
  double at[3];
  double weight;
  double far2;
};

// The patches whose squared distance is least and that have half of the weight come first; how many
// they are.
std::size_t nearer_half(std::vector<Patch>& patches, double total) {
  auto low = patches.begin();
  auto high = patches.end();
  double below = 0;
  while (high - low > 1) {
    auto middle = low + (high - low) / 2;
    std::nth_element(low, middle, high,
                     [](const Patch& a, const Patch& b) { return a.far2 < b.far2; });
    double here = 0;
    for (auto p = low; p != middle; ++p) here += p->weight;
    if (below + here >= total / 2) {
      high = middle;
    } else {
      below += here;
      low = middle;
    }
  }
  return low - patches.begin() + 1;
}

double distance2(const Patch& p, const double* middle) {
  double x = p.at[0] - middle[0], y = p.at[1] - middle[1], z = p.at[2] - middle[2];
  return x * x + y * y + z * z;
}

// From the middle to the mean of the patches by weight over distance, a step of Weiszfeld; `near`:
// distances below it count as that. Where it is infinite: to their mean by weight.
void step_to_middle(const std::vector<Patch>& patches, double near, double* middle) {
  double total = 0, sum[3] = {0, 0, 0};
  bool plain = std::isinf(near);
  for (const Patch& p : patches) {
    double weight = plain ? p.weight : p.weight / std::max(std::sqrt(distance2(p, middle)), near);
    total += weight;
    for (int i = 0; i < 3; ++i) sum[i] += weight * p.at[i];
  }
  for (int i = 0; i < 3; ++i) middle[i] = sum[i] / total;
}

std::vector<Patch> patches_of(const Triangulation& mesh, const int* used) {
  std::vector<Patch> patches;
  patches.reserve(mesh.m);
  for (int f = 0; f < mesh.m; ++f) {
    if (!used[f]) continue;
    const double* at[3];
    for (int c = 0; c < 3; ++c) at[c] = corner(mesh, vertex_at(mesh, 3 * f + c));
    double normal[3];
    triangle_normal(at[0], at[1], at[2], normal);
    Patch p;
    for (int i = 0; i < 3; ++i) p.at[i] = (at[0][i] + at[1][i] + at[2][i]) / 3;
    p.weight = std::sqrt(dot(normal, normal)) / 2;
    if (p.weight > 0) patches.push_back(p);
  }
  return patches;
}

}  // namespace

double half_area_radius(const Triangulation& mesh, const int* used, double cap, int steps) {
  std::vector<Patch> patches = patches_of(mesh, used);
  if (patches.empty()) return 0;
  std::vector<double> area(patches.size());
  std::transform(patches.begin(), patches.end(), area.begin(),
                 [](const Patch& p) { return p.weight; });
  std::nth_element(area.begin(), area.begin() + area.size() / 2, area.end());
  double most = cap * area[area.size() / 2], total = 0, middle[3] = {0, 0, 0};
  for (Patch& p : patches) total += p.weight = std::min(p.weight, most);
  step_to_middle(patches, std::numeric_limits<double>::infinity(), middle);
  for (int step = 0; step < steps; ++step) step_to_middle(patches, std::sqrt(most), middle);
  for (Patch& p : patches) p.far2 = distance2(p, middle);
  return std::sqrt(patches[nearer_half(patches, total) - 1].far2);
}

}  // namespace crestline
