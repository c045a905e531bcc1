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

// The means' deviations from their mean by precision, each divided by its own standard error:
// m x groups. `sums`: m x groups, of the members.
void laid_means(const Matrix& sums, int m, const std::vector<int>& size,
                const std::vector<double>& scale, Matrix& out) {
  const int groups = static_cast<int>(size.size());
  double total = 0;
  for (int g = 0; g < groups; ++g) total += size[g] / scale[g];
  for (int c = 0; c < m; ++c) {
    double mean = 0;
    for (int g = 0; g < groups; ++g) mean += sums[c + std::size_t(g) * m] / scale[g] / total;
    for (int g = 0; g < groups; ++g) {
      const double off = sums[c + std::size_t(g) * m] / size[g] - mean;
      out[c + std::size_t(g) * m] = std::sqrt(size[g] / scale[g]) * off;
    }
  }
}

// To a mean of 1 over degrees of freedom, none below `least`.
void normalise(std::vector<double>& scale, const std::vector<int>& size, int df, double least) {
  double mean = 0;
  for (std::size_t g = 0; g < size.size(); ++g) mean += scale[g] * (size[g] - 1) / df;
  for (double& one : scale) one = mean > 0 ? std::max(one / mean, least) : 1;
}

// a' b of two count x groups matrices.
Matrix crossed(const Matrix& a, const Matrix& b, int count, int groups) {
  Matrix out(std::size_t(groups) * groups);
  for (int h = 0; h < groups; ++h) {
    for (int g = 0; g < groups; ++g) {
      double sum = 0;
      for (int j = 0; j < count; ++j) {
        sum += a[j + std::size_t(g) * count] * b[j + std::size_t(h) * count];
      }
      out[g + std::size_t(h) * groups] = sum;
    }
  }
  return out;
}

// Trace of b b' (I - p p')^-1: b the means that are tested, I - p p' the residuals' share of the
// sum that the components are of. count x groups each.
double trace_of(const Matrix& p, const Matrix& b, int count, int groups) {
  Matrix a = crossed(p, p, count, groups), mixed = crossed(b, p, count, groups);
  std::vector<double> value(groups), work(8 * groups + 8);
  int info = 0, size = static_cast<int>(work.size());
  F77_CALL(dsyev)("V", "U", &groups, a.data(), &groups, value.data(), work.data(), &size, &info
                  FCONE FCONE);
  double trace = 0;
  for (double one : b) trace += one * one;
  for (int k = 0; k < groups; ++k) {
    const double* vector = a.data() + std::size_t(k) * groups;
    for (int g = 0; g < groups; ++g) {
      double sum = 0;
      for (int h = 0; h < groups; ++h) sum += mixed[g + std::size_t(h) * groups] * vector[h];
      trace += sum * sum / std::max(1 - value[k], 1e-12);
    }
  }
  return trace;
}

// Means on the components, as shares of the roots of `value`: count x groups. 0 up to `rounding`.
void scores_of(const Matrix& laid, const Leading& on, int m, int count, int groups, double rounding,
               Matrix& out) {
  for (int j = 0; j < count; ++j) {
    const double* v = on.vectors.data() + std::size_t(j) * m;
    const double root = std::sqrt(std::max(on.values[j], 1e-300));
    for (int g = 0; g < groups; ++g) {
      const double* own = laid.data() + std::size_t(g) * m;
      double sum = 0;
      for (int c = 0; c < m; ++c) sum += v[c] * own[c];
      out[j + std::size_t(g) * count] = std::abs(sum / root) > rounding ? sum / root : 0;
    }
  }
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
  Matrix laid(sums.size()), means(std::size_t(count) * groups), tested(means.size());
  std::vector<double> own(groups), found(groups), corrected(groups);
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
      laid_means(sums, m, size, own, laid);
      for (int c = 0; c < m; ++c) {
        for (int r = 0; r <= c; ++r) {
          const std::size_t at = r + std::size_t(c) * m;
          double sum = 0;
          for (int g = 0; g < groups; ++g) {
            const double* off = laid.data() + std::size_t(g) * m;
            sum += within[g][at] / own[g] + off[r] * off[c];
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
          found[g] += form(within[g].data(), v, m) / (value * (size[g] - 1));
        }
      }
      // The trace takes what all residuals have on the components for that of one specimen.
      double common = 0;
      for (int g = 0; g < groups; ++g) common += found[g] / own[g] * (size[g] - 1) / df;
      scores_of(laid, leading, m, count, groups, rounding, means);
      t2[k] = 0;
      if (common > 0) {
        for (int g = 0; g < groups; ++g) corrected[g] = std::max(found[g] / common, least);
        laid_means(sums, m, size, corrected, laid);
        scores_of(laid, leading, m, count, groups, rounding, tested);
        t2[k] = df * trace_of(means, tested, count, groups);
      }
      normalise(found, size, df, least);
      own = found;
    }
    std::copy(own.begin(), own.end(), scale + std::size_t(k) * groups);
  }
}

}  // namespace crestline
