#include "placing_starts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace crestline {

namespace {

constexpr double most_cells = 3e6;

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The point of a cloud nearest to the middle of each cell, -1 where none is within reach.
class LookUp {
 public:
  LookUp(const Cloud& cloud, double cell, double reach) : cell_(cell) {
    double half[3] = {0, 0, 0};
    for (int i = 0; i < cloud.n; ++i)
      for (int k = 0; k < 3; ++k) half[k] = std::max(half[k], std::fabs(cloud.xyz[3 * i + k]));
    for (double total = most_cells + 1; total > most_cells;) {
      total = 1;
      for (int k = 0; k < 3; ++k) {
        cells_[k] = 2 * (static_cast<long>((half[k] + reach) / cell_) + 1);
        total *= cells_[k];
      }
      if (total > most_cells) cell_ *= 1.3;
    }
    near_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2], -1);
    std::vector<float> gap(near_.size(), std::numeric_limits<float>::max());
    for (int i = 0; i < cloud.n; ++i) spread(cloud.xyz + 3 * i, i, reach, &gap);
  }

  int nearest(const double* x) const {
    long c[3];
    for (int k = 0; k < 3; ++k) {
      c[k] = cell_of(x[k], k);
      if (c[k] < 0 || c[k] >= cells_[k]) return -1;
    }
    return near_[(static_cast<std::size_t>(c[2]) * cells_[1] + c[1]) * cells_[0] + c[0]];
  }

 private:
  long cell_of(double x, int k) const {
    return static_cast<long>(std::floor(x / cell_)) + cells_[k] / 2;
  }
  double middle(long c, int k) const { return (c - cells_[k] / 2 + 0.5) * cell_; }

  // Makes a point the nearest of the cells about it to which no other is nearer.
  void spread(const double* x, int i, double reach, std::vector<float>* gap) {
    long from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = std::max(0L, cell_of(x[k] - reach, k));
      to[k] = std::min(cells_[k] - 1, cell_of(x[k] + reach, k));
    }
    for (long c = from[2]; c <= to[2]; ++c)
      for (long b = from[1]; b <= to[1]; ++b) {
        double dz = middle(c, 2) - x[2], dy = middle(b, 1) - x[1], base = dz * dz + dy * dy;
        std::size_t row = (static_cast<std::size_t>(c) * cells_[1] + b) * cells_[0];
        for (long a = from[0]; a <= to[0]; ++a) {
          double dx = middle(a, 0) - x[0], d2 = base + dx * dx;
          if (d2 > reach * reach || d2 >= (*gap)[row + a]) continue;
          (*gap)[row + a] = static_cast<float>(d2);
          near_[row + a] = i;
        }
      }
  }

  double cell_;
  long cells_[3];
  std::vector<int> near_;
};

// Axes square to a normal, columns 0 and 1, and the normal, column 2: the first from the axis of
// the cloud that is least along it.
void frame_about(const double* normal, double* frame) {
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::fabs(normal[k]) < std::fabs(normal[least])) least = k;
  double length = 0;
  for (int k = 0; k < 3; ++k) {
    frame[k] = (k == least) - normal[least] * normal[k];
    length += frame[k] * frame[k];
    frame[6 + k] = normal[k];
  }
  for (int k = 0; k < 3; ++k) frame[k] /= std::sqrt(length);
  for (int k = 0; k < 3; ++k)
    frame[3 + k] =
        normal[(k + 1) % 3] * frame[(k + 2) % 3] - normal[(k + 2) % 3] * frame[(k + 1) % 3];
}

Pose turned(const double* frame, int turn, int turns, double scale, const double* at) {
  double c = std::cos(2 * M_PI * turn / turns), s = std::sin(2 * M_PI * turn / turns);
  Pose out;
  for (int k = 0; k < 3; ++k) {
    out.rotation[k] = c * frame[k] + s * frame[3 + k];
    out.rotation[3 + k] = c * frame[3 + k] - s * frame[k];
    out.rotation[6 + k] = frame[6 + k];
    out.shift[k] = at[k];
  }
  out.scale = scale;
  return out;
}

// Mean cost of the template's points; those left over are not looked at once the sum is above
// `limit`, and the answer is then too small but above limit / n.
double look_up_score(const Cloud& points, const Cloud& cloud, const LookUp& near, const Pose& pose,
                     const StartSettings& settings, double limit) {
  double sum = 0;
  double saturation = settings.reach * std::min(pose.scale, 1.0);
  for (int i = 0; i < points.n && sum < limit; ++i) {
    double x[3], n[3];
    for (int k = 0; k < 3; ++k) {
      const double* r = pose.rotation + k;
      const double* p = points.xyz + 3 * i;
      const double* q = points.normal + 3 * i;
      x[k] = pose.shift[k] + pose.scale * (r[0] * p[0] + r[3] * p[1] + r[6] * p[2]);
      n[k] = r[0] * q[0] + r[3] * q[1] + r[6] * q[2];
    }
    int j = near.nearest(x);
    if (j < 0 || dot(n, cloud.normal + 3 * j) < settings.cosine) {
      sum += 1;
      continue;
    }
    double d2 = 0;
    for (int k = 0; k < 3; ++k) d2 += (x[k] - cloud.xyz[3 * j + k]) * (x[k] - cloud.xyz[3 * j + k]);
    double cost = (std::sqrt(d2) - settings.spacing / 2) / saturation;
    sum += std::min(1.0, std::max(0.0, cost));
  }
  return sum / points.n;
}

bool better(const Start& a, const Start& b) { return a.score < b.score; }

}  // namespace

std::vector<Mound> mounds(const Cloud& cloud, const double* at, int m, double radius) {
  CloudGrid grid(cloud, radius / 2);
  std::vector<Mound> out(m);
  for (int j = 0; j < m; ++j) {
    const double* x = at + 3 * j;
    double normal[3] = {0, 0, 0}, centroid[3] = {0, 0, 0}, sum = 0;
    grid.visit(x, radius, [&](int p, double d2) {
      double w = 1 - d2 / (radius * radius);
      sum += w;
      for (int k = 0; k < 3; ++k) {
        normal[k] += w * cloud.normal[3 * p + k];
        centroid[k] += w * (cloud.xyz[3 * p + k] - x[k]);
      }
    });
    double length = std::sqrt(dot(normal, normal));
    for (int k = 0; k < 3; ++k) out[j].normal[k] = length > 0 ? normal[k] / length : 0;
    out[j].height = sum > 0 ? -dot(out[j].normal, centroid) / sum : 0;
  }
  return out;
}

std::vector<Start> search_starts(const Cloud& points, const Cloud& cloud, const double* at,
                                 const std::vector<Mound>& mound, const StartSettings& settings,
                                 void (*between)()) {
  LookUp near(cloud, settings.voxel, settings.reach);
  std::vector<Start> all, here;
  for (std::size_t place = 0; place < mound.size(); ++place) {
    between();
    if (dot(mound[place].normal, mound[place].normal) < 0.5) continue;
    double frame[9];
    frame_about(mound[place].normal, frame);
    here.clear();
    for (int turn = 0; turn < settings.turns; ++turn)
      for (double scale : settings.scales) {
        Pose pose = turned(frame, turn, settings.turns, scale, at + 3 * place);
        bool full = static_cast<int>(here.size()) == settings.each;
        double limit = full ? here.back().score : 1;
        double score = look_up_score(points, cloud, near, pose, settings, limit * points.n);
        if (score >= limit) continue;
        if (full) here.pop_back();
        Start one{pose, score, static_cast<int>(place)};
        here.insert(std::upper_bound(here.begin(), here.end(), one, better), one);
      }
    all.insert(all.end(), here.begin(), here.end());
  }
  std::stable_sort(all.begin(), all.end(), better);
  return all;
}

}  // namespace crestline
