// The normal matrix of a displacement that is fitted to matched points.
#pragma once
#include <vector>

namespace crestline {

// Functions of one co-ordinate at all points: n x size, column by column.
struct Basis {
  const double* values;
  int n;
  int size;
};

// Gram matrix of the weighted equations "the displacement's part along the normal" and, of each
// co-ordinate, "the displacement":
//   G[(k, i), (l, j)] = sum over matches r of (across w n_k n_l + [k = l] along w) B_k[r, i] B_l[r,
//   j].
// basis: of x, y and z; used: the matched points, from 0; normal: 3 x matches; weight: of the
// matches. p x p, both triangles, p the sum of the sizes. `between` is called between blocks of
// matches.
std::vector<double> warp_gram(const Basis basis[3], const std::vector<int>& used,
                              const double* normal, const double* weight, double along,
                              double across, void (*between)());

}  // namespace crestline
