// Cubic B-splines, and their averages under a biweight kernel, exactly.
#pragma once
#include <vector>

namespace crestline {

// Cubic B-splines on `knots` (k + 4 of them, rising), averaged about each x under the kernel
// 15 / 16 (1 - (t / half)^2)^2 / half on (-half, half), or the first or second derivative of that mean by x:
// n x k, column major. Beyond the knots 4 and k + 1 (counted from 1), where the splines' interval ends, they
// count as 0. Each piece of the integrand is a polynomial of degree 7 at most, so that four Gauss points a knot
// interval are exact.
std::vector<double> biweight_design(const double* knots, int k, const double* x, int n, double half,
                                    int derivative);

// The splines themselves, or a derivative of order 1 to 3, at each x between the knots 4 and k + 1: n x k, column
// major.
std::vector<double> spline_design(const double* knots, int k, const double* x, int n, int derivative);

}  // namespace crestline
