#include "analysis_rows.h"

#include <algorithm>
#include <cstddef>

#include "interrupt.h"

namespace crestline {

namespace {

// Variables and specimens turned round at a time: both sides stay in the cache.
constexpr int kTile = 32;

}  // namespace

void centred_rows(const std::vector<const double*>& x, int from, int q, const double* factor,
                  double* out, const std::function<void()>& between) {
  Patience patience(between);
  const int n = static_cast<int>(x.size());
  for (int j = 0; j < q; j += kTile) {
    if (patience.over()) patience.finish();
    const int end = std::min(j + kTile, q);
    for (int i = 0; i < n; i += kTile) {
      for (int r = i; r < std::min(i + kTile, n); ++r) {
        const double* own = x[r] + from;
        for (int c = j; c < end; ++c) out[r + static_cast<std::size_t>(c) * n] = own[c];
      }
    }
    for (int c = j; c < end; ++c) {
      double* column = out + static_cast<std::size_t>(c) * n;
      double sum = 0, rest = 0;
      for (int i = 0; i < n; ++i) sum += column[i];
      const double mean = sum / n;
      // What rounding left of the mean.
      for (int i = 0; i < n; ++i) rest += column[i] - mean;
      const double centre = mean + rest / n, by = factor[c];
      for (int i = 0; i < n; ++i) column[i] = (column[i] - centre) * by;
    }
  }
}

void squared_distances(const double* y, int n, int q, const double* means, int groups,
                       const int* group, double* out, const std::function<void()>& between) {
  Patience patience(between);
  std::fill(out, out + n, 0.0);
  for (int j = 0; j < q; ++j) {
    if (patience.over()) patience.finish();
    const double* column = y + static_cast<std::size_t>(j) * n;
    const double* mean = means + static_cast<std::size_t>(j) * groups;
    for (int i = 0; i < n; ++i) {
      const double off = column[i] - mean[group[i]];
      out[i] += off * off;
    }
  }
}

void weighted_sum(const std::vector<const double*>& x, int m, const double* weight, double* out) {
  std::fill(out, out + m, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double* own = x[i];
    if (weight[i] == 0) continue;
    for (int j = 0; j < m; ++j) out[j] += weight[i] * own[j];
  }
}

}  // namespace crestline
