#include "placing_rigid.h"

#include <algorithm>
#include <cmath>

#include "geometry_rotation.h"

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

std::vector<Pair> matches(const Cloud& moving, const CloudGrid& fixed, const Pose& pose,
                          double reach, double cosine) {
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

void rotation_of(const double s[3][3], double* r) {
  double h[9], rows[9];
  for (int i = 0; i < 3; ++i) for (int j = 0; j < 3; ++j) h[3 * j + i] = s[i][j];
  rotation_in_space(h, rows);
  for (int i = 0; i < 3; ++i) for (int j = 0; j < 3; ++j) r[3 * j + i] = rows[3 * i + j];
}

Pose pose_of(const Cloud& moving, const Cloud& fixed, const std::vector<Pair>& pairs,
             const double* bounds) {
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
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) along += out.rotation[3 * j + i] * s[j][i];
  out.scale = std::min(std::max(along / spread, bounds[0]), bounds[1]);
  double turned[3];
  turn(out.rotation, a, turned);
  for (int k = 0; k < 3; ++k) out.shift[k] = b[k] - out.scale * turned[k];
  return out;
}

// Root mean square of the way from one pose of the points to another.
double moved_by(const Cloud& moving, const Pose& from, const Pose& to) {
  double sum = 0;
  for (int i = 0; i < moving.n; ++i) {
    double a[3], b[3];
    move_point(from, moving.xyz + 3 * i, a);
    move_point(to, moving.xyz + 3 * i, b);
    for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return std::sqrt(sum / moving.n);
}

}  // namespace

Pose fit_pose(const Cloud& moving, const CloudGrid& fixed, Pose pose,
              const RigidSettings& settings, bool* rests) {
  *rests = false;
  for (int step = 0; step < settings.steps + settings.more && !*rests; ++step) {
    double share = settings.steps > 1 ? std::min(step / (settings.steps - 1.0), 1.0) : 1;
    double reach = settings.reach[0] * std::pow(settings.reach[1] / settings.reach[0], share);
    std::vector<Pair> pairs = matches(moving, fixed, pose, reach, settings.cosine);
    std::size_t kept = static_cast<std::size_t>(settings.kept * pairs.size());
    if (kept < 6) return pose;
    std::nth_element(pairs.begin(), pairs.begin() + (kept - 1), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.distance2 < y.distance2; });
    pairs.resize(kept);
    Pose next = pose_of(moving, fixed.cloud(), pairs, settings.scale);
    if (step >= settings.steps) *rests = moved_by(moving, pose, next) <= settings.rest;
    pose = next;
  }
  return pose;
}

double pose_score(const Cloud& moving, const CloudGrid& fixed, const Pose& pose,
                  const RigidSettings& settings) {
  double sum = 0;
  const Cloud& to = fixed.cloud();
  std::vector<Pair> pairs =
      matches(moving, fixed, pose, settings.saturation + settings.spacing, settings.cosine);
  for (const Pair& p : pairs) {
    double at[3], across = 0;
    move_point(pose, moving.xyz + 3 * p.moving, at);
    for (int k = 0; k < 3; ++k)
      across += (at[k] - to.xyz[3 * p.fixed + k]) * to.normal[3 * p.fixed + k];
    double along =
        std::max(std::sqrt(std::max(p.distance2 - across * across, 0.0)) - settings.spacing, 0.0);
    sum += std::min(std::sqrt(across * across + along * along) / settings.saturation, 1.0);
  }
  return (sum + moving.n - static_cast<double>(pairs.size())) / moving.n;
}

}  // namespace crestline
