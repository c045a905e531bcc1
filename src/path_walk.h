// Walks through the triangles of a mesh along the zero line of a function given at the vertices.
#pragma once
#include <cmath>
#include <vector>

#include "mesh_view.h"

namespace crestline {

struct SurfacePoint {
  int face;
  double w[3];  // barycentric weights
};

// Where the zero line leaves a triangle: half edge, and share of the way from its first corner.
struct Crossing {
  int half_edge;
  double share;
};

enum class WalkEnd { arrived, border, round, too_far };

// Half edges by which the zero line leaves `face`: two where it crosses it, else none. Zero counts
// as positive, so a line through a vertex is never lost.
template <class Value>
int exits(const Triangulation& t, int face, Value&& value, int* half_edges) {
  bool positive[3];
  for (int c = 0; c < 3; ++c) positive[c] = value(vertex_at(t, 3 * face + c)) >= 0;
  int count = 0;
  for (int c = 0; c < 3; ++c)
    if (positive[c] != positive[(c + 1) % 3]) half_edges[count++] = 3 * face + c;
  return count;
}

// From the half edge `leave` on until `to_face`. keep(vertex a, vertex b, share) sees every
// crossing and returns false to give up.
template <class Value, class Keep>
WalkEnd walk(const Triangulation& t, int leave, int to_face, Value&& value, Keep&& keep) {
  int from_face = face_of(leave), h = leave;
  for (int step = 0; step <= t.m; ++step) {
    int a = vertex_at(t, h), b = vertex_at(t, next_half_edge(h));
    double fa = value(a), fb = value(b);
    if (!keep(h, a, b, fa / (fa - fb))) return WalkEnd::too_far;
    int across = twin_of(t, h);
    if (across < 0) return WalkEnd::border;
    int face = face_of(across);
    if (face == to_face) return WalkEnd::arrived;
    if (face == from_face) return WalkEnd::round;
    int second = next_half_edge(across), third = next_half_edge(second);
    // `across` runs from b to a; its opposite corner decides which side the line leaves by.
    bool opposite = value(vertex_at(t, third)) >= 0;
    h = opposite != (fa >= 0) ? second : third;
  }
  return WalkEnd::round;
}

}  // namespace crestline
