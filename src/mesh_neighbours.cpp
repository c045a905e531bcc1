#include "mesh_neighbours.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "mesh_normals.h"

namespace crestline {

namespace {

constexpr int kAxis = 21;  // bits of a cell's index along one axis

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

MeshGraph mesh_graph(const Triangulation& mesh) { return {mesh, vertex_graph(mesh), vertex_normals(mesh)}; }

ConnectedBalls::ConnectedBalls(const MeshGraph& mesh, double radius, const std::vector<int>& targets)
    : mesh_(mesh), radius_(radius), targets_(targets) {
  double low[3], cell_size = radius / 2;
  for (int a = 0; a < 3; ++a) {
    low[a] = INFINITY;
    double high = -INFINITY;
    for (int t : targets) {
      low[a] = std::min(low[a], at(t)[a]);
      high = std::max(high, at(t)[a]);
    }
    cell_size = std::max(cell_size, (high - low[a]) / ((1 << kAxis) - 2));
  }
  std::vector<std::pair<std::uint64_t, int>> order(targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    std::uint64_t key = 0;
    for (int a = 2; a >= 0; --a)
      key = (key << kAxis) | static_cast<std::uint64_t>((at(targets[t])[a] - low[a]) / cell_size);
    order[t] = {key, static_cast<int>(t)};
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) cell_start_.push_back(static_cast<int>(i));
    cell_target_.push_back(order[i].second);
  }
  cell_start_.push_back(static_cast<int>(order.size()));
}

ConnectedBalls::Workspace ConnectedBalls::workspace() const {
  Workspace w;
  w.place.assign(mesh_.mesh.n, kUnseen);
  return w;
}

// About the middle of the box of a cell's targets.
ConnectedBalls::Ball ConnectedBalls::ball_of(int cell) const {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int i = cell_start_[cell]; i < cell_start_[cell + 1]; ++i)
    for (int a = 0; a < 3; ++a) {
      double value = at(targets_[cell_target_[i]])[a];
      low[a] = std::min(low[a], value);
      high[a] = std::max(high[a], value);
    }
  Ball ball;
  for (int a = 0; a < 3; ++a) ball.centre[a] = (low[a] + high[a]) / 2;
  double rho2 = 0;
  for (int i = cell_start_[cell]; i < cell_start_[cell + 1]; ++i)
    rho2 = std::max(rho2, squared(at(targets_[cell_target_[i]]), ball.centre));
  ball.rho = std::sqrt(rho2);
  return ball;
}

void ConnectedBalls::append(int vertex, double square, Workspace& w) const {
  const double* p = at(vertex);
  w.place[vertex] = static_cast<int>(w.candidate.size());
  w.candidate.push_back(vertex);
  w.x.push_back(p[0]);
  w.y.push_back(p[1]);
  w.z.push_back(p[2]);
  w.square.push_back(square);
}

// From a target over its core component outwards: those reached are in every ball of the component's
// targets that they are near enough to, the rest has to be searched for.
void ConnectedBalls::flood(int seed, const Ball& ball, Workspace& w) const {
  double core = std::max(radius_ - ball.rho, 0.0) * std::max(radius_ - ball.rho, 0.0);
  double reach = (radius_ + ball.rho) * (radius_ + ball.rho), four_rho2 = 4 * ball.rho * ball.rho;
  for (auto* list : {&w.x, &w.y, &w.z, &w.square}) list->clear();
  w.candidate.clear();
  w.pending.clear();
  append(seed, squared(at(seed), ball.centre), w);
  w.touched.assign(1, seed);
  const VertexGraph& graph = mesh_.graph;
  for (std::size_t k = 0; k < w.candidate.size(); ++k) {
    int from = w.candidate[k];
    double square = w.square[k];
    const double* p = at(from);
    for (int e = graph.start[from]; e < graph.start[from + 1]; ++e) {
      int v = graph.neighbour[e], mark = w.place[v];
      if (mark >= 0 || mark == kOutside) continue;
      double own = squared(at(v), ball.centre);
      if (mark == kUnseen) {
        w.touched.push_back(v);
        w.place[v] = own > reach ? kOutside : kPending;
        if (own > reach) continue;
        if (square > core) w.pending.push_back(v);
      }
      if (square > core) {
        double gain = own - square;
        if (gain <= 0 || gain * gain <= four_rho2 * squared(at(v), p)) continue;
      }
      append(v, own, w);
    }
  }
  w.reached = w.candidate.size();
  add_rest(ball, w);
}

// The candidates that were not reached: those that were met, and those beyond them.
void ConnectedBalls::add_rest(const Ball& ball, Workspace& w) const {
  double reach = (radius_ + ball.rho) * (radius_ + ball.rho);
  for (int v : w.pending)
    if (w.place[v] == kPending) append(v, 0, w);
  const VertexGraph& graph = mesh_.graph;
  for (std::size_t k = w.reached; k < w.candidate.size(); ++k) {
    int from = w.candidate[k];
    for (int e = graph.start[from]; e < graph.start[from + 1]; ++e) {
      int v = graph.neighbour[e];
      if (w.place[v] != kUnseen) continue;
      w.touched.push_back(v);
      if (squared(at(v), ball.centre) > reach) w.place[v] = kOutside;
      else append(v, 0, w);
    }
  }
  w.inside.assign(w.candidate.size(), 0);
}

// The neighbours of one target: reached candidates within its ball, then those of the rest that
// touch them inside it.
void ConnectedBalls::select(int target, Workspace& w) const {
  double tx = w.x[target], ty = w.y[target], tz = w.z[target], r2 = radius_ * radius_;
  auto distance2 = [&](int c) {
    double dx = w.x[c] - tx, dy = w.y[c] - ty, dz = w.z[c] - tz;
    return dx * dx + dy * dy + dz * dz;
  };
  const VertexGraph& graph = mesh_.graph;
  const int reached = static_cast<int>(w.reached), all = static_cast<int>(w.candidate.size());
  w.selected.resize(all);
  int count = 0;
  for (int c = 0; c < reached; ++c) {
    w.selected[count] = c;
    count += distance2(c) <= r2;
  }
  w.stack.clear();
  auto add = [&](int c) {
    w.inside[c] = 1;
    w.selected[count++] = c;
    w.stack.push_back(c);
  };
  for (int c = reached; c < all; ++c) {
    if (distance2(c) > r2) continue;
    int v = w.candidate[c];
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      int j = w.place[graph.neighbour[e]];
      if (j < 0 || j >= reached || distance2(j) > r2) continue;
      add(c);
      break;
    }
  }
  int first_found = count - static_cast<int>(w.stack.size());
  while (!w.stack.empty()) {
    int v = w.candidate[w.stack.back()];
    w.stack.pop_back();
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
      int j = w.place[graph.neighbour[e]];
      if (j >= reached && !w.inside[j] && distance2(j) <= r2) add(j);
    }
  }
  for (int i = first_found; i < count; ++i) w.inside[w.selected[i]] = 0;
  w.selected.resize(count);
}

}  // namespace crestline
