#include "mesh_neighbours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crestline {

namespace {

constexpr int kReach = 2;            // cells are half a radius wide, so a ball reaches two cells on
constexpr std::uint64_t kAxis = 21;  // bits of a cell's index along one axis

double squared(const double* p, const double* q) {
  double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return x * x + y * y + z * z;
}

}  // namespace

VertexGraph vertex_graph(const Triangulation& mesh) {
  const int n = mesh.n;
  VertexGraph g;
  std::vector<int> count(n + 1, 0);
  for (int h = 0; h < 3 * mesh.m; ++h) count[vertex_at(mesh, h) + 1] += 2;
  for (int v = 0; v < n; ++v) count[v + 1] += count[v];
  std::vector<int> all(count[n]), at(count.begin(), count.end() - 1);
  for (int h = 0; h < 3 * mesh.m; ++h) {
    int v = vertex_at(mesh, h), next = next_half_edge(h);
    all[at[v]++] = vertex_at(mesh, next);
    all[at[v]++] = vertex_at(mesh, next_half_edge(next));
  }
  g.start.assign(n + 1, 0);
  g.neighbour.reserve(all.size() / 2 + n);
  for (int v = 0; v < n; ++v) {
    auto begin = all.begin() + count[v], end = all.begin() + count[v + 1];
    std::sort(begin, end);
    g.neighbour.insert(g.neighbour.end(), begin, std::unique(begin, end));
    g.start[v + 1] = static_cast<int>(g.neighbour.size());
  }
  return g;
}

ConnectedBalls::ConnectedBalls(const double* xyz, int n, const VertexGraph& graph, double radius,
                               const std::vector<int>& targets)
    : xyz_(xyz), graph_(graph), radius_(radius), targets_(targets), cell_size_(radius / 2) {
  double high[3];
  for (int a = 0; a < 3; ++a) {
    origin_[a] = INFINITY;
    high[a] = -INFINITY;
    for (int t : targets) {
      origin_[a] = std::min(origin_[a], xyz[3 * t + a]);
      high[a] = std::max(high[a], xyz[3 * t + a]);
    }
    origin_[a] -= 2 * radius;
    high[a] += 2 * radius;
    cell_size_ = std::max(cell_size_, (high[a] - origin_[a]) / ((1 << kAxis) - 2 * kReach - 2));
  }
  std::vector<std::pair<std::uint64_t, int>> gridded;
  for (int v = 0; v < n; ++v) {
    const double* p = xyz + 3 * static_cast<std::size_t>(v);
    bool near = true;
    for (int a = 0; a < 3; ++a) near = near && p[a] >= origin_[a] && p[a] <= high[a];
    if (!near) continue;
    int c[3];
    cell_of(p, c);
    gridded.push_back({key(c[0], c[1], c[2]), v});
  }
  std::sort(gridded.begin(), gridded.end());
  key_.reserve(gridded.size());
  vertex_.reserve(gridded.size());
  for (const auto& g : gridded) {
    key_.push_back(g.first);
    vertex_.push_back(g.second);
  }
  std::vector<std::pair<std::uint64_t, int>> order(targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    int c[3];
    cell_of(xyz + 3 * static_cast<std::size_t>(targets[t]), c);
    order[t] = {key(c[0], c[1], c[2]), static_cast<int>(t)};
  }
  std::sort(order.begin(), order.end());
  cell_start_.push_back(0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && order[i].first != order[i - 1].first) cell_start_.push_back(static_cast<int>(i));
    cell_target_.push_back(order[i].second);
  }
  if (!order.empty()) cell_start_.push_back(static_cast<int>(order.size()));
}

void ConnectedBalls::cell_of(const double* p, int* index) const {
  for (int a = 0; a < 3; ++a)
    index[a] = kReach + static_cast<int>(std::floor((p[a] - origin_[a]) / cell_size_));
}

std::uint64_t ConnectedBalls::key(int ix, int iy, int iz) const {
  return (static_cast<std::uint64_t>(iz) << (2 * kAxis)) |
         (static_cast<std::uint64_t>(iy) << kAxis) | static_cast<std::uint64_t>(ix);
}

ConnectedBalls::Workspace ConnectedBalls::workspace() const {
  Workspace w;
  w.local.assign(graph_.start.size() - 1, -1);
  return w;
}

// Candidates of a cell with their distances from the centre of its targets; returns rho.
double ConnectedBalls::gather(int cell, Workspace& w) const {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int i = cell_start_[cell]; i < cell_start_[cell + 1]; ++i)
    for (int a = 0; a < 3; ++a) {
      double value = xyz_[3 * static_cast<std::size_t>(targets_[cell_target_[i]]) + a];
      low[a] = std::min(low[a], value);
      high[a] = std::max(high[a], value);
    }
  double centre[3], rho2 = 0;
  for (int a = 0; a < 3; ++a) centre[a] = (low[a] + high[a]) / 2;
  for (int i = cell_start_[cell]; i < cell_start_[cell + 1]; ++i)
    rho2 = std::max(
        rho2, squared(xyz_ + 3 * static_cast<std::size_t>(targets_[cell_target_[i]]), centre));
  double rho = std::sqrt(rho2), reach = (radius_ + rho) * (radius_ + rho);
  w.candidate.clear();
  w.x.clear();
  w.y.clear();
  w.z.clear();
  w.square.clear();
  int c[3];
  cell_of(xyz_ + 3 * static_cast<std::size_t>(targets_[cell_target_[cell_start_[cell]]]), c);
  for (int dz = -kReach; dz <= kReach; ++dz)
    for (int dy = -kReach; dy <= kReach; ++dy) {
      auto from =
          std::lower_bound(key_.begin(), key_.end(), key(c[0] - kReach, c[1] + dy, c[2] + dz));
      std::uint64_t last = key(c[0] + kReach, c[1] + dy, c[2] + dz);
      for (std::size_t i = from - key_.begin(); i < key_.size() && key_[i] <= last; ++i) {
        const double* p = xyz_ + 3 * static_cast<std::size_t>(vertex_[i]);
        double d2 = squared(p, centre);
        if (d2 > reach) continue;
        w.local[vertex_[i]] = static_cast<int>(w.candidate.size());
        w.candidate.push_back(vertex_[i]);
        w.x.push_back(p[0]);
        w.y.push_back(p[1]);
        w.z.push_back(p[2]);
        w.square.push_back(d2);
      }
    }
  w.inside.assign(w.candidate.size(), 0);
  w.reached_mark.assign(w.candidate.size(), 0);
  return rho;
}

// From a target over its core component outwards: w.reached is in every ball of the component's
// targets that it is near enough to, w.rest has to be searched for.
void ConnectedBalls::flood(int seed, double rho, Workspace& w) const {
  double core = std::max(radius_ - rho, 0.0) * std::max(radius_ - rho, 0.0);
  std::fill(w.reached_mark.begin(), w.reached_mark.end(), 0);
  w.reached.assign(1, seed);
  w.reached_mark[seed] = 1;
  for (std::size_t i = 0; i < w.reached.size(); ++i) {
    int k = w.reached[i], v = w.candidate[k];
    bool k_in_core = w.square[k] <= core;
    for (int e = graph_.start[v]; e < graph_.start[v + 1]; ++e) {
      int j = w.local[graph_.neighbour[e]];
      if (j < 0 || w.reached_mark[j]) continue;
      if (!k_in_core) {
        double gain = w.square[j] - w.square[k];
        double dx = w.x[j] - w.x[k], dy = w.y[j] - w.y[k], dz = w.z[j] - w.z[k];
        if (gain <= 0 || gain * gain <= 4 * rho * rho * (dx * dx + dy * dy + dz * dz)) continue;
      }
      w.reached_mark[j] = 1;
      w.reached.push_back(j);
    }
  }
  w.rest.clear();
  for (std::size_t c = 0; c < w.candidate.size(); ++c)
    if (!w.reached_mark[c]) w.rest.push_back(static_cast<int>(c));
}

// The neighbours of one target: reached candidates within its ball, then those of the rest that
// touch them inside it.
void ConnectedBalls::select(int target, Workspace& w) const {
  double tx = w.x[target], ty = w.y[target], tz = w.z[target], r2 = radius_ * radius_;
  auto distance2 = [&](int c) {
    double dx = w.x[c] - tx, dy = w.y[c] - ty, dz = w.z[c] - tz;
    return dx * dx + dy * dy + dz * dz;
  };
  w.selected.resize(w.candidate.size());
  int count = 0;
  for (int c : w.reached) {
    w.selected[count] = c;
    count += distance2(c) <= r2;
  }
  w.stack.clear();
  auto add = [&](int c) {
    w.inside[c] = 1;
    w.selected[count++] = c;
    w.stack.push_back(c);
  };
  for (int c : w.rest) {
    if (distance2(c) > r2) continue;
    int v = w.candidate[c];
    for (int e = graph_.start[v]; e < graph_.start[v + 1]; ++e) {
      int j = w.local[graph_.neighbour[e]];
      if (j < 0 || !w.reached_mark[j] || distance2(j) > r2) continue;
      add(c);
      break;
    }
  }
  int first_found = count - static_cast<int>(w.stack.size());
  while (!w.stack.empty()) {
    int v = w.candidate[w.stack.back()];
    w.stack.pop_back();
    for (int e = graph_.start[v]; e < graph_.start[v + 1]; ++e) {
      int j = w.local[graph_.neighbour[e]];
      if (j >= 0 && !w.reached_mark[j] && !w.inside[j] && distance2(j) <= r2) add(j);
    }
  }
  for (int i = first_found; i < count; ++i) w.inside[w.selected[i]] = 0;
  w.selected.resize(count);
}

}  // namespace crestline
