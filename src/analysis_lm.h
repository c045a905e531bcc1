// Sums of squares of a linear model's term when the residuals of the model without it are permuted (Freedman and Lane 1983;
// Collyer, Sekora and Adams 2015: RRPP).
#pragma once
#include <functional>

namespace crestline {

// What a permutation leaves in the span of the term, and in that of the whole model, summed over all variables.
// gram: n x n, inner products of the residuals. own, whole: n x n, projections onto the two spans. orders: n x b, from 0, a
// column a permutation. out: 2 x b.
void permuted_forms(const double* gram, const double* own, const double* whole, int n, const int* orders, int b, double* out,
                    const std::function<void()>& between);

// The same for every variable by itself.
// residuals: q x n, a column a specimen. basis: n x p, orthonormal, the term's own `df` columns first. own, whole: b x q.
void permuted_squares(const double* residuals, int q, int n, const double* basis, int p, int df, const int* orders, int b,
                      double* own, double* whole, const std::function<void()>& between);

}  // namespace crestline
