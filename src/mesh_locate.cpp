#include "mesh_locate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crestline {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A place has three products and sums a co-ordinate, a gap some more: so many units in the last
// place are safe.
constexpr double kUnits = 16;

void include(const double* xyz, double* low, double* high) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], xyz[k]);
    high[k] = std::max(high[k], xyz[k]);
  }
}

void empty_box(double* low, double* high) {
  std::fill(low, low + 3, kInfinite);
  std::fill(high, high + 3, -kInfinite);
}

double gap_of(const double* low, const double* high, const double* to) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    double gap = std::max(std::max(low[k] - to[k], to[k] - high[k]), 0.0);
    sum += gap * gap;
  }
  return sum;
}

void face_box(const Triangulation& mesh, int face, double* low, double* high) {
  empty_box(low, high);
  for (int c = 0; c < 3; ++c) include(corner(mesh, vertex_at(mesh, 3 * face + c)), low, high);
}

bool has_area(const Triangulation& mesh, int face) {
  const double* a = corner(mesh, vertex_at(mesh, 3 * face));
  const double* b = corner(mesh, vertex_at(mesh, 3 * face + 1));
  const double* c = corner(mesh, vertex_at(mesh, 3 * face + 2));
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    double normal = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    sum += normal * normal;
  }
  return sum > 0;
}

}  // namespace

FaceTree::FaceTree(const Triangulation& mesh, int leaf) : mesh_(mesh), leaf_(leaf) {
  for (int f = 0; f < mesh.m; ++f)
    if (has_area(mesh, f)) face_.push_back(f);
  if (face_.empty())
    for (int f = 0; f < mesh.m; ++f) face_.push_back(f);
  int count = face_.size();
  std::vector<double> centre;
  if (count > leaf) {
    centre.resize(3 * static_cast<std::size_t>(mesh.m));
    for (int f : face_) {
      double low[3], high[3];
      face_box(mesh, f, low, high);
      double* middle = centre.data() + 3 * static_cast<std::size_t>(f);
      for (int k = 0; k < 3; ++k) middle[k] = low[k] / 2 + high[k] / 2;
    }
  }
  build(0, count, centre);
  for (int k = 0; k < 3; ++k)
    largest_ = std::max(largest_, std::max(std::fabs(box_[0].low[k]), std::fabs(box_[0].high[k])));
}

int FaceTree::build(int first, int last, const std::vector<double>& centre) {
  int here = box_.size();
  Box box{{0, 0, 0}, {0, 0, 0}, first, last, 0, 0};
  empty_box(box.low, box.high);
  for (int i = first; i < last; ++i)
    for (int c = 0; c < 3; ++c)
      include(corner(mesh_, vertex_at(mesh_, 3 * face_[i] + c)), box.low, box.high);
  box_.push_back(box);
  if (last - first <= leaf_) return here;
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  int middle = first + (last - first) / 2;
  auto along = [&](int face) { return centre[3 * static_cast<std::size_t>(face) + axis]; };
  auto before = [&](int a, int b) { return along(a) < along(b); };
  std::nth_element(face_.begin() + first, face_.begin() + middle, face_.begin() + last, before);
  int left = build(first, middle, centre), right = build(middle, last, centre);
  box_[here].left = left;
  box_[here].right = right;
  return here;
}

double FaceTree::squared_gap(const Box& box, const double* to) const {
  return gap_of(box.low, box.high, to);
}

// Whether something at least so far away may still be as near as the best, but for rounding.
bool FaceTree::may_hold(double gap2, const ClosestPoint& best, double rounding) const {
  double reach = best.distance * (1 + kUnits * kEpsilon) + rounding;
  return !(gap2 > reach * reach);
}

void FaceTree::search(int number, double gap2, const double* to, double rounding,
                      ClosestPoint& best) const {
  const Box& box = box_[number];
  if (!may_hold(gap2, best, rounding)) return;
  if (box.right) {
    double left = squared_gap(box_[box.left], to), right = squared_gap(box_[box.right], to);
    if (left <= right) search(box.left, left, to, rounding, best);
    search(box.right, right, to, rounding, best);
    if (left > right) search(box.left, left, to, rounding, best);
    return;
  }
  for (int i = box.first; i < box.last; ++i) {
    int face = face_[i];
    double low[3], high[3];
    face_box(mesh_, face, low, high);
    if (!may_hold(gap_of(low, high, to), best, rounding)) continue;
    ClosestPoint here = closest_on_face(mesh_, face, to);
    bool nearer = here.distance < best.distance;
    if (nearer || (here.distance == best.distance && face < best.at.face)) best = here;
  }
}

ClosestPoint FaceTree::closest(const double* to) const {
  double largest = largest_;
  for (int k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(to[k]));
  ClosestPoint best{{mesh_.m, {0, 0, 0}}, {0, 0, 0}, kInfinite};
  search(0, squared_gap(box_[0], to), to, kUnits * kEpsilon * largest, best);
  return best;
}

}  // namespace crestline
