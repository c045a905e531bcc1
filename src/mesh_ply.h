// Numbers of a binary file at given places.
#pragma once
#include <cstddef>
#include <vector>

namespace crestline {

enum class Kind { whole, natural, real };  // with sign, without sign, floating point

// places: bytes from the start at which numbers of `size` bytes begin, all within `raw`; big: their
// most significant byte comes first.
std::vector<double> numbers_at(const unsigned char* raw, const double* places, std::size_t n,
                               Kind kind, int size, bool big);

}  // namespace crestline
