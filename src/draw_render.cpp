#include "draw_render.h"

#include "interrupt.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crestline {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

// n values, in steps between which the user may end: large pictures take gigabytes.
template <class T>
void fill(std::vector<T>& x, std::size_t n, T value, Patience& patience) {
  constexpr std::size_t kStep = 1 << 22;
  x.reserve(n);
  while (x.size() < n) {
    x.resize(std::min(n, x.size() + kStep), value);
    if (patience.over()) patience.finish();
  }
}

// What each sample sees: depth and colour, row by row.
struct Samples {
  int width, height;
  std::vector<double> depth;
  std::vector<float> rgb;

  Samples(int w, int h, Patience& patience) : width(w), height(h) {
    fill(depth, static_cast<std::size_t>(w) * h, kNothing, patience);
    fill(rgb, 3 * static_cast<std::size_t>(w) * h, 0.0f, patience);
  }
};

int clamp_to(double x, int last) {
  return static_cast<int>(std::min(std::max(x, 0.0), static_cast<double>(last)));
}

// Corner co-ordinates times `scale` are in samples; sample (i, j) sits at (i + 0.5, j + 0.5).
void draw_triangle(const double* xyz, const double* rgb, const int* corner, double scale,
                   Samples& s) {
  const double* p[3];
  double x[3], y[3];
  for (int c = 0; c < 3; ++c) {
    p[c] = xyz + 3 * corner[c];
    x[c] = p[c][0] * scale;
    y[c] = p[c][1] * scale;
  }
  double area = (x[2] - x[0]) * (y[1] - y[0]) - (x[1] - x[0]) * (y[2] - y[0]);
  if (!(area > 0)) return;
  auto range_x = std::minmax({x[0], x[1], x[2]});
  auto range_y = std::minmax({y[0], y[1], y[2]});
  if (range_x.second < 0 || range_y.second < 0 || range_x.first > s.width ||
      range_y.first > s.height)
    return;
  int first_i = clamp_to(std::ceil(range_x.first - 0.5), s.width - 1);
  int last_i = clamp_to(std::floor(range_x.second - 0.5), s.width - 1);
  int first_j = clamp_to(std::ceil(range_y.first - 0.5), s.height - 1);
  int last_j = clamp_to(std::floor(range_y.second - 0.5), s.height - 1);
  for (int j = first_j; j <= last_j; ++j)
    for (int i = first_i; i <= last_i; ++i) {
      double px = i + 0.5, py = j + 0.5;
      double w0 = ((x[2] - px) * (y[1] - py) - (x[1] - px) * (y[2] - py)) / area;
      double w1 = ((x[0] - px) * (y[2] - py) - (x[2] - px) * (y[0] - py)) / area;
      double w2 = 1 - w0 - w1;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      std::size_t at = static_cast<std::size_t>(j) * s.width + i;
      double depth = w0 * p[0][2] + w1 * p[1][2] + w2 * p[2][2];
      if (depth <= s.depth[at]) continue;
      s.depth[at] = depth;
      for (int k = 0; k < 3; ++k)
        s.rgb[3 * at + k] =
            static_cast<float>(w0 * rgb[3 * corner[0] + k] + w1 * rgb[3 * corner[1] + k] +
                               w2 * rgb[3 * corner[2] + k]);
    }
}

// Pixel (column i, row j): the mean colour of the samples that see something, and their share as
// alpha.
void average_pixel(const Samples& s, int i, int j, int samples, int width, int height,
                   Picture& out) {
  double sum[3] = {0, 0, 0}, farthest = std::numeric_limits<double>::infinity();
  int seen = 0;
  for (int dj = 0; dj < samples; ++dj)
    for (int di = 0; di < samples; ++di) {
      std::size_t at = static_cast<std::size_t>(j * samples + dj) * s.width + i * samples + di;
      if (s.depth[at] == kNothing) continue;
      ++seen;
      farthest = std::min(farthest, s.depth[at]);
      for (int k = 0; k < 3; ++k) sum[k] += s.rgb[3 * at + k];
    }
  if (seen == 0) return;
  std::size_t plane = static_cast<std::size_t>(width) * height;
  std::size_t pixel = static_cast<std::size_t>(i) * height + j;
  for (int k = 0; k < 3; ++k) out.rgba[k * plane + pixel] = std::min(1.0, sum[k] / seen);
  out.rgba[3 * plane + pixel] = static_cast<double>(seen) / (samples * samples);
  out.depth[pixel] = farthest;
}

}  // namespace

Picture render_mesh(const double* xyz, const double* rgb, const int* it, int m, int width,
                    int height, int samples, const std::function<void()>& between) {
  Patience patience(between);
  Samples s(width * samples, height * samples, patience);
  for (int f = 0; f < m && !patience.over(); ++f) draw_triangle(xyz, rgb, it + 3 * f, samples, s);
  patience.finish();
  Picture out;
  fill(out.rgba, 4 * static_cast<std::size_t>(width) * height, 0.0, patience);
  fill(out.depth, static_cast<std::size_t>(width) * height, kNothing, patience);
  for (int i = 0; i < width && !patience.over(); ++i)
    for (int j = 0; j < height; ++j) average_pixel(s, i, j, samples, width, height, out);
  patience.finish();
  return out;
}

}  // namespace crestline
