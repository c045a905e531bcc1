#include "path_crest.h"

#include "interrupt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "geometry.h"
#include "path_plane.h"

namespace crestline {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A node is a vertex, or the middle of an edge: the vertices come first, then the edges by the
// lower of their half edges. On the way a node is held by a half edge of the face that it is looked
// at from: the one that starts at the vertex, or the edge's own.
struct Node {
  int id, half_edge;
};

struct Place {
  double xyz[3], cost, angle;
};

class Search {
 public:
  Search(const Triangulation& mesh, const CrestRequest& request)
      : mesh_(mesh),
        request_(request),
        floor_(*std::min_element(request.cost, request.cost + mesh.n)),
        best_(mesh.n + 3 * static_cast<std::size_t>(mesh.m), kInfinite),
        held_(best_.size(), -1),
        before_(best_.size(), -1),
        done_(best_.size(), 0) {}

  CrestPath run(const std::function<void()>& between) {
    start_ = at(request_.from);
    goal_ = at(request_.to);
    double found = kInfinite;
    int last = -1;
    if (request_.from.face == request_.to.face && !request_.round) found = way(start_, goal_);
    for (int corner = 0; corner < 6; ++corner) {
      Node node = node_of(request_.from.face, corner);
      Place place = at(node);
      if (request_.angle && !(place.angle <= (request_.round ? kPi : kInfinite))) continue;
      offer(node, place, way(start_, place), -1);
    }
    Patience patience(between);
    while (!queue_.empty()) {
      if (patience.over()) patience.finish();
      Entry top = queue_.top();
      queue_.pop();
      int id = top.second;
      if (done_[id]) continue;
      if (top.first >= found) break;
      done_[id] = 1;
      Node node{id, held_[id]};
      Place place = at(node);
      each_face(node, [&](int face) {
        if (face == request_.to.face && !(request_.round && !(place.angle > kPi))) {
          double d = best_[id] + way(place, goal_);
          if (d < found) {
            found = d;
            last = id;
          }
        }
        spread(id, place, face);
      });
    }
    return path(found, last);
  }

 private:
  using Entry = std::pair<double, int>;

  double value(const double* x, int half_edge, bool middle) const {
    int a = vertex_at(mesh_, half_edge);
    return middle ? 0.5 * (x[a] + x[vertex_at(mesh_, next_half_edge(half_edge))]) : x[a];
  }

  Place at(const SurfacePoint& p) const {
    Place place{{0, 0, 0}, 0, 0};
    position(mesh_, p, place.xyz);
    for (int c = 0; c < 3; ++c)
      place.cost += p.w[c] * request_.cost[vertex_at(mesh_, 3 * p.face + c)];
    return place;
  }

  Place at(const Node& node) const {
    bool middle = node.id >= mesh_.n;
    Place place{{0, 0, 0}, value(request_.cost, node.half_edge, middle), 0};
    position(mesh_, Crossing{node.half_edge, middle ? 0.5 : 0.0}, place.xyz);
    if (!request_.angle) return place;
    place.angle = value(request_.angle, node.half_edge, middle);
    double other = request_.angle[vertex_at(mesh_, next_half_edge(node.half_edge))];
    if (middle && std::fabs(other - request_.angle[vertex_at(mesh_, node.half_edge)]) > kPi)
      place.angle += place.angle < kPi ? kPi : -kPi;
    return place;
  }

  // The corners of a face, then the middles of its edges.
  Node node_of(int face, int corner) const {
    int h = 3 * face + corner % 3;
    if (corner < 3) return {vertex_at(mesh_, h), h};
    int across = twin_of(mesh_, h);
    return {mesh_.n + (across >= 0 ? std::min(h, across) : h), h};
  }

  static double distance(const Place& a, const Place& b) {
    double off[3] = {a.xyz[0] - b.xyz[0], a.xyz[1] - b.xyz[1], a.xyz[2] - b.xyz[2]};
    return std::sqrt(dot(off, off));
  }

  static double way(const Place& a, const Place& b) {
    return distance(a, b) * 0.5 * (a.cost + b.cost);
  }

  void offer(const Node& node, const Place& place, double d, int before) {
    if (!(d < best_[node.id])) return;
    best_[node.id] = d;
    held_[node.id] = node.half_edge;
    before_[node.id] = before;
    queue_.push({d + floor_ * distance(place, goal_), node.id});
  }

  void spread(int id, const Place& place, int face) {
    for (int corner = 0; corner < 6; ++corner) {
      Node next = node_of(face, corner);
      if (done_[next.id]) continue;
      Place there = at(next);
      if (request_.angle && !(std::fabs(there.angle - place.angle) <= kPi)) continue;
      offer(next, there, best_[id] + way(place, there), id);
    }
  }

  // The faces at a node, over the edges about it.
  template <class Look>
  void each_face(const Node& node, Look&& look) const {
    int h = node.half_edge;
    look(face_of(h));
    if (node.id >= mesh_.n) {
      if (twin_of(mesh_, h) >= 0) look(face_of(twin_of(mesh_, h)));
      return;
    }
    int first = h;
    for (;;) {
      int across = twin_of(mesh_, next_half_edge(next_half_edge(h)));
      if (across == first) return;
      if (across < 0) break;
      h = across;
      look(face_of(h));
    }
    for (h = first;;) {
      int across = twin_of(mesh_, h);
      if (across < 0) return;
      h = next_half_edge(across);
      look(face_of(h));
    }
  }

  CrestPath path(double found, int last) const {
    CrestPath out{found < kInfinite, found, {}};
    if (!out.arrived) return out;
    out.places.push_back(request_.to);
    for (int id = last; id >= 0; id = before_[id]) {
      int h = held_[id], c = h % 3;
      SurfacePoint place{face_of(h), {0, 0, 0}};
      place.w[c] = id < mesh_.n ? 1 : 0.5;
      place.w[(c + 1) % 3] = 1 - place.w[c];
      out.places.push_back(place);
    }
    out.places.push_back(request_.from);
    std::reverse(out.places.begin(), out.places.end());
    return out;
  }

  const Triangulation& mesh_;
  const CrestRequest& request_;
  double floor_;
  Place start_, goal_;
  std::vector<double> best_;
  std::vector<int> held_, before_;
  std::vector<char> done_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue_;
};

}  // namespace

CrestPath crest_path(const Triangulation& mesh, const CrestRequest& request,
                     const std::function<void()>& between) {
  return Search(mesh, request).run(between);
}

}  // namespace crestline
