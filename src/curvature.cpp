#include "curvature.h"

#include "interrupt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace crestline {

namespace {

void store(const LocalFit& fit, int t, Curvature& out) {
  out.neighbours[t] = fit.neighbours;
  if (!fit.ok) return;
  PrincipalCurvature p = principal_curvature(fit);
  out.k1[t] = p.k1;
  out.k2[t] = p.k2;
  out.sigma[t] = fit.sigma;
  out.order[t] = fit.order;
  for (int a = 0; a < 3; ++a) {
    out.direction1[3 * t + a] = p.direction1[a];
    out.direction2[3 * t + a] = p.direction2[a];
    out.normal[3 * t + a] = p.normal[a];
  }
}

bool is_unit(const double* normal) {
  return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
}

// The targets of a cell, each fitted and handed on.
template <class Use>
void fit_cell(const ConnectedBalls& balls, int cell, const MeshGraph& mesh,
              const std::vector<int>& targets, const FitSettings& settings,
              ConnectedBalls::Workspace& space, FitBuffer& buffer, Patience& patience, int thread,
              Use&& use) {
  balls.visit_cell(cell, space, [&](int t, const ConnectedBalls::Workspace& w) {
    if (patience.over(thread)) return false;
    std::size_t v = targets[t];
    LocalFit fit;
    fit.neighbours = static_cast<int>(w.selected.size());
    if (is_unit(&mesh.normals[3 * v]))
      fit = fit_surface(corner(mesh.mesh, targets[t]), &mesh.normals[3 * v], w.x.data(), w.y.data(),
                        w.z.data(), w.selected.data(), fit.neighbours, settings, buffer);
    use(t, fit, w);
    return true;
  });
}

}  // namespace

Curvature curvature(const MeshGraph& mesh, const std::vector<int>& targets,
                    const FitSettings& settings, int threads,
                    const std::function<void()>& between) {
  std::size_t count = targets.size();
  Curvature out;
  for (auto* field : {&out.k1, &out.k2, &out.sigma}) field->assign(count, NAN);
  for (auto* field : {&out.direction1, &out.direction2, &out.normal}) field->assign(3 * count, NAN);
  out.order.assign(count, 0);
  out.neighbours.assign(count, 0);
  if (targets.empty()) return out;
  ConnectedBalls balls(mesh, settings.radius, targets);
  int cells = balls.cells();
  Patience patience(between);
  std::vector<ConnectedBalls::Workspace> spaces(threads, balls.workspace());
  std::vector<FitBuffer> buffers(threads);
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
#ifdef _OPENMP
    int thread = omp_get_thread_num(), team = omp_get_num_threads();
#else
    int thread = 0, team = 1;
#endif
#pragma omp for schedule(dynamic) nowait
    for (int cell = 0; cell < cells; ++cell) {
      if (patience.over(thread)) continue;
      fit_cell(balls, cell, mesh, targets, settings, spaces[thread], buffers[thread], patience,
               thread, [&](int t, const LocalFit& fit, const ConnectedBalls::Workspace&) {
                 store(fit, t, out);
               });
    }
    patience.wait_for_others(thread, team);
  }
  patience.finish();
  return out;
}

namespace {

using Entry = std::pair<int, double>;

// How the functions respond to the height of each vertex that any of them depends on.
struct Responses {
  std::vector<int> vertex;
  std::vector<std::size_t> start;  // entries of each such vertex: what is not 0
  std::vector<Entry> entry;
  std::vector<double> own;         // sum of squares of the curvatures' own responses
};

// Gathers the responses of the functions, one curvature after the other.
class Responder {
 public:
  // design: functions x targets
  Responder(int vertices, const double* directions, const double* design, int functions)
      : directions_(directions), design_(design), height_(functions), column_(vertices, -1) {}

  void add(std::size_t t, const LocalFit& fit, const ConnectedBalls::Workspace& w, const FitSettings& settings,
           const FitBuffer& buffer) {
    derivative_.resize(fit.neighbours);
    curvature_derivative(fit, directions_ + 3 * t, settings, buffer, derivative_.data());
    row_.clear();
    for (std::size_t g = 0; g < height_; ++g) {
      double value = design_[height_ * t + g];
      if (value != 0) row_.push_back({static_cast<int>(g), value});
    }
    for (int i = 0; i < fit.neighbours; ++i) {
      std::size_t c = column_of(w.candidate[w.selected[i]]);
      double* sum = &total_[height_ * c];
      double slope = derivative_[i];
      for (const Entry& entry : row_) sum[entry.first] += slope * entry.second;
      out_.own[c] += slope * slope;
    }
  }

  Responses finish() {
    out_.start.push_back(0);
    for (std::size_t c = 0; c < out_.vertex.size(); ++c) {
      for (std::size_t g = 0; g < height_; ++g) {
        double value = total_[height_ * c + g];
        if (value != 0) out_.entry.push_back({static_cast<int>(g), value});
      }
      out_.start.push_back(out_.entry.size());
    }
    return std::move(out_);
  }

 private:
  const double *directions_, *design_;
  std::size_t height_;
  std::vector<int> column_;  // of each vertex, its column of total_
  std::vector<double> derivative_, total_;
  std::vector<Entry> row_;
  Responses out_;

  std::size_t column_of(int vertex) {
    if (column_[vertex] < 0) {
      column_[vertex] = static_cast<int>(out_.vertex.size());
      out_.vertex.push_back(vertex);
      out_.own.push_back(0);
      total_.resize(out_.vertex.size() * height_, 0.0);
    }
    return column_[vertex];
  }
};

// Where a ball has too few points it is widened, as the curvature itself is.
Responses responses(const MeshGraph& mesh, const std::vector<int>& targets, const double* directions,
                    const double* design, int functions, const FitSettings& settings,
                    const std::function<void()>& between) {
  FitBuffer buffer;
  Patience patience(between);
  Responder responder(mesh.mesh.n, directions, design, functions);
  std::vector<int> open(targets.size()), places, unfitted;
  std::iota(open.begin(), open.end(), 0);
  FitSettings ball = settings;
  for (; !open.empty() && ball.radius <= settings.widen * settings.radius; ball.radius *= settings.growth) {
    places.clear();
    for (int t : open) places.push_back(targets[t]);
    ConnectedBalls balls(mesh, ball.radius, places);
    ConnectedBalls::Workspace space = balls.workspace();
    unfitted.clear();
    for (int cell = 0; cell < balls.cells(); ++cell) {
      fit_cell(balls, cell, mesh, places, ball, space, buffer, patience, 0,
               [&](int i, const LocalFit& fit, const ConnectedBalls::Workspace& w) {
                 if (fit.ok) responder.add(open[i], fit, w, ball, buffer);
                 else unfitted.push_back(open[i]);
               });
      patience.finish();
    }
    open = unfitted;
  }
  return responder.finish();
}

// Responses to errors along an axis: those along the normals times its cosines with them (3 x vertices).
void along_axis(Responses& r, const std::vector<double>& normals, const double* axis) {
  for (std::size_t c = 0; c < r.vertex.size(); ++c) {
    const double* normal = &normals[3 * r.vertex[c]];
    double cosine = normal[0] * axis[0] + normal[1] * axis[1] + normal[2] * axis[2];
    r.own[c] *= cosine * cosine;
    for (std::size_t p = r.start[c]; p < r.start[c + 1]; ++p) r.entry[p].second *= cosine;
  }
}

// Calls use(j) for every place j (from 0, one of n, itself among them) within `reach` of each i in turn: by a grid
// of cells of that side.
template <class Start, class Use>
void visit_near(const std::vector<double>& xyz, double reach, const std::function<void()>& between,
                Start&& start, Use&& use) {
  int n = static_cast<int>(xyz.size() / 3);
  auto cell = [&](int i, int a) { return static_cast<long>(std::floor(xyz[3 * i + a] / reach)); };
  std::map<std::array<long, 3>, std::vector<int>> grid;
  for (int i = 0; i < n; ++i) grid[{cell(i, 0), cell(i, 1), cell(i, 2)}].push_back(i);
  for (int i = 0; i < n; ++i) {
    if (i % 256 == 0) between();
    start(i);
    for (long x = cell(i, 0) - 1; x <= cell(i, 0) + 1; ++x)
      for (long y = cell(i, 1) - 1; y <= cell(i, 1) + 1; ++y)
        for (long z = cell(i, 2) - 1; z <= cell(i, 2) + 1; ++z) {
          auto found = grid.find({x, y, z});
          if (found == grid.end()) continue;
          for (int j : found->second) {
            double square = 0;
            for (int a = 0; a < 3; ++a) {
              double step = xyz[3 * i + a] - xyz[3 * j + a];
              square += step * step;
            }
            if (square <= reach * reach) use(i, j, square);
          }
        }
  }
}

}  // namespace

CurvatureCovariance curvature_covariance(const MeshGraph& mesh, const std::vector<int>& targets,
                                         const double* directions, const double* design,
                                         int functions, const HeightNoise& noise,
                                         const FitSettings& settings,
                                         const std::function<void()>& between) {
  Responses r = responses(mesh, targets, directions, design, functions, settings, between);
  if (noise.axis) along_axis(r, mesh.normals, noise.axis);
  std::size_t size = functions;
  CurvatureCovariance out{std::vector<double>(size * size, 0.0), 0.0};
  for (std::size_t c = 0; c < r.vertex.size(); ++c) {
    double variance = noise.sigma[r.vertex[c]] * noise.sigma[r.vertex[c]];
    out.trace += variance * r.own[c];
    for (std::size_t p = r.start[c]; p < r.start[c + 1]; ++p) {
      double* column = &out.matrix[size * r.entry[p].first];
      double slope = variance * r.entry[p].second;
      for (std::size_t q = p; q < r.start[c + 1]; ++q) column[r.entry[q].first] += slope * r.entry[q].second;
    }
  }
  for (std::size_t p = 0; p < size; ++p)
    for (std::size_t q = 0; q < p; ++q) out.matrix[size * p + q] = out.matrix[size * q + p];
  if (noise.smooth == 0 || noise.range == 0) return out;
  std::vector<double> xyz;
  for (int v : r.vertex) {
    const double* p = corner(mesh.mesh, v);
    double depth = noise.axis ? p[0] * noise.axis[0] + p[1] * noise.axis[1] + p[2] * noise.axis[2] : 0;
    for (int a = 0; a < 3; ++a) xyz.push_back(noise.axis ? p[a] - depth * noise.axis[a] : p[a]);
  }
  std::vector<double> sum(size);
  double variance = noise.smooth * noise.smooth, scale = -1 / (2 * noise.range * noise.range);
  int last = -1;
  auto add = [&](int i) {
    if (i < 0) return;
    for (std::size_t p = r.start[i]; p < r.start[i + 1]; ++p)
      for (std::size_t g = 0; g < size; ++g)
        out.matrix[size * r.entry[p].first + g] += r.entry[p].second * sum[g];
  };
  visit_near(xyz, 4 * noise.range, between,
             [&](int i) {
               add(last);
               std::fill(sum.begin(), sum.end(), 0.0);
               last = i;
             },
             [&](int, int j, double square) {
               double weight = variance * std::exp(scale * square);
               for (std::size_t q = r.start[j]; q < r.start[j + 1]; ++q)
                 sum[r.entry[q].first] += weight * r.entry[q].second;
             });
  add(last);
  return out;
}

}  // namespace crestline
