// The vertices within a ball of each target vertex that are connected to it inside that ball.
#pragma once
#include <cstdint>
#include <vector>

#include "mesh_view.h"

namespace crestline {

// Neighbours of each vertex over mesh edges, in one array.
struct VertexGraph {
  std::vector<int> start;      // n + 1
  // neighbours of v: neighbour[start[v]] ... neighbour[start[v + 1] - 1]
  std::vector<int> neighbour;
};

VertexGraph vertex_graph(const Triangulation& mesh);

// Connected balls by a uniform grid. What holds for all targets of a grid cell is found once a
// cell: with C the centre of its targets and rho their largest distance from it, every vertex
// within r - rho of C is in all their balls, and a vertex j reached over an edge from a reached
// vertex k is in a ball only together with k where |p_j - C|^2 - |p_k - C|^2 > 2 rho |p_j - p_k|.
// What is left is searched for each target.
class ConnectedBalls {
 public:
  // xyz: 3 x n; targets: vertices whose balls are wanted.
  ConnectedBalls(const double* xyz, int n, const VertexGraph& graph, double radius,
                 const std::vector<int>& targets);

  int cells() const { return static_cast<int>(cell_start_.size()) - 1; }

  // One thread's memory.
  struct Workspace {
    std::vector<int> local;              // n: place among the candidates, -1 if none
    std::vector<int> candidate;          // vertices that may be in a ball of this cell
    std::vector<double> x, y, z, square; // their co-ordinates; squared distance from C
    std::vector<char> reached_mark, inside, done;
    std::vector<int> reached, rest, stack, selected;  // places among the candidates
  };
  Workspace workspace() const;

  // Calls visit(t, w) for each target of a cell: t is its place in `targets`; its neighbours,
  // itself among them, are the places w.selected in w.candidate, w.x, w.y and w.z. It ends where
  // visit() gives false.
  template <class Visit>
  void visit_cell(int cell, Workspace& w, Visit&& visit) const {
    double rho = gather(cell, w);
    int first = cell_start_[cell], end = cell_start_[cell + 1];
    w.done.assign(end - first, 0);
    bool going = true;
    for (int i = first; i < end && going; ++i) {
      if (w.done[i - first]) continue;
      flood(w.local[targets_[cell_target_[i]]], rho, w);
      for (int j = i; j < end && going; ++j) {
        int at = w.local[targets_[cell_target_[j]]];
        if (!w.reached_mark[at] || w.done[j - first]) continue;
        select(at, w);
        going = visit(cell_target_[j], w);
        w.done[j - first] = 1;
      }
    }
    for (int v : w.candidate) w.local[v] = -1;
  }

 private:
  const double* xyz_;
  const VertexGraph& graph_;
  double radius_;
  const std::vector<int>& targets_;
  double origin_[3];
  double cell_size_;
  std::vector<std::uint64_t> key_;  // of each gridded vertex, ascending
  std::vector<int> vertex_;         // in the order of key_
  std::vector<int> cell_start_;     // targets of each cell that has any
  std::vector<int> cell_target_;

  std::uint64_t key(int ix, int iy, int iz) const;
  void cell_of(const double* p, int* index) const;
  double gather(int cell, Workspace& w) const;
  void flood(int seed, double rho, Workspace& w) const;
  void select(int target, Workspace& w) const;
};

}  // namespace crestline
