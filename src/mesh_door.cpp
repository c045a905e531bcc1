#include "mesh_door.h"

#include <cmath>
#include <cstddef>

namespace crestline {

namespace {

int next_side(int h) { return h % 3 == 2 ? h - 2 : h + 1; }

bool leads_back(const int* it, const int* twin, int h, int sides) {
  int t = twin[h] - 1;
  if (t == -1) return true;
  if (t < 0 || t >= sides || twin[t] != h + 1) return false;
  return it[h] == it[next_side(t)] && it[next_side(h)] == it[t];
}

}  // namespace

MeshFaults mesh_faults(const double* vb, int rows, int n, const int* it, int m) {
  MeshFaults found{0, 0};
  for (int f = 0; f < m; ++f) {
    const int* v = it + 3 * static_cast<std::size_t>(f);
    bool good = true;
    for (int c = 0; c < 3; ++c) good = good && v[c] >= 1 && v[c] <= n;
    found.faces += !good;
  }
  for (int i = 0; i < n; ++i) {
    const double* x = vb + rows * static_cast<std::size_t>(i);
    double fourth = 0;
    for (int k = 0; k < 3; ++k) fourth += x[k] * x[k] * x[k] * x[k];
    found.vertices += !std::isfinite(fourth);
  }
  return found;
}

int twin_faults(const int* it, const int* twin, int m) {
  int found = 0;
  for (int h = 0; h < 3 * m; ++h) found += !leads_back(it, twin, h, 3 * m);
  return found;
}

double box_diagonal(const double* vb, int rows, int n) {
  double low[3], high[3], total = 0, seen = 0;
  for (int k = 0; k < 3; ++k) low[k] = high[k] = vb[k];
  for (int i = 0; i < n; ++i) {
    const double* x = vb + rows * static_cast<std::size_t>(i);
    for (int k = 0; k < 3; ++k) {
      if (x[k] < low[k]) low[k] = x[k];
      if (x[k] > high[k]) high[k] = x[k];
      seen += x[k] - x[k];
    }
  }
  for (int k = 0; k < 3; ++k) total += (high[k] - low[k]) * (high[k] - low[k]);
  return std::sqrt(total) + seen;
}

}  // namespace crestline
