#include "curvature_fit.h"

#include <algorithm>
#include <cmath>

// On x86 Linux the sums are compiled several times and the processor picks: with glibc (musl has no
// resolvers), and not under a sanitizer, whose start-up cannot be called by the resolver.
#if defined(__x86_64__) && defined(__linux__) && defined(__GLIBC__) && defined(__GNUC__) && \
    !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define CRESTLINE_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define CRESTLINE_CLONES
#endif
#if defined(__GNUC__)
#define CRESTLINE_INLINE inline __attribute__((always_inline))
#else
#define CRESTLINE_INLINE inline
#endif

namespace crestline {

namespace {

constexpr int kBlock = 128;  // points whose powers are held at a time
constexpr int kOrders = 3;   // 2, 3 and 4
constexpr double kLeastPivot = 1e-10;

int terms_of(int order) { return (order + 1) * (order + 2) / 2; }

// Monomials x^a y^b by degree, so that a lower order is the leading part of a higher one.
constexpr int kPowerX[kTerms] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0, 4, 3, 2, 1, 0};
constexpr int kPowerY[kTerms] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 4};

struct Moments {
  double xy[kDegrees][kDegrees];  // sum of x^a y^b
  double xyz[5][5];               // sum of x^a y^b z
  double zz;
};

// Adds the sums over j of x[j] y[k][j] to s[k], k = 0 ... count - 1, up to four at once: that keeps the adders busy.
template <int count>
CRESTLINE_INLINE void add_products(const double* x, const double (*y)[kBlock], int n, double* s) {
  double a = 0, b = 0, c = 0, d = 0;
#pragma omp simd reduction(+ : a, b, c, d)
  for (int j = 0; j < n; ++j) {
    a += x[j] * y[0][j];
    if (count > 1) b += x[j] * y[1][j];
    if (count > 2) c += x[j] * y[2][j];
    if (count > 3) d += x[j] * y[3][j];
  }
  s[0] += a;
  if (count > 1) s[1] += b;
  if (count > 2) s[2] += c;
  if (count > 3) s[3] += d;
}

CRESTLINE_INLINE void add_row(const double* x, const double (*y)[kBlock], int n, int count, double* s) {
  int k = 0;
  for (; k + 4 <= count; k += 4) add_products<4>(x, y + k, n, s + k);
  if (count - k == 3) add_products<3>(x, y + k, n, s + k);
  if (count - k == 2) add_products<2>(x, y + k, n, s + k);
  if (count - k == 1) add_products<1>(x, y + k, n, s + k);
}

// Moments up to x^a y^b with a + b <= 2 order, and with z up to a + b <= order.
CRESTLINE_CLONES
void sum_moments(const double* x, const double* y, const double* z, int n, int order, Moments& m) {
  double px[kDegrees][kBlock], py[kDegrees][kBlock], zy[5][kBlock];
  for (int a = 0; a < kDegrees; ++a)
    for (int b = 0; b < kDegrees; ++b) m.xy[a][b] = 0;
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < 5; ++b) m.xyz[a][b] = 0;
  m.zz = 0;
  int top = 2 * order;
  for (int begin = 0; begin < n; begin += kBlock) {
    int size = std::min(kBlock, n - begin);
    for (int j = 0; j < size; ++j) px[0][j] = py[0][j] = 1;
    for (int a = 1; a <= top; ++a)
#pragma omp simd
      for (int j = 0; j < size; ++j) {
        px[a][j] = px[a - 1][j] * x[begin + j];
        py[a][j] = py[a - 1][j] * y[begin + j];
      }
    for (int b = 0; b <= order; ++b)
#pragma omp simd
      for (int j = 0; j < size; ++j) zy[b][j] = py[b][j] * z[begin + j];
    for (int a = 0; a <= top; ++a) add_row(px[a], py, size, top - a + 1, m.xy[a]);
    for (int a = 0; a <= order; ++a) add_row(px[a], zy, size, order - a + 1, m.xyz[a]);
    double zz = 0;
#pragma omp simd reduction(+ : zz)
    for (int j = 0; j < size; ++j) zz += z[begin + j] * z[begin + j];
    m.zz += zz;
  }
}

CRESTLINE_CLONES
void to_frame(const Frame& f, double scale, const double* x, const double* y, const double* z,
              const int* index, int count, double* fx, double* fy, double* fz) {
#pragma omp simd
  for (int j = 0; j < count; ++j) {
    int i = index[j];
    double dx = (x[i] - f.origin[0]) * scale, dy = (y[i] - f.origin[1]) * scale,
           dz = (z[i] - f.origin[2]) * scale;
    fx[j] = dx * f.t1[0] + dy * f.t1[1] + dz * f.t1[2];
    fy[j] = dx * f.t2[0] + dy * f.t2[1] + dz * f.t2[2];
    fz[j] = dx * f.normal[0] + dy * f.normal[1] + dz * f.normal[2];
  }
}

// Cholesky factor of the moment matrix of the first `terms` monomials (from `first` on); returns
// how many terms it stands up to.
int factorise(const Moments& m, int first, int terms, double (*l)[kTerms]) {
  for (int i = first; i < terms; ++i) {
    double whole = m.xy[2 * kPowerX[i]][2 * kPowerY[i]];
    for (int j = first; j <= i; ++j) {
      double sum = m.xy[kPowerX[i] + kPowerX[j]][kPowerY[i] + kPowerY[j]];
      for (int k = first; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (j < i) {
        l[i][j] = sum / l[j][j];
      } else {
        if (!(sum > kLeastPivot * whole)) return i;
        l[i][i] = std::sqrt(sum);
      }
    }
  }
  return terms;
}

// Solves for the coefficients 1 to 5 (slope and Hessian) of the fit of `terms` terms.
void solve_back(double (*l)[kTerms], const double* y, int first, int terms, double* out) {
  double a[kTerms];
  for (int i = terms - 1; i >= first; --i) {
    double sum = y[i];
    for (int k = i + 1; k < terms; ++k) sum -= l[k][i] * a[k];
    a[i] = sum / l[i][i];
  }
  for (int i = first; i < 6; ++i) out[i] = a[i];
}

// Squared norm of a Hessian from its polynomial coefficients xx, xy, yy.
double squared_norm(double xx, double xy, double yy) {
  return 4 * xx * xx + 2 * xy * xy + 4 * yy * yy;
}

struct Nested {
  double coefficient[kOrders][6];  // of the fits of order 2, 3 and 4
  double variance[kOrders];        // trace of the Hessian's covariance over sigma^2
  double residual[kOrders];        // sum of squares
};

void fit_nested(LocalFit& fit, const Moments& m, int first, int highest, Nested& out) {
  double y[kTerms];
  int terms = terms_of(highest);
  for (int i = first; i < terms; ++i) {
    double sum = m.xyz[kPowerX[i]][kPowerY[i]];
    for (int k = first; k < i; ++k) sum -= fit.factor[i][k] * y[k];
    y[i] = sum / fit.factor[i][i];
  }
  double inverse[3][kTerms];  // columns 3, 4, 5 of the inverse factor
  for (int c = 0; c < 3; ++c)
    for (int i = 3; i < terms; ++i) {
      double sum = i == 3 + c ? 1 : 0;
      for (int k = 3; k < i; ++k) sum -= fit.factor[i][k] * inverse[c][k];
      inverse[c][i] = sum / fit.factor[i][i];
    }
  double residual = m.zz, variance = 0;
  int done = first;
  for (int order = 2; order <= highest; ++order) {
    int end = terms_of(order);
    for (int i = done; i < end; ++i) {
      residual -= y[i] * y[i];
      if (i >= 3) variance += squared_norm(inverse[0][i], inverse[1][i], inverse[2][i]);
    }
    done = end;
    out.residual[order - 2] = std::max(residual, 0.0);
    out.variance[order - 2] = variance;
    for (int i = 0; i < first; ++i) out.coefficient[order - 2][i] = 0;
    solve_back(fit.factor, y, first, end, out.coefficient[order - 2]);
  }
}

// Share of the way from the lower to the higher fit that its gain over noise earns.
double shrinkage_weight(const Nested& n, int low, int high, double s2, double factor) {
  const double *a = n.coefficient[low], *b = n.coefficient[high];
  double gain = squared_norm(b[3] - a[3], b[4] - a[4], b[5] - a[5]);
  double noise = factor * s2 * (n.variance[high] - n.variance[low]);
  return gain > noise ? 1 - noise / gain : 0;
}

void combine(LocalFit& fit, const Nested& n, int lowest, int highest, int first, double radius,
             double shrinkage) {
  double* w = fit.weight;
  w[0] = w[1] = w[2] = 0;
  w[lowest - 2] = 1;
  int dof = std::max(fit.neighbours - terms_of(highest) + first, 1);
  double s2 = n.residual[highest - 2] / dof;
  for (int order = lowest + 1; order <= highest; ++order) {
    double step = shrinkage_weight(n, order - 3, order - 2, s2, shrinkage);
    for (int k = 0; k < order - 2; ++k) w[k] *= 1 - step;
    w[order - 2] = step;
  }
  double c[6] = {0, 0, 0, 0, 0, 0};
  for (int k = lowest - 2; k <= highest - 2; ++k) {
    if (w[k] > 0) fit.order = k + 2;
    for (int i = 0; i < 6; ++i)
      if (w[k] > 0) c[i] += w[k] * n.coefficient[k][i];
  }
  fit.slope[0] = c[1];
  fit.slope[1] = c[2];
  fit.hessian[0] = 2 * c[3] / radius;
  fit.hessian[1] = c[4] / radius;
  fit.hessian[2] = 2 * c[5] / radius;
  fit.sigma = std::sqrt(s2) * radius;
}

// Normal of the plain quadratic fit, where there is one.
bool refine_normal(const Moments& m, Frame& frame) {
  double l[kTerms][kTerms], y[6], c[6];
  if (factorise(m, 0, 6, l) < 6) return false;
  for (int i = 0; i < 6; ++i) {
    double sum = m.xyz[kPowerX[i]][kPowerY[i]];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * y[k];
    y[i] = sum / l[i][i];
  }
  solve_back(l, y, 0, 6, c);
  double normal[3], length = 0;
  for (int a = 0; a < 3; ++a) {
    normal[a] = frame.normal[a] - c[1] * frame.t1[a] - c[2] * frame.t2[a];
    length += normal[a] * normal[a];
  }
  for (double& v : normal) v /= std::sqrt(length);
  frame = make_frame(frame.origin, normal);
  return true;
}

bool one_sided(const Moments& m, int count, double limit) {
  return std::hypot(m.xy[1][0], m.xy[0][1]) > limit * count;
}

}  // namespace

Frame make_frame(const double* origin, const double* normal) {
  Frame f;
  int least = 0;
  for (int a = 0; a < 3; ++a) {
    f.origin[a] = origin[a];
    f.normal[a] = normal[a];
    if (std::fabs(normal[a]) < std::fabs(normal[least])) least = a;
  }
  double length = 0;
  for (int a = 0; a < 3; ++a) {
    f.t1[a] = (a == least) - normal[least] * normal[a];
    length += f.t1[a] * f.t1[a];
  }
  for (double& v : f.t1) v /= std::sqrt(length);
  f.t2[0] = normal[1] * f.t1[2] - normal[2] * f.t1[1];
  f.t2[1] = normal[2] * f.t1[0] - normal[0] * f.t1[2];
  f.t2[2] = normal[0] * f.t1[1] - normal[1] * f.t1[0];
  return f;
}

LocalFit fit_surface(const double* origin, const double* normal, const double* x, const double* y,
                     const double* z, const int* index, int count, const FitSettings& settings,
                     FitBuffer& buffer) {
  LocalFit fit;
  fit.neighbours = count;
  fit.frame = make_frame(origin, normal);
  int first = settings.forced ? 3 : 0;
  if (count < settings.points_per_term * (6 - first)) return fit;
  if (static_cast<int>(buffer.x.size()) < count) {
    buffer.x.resize(count);
    buffer.y.resize(count);
    buffer.z.resize(count);
  }
  double scale = 1 / settings.radius;
  Moments m;
  double *fx = buffer.x.data(), *fy = buffer.y.data(), *fz = buffer.z.data();
  to_frame(fit.frame, scale, x, y, z, index, count, fx, fy, fz);
  if (!settings.forced) {
    sum_moments(fx, fy, fz, count, 2, m);
    if (!refine_normal(m, fit.frame)) return fit;
    to_frame(fit.frame, scale, x, y, z, index, count, fx, fy, fz);
  }
  int highest = settings.highest;
  while (highest > 2 && count < settings.points_per_term * terms_of(highest)) --highest;
  sum_moments(fx, fy, fz, count, highest, m);
  if (highest > 3 && settings.lowest < 4 && one_sided(m, count, settings.one_sided)) highest = 3;
  int stands = factorise(m, first, terms_of(highest), fit.factor);
  while (highest > 2 && stands < terms_of(highest)) --highest;
  if (stands < 6) return fit;
  Nested nested;
  fit_nested(fit, m, first, highest, nested);
  combine(fit, nested, std::min(settings.lowest, highest), highest, first, settings.radius,
          settings.shrinkage);
  fit.ok = true;
  return fit;
}

PrincipalCurvature principal_curvature(const LocalFit& fit) {
  double p = fit.slope[0], q = fit.slope[1];
  double lean = std::sqrt(1 + p * p + q * q);
  // Orthonormal tangents in (dx, dy): columns of the inverse transposed factor of I = L L'.
  double l11 = std::sqrt(1 + p * p), l21 = p * q / l11, l22 = lean / l11;
  double e1[2] = {1 / l11, 0}, e2[2] = {-l21 / (l11 * l22), 1 / l22};
  const double* h = fit.hessian;
  auto second = [&](const double* u, const double* v) {
    return (u[0] * (h[0] * v[0] + h[1] * v[1]) + u[1] * (h[1] * v[0] + h[2] * v[1])) / lean;
  };
  double a = second(e1, e1), b = second(e1, e2), c = second(e2, e2);
  double mean = (a + c) / 2, half = (a - c) / 2, root = std::hypot(half, b);
  double angle = 0.5 * std::atan2(b, half);
  PrincipalCurvature out;
  out.k1 = mean + root;
  out.k2 = mean - root;
  double u1 = std::cos(angle), u2 = std::sin(angle);
  const Frame& f = fit.frame;
  for (int i = 0; i < 3; ++i) {
    double tx = f.t1[i] + p * f.normal[i], ty = f.t2[i] + q * f.normal[i];
    double v1 = e1[0] * tx + e1[1] * ty, v2 = e2[0] * tx + e2[1] * ty;
    out.direction1[i] = u1 * v1 + u2 * v2;
    out.direction2[i] = -u2 * v1 + u1 * v2;
    out.normal[i] = (f.normal[i] - p * f.t1[i] - q * f.t2[i]) / lean;
  }
  return out;
}

void curvature_derivative(const LocalFit& fit, const double* direction, const FitSettings& settings,
                          const FitBuffer& buffer, double* derivative) {
  const Frame& f = fit.frame;
  double u = 0, v = 0;
  for (int a = 0; a < 3; ++a) {
    u += direction[a] * f.t1[a];
    v += direction[a] * f.t2[a];
  }
  double form[3] = {2 * u * u, 2 * u * v, 2 * v * v};
  double row[kTerms] = {0};
  int first = settings.forced ? 3 : 0;
  for (int order = 2; order <= 4; ++order) {
    double weight = fit.weight[order - 2];
    if (weight == 0) continue;
    int terms = terms_of(order);
    double c[kTerms] = {0}, d[kTerms];
    for (int i = first; i < terms; ++i) {
      double sum = i >= 3 && i < 6 ? form[i - 3] : 0;
      for (int k = first; k < i; ++k) sum -= fit.factor[i][k] * c[k];
      c[i] = sum / fit.factor[i][i];
    }
    for (int i = terms - 1; i >= first; --i) {
      double sum = c[i];
      for (int k = i + 1; k < terms; ++k) sum -= fit.factor[k][i] * d[k];
      d[i] = sum / fit.factor[i][i];
      row[i] += weight * d[i];
    }
  }
  // Lengths in the buffer are in units of the radius: curvature by height is 1 / radius^2.
  double unit = 1 / (settings.radius * settings.radius);
  for (int j = 0; j < fit.neighbours; ++j) {
    double x = buffer.x[j], y = buffer.y[j];
    double value = row[0] + x * (row[1] + x * (row[3] + x * (row[6] + x * row[10]))) +
                   y * (row[2] + x * (row[4] + x * (row[7] + x * row[11])) +
                        y * (row[5] + x * (row[8] + x * row[12]) +
                             y * (row[9] + x * row[13] + y * row[14])));
    derivative[j] = value * unit;
  }
}

}  // namespace crestline
