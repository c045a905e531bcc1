// Groups whose covariances have one form and differ by a factor: their scales, and T2 on the
// components of the specimens that are brought to one scale.
#pragma once
#include <functional>

namespace crestline {

// For every regrouping: the scale of each group and T2 (more groups: Hotelling and Lawley's trace
// times the degrees of freedom).
//
// Residuals of each group are divided by the root of its scale, and means' deviations from the mean
// by precision by their standard errors by these scales (Welch; James 1951). T2 is that on the first
// components of the sum of the two scatters. A group's scale is then what its residuals have on
// these components, each component alike, and the components are found anew: `rounds` times.
//
// x: m x n, a column a specimen, rows centred. labels: n x b, from 0, a column a regrouping.
// count: components, at most m. least: least scale, as a share of the mean one. rounding:
// a mean's score is 0 up to that share of all of the component.
// t2: b. scale: groups x b, their mean over degrees of freedom is 1.
void common_form_t2(const double* x, int m, int n, const int* labels, int b, int groups, int count,
                    int rounds, double least, double rounding, double* t2,
                    double* scale,
                    const std::function<void()>& between);

}  // namespace crestline
