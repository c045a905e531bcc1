#include "analysis_sums.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "interrupt.h"

namespace crestline {

namespace {

// Specimens of a lot, and variables at a time: the sums of a lot and those of 1,000 regroupings
// stay in the cache.
constexpr int kLot = 8;
constexpr int kTile = 32;

using Codes = std::vector<unsigned char>;

// Which of the specimens of every lot are members, a bit each: lots x b, a row a lot.
Codes member_codes(const int* member, int m, int b, int lots) {
  Codes code(static_cast<std::size_t>(lots) * b);
  for (int k = 0; k < b; ++k) {
    const int* own = member + static_cast<std::size_t>(k) * m;
    for (int i = 0; i < m; ++i) {
      if (own[i] != 0) code[static_cast<std::size_t>(i / kLot) * b + k] |= 1u << (i % kLot);
    }
  }
  return code;
}

void add_to(double* to, const double* own) {
  for (int j = 0; j < kTile; ++j) to[j] += own[j];
}

// All sums of some of the specimens of a lot: 2^kLot x kTile.
void sums_of_lot(const double* lot, int specimens, double* sums) {
  std::fill(sums, sums + kTile, 0.0);
  for (int i = 0; i < specimens; ++i) {
    const int half = 1 << i;
    for (int s = 0; s < half; ++s) {
      double* to = sums + (half + s) * kTile;
      std::copy(sums + s * kTile, sums + (s + 1) * kTile, to);
      add_to(to, lot + i * kTile);
    }
  }
}

}  // namespace

void member_sums(const double* x, int q, int m, const int* member, int b, double* out,
                 const std::function<void()>& between) {
  Patience patience(between);
  const int lots = (m + kLot - 1) / kLot;
  const Codes code = member_codes(member, m, b, lots);
  std::vector<double> lot(kLot * kTile), sums((1 << kLot) * kTile);
  std::vector<double> all(static_cast<std::size_t>(b) * kTile);
  for (int from = 0; from < q; from += kTile) {
    if (patience.over()) patience.finish();
    const int wide = std::min(kTile, q - from);
    std::fill(all.begin(), all.end(), 0.0);
    for (int l = 0; l < lots; ++l) {
      const int specimens = std::min(kLot, m - l * kLot);
      std::fill(lot.begin(), lot.end(), 0.0);
      for (int i = 0; i < specimens; ++i) {
        const double* own = x + static_cast<std::size_t>(l * kLot + i) * q + from;
        std::copy(own, own + wide, lot.begin() + i * kTile);
      }
      sums_of_lot(lot.data(), specimens, sums.data());
      const unsigned char* of = code.data() + static_cast<std::size_t>(l) * b;
      for (int k = 0; k < b; ++k) {
        if (of[k] != 0) add_to(all.data() + std::size_t(k) * kTile, sums.data() + of[k] * kTile);
      }
    }
    for (int k = 0; k < b; ++k) {
      const double* own = all.data() + static_cast<std::size_t>(k) * kTile;
      std::copy(own, own + wide, out + static_cast<std::size_t>(k) * q + from);
    }
  }
}

}  // namespace crestline
