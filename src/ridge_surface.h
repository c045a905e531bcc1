// Moments of a tensor-product regression from the designs of its two margins.
#pragma once
#include <vector>

namespace crestline {

struct TensorMoments {
  std::vector<double> matrix;  // X'X, square of order ka * kc
  std::vector<double> right;   // X'y
};

// along: n x ka, across: n x kc, column major, mostly zeros; y: n. Column (c, a) of X is the product of
// column c of `across` and column a of `along`, c running fastest.
TensorMoments tensor_moments(const double* along, int ka, const double* across, int kc,
                             const double* y, int n);

// Rows of such an X summed by group: functions x groups, column major. group: of each row, from 0.
std::vector<double> summed_tensor(const double* along, int ka, const double* across, int kc,
                                  const std::vector<int>& group, int groups);

}  // namespace crestline
