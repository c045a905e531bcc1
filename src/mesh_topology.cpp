#include "mesh_topology.h"

#include <algorithm>

namespace crestline {

namespace {

struct HalfEdge {
  int low, high;  // its two vertices
  int index;
};

// Half edges grouped by their lower vertex: a counting sort, then small sorts within a vertex.
std::vector<HalfEdge> sorted_half_edges(const int* it, int m, int n) {
  std::vector<int> start(n + 1, 0);
  for (int h = 0; h < 3 * m; ++h) ++start[std::min(it[h], it[next_half_edge(h)]) + 1];
  for (int v = 0; v < n; ++v) start[v + 1] += start[v];
  std::vector<HalfEdge> edges(3 * static_cast<std::size_t>(m));
  std::vector<int> at(start.begin(), start.end() - 1);
  for (int h = 0; h < 3 * m; ++h) {
    int a = it[h], b = it[next_half_edge(h)];
    edges[at[std::min(a, b)]++] = {std::min(a, b), std::max(a, b), h};
  }
  for (int v = 0; v < n; ++v)
    std::sort(edges.begin() + start[v], edges.begin() + start[v + 1],
              [](const HalfEdge& x, const HalfEdge& y) {
                return x.high != y.high ? x.high < y.high : x.index < y.index;
              });
  return edges;
}

void pair_twins(const int* it, const std::vector<HalfEdge>& edges, Topology& t) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    if (j - i == 1) {
      ++t.border_edges;
    } else if (j - i == 2 && it[edges[i].index] != it[edges[i + 1].index]) {
      t.twin[edges[i].index] = edges[i + 1].index;
      t.twin[edges[i + 1].index] = edges[i].index;
    } else {
      ++t.nonmanifold_edges;
    }
    i = j;
  }
}

void label_pieces(int m, Topology& t) {
  std::vector<int> stack;
  for (int seed = 0; seed < m; ++seed) {
    if (t.piece[seed] >= 0) continue;
    t.piece[seed] = t.pieces;
    stack.push_back(seed);
    while (!stack.empty()) {
      int f = stack.back();
      stack.pop_back();
      for (int c = 0; c < 3; ++c) {
        int across = t.twin[3 * f + c];
        if (across < 0 || t.piece[face_of(across)] >= 0) continue;
        t.piece[face_of(across)] = t.pieces;
        stack.push_back(face_of(across));
      }
    }
    ++t.pieces;
  }
}

}  // namespace

Topology mesh_topology(const int* it, int m, int n) {
  Topology t;
  t.twin.assign(3 * static_cast<std::size_t>(m), -1);
  t.piece.assign(m, -1);
  pair_twins(it, sorted_half_edges(it, m, n), t);
  label_pieces(m, t);
  return t;
}

std::vector<std::vector<int>> border_loops(const std::vector<int>& twin) {
  std::vector<char> seen(twin.size(), 0);
  std::vector<std::vector<int>> loops;
  for (int seed = 0; seed < static_cast<int>(twin.size()); ++seed) {
    if (twin[seed] >= 0 || seen[seed]) continue;
    std::vector<int> loop;
    for (int h = seed; !seen[h];) {
      seen[h] = 1;
      loop.push_back(h);
      // Round the vertex at its end, triangle by triangle, to the next border.
      h = next_half_edge(h);
      while (twin[h] >= 0) h = next_half_edge(twin[h]);
    }
    loops.push_back(loop);
  }
  return loops;
}

}  // namespace crestline
