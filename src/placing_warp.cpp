#include "placing_warp.h"

#include <algorithm>
#include <cstddef>

namespace crestline {

namespace {

// Columns are taken four at a time, rows in blocks that stay in the first cache with two such
// panels.
constexpr int kPanel = 4;
constexpr int kRows = 256;

// A block of rows of a matrix, its columns in panels of four, row by row; the last panel is filled
// up with 0.
class Panels {
 public:
  explicit Panels(int columns) : panels_((columns + kPanel - 1) / kPanel), columns_(columns) {
    values_.assign(static_cast<std::size_t>(panels_) * kPanel * kRows, 0);
  }

  double& at(int row, int column) { return panel(column / kPanel)[row * kPanel + column % kPanel]; }

  // This block, each row times a factor.
  void scale(const Panels& from, const double* factor, int rows) {
    for (int i = 0; i < panels_; ++i) {
      const double* source = from.panel(i);
      double* to = panel(i);
      for (int r = 0; r < rows; ++r)
        for (int j = 0; j < kPanel; ++j) to[r * kPanel + j] = factor[r] * source[r * kPanel + j];
    }
  }

  // Adds the inner products of its columns and another's over the first `rows` rows to the part of
  // a matrix (stride x stride) that begins at `part`; of a symmetric part the upper triangle alone.
  void add_products(const Panels& other, int rows, bool symmetric, std::size_t stride,
                    double* part) const {
    for (int a = 0; a < panels_; ++a)
      for (int b = symmetric ? a : 0; b < other.panels_; ++b) {
        double sums[kPanel][kPanel];
        products(panel(a), other.panel(b), rows, sums);
        for (int i = 0; i < kPanel && kPanel * a + i < columns_; ++i)
          for (int j = 0; j < kPanel && kPanel * b + j < other.columns_; ++j)
            part[(kPanel * a + i) + stride * (kPanel * b + j)] += sums[i][j];
      }
  }

 private:
  static std::size_t offset(int i) { return static_cast<std::size_t>(i) * kPanel * kRows; }
  double* panel(int i) { return &values_[offset(i)]; }
  const double* panel(int i) const { return &values_[offset(i)]; }

  // Written out, so that the sums stay in registers whatever the compiler unrolls: half the time of
  // two loops at -O2.
  static void products(const double* a, const double* b, int rows, double sums[kPanel][kPanel]) {
    static_assert(kPanel == 4, "the sums are written out for panels of four");
    double s00 = 0, s01 = 0, s02 = 0, s03 = 0;
    double s10 = 0, s11 = 0, s12 = 0, s13 = 0;
    double s20 = 0, s21 = 0, s22 = 0, s23 = 0;
    double s30 = 0, s31 = 0, s32 = 0, s33 = 0;
    for (int r = 0; r < rows; ++r, a += kPanel, b += kPanel) {
      s00 += a[0] * b[0]; s01 += a[0] * b[1]; s02 += a[0] * b[2]; s03 += a[0] * b[3];
      s10 += a[1] * b[0]; s11 += a[1] * b[1]; s12 += a[1] * b[2]; s13 += a[1] * b[3];
      s20 += a[2] * b[0]; s21 += a[2] * b[1]; s22 += a[2] * b[2]; s23 += a[2] * b[3];
      s30 += a[3] * b[0]; s31 += a[3] * b[1]; s32 += a[3] * b[2]; s33 += a[3] * b[3];
    }
    sums[0][0] = s00; sums[0][1] = s01; sums[0][2] = s02; sums[0][3] = s03;
    sums[1][0] = s10; sums[1][1] = s11; sums[1][2] = s12; sums[1][3] = s13;
    sums[2][0] = s20; sums[2][1] = s21; sums[2][2] = s22; sums[2][3] = s23;
    sums[3][0] = s30; sums[3][1] = s31; sums[3][2] = s32; sums[3][3] = s33;
  }

  int panels_, columns_;
  std::vector<double> values_;
};

}  // namespace

std::vector<double> warp_gram(const Basis basis[3], const std::vector<int>& used,
                              const double* normal, const double* weight, double along,
                              double across, void (*between)()) {
  int start[4] = {0, 0, 0, 0};
  for (int k = 0; k < 3; ++k) start[k + 1] = start[k] + basis[k].size;
  std::size_t p = start[3];
  std::vector<double> gram(p * p, 0);
  std::vector<Panels> values, scaled;
  for (int k = 0; k < 3; ++k) values.emplace_back(basis[k].size);
  scaled = values;
  std::vector<double> factor(kRows);
  int m = used.size();
  for (int first = 0; first < m; first += kRows) {
    between();
    int rows = std::min(kRows, m - first);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < basis[k].size; ++i) {
        const double* column = basis[k].values + static_cast<std::size_t>(basis[k].n) * i;
        for (int r = 0; r < rows; ++r) values[k].at(r, i) = column[used[first + r]];
      }
    for (int k = 0; k < 3; ++k)
      for (int l = k; l < 3; ++l) {
        for (int r = 0; r < rows; ++r) {
          const double* n = normal + 3 * static_cast<std::size_t>(first + r);
          factor[r] = weight[first + r] * (across * n[k] * n[l] + (k == l ? along : 0));
        }
        scaled[k].scale(values[k], factor.data(), rows);
        scaled[k].add_products(values[l], rows, k == l, p, gram.data() + start[k] + p * start[l]);
      }
  }
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < i; ++j) gram[i + p * j] = gram[j + p * i];
  return gram;
}

}  // namespace crestline
