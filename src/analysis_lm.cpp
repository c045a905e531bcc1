#include "analysis_lm.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "interrupt.h"

namespace crestline {

namespace {

// Variables taken at a time: their sums stay in the first cache.
constexpr int kChunk = 256;

// sums: p x width, of basis' times the permuted residuals of some variables. Four specimens at a time: a sum is read and
// written once for all of them.
void project(const double* residuals, int q, int n, int width, const double* basis, int p, const int* order, double* sums) {
  std::fill(sums, sums + static_cast<std::size_t>(p) * width, 0.0);
  auto row = [&](int i) { return residuals + static_cast<std::size_t>(order[i]) * q; };
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    const double *e0 = row(i), *e1 = row(i + 1), *e2 = row(i + 2), *e3 = row(i + 3);
    for (int l = 0; l < p; ++l) {
      const double* c = basis + i + static_cast<std::size_t>(n) * l;
      const double c0 = c[0], c1 = c[1], c2 = c[2], c3 = c[3];
      double* sum = sums + static_cast<std::size_t>(l) * width;
      for (int j = 0; j < width; ++j) sum[j] += c0 * e0[j] + c1 * e1[j] + c2 * e2[j] + c3 * e3[j];
    }
  }
  for (; i < n; ++i) {
    const double* e = row(i);
    for (int l = 0; l < p; ++l) {
      const double c = basis[i + static_cast<std::size_t>(n) * l];
      double* sum = sums + static_cast<std::size_t>(l) * width;
      for (int j = 0; j < width; ++j) sum[j] += c * e[j];
    }
  }
}

}  // namespace

void permuted_forms(const double* gram, const double* own, const double* whole, int n, const int* orders, int b, double* out,
                    const std::function<void()>& between) {
  Patience patience(between);
  for (int k = 0; k < b; ++k) {
    if (patience.over()) patience.finish();
    const int* order = orders + static_cast<std::size_t>(k) * n;
    double in_own = 0, in_whole = 0;
    for (int j = 0; j < n; ++j) {
      const double* g = gram + static_cast<std::size_t>(order[j]) * n;
      const double* a = own + static_cast<std::size_t>(j) * n;
      const double* h = whole + static_cast<std::size_t>(j) * n;
      double sum_own = 0, sum_whole = 0;
      for (int i = 0; i < j; ++i) {
        const double value = g[order[i]];
        sum_own += a[i] * value;
        sum_whole += h[i] * value;
      }
      in_own += 2 * sum_own + a[j] * g[order[j]];
      in_whole += 2 * sum_whole + h[j] * g[order[j]];
    }
    out[2 * k] = in_own;
    out[2 * k + 1] = in_whole;
  }
}

void permuted_squares(const double* residuals, int q, int n, const double* basis, int p, int df, const int* orders, int b,
                      double* own, double* whole, const std::function<void()>& between) {
  Patience patience(between);
  std::vector<double> sums(static_cast<std::size_t>(p) * kChunk);
  for (int from = 0; from < q; from += kChunk) {
    const int width = std::min(kChunk, q - from);
    for (int k = 0; k < b; ++k) {
      if (patience.over()) patience.finish();
      project(residuals + from, q, n, width, basis, p, orders + static_cast<std::size_t>(k) * n, sums.data());
      for (int j = 0; j < width; ++j) {
        double in_own = 0, rest = 0;
        for (int l = 0; l < p; ++l) {
          const double value = sums[static_cast<std::size_t>(l) * width + j];
          (l < df ? in_own : rest) += value * value;
        }
        own[k + static_cast<std::size_t>(b) * (from + j)] = in_own;
        whole[k + static_cast<std::size_t>(b) * (from + j)] = in_own + rest;
      }
    }
  }
}

}  // namespace crestline
