#include "analysis_align.h"

#include "interrupt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry_rotation.h"

namespace crestline {

namespace {

constexpr int kMost = 3;

void rotation_in_plane(const double* h, double* r) {
  double c = h[0] + h[3], s = h[2] - h[1], size = std::hypot(c, s);
  c = size > 0 ? c / size : 1;
  s = size > 0 ? s / size : 0;
  r[0] = c;
  r[1] = -s;
  r[2] = s;
  r[3] = c;
}

// Weighted centre to 0; returns the weighted size.
double centre(double* x, int k, int dim, const double* weight) {
  double total = 0, size = 0;
  for (int i = 0; i < k; ++i) total += weight[i];
  for (int d = 0; d < dim; ++d) {
    double* column = x + static_cast<std::size_t>(k) * d;
    double mean = 0;
    for (int i = 0; i < k; ++i) mean += weight[i] * column[i];
    mean /= total;
    for (int i = 0; i < k; ++i) {
      column[i] -= mean;
      size += weight[i] * column[i] * column[i];
    }
  }
  return std::sqrt(size);
}

void times(double* x, std::size_t n, double factor) {
  for (std::size_t i = 0; i < n; ++i) x[i] *= factor;
}

// h = x' W y
void overlap(const double* x, const double* y, int k, int dim, double* h) {
  for (int b = 0; b < dim; ++b)
    for (int a = 0; a < dim; ++a) {
      const double *p = x + static_cast<std::size_t>(k) * a,
                   *q = y + static_cast<std::size_t>(k) * b;
      double sum = 0;
      for (int i = 0; i < k; ++i) sum += p[i] * q[i];
      h[a + dim * b] = sum;
    }
}

// to += factor x r
void add_turned(const double* x, const double* r, double factor, int k, int dim, double* to) {
  for (int b = 0; b < dim; ++b)
    for (int a = 0; a < dim; ++a) {
      const double* from = x + static_cast<std::size_t>(k) * a;
      double* sum = to + static_cast<std::size_t>(k) * b;
      double f = factor * r[a + dim * b];
      for (int i = 0; i < k; ++i) sum[i] += f * from[i];
    }
}

std::vector<double> weighted(const std::vector<double>& x, const double* weight, int k) {
  std::vector<double> out(x);
  for (std::size_t i = 0; i < x.size(); ++i) out[i] *= weight[i % k];
  return out;
}

double norm(const std::vector<double>& x, const double* weight, int k) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i % k] * x[i] * x[i];
  return std::sqrt(sum);
}

double trace_with(const double* r, const double* h, int dim) {
  double sum = 0;
  for (int i = 0; i < dim * dim; ++i) sum += r[i] * h[i];
  return sum;
}

double furthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

void turn_in_place(double* x, const double* r, double factor, int k, int dim,
                   std::vector<double>& room) {
  std::fill(room.begin(), room.end(), 0.0);
  add_turned(x, r, factor, k, dim, room.data());
  std::copy(room.begin(), room.end(), x);
}

}  // namespace

void nearest_rotation(const double* h, int dim, double* r) {
  if (dim == 2) {
    rotation_in_plane(h, r);
  } else {
    rotation_in_space(h, r);
  }
}

Aligned align_configurations(std::vector<double>& x, int k, int dim, int n, const double* weight,
                             const double* reference, const AlignSettings& settings,
                             const std::function<void()>& between) {
  Patience patience(between);
  const std::size_t block = static_cast<std::size_t>(k) * dim;
  const bool unit = settings.scaling != Scaling::kNone;
  Aligned out;
  out.converged = false;
  for (int i = 0; i < n; ++i) {
    out.size.push_back(centre(&x[i * block], k, dim, weight));
    if (unit) times(&x[i * block], block, 1 / out.size[i]);
  }
  std::vector<double> start(reference, reference + block);
  double start_size = centre(start.data(), k, dim, weight);
  if (unit) times(start.data(), block, 1 / start_size);
  out.mean = start;
  std::vector<double> turns(static_cast<std::size_t>(n) * kMost * kMost), factor(n, 1.0),
      next(block);
  double h[kMost * kMost];
  for (int round = 0; round < settings.rounds && !out.converged; ++round) {
    std::vector<double> aim = weighted(out.mean, weight, k);
    std::fill(next.begin(), next.end(), 0.0);
    for (int i = 0; i < n; ++i) {
      if (patience.over()) patience.finish();
      double* r = &turns[static_cast<std::size_t>(i) * kMost * kMost];
      overlap(&x[i * block], aim.data(), k, dim, h);
      nearest_rotation(h, dim, r);
      if (settings.scaling == Scaling::kFull) factor[i] = trace_with(r, h, dim);
      add_turned(&x[i * block], r, factor[i], k, dim, next.data());
    }
    times(next.data(), block, unit ? 1 / norm(next, weight, k) : 1.0 / n);
    double size = norm(next, weight, k);
    out.moved.push_back(furthest(next, out.mean) / size);
    out.mean.swap(next);
    out.converged = out.moved.back() <= settings.tolerance;
  }
  // All in the pose of the reference.
  std::vector<double> room(block);
  double back[kMost * kMost];
  overlap(out.mean.data(), weighted(start, weight, k).data(), k, dim, h);
  nearest_rotation(h, dim, back);
  for (int i = 0; i < n; ++i) {
    turn_in_place(&x[i * block], &turns[static_cast<std::size_t>(i) * kMost * kMost], factor[i], k,
                  dim, room);
    turn_in_place(&x[i * block], back, 1, k, dim, room);
  }
  turn_in_place(out.mean.data(), back, 1, k, dim, room);
  return out;
}

std::vector<double> lay_onto(std::vector<double>& x, int k, int dim, int n, const double* weight,
                             const double* mean, Scaling scaling,
                             const std::function<void()>& between) {
  Patience patience(between);
  const std::size_t block = static_cast<std::size_t>(k) * dim;
  std::vector<double> size(n), room(block);
  const std::vector<double> aim = weighted(std::vector<double>(mean, mean + block), weight, k);
  double h[kMost * kMost], r[kMost * kMost];
  for (int i = 0; i < n; ++i) {
    if (patience.over()) patience.finish();
    double* own = &x[i * block];
    size[i] = centre(own, k, dim, weight);
    if (scaling != Scaling::kNone) times(own, block, 1 / size[i]);
    overlap(own, aim.data(), k, dim, h);
    nearest_rotation(h, dim, r);
    const double factor = scaling == Scaling::kFull ? trace_with(r, h, dim) : 1;
    turn_in_place(own, r, factor, k, dim, room);
  }
  return size;
}

}  // namespace crestline
