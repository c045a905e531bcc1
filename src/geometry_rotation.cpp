#include "geometry_rotation.h"

#include <algorithm>
#include <cmath>

namespace crestline {

namespace {

// Rotates rows p and q of the symmetric 4 x 4 matrix a so that a[p][q] is 0; v gathers the
// rotations.
void jacobi_turn(double a[4][4], double v[4][4], int p, int q) {
  if (a[p][q] == 0) return;
  double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  double t = (theta >= 0 ? 1 : -1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (int i = 0; i < 4; ++i) {
    double ip = a[i][p], iq = a[i][q];
    a[i][p] = c * ip - s * iq;
    a[i][q] = s * ip + c * iq;
  }
  for (int i = 0; i < 4; ++i) {
    double pi = a[p][i], qi = a[q][i], vp = v[i][p], vq = v[i][q];
    a[p][i] = c * pi - s * qi;
    a[q][i] = s * pi + c * qi;
    v[i][p] = c * vp - s * vq;
    v[i][q] = s * vp + c * vq;
  }
}

// The eigenvector of the largest eigenvalue.
void largest_eigenvector(double a[4][4], double* q) {
  double v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (int sweep = 0; sweep < 50; ++sweep) {
    double off = 0, on = 0;
    for (int i = 0; i < 4; ++i) {
      on += a[i][i] * a[i][i];
      for (int j = i + 1; j < 4; ++j) off += a[i][j] * a[i][j];
    }
    if (off <= 1e-36 * on) break;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) jacobi_turn(a, v, i, j);
  }
  int best = 0;
  for (int i = 1; i < 4; ++i)
    if (a[i][i] > a[best][best]) best = i;
  for (int i = 0; i < 4; ++i) q[i] = v[i][best];
}

}  // namespace

void rotation_in_space(const double* h, double* r) {
  auto m = [h](int i, int j) { return h[i + 3 * j]; };
  double a[4][4] = {
      {m(0, 0) + m(1, 1) + m(2, 2), m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0)},
      {0, m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(2, 0) + m(0, 2)},
      {0, 0, -m(0, 0) + m(1, 1) - m(2, 2), m(1, 2) + m(2, 1)},
      {0, 0, 0, -m(0, 0) - m(1, 1) + m(2, 2)}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) a[i][j] = a[j][i];
  double q[4];
  largest_eigenvector(a, q);
  double w = q[0], x = q[1], y = q[2], z = q[3];
  double turn[9] = {
      w * w + x * x - y * y - z * z, 2 * (x * y - w * z),           2 * (x * z + w * y),
      2 * (x * y + w * z),           w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
      2 * (x * z - w * y),           2 * (y * z + w * x),           w * w - x * x - y * y + z * z};
  std::copy(turn, turn + 9, r);
}

}  // namespace crestline
