// The vertices within a ball of each target vertex that are connected to it inside that ball.
#pragma once
#include <cstddef>
#include <vector>

#include "mesh_view.h"

namespace crestline {

// Neighbours of each vertex over mesh edges, in one array.
struct VertexGraph {
  std::vector<int> start;      // n + 1
  // neighbours of v, ascending: neighbour[start[v]] ... neighbour[start[v + 1] - 1]
  std::vector<int> neighbour;
};

VertexGraph vertex_graph(const Triangulation& mesh);

// A mesh with what all searches about its vertices share. The mesh's own arrays stay where they are.
struct MeshGraph {
  Triangulation mesh;
  VertexGraph graph;
  std::vector<double> normals;  // of the vertices, 3 x n, as of vertex_normals()
};

MeshGraph mesh_graph(const Triangulation& mesh);

// Connected balls, for the targets of a cell of a grid at once: with C the centre of its targets and rho their largest
// distance from it, every vertex within r - rho of C is in all their balls, and a vertex j reached over an edge from a
// reached vertex k is in a ball only together with k where |p_j - C|^2 - |p_k - C|^2 > 2 rho |p_j - p_k|. What is left
// is searched for each target.
class ConnectedBalls {
 public:
  // targets: vertices whose balls are wanted.
  ConnectedBalls(const MeshGraph& mesh, double radius, const std::vector<int>& targets);

  int cells() const { return static_cast<int>(cell_start_.size()) - 1; }

  // One thread's memory.
  struct Workspace {
    std::vector<int> place;       // n: place among the candidates, or one of the marks below
    std::vector<int> touched;     // vertices whose place is to be cleared
    std::vector<int> candidate;   // vertices that may be in a ball of this cell, those reached first
    std::vector<double> x, y, z;  // their co-ordinates
    std::vector<double> square;   // of those reached, the squared distance from C
    std::size_t reached;          // how many are in every ball that they are near enough to
    std::vector<char> inside, done;
    std::vector<int> pending, stack, selected;  // selected: places among the candidates
  };
  Workspace workspace() const;

  // Calls visit(t, w) for each target of a cell: t is its place in `targets`; its neighbours,
  // itself among them, are the places w.selected in w.candidate, w.x, w.y and w.z. It ends where
  // visit() gives false.
  template <class Visit>
  void visit_cell(int cell, Workspace& w, Visit&& visit) const {
    Ball ball = ball_of(cell);
    int first = cell_start_[cell], end = cell_start_[cell + 1];
    w.done.assign(end - first, 0);
    bool going = true;
    for (int i = first; i < end && going; ++i) {
      if (w.done[i - first]) continue;
      flood(targets_[cell_target_[i]], ball, w);
      for (int j = i; j < end && going; ++j) {
        int at = w.place[targets_[cell_target_[j]]];
        if (w.done[j - first] || at < 0 || at >= static_cast<int>(w.reached)) continue;
        select(at, w);
        going = visit(cell_target_[j], w);
        w.done[j - first] = 1;
      }
      for (int v : w.touched) w.place[v] = kUnseen;
    }
  }

 private:
  static constexpr int kUnseen = -1, kPending = -2, kOutside = -3;
  struct Ball {
    double centre[3], rho;
  };

  const MeshGraph& mesh_;
  double radius_;
  const std::vector<int>& targets_;
  std::vector<int> cell_start_;  // targets of each cell that has any
  std::vector<int> cell_target_;

  const double* at(int vertex) const { return corner(mesh_.mesh, vertex); }
  Ball ball_of(int cell) const;
  void flood(int seed, const Ball& ball, Workspace& w) const;
  void add_rest(const Ball& ball, Workspace& w) const;
  void append(int vertex, double square, Workspace& w) const;
  void select(int target, Workspace& w) const;
};

}  // namespace crestline
