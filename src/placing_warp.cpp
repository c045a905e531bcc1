#include "placing_warp.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace crestline {

namespace {

// Columns are taken four at a time, rows in blocks that stay in the first cache with two such panels.
constexpr int kPanel = 4;
constexpr int kRows = 256;

// A block of rows of a matrix, its columns in panels of four, row by row; the last panel is filled up with 0.
class Panels {
 public:
  explicit Panels(int columns) : panels_((columns + kPanel - 1) / kPanel), columns_(columns) {
    values_.assign(static_cast<std::size_t>(panels_) * kPanel * kRows, 0);
  }

  double& at(int row, int column) { return panel(column / kPanel)[row * kPanel + column % kPanel]; }

  // Adds the inner products of the columns over the first `rows` rows to the upper triangle of the part of a
  // matrix (stride x stride) that begins at (first, first).
  void add_products(int rows, double* gram, std::size_t stride, int first) {
    for (int a = 0; a < panels_; ++a)
      for (int b = a; b < panels_; ++b) {
        double sums[kPanel][kPanel] = {};
        products(panel(a), panel(b), rows, sums);
        for (int i = 0; i < kPanel && kPanel * a + i < columns_; ++i)
          for (int j = 0; j < kPanel && kPanel * b + j < columns_; ++j)
            gram[(first + kPanel * a + i) + stride * (first + kPanel * b + j)] += sums[i][j];
      }
  }

 private:
  double* panel(int i) { return &values_[static_cast<std::size_t>(i) * kPanel * kRows]; }

  static void products(const double* a, const double* b, int rows, double sums[kPanel][kPanel]) {
    for (int r = 0; r < rows; ++r, a += kPanel, b += kPanel)
      for (int i = 0; i < kPanel; ++i)
        for (int j = 0; j < kPanel; ++j) sums[i][j] += a[i] * b[j];
  }

  int panels_, columns_;
  std::vector<double> values_;
};

}  // namespace

std::vector<double> warp_gram(const Basis basis[3], const std::vector<int>& used, const double* normal,
                              const double* weight, double along, double across, void (*between)()) {
  int start[4] = {0, 0, 0, 0};
  for (int k = 0; k < 3; ++k) start[k + 1] = start[k] + basis[k].size;
  std::size_t p = start[3];
  std::vector<double> gram(p * p, 0);
  Panels whole(start[3]);
  std::vector<Panels> parts;
  for (int k = 0; k < 3; ++k) parts.emplace_back(basis[k].size);
  int m = used.size();
  for (int first = 0; first < m; first += kRows) {
    between();
    int rows = std::min(kRows, m - first);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < basis[k].size; ++i) {
        const double* column = basis[k].values + static_cast<std::size_t>(basis[k].n) * i;
        for (int r = 0; r < rows; ++r) {
          double value = column[used[first + r]], w = weight[first + r];
          whole.at(r, start[k] + i) = std::sqrt(across * w) * normal[3 * static_cast<std::size_t>(first + r) + k] * value;
          parts[k].at(r, i) = std::sqrt(along * w) * value;
        }
      }
    whole.add_products(rows, gram.data(), p, 0);
    for (int k = 0; k < 3; ++k) parts[k].add_products(rows, gram.data(), p, start[k]);
  }
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < i; ++j) gram[i + p * j] = gram[j + p * i];
  return gram;
}

}  // namespace crestline
