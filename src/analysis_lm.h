// Sums of squares of a linear model's term when the residuals of the model without it are permuted (Freedman and Lane 1983;
// Collyer, Sekora and Adams 2015: RRPP).
#pragma once
#include <functional>
#include <vector>

namespace crestline {

// What a permutation leaves in the span of the term, and in that of the whole model, summed over all variables.
// gram: n x n, inner products of the residuals. own, whole: n x n, projections onto the two spans. orders: n x b, from 0, a
// column a permutation. out: 2 x b.
void permuted_forms(const double* gram, const double* own, const double* whole, int n, const int* orders, int b, double* out,
                    const std::function<void()>& between);

// A term of a model, and where its sums of squares go.
struct PermutedTerm {
  const double* without;  // n x without_count, orthonormal: the model without the term
  int without_count;
  const double* fitted;  // q x without_count: what the variables have on these
  const double* own;  // p x df: the term's own directions in the basis of the whole model
  int df;
  double* in_own;  // b x q: in the span of the term
  double* in_whole;  // b x q: in that of the whole model
};

// The same for every variable by itself, for all terms of a model at once: the variables are permuted once, and what the
// model without a term fits is taken off afterwards.
// y: q x n, a column a specimen. basis: n x p, orthonormal, the whole model square to the mean.
void permuted_squares(const double* y, int q, int n, const double* basis, int p, const std::vector<PermutedTerm>& terms,
                      const int* orders, int b, const std::function<void()>& between);

}  // namespace crestline
