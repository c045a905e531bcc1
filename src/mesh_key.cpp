#include "mesh_key.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace crestline {

namespace {

// The primes of xxHash (Collet), whose round and finish these are: four lanes keep the multiplier
// busy.
const std::uint64_t p1 = 0x9E3779B185EBCA87ULL, p2 = 0xC2B2AE3D27D4EB4FULL,
                    p3 = 0x165667B19E3779F9ULL, p4 = 0x85EBCA77C2B2AE63ULL,
                    p5 = 0x27D4EB2F165667C5ULL;

std::uint64_t turned(std::uint64_t x, int by) { return (x << by) | (x >> (64 - by)); }

std::uint64_t mixed(std::uint64_t lane, std::uint64_t word) {
  return turned(lane + word * p2, 31) * p1;
}

std::uint64_t spread(std::uint64_t x) {
  x = (x ^ (x >> 33)) * p2;
  x = (x ^ (x >> 29)) * p3;
  return x ^ (x >> 32);
}

class Lanes {
 public:
  void add(int lane, std::uint64_t word) { lane_[lane] = mixed(lane_[lane], word); }

  MeshKey finish() const {
    std::uint64_t high = p5, low = p4;
    for (int i = 0; i < 4; ++i) {
      high = (high ^ mixed(0, lane_[i])) * p1 + p4;
      low = turned(low + mixed(p3, lane_[3 - i]), 27) * p2 + p5;
    }
    return {spread(high), spread(low ^ turned(high, 17))};
  }

 private:
  std::uint64_t lane_[4] = {p1 + p2, p2, 0, 0 - p1};
};

std::uint64_t word(double x) {
  x = std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x + 0.0;
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

std::uint64_t word(int x) { return static_cast<std::uint32_t>(x); }

}  // namespace

MeshKey mesh_key(const double* vb, int rows, int n, const int* it, std::size_t corners) {
  Lanes lanes;
  lanes.add(3, static_cast<std::uint64_t>(n));
  lanes.add(3, static_cast<std::uint64_t>(corners));
  for (int v = 0; v < n; ++v) {
    const double* x = vb + static_cast<std::size_t>(rows) * v;
    for (int k = 0; k < 3; ++k) lanes.add(k, word(x[k]));
  }
  for (std::size_t i = 0; i + 2 < corners; i += 3) {
    lanes.add(3, word(it[i]) | word(it[i + 1]) << 32);
    lanes.add(static_cast<int>(i & 1), word(it[i + 2]));
  }
  return lanes.finish();
}

}  // namespace crestline
