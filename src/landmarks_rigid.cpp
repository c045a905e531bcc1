#include "landmarks_rigid.h"

#include <algorithm>
#include <cmath>

namespace crestline {

namespace {

void turn(const double* r, const double* x, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = r[i] * x[0] + r[3 + i] * x[1] + r[6 + i] * x[2];
}

void move_point(const Pose& pose, const double* x, double* out) {
  turn(pose.rotation, x, out);
  for (int k = 0; k < 3; ++k) out[k] = pose.scale * out[k] + pose.shift[k];
}

struct Pair {
  int moving;
  int fixed;
  double distance2;
};

std::vector<Pair> matches(const Cloud& moving, const CloudGrid& fixed, const Pose& pose, double reach, double cosine) {
  std::vector<Pair> out;
  for (int i = 0; i < moving.n; ++i) {
    double at[3], normal[3], d2 = 0;
    move_point(pose, moving.xyz + 3 * i, at);
    turn(pose.rotation, moving.normal + 3 * i, normal);
    int j = fixed.nearest(at, normal, nullptr, reach, cosine, &d2);
    if (j >= 0) out.push_back({i, j, d2});
  }
  return out;
}

// Eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix, by Jacobi's rotations.
void largest_eigenvector(double a[4][4], double* vector) {
  double v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0, on = 0;
    for (int p = 0; p < 4; ++p) {
      on += a[p][p] * a[p][p];
      for (int q = p + 1; q < 4; ++q) off += a[p][q] * a[p][q];
    }
    if (off <= 1e-28 * on) break;
    for (int p = 0; p < 3; ++p) {
      for (int q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0) continue;
        double theta = 0.5 * std::atan2(2 * a[p][q], a[q][q] - a[p][p]);
        double c = std::cos(theta), s = std::sin(theta);
        for (int k = 0; k < 4; ++k) {
          double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y;
          a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          double x = a[p][k], y = a[q][k], vx = v[k][p], vy = v[k][q];
          a[p][k] = c * x - s * y;
          a[q][k] = s * x + c * y;
          v[k][p] = c * vx - s * vy;
          v[k][q] = s * vx + c * vy;
        }
      }
    }
  }
  int best = 0;
  for (int p = 1; p < 4; ++p) if (a[p][p] > a[best][best]) best = p;
  for (int k = 0; k < 4; ++k) vector[k] = v[k][best];
}

// Horn's closed form: the unit quaternion of the rotation that takes the moving points to the fixed.
void rotation_of(const double s[3][3], double* r) {
  double n[4][4] = {
      {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
      {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
      {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
      {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}};
  double q[4];
  largest_eigenvector(n, q);
  double w = q[0], x = q[1], y = q[2], z = q[3];
  double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                       {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                       {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  for (int i = 0; i < 3; ++i) for (int j = 0; j < 3; ++j) r[3 * j + i] = rows[i][j];
}

Pose pose_of(const Cloud& moving, const Cloud& fixed, const std::vector<Pair>& pairs, const double* bounds) {
  double a[3] = {0, 0, 0}, b[3] = {0, 0, 0}, s[3][3] = {{0}}, spread = 0, along = 0;
  for (const Pair& p : pairs) {
    for (int k = 0; k < 3; ++k) {
      a[k] += moving.xyz[3 * p.moving + k] / pairs.size();
      b[k] += fixed.xyz[3 * p.fixed + k] / pairs.size();
    }
  }
  for (const Pair& p : pairs) {
    for (int i = 0; i < 3; ++i) {
      double x = moving.xyz[3 * p.moving + i] - a[i];
      spread += x * x;
      for (int j = 0; j < 3; ++j) s[i][j] += x * (fixed.xyz[3 * p.fixed + j] - b[j]);
    }
  }
  Pose out;
  rotation_of(s, out.rotation);
  for (int i = 0; i < 3; ++i) for (int j = 0; j < 3; ++j) along += out.rotation[3 * j + i] * s[j][i];
  out.scale = std::min(std::max(along / spread, bounds[0]), bounds[1]);
  double turned[3];
  turn(out.rotation, a, turned);
  for (int k = 0; k < 3; ++k) out.shift[k] = b[k] - out.scale * turned[k];
  return out;
}

}  // namespace

Pose fit_pose(const Cloud& moving, const CloudGrid& fixed, Pose pose, const RigidSettings& settings) {
  for (int step = 0; step < settings.steps; ++step) {
    double share = settings.steps > 1 ? step / (settings.steps - 1.0) : 1;
    double reach = settings.reach[0] * std::pow(settings.reach[1] / settings.reach[0], share);
    std::vector<Pair> pairs = matches(moving, fixed, pose, reach, settings.cosine);
    std::size_t kept = static_cast<std::size_t>(settings.kept * pairs.size());
    if (kept < 6) return pose;
    std::nth_element(pairs.begin(), pairs.begin() + (kept - 1), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.distance2 < y.distance2; });
    pairs.resize(kept);
    pose = pose_of(moving, fixed.cloud(), pairs, settings.scale);
  }
  return pose;
}

double pose_score(const Cloud& moving, const CloudGrid& fixed, const Pose& pose, const RigidSettings& settings) {
  double sum = 0;
  const Cloud& to = fixed.cloud();
  std::vector<Pair> pairs = matches(moving, fixed, pose, settings.saturation + settings.spacing, settings.cosine);
  for (const Pair& p : pairs) {
    double at[3], across = 0;
    move_point(pose, moving.xyz + 3 * p.moving, at);
    for (int k = 0; k < 3; ++k) across += (at[k] - to.xyz[3 * p.fixed + k]) * to.normal[3 * p.fixed + k];
    double along = std::max(std::sqrt(std::max(p.distance2 - across * across, 0.0)) - settings.spacing, 0.0);
    sum += std::min(std::sqrt(across * across + along * along) / settings.saturation, 1.0);
  }
  return (sum + moving.n - static_cast<double>(pairs.size())) / moving.n;
}

}  // namespace crestline
