#define USE_FC_LEN_T
#include "analysis_spread.h"

#include <R_ext/Lapack.h>

#ifndef FCONE
#define FCONE
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "interrupt.h"

namespace crestline {

namespace {

using Matrix = std::vector<double>;

// Leading eigenvectors of a symmetric matrix, by its upper triangle; room is kept between calls.
class Leading {
 public:
  Leading(int m, int count) : m_(m), count_(count), values(m), vectors(std::size_t(m) * count),
                              support_(2 * m) {
    double size;
    int whole;
    int ask = -1;
    Matrix none(std::size_t(m) * m);
    solve(none.data(), &size, ask, &whole, ask);
    work_.resize(static_cast<std::size_t>(size));
    whole_.resize(whole);
  }
  // Overwrites a. Whether it was found; greatest first.
  bool of(double* a) {
    return solve(a, work_.data(), static_cast<int>(work_.size()), whole_.data(),
                 static_cast<int>(whole_.size())) == 0;
  }

 private:
  int m_, count_;

 public:
  Matrix values, vectors;

 private:
  int solve(double* a, double* work, int lwork, int* whole, int lwhole) {
    int from = m_ - count_ + 1, found = 0, info = 0;
    double none = 0;
    F77_CALL(dsyevr)("V", "I", "U", &m_, a, &m_, &none, &none, &from, &m_, &none, &found,
                     values.data(), vectors.data(), &m_, support_.data(), work, &lwork, whole,
                     &lwhole, &info FCONE FCONE FCONE);
    return info;
  }
  std::vector<int> support_, whole_;
  Matrix work_;
};

// Scatters of the groups about their means (m x m, upper triangles), and the sums of their members.
void scatters(const double* x, int m, int n, const int* label, const std::vector<int>& size,
              std::vector<Matrix>& within, Matrix& sums) {
  for (auto& one : within) std::fill(one.begin(), one.end(), 0.0);
  std::fill(sums.begin(), sums.end(), 0.0);
  for (int i = 0; i < n; ++i) {
    const double* row = x + static_cast<std::size_t>(i) * m;
    double* sum = sums.data() + static_cast<std::size_t>(label[i]) * m;
    double* square = within[label[i]].data();
    for (int c = 0; c < m; ++c) {
      sum[c] += row[c];
      double* column = square + static_cast<std::size_t>(c) * m;
      for (int r = 0; r <= c; ++r) column[r] += row[r] * row[c];
    }
  }
  for (std::size_t g = 0; g < within.size(); ++g) {
    const double* sum = sums.data() + g * m;
    for (int c = 0; c < m; ++c) {
      double* column = within[g].data() + static_cast<std::size_t>(c) * m;
      for (int r = 0; r <= c; ++r) column[r] -= sum[r] * sum[c] / size[g];
    }
  }
}

// v' a v of a symmetric matrix, by its upper triangle.
double form(const double* a, const double* v, int m) {
  double total = 0;
  for (int c = 0; c < m; ++c) {
    const double* column = a + static_cast<std::size_t>(c) * m;
    double sum = 0.5 * column[c] * v[c];
    for (int r = 0; r < c; ++r) sum += column[r] * v[r];
    total += 2 * sum * v[c];
  }
  return total;
}

// What the deviations of means vary by, as a share of what one specimen does.
double of_means(const std::vector<double>& scale, const std::vector<int>& size, int n) {
  double sum = 0;
  for (std::size_t g = 0; g < size.size(); ++g) sum += (1 - double(size[g]) / n) * scale[g];
  return sum / (size.size() - 1);
}

// To a mean of 1 over degrees of freedom, none below `least`.
void normalise(std::vector<double>& scale, const std::vector<int>& size, int df, double least) {
  double mean = 0;
  for (std::size_t g = 0; g < size.size(); ++g) mean += scale[g] * (size[g] - 1) / df;
  for (double& one : scale) one = mean > 0 ? std::max(one / mean, least) : 1;
}

// Sum of t / (1 - t) over the eigenvalues t of p' p, groups x groups.
double trace_of(const Matrix& p, int count, int groups) {
  std::vector<double> a(std::size_t(groups) * groups), value(groups), work(8 * groups + 8);
  for (int g = 0; g < groups; ++g) {
    for (int h = 0; h <= g; ++h) {
      double sum = 0;
      for (int j = 0; j < count; ++j) {
        sum += p[j + std::size_t(g) * count] * p[j + std::size_t(h) * count];
      }
      a[h + std::size_t(g) * groups] = sum;
    }
  }
  int info = 0, size = static_cast<int>(work.size());
  F77_CALL(dsyev)("N", "U", &groups, a.data(), &groups, value.data(), work.data(), &size, &info
                  FCONE FCONE);
  double trace = 0;
  for (double t : value) trace += std::min(t, 1 - 1e-12) / std::max(1 - t, 1e-12);
  return trace;
}

}  // namespace

void common_form_t2(const double* x, int m, int n, const int* labels, int b, int groups, int count,
                    int rounds, double least, double rounding, double* t2,
                    double* scale,
                    const std::function<void()>& between) {
  Patience patience(between);
  std::vector<int> size(groups);
  for (int i = 0; i < n; ++i) ++size[labels[i]];
  const int df = n - groups;
  std::vector<Matrix> within(groups, Matrix(std::size_t(m) * m));
  Matrix sums(std::size_t(m) * groups), whole(std::size_t(m) * m);
  Matrix means(std::size_t(count) * groups);
  std::vector<double> own(groups), found(groups);
  Leading leading(m, count);
  for (int k = 0; k < b; ++k) {
    if (patience.over()) patience.finish();
    scatters(x, m, n, labels + std::size_t(k) * n, size, within, sums);
    for (int g = 0; g < groups; ++g) {
      own[g] = 0;
      for (int c = 0; c < m; ++c) own[g] += within[g][c + std::size_t(c) * m] / (size[g] - 1);
    }
    normalise(own, size, df, least);
    t2[k] = 0;
    for (int round = 0; round < rounds; ++round) {
      const double apart = of_means(own, size, n);
      for (int c = 0; c < m; ++c) {
        for (int r = 0; r <= c; ++r) {
          const std::size_t at = r + std::size_t(c) * m;
          double sum = 0;
          for (int g = 0; g < groups; ++g) {
            const double* s = sums.data() + std::size_t(g) * m;
            sum += within[g][at] / own[g] + s[r] * s[c] / (size[g] * apart);
          }
          whole[at] = sum;
        }
      }
      if (!leading.of(whole.data())) break;
      std::fill(found.begin(), found.end(), 0.0);
      for (int j = 0; j < count; ++j) {
        const double* v = leading.vectors.data() + std::size_t(j) * m;
        const double value = std::max(leading.values[j], 1e-300);
        for (int g = 0; g < groups; ++g) {
          const double* s = sums.data() + std::size_t(g) * m;
          double sum = 0;
          for (int c = 0; c < m; ++c) sum += v[c] * s[c];
          const double share = sum / std::sqrt(size[g] * apart * value);
          means[j + std::size_t(g) * count] = std::abs(share) > rounding ? share : 0;
          found[g] += form(within[g].data(), v, m) / (value * (size[g] - 1));
        }
      }
      // The trace takes what all residuals have on the components for that of one specimen.
      double common = 0;
      for (int g = 0; g < groups; ++g) common += found[g] / own[g] * (size[g] - 1) / df;
      const double corrected = of_means(found, size, n) / common;
      t2[k] = corrected > 0 ? df * trace_of(means, count, groups) * apart / corrected : 0;
      normalise(found, size, df, least);
      own = found;
    }
    std::copy(own.begin(), own.end(), scale + std::size_t(k) * groups);
  }
}

}  // namespace crestline
