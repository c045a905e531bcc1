// Sums of the members of a group, for many regroupings at once.
#pragma once
#include <functional>

namespace crestline {

// Of eight specimens there are 256 sums of some of them: these are made once, and every regrouping
// adds one of them, in place of up to eight specimens (Arlazarov, Dinic, Kronrod, Faradzhev 1970).
//
// x: q x m, a column a specimen. member: m x b, other than 0 where it is one. out: q x b.
void member_sums(const double* x, int q, int m, const int* member, int b, double* out,
                 const std::function<void()>& between);

}  // namespace crestline
