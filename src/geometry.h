// Vectors of three numbers.
#pragma once
#include <cmath>

namespace crestline {

inline double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// out may be neither a nor b.
inline void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

// Normal of the triangle (a, b, c), twice its area long.
inline void triangle_normal(const double* a, const double* b, const double* c, double* out) {
  double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
         v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  cross(u, v, out);
}

struct Vec {
  double x, y, z;
};

inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator*(double f, Vec a) { return {f * a.x, f * a.y, f * a.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec unit(Vec a) { return (1 / std::sqrt(dot(a, a))) * a; }

}  // namespace crestline
