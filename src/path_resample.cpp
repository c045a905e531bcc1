#include "path_resample.h"

#include <algorithm>

namespace crestline {

namespace {

double chord(const double* a, const double* b) {
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

// Where the sum of chords reaches equal shares, by linear interpolation of `s`.
std::vector<double> equal_shares(const std::vector<double>& sum, const std::vector<double>& s) {
  std::size_t n = s.size(), i = 1;
  std::vector<double> aim(s);
  for (std::size_t j = 1; j + 1 < n; ++j) {
    double wanted = sum[n - 1] * j / (n - 1);
    while (i + 1 < n && sum[i] < wanted) ++i;
    double step = sum[i] - sum[i - 1];
    aim[j] = s[i - 1] + (step > 0 ? (wanted - sum[i - 1]) / step : 0) * (s[i] - s[i - 1]);
  }
  return aim;
}

}  // namespace

int point_along(const Track& track, double s, double* xyz) {
  std::size_t k = track.s.size();
  std::size_t i = std::upper_bound(track.s.begin(), track.s.end(), s) - track.s.begin();
  i = std::min(std::max<std::size_t>(i, 1), k - 1);
  double step = track.s[i] - track.s[i - 1];
  double share = step > 0 ? std::min(std::max((s - track.s[i - 1]) / step, 0.0), 1.0) : 0;
  const double *a = &track.xyz[3 * (i - 1)], *b = &track.xyz[3 * i];
  for (int c = 0; c < 3; ++c) xyz[c] = a[c] + share * (b[c] - a[c]);
  return static_cast<int>(i);
}

Spacing equal_chords(const Track& track, int n, const ChordSettings& settings) {
  Spacing out;
  double length = track.s.back(), spread = INFINITY, share = 1;
  for (int j = 0; j < n; ++j) out.s.push_back(j + 1 < n ? length * j / (n - 1) : length);
  std::vector<double> at(3 * static_cast<std::size_t>(n)), sum(n, 0.0);
  for (int round = 0; round < settings.iterations; ++round) {
    double least = INFINITY, most = 0;
    for (int j = 0; j < n; ++j) {
      point_along(track, out.s[j], &at[3 * j]);
      if (j == 0) continue;
      double c = chord(&at[3 * j], &at[3 * (j - 1)]);
      sum[j] = sum[j - 1] + c;
      least = std::min(least, c);
      most = std::max(most, c);
    }
    double before = spread;
    spread = most / least - 1;
    if (!(spread >= settings.tolerance)) break;
    // Towards where the sum of chords reaches equal shares; more slowly once that overshoots.
    if (spread >= before) share = std::max(share / 2, settings.slowest);
    std::vector<double> aim = equal_shares(sum, out.s);
    for (int j = 0; j < n; ++j) out.s[j] += share * (aim[j] - out.s[j]);
  }
  out.converged = spread < settings.tolerance;
  return out;
}

SurfacePoint place_in_face(const Triangulation& mesh, int face, const double* xyz) {
  const double* a = corner(mesh, vertex_at(mesh, 3 * face));
  const double* b = corner(mesh, vertex_at(mesh, 3 * face + 1));
  const double* c = corner(mesh, vertex_at(mesh, 3 * face + 2));
  double uu = 0, uv = 0, vv = 0, wu = 0, wv = 0;
  for (int i = 0; i < 3; ++i) {
    double u = b[i] - a[i], v = c[i] - a[i], w = xyz[i] - a[i];
    uu += u * u;
    uv += u * v;
    vv += v * v;
    wu += w * u;
    wv += w * v;
  }
  double det = uu * vv - uv * uv, w2 = (vv * wu - uv * wv) / det, w3 = (uu * wv - uv * wu) / det;
  SurfacePoint p{face, {std::max(1 - w2 - w3, 0.0), std::max(w2, 0.0), std::max(w3, 0.0)}};
  double total = p.w[0] + p.w[1] + p.w[2];
  for (double& w : p.w) w /= total;
  return p;
}

}  // namespace crestline
