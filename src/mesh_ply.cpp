#include "mesh_ply.h"

#include <cstdint>
#include <cstring>

namespace crestline {

namespace {

double number(std::uint64_t bits, Kind kind, int size) {
  if (kind == Kind::real && size == 4) {
    std::uint32_t half = static_cast<std::uint32_t>(bits);
    float value;
    std::memcpy(&value, &half, 4);
    return value;
  }
  if (kind == Kind::real) {
    double value;
    std::memcpy(&value, &bits, 8);
    return value;
  }
  double value = static_cast<double>(bits);
  double top = static_cast<double>(std::uint64_t{1} << (8 * size - 1));
  return kind == Kind::whole && value >= top ? value - 2 * top : value;
}

}  // namespace

std::vector<double> numbers_at(const unsigned char* raw, const double* places, std::size_t n,
                               Kind kind, int size, bool big) {
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const unsigned char* at = raw + static_cast<std::size_t>(places[i]);
    std::uint64_t bits = 0;
    for (int b = 0; b < size; ++b)
      bits |= static_cast<std::uint64_t>(at[big ? size - 1 - b : b]) << (8 * b);
    out[i] = number(bits, kind, size);
  }
  return out;
}

}  // namespace crestline
