#include "ridge_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace crestline {

namespace {

constexpr int kOrder = 4;
constexpr double kNode[kOrder] = {-0.86113631159405257522, -0.33998104358485626480,
                                  0.33998104358485626480, 0.86113631159405257522};
constexpr double kWeight[kOrder] = {0.34785484513745385737, 0.65214515486254614263,
                                    0.65214515486254614263, 0.34785484513745385737};

// The B-splines of a degree that are not 0 between knots[i] and knots[i + 1], at q in there (Cox and de Boor).
void splines_of_degree(const double* knots, int i, double q, int top, double* value) {
  double left[kOrder], right[kOrder];
  value[0] = 1;
  for (int degree = 1; degree <= top; ++degree) {
    left[degree] = q - knots[i + 1 - degree];
    right[degree] = knots[i + degree] - q;
    double carried = 0;
    for (int r = 0; r < degree; ++r) {
      double share = value[r] / (right[r + 1] + left[degree - r]);
      value[r] = carried + right[r + 1] * share;
      carried = left[degree - r] * share;
    }
    value[degree] = carried;
  }
}

void cubic_splines(const double* knots, int i, double q, double* value) {
  splines_of_degree(knots, i, q, kOrder - 1, value);
}

// Their derivatives: of splines of each degree from those of the degree below.
void cubic_derivatives(const double* knots, int i, double q, int derivative, double* value) {
  int start = kOrder - 1 - derivative;
  splines_of_degree(knots, i, q, start, value);
  for (int degree = start + 1; degree < kOrder; ++degree) {
    double carried = 0;
    for (int r = 0; r < degree; ++r) {
      int j = i - degree + 1 + r;
      double share = degree * value[r] / (knots[j + degree] - knots[j]);
      value[r] = carried - share;
      carried = share;
    }
    value[degree] = carried;
  }
}

// The kernel of half width 1, or its derivative by the place that it is centred on.
double biweight(double t, int derivative) {
  double inner = 1 - t * t;
  if (derivative == 0) return 15.0 / 16 * inner * inner;
  if (derivative == 1) return 15.0 / 4 * t * inner;
  return 15.0 / 4 * (3 * t * t - 1);
}

}  // namespace

std::vector<double> biweight_design(const double* knots, int k, const double* x, int n, double half,
                                    int derivative) {
  std::vector<double> out(static_cast<std::size_t>(n) * k, 0.0);
  double scale = std::pow(half, -1 - derivative);
  double value[kOrder];
  for (int row = 0; row < n; ++row) {
    for (int i = kOrder - 1; i < k; ++i) {
      double lower = std::max(knots[i], x[row] - half), upper = std::min(knots[i + 1], x[row] + half);
      if (lower >= upper) continue;
      double middle = (lower + upper) / 2, reach = (upper - lower) / 2;
      for (int g = 0; g < kOrder; ++g) {
        double q = middle + reach * kNode[g];
        double weight = kWeight[g] * reach * scale * biweight((q - x[row]) / half, derivative);
        cubic_splines(knots, i, q, value);
        for (int j = 0; j < kOrder; ++j)
          out[row + static_cast<std::size_t>(n) * (i - kOrder + 1 + j)] += weight * value[j];
      }
    }
  }
  return out;
}

std::vector<double> spline_design(const double* knots, int k, const double* x, int n, int derivative) {
  std::vector<double> out(static_cast<std::size_t>(n) * k, 0.0);
  double value[kOrder];
  for (int row = 0; row < n; ++row) {
    int i = kOrder - 1;
    while (i < k - 1 && x[row] >= knots[i + 1]) ++i;
    cubic_derivatives(knots, i, x[row], derivative, value);
    for (int j = 0; j < kOrder; ++j) out[row + static_cast<std::size_t>(n) * (i - kOrder + 1 + j)] = value[j];
  }
  return out;
}

}  // namespace crestline
