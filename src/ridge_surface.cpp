#include "ridge_surface.h"

#include <cstddef>

namespace crestline {

namespace {

struct Entry {
  int column;
  double value;
};

void entries_of(const double* design, int k, int n, int row, std::vector<Entry>& out) {
  out.clear();
  for (int c = 0; c < k; ++c) {
    double value = design[row + static_cast<std::size_t>(n) * c];
    if (value != 0) out.push_back({c, value});
  }
}

}  // namespace

TensorMoments tensor_moments(const double* along, int ka, const double* across, int kc,
                             const double* y, int n) {
  std::size_t size = static_cast<std::size_t>(ka) * kc;
  TensorMoments out{std::vector<double>(size * size, 0.0), std::vector<double>(size, 0.0)};
  std::vector<Entry> a, c, both;
  for (int i = 0; i < n; ++i) {
    entries_of(along, ka, n, i, a);
    entries_of(across, kc, n, i, c);
    both.clear();
    for (const Entry& p : a)
      for (const Entry& q : c) both.push_back({p.column * kc + q.column, p.value * q.value});
    for (const Entry& p : both) {
      out.right[p.column] += p.value * y[i];
      double* column = &out.matrix[size * p.column];
      for (const Entry& q : both) column[q.column] += p.value * q.value;
    }
  }
  return out;
}

std::vector<double> summed_tensor(const double* along, int ka, const double* across, int kc,
                                  const std::vector<int>& group, int groups) {
  std::size_t size = static_cast<std::size_t>(ka) * kc;
  std::vector<double> out(size * groups, 0.0);
  std::vector<Entry> a, c;
  int n = static_cast<int>(group.size());
  for (int i = 0; i < n; ++i) {
    entries_of(along, ka, n, i, a);
    entries_of(across, kc, n, i, c);
    double* column = &out[size * group[i]];
    for (const Entry& p : a)
      for (const Entry& q : c) column[p.column * kc + q.column] += p.value * q.value;
  }
  return out;
}

}  // namespace crestline
