#include "analysis_lm.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "interrupt.h"

namespace crestline {

namespace {

// Variables taken at a time: their sums stay in the first cache.
constexpr int kChunk = 256;

// sums: p x width, of basis' times some permuted variables. Four specimens at a time: a sum is read and
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
#pragma omp simd
      for (int j = 0; j < width; ++j) sum[j] += c0 * e0[j] + c1 * e1[j] + c2 * e2[j] + c3 * e3[j];
    }
  }
  for (; i < n; ++i) {
    const double* e = row(i);
    for (int l = 0; l < p; ++l) {
      const double c = basis[i + static_cast<std::size_t>(n) * l];
      double* sum = sums + static_cast<std::size_t>(l) * width;
#pragma omp simd
      for (int j = 0; j < width; ++j) sum[j] += c * e[j];
    }
  }
}

// By term, p x without_count x b: basis' times the permuted basis of the model without the term.
std::vector<std::vector<double>> permuted_products(int n, const double* basis, int p, const std::vector<PermutedTerm>& terms,
                                                   const int* orders, int b) {
  std::vector<std::vector<double>> laid;
  for (const PermutedTerm& term : terms) {
    std::vector<double> each(static_cast<std::size_t>(p) * term.without_count * b);
    double* at = each.data();
    for (int k = 0; k < b; ++k) {
      const int* order = orders + static_cast<std::size_t>(k) * n;
      for (int r = 0; r < term.without_count; ++r) {
        const double* own = term.without + static_cast<std::size_t>(r) * n;
        for (int l = 0; l < p; ++l, ++at) {
          const double* c = basis + static_cast<std::size_t>(l) * n;
          double sum = 0;
          for (int i = 0; i < n; ++i) sum += c[i] * own[order[i]];
          *at = sum;
        }
      }
    }
    laid.push_back(std::move(each));
  }
  return laid;
}

// left: p x width, on the basis, of permutation k and the variables from `from`.
void add_squares(const double* left, int width, int p, const PermutedTerm& term, int b, int k, int from) {
  for (int j = 0; j < width; ++j) {
    double in_own = 0, in_whole = 0;
    for (int d = 0; d < term.df; ++d) {
      double sum = 0;
      for (int l = 0; l < p; ++l) sum += term.own[l + static_cast<std::size_t>(p) * d] * left[static_cast<std::size_t>(l) * width + j];
      in_own += sum * sum;
    }
    for (int l = 0; l < p; ++l) {
      const double value = left[static_cast<std::size_t>(l) * width + j];
      in_whole += value * value;
    }
    term.in_own[k + static_cast<std::size_t>(b) * (from + j)] = in_own;
    term.in_whole[k + static_cast<std::size_t>(b) * (from + j)] = in_whole;
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

void permuted_squares(const double* y, int q, int n, const double* basis, int p, const std::vector<PermutedTerm>& terms,
                      const int* orders, int b, const std::function<void()>& between) {
  Patience patience(between);
  std::vector<double> sums(static_cast<std::size_t>(p) * kChunk), left(sums.size());
  const std::vector<std::vector<double>> laid = permuted_products(n, basis, p, terms, orders, b);
  for (int from = 0; from < q; from += kChunk) {
    const int width = std::min(kChunk, q - from);
    for (int k = 0; k < b; ++k) {
      if (patience.over()) patience.finish();
      project(y + from, q, n, width, basis, p, orders + static_cast<std::size_t>(k) * n, sums.data());
      for (std::size_t t = 0; t < terms.size(); ++t) {
        const PermutedTerm& term = terms[t];
        const double* product = laid[t].data() + static_cast<std::size_t>(k) * p * term.without_count;
        std::copy(sums.begin(), sums.end(), left.begin());
        for (int l = 0; l < p; ++l) {
          double* rest = left.data() + static_cast<std::size_t>(l) * width;
          for (int r = 0; r < term.without_count; ++r) {
            const double share = product[l + static_cast<std::size_t>(p) * r];
            const double* fitted = term.fitted + static_cast<std::size_t>(r) * q + from;
#pragma omp simd
            for (int j = 0; j < width; ++j) rest[j] -= share * fitted[j];
          }
        }
        add_squares(left.data(), width, p, term, b, k, from);
      }
    }
  }
}

}  // namespace crestline
