// Matrices of specimens by variables without a copy on the way.
#pragma once
#include <functional>
#include <vector>

namespace crestline {

// Some variables of every specimen, centred and multiplied: a row a specimen.
// x: the variables of each of n specimens. from, q: the first variable taken, from 0, and how many.
// factor: q. out: n x q.
void centred_rows(const std::vector<const double*>& x, int from, int q, const double* factor,
                  double* out, const std::function<void()>& between);

// Squared distance of every row to the mean of its group. y: n x q. means: groups x q. group: n,
// from 0. out: n.
void squared_distances(const double* y, int n, int q, const double* means, int groups,
                       const int* group, double* out, const std::function<void()>& between);

// Sum of the specimens, each times its weight. x: m variables of each of n. weight: n. out: m.
void weighted_sum(const std::vector<const double*>& x, int m, const double* weight, double* out);

}  // namespace crestline
