#include "curvature.h"

#include "interrupt.h"

#include <algorithm>
#include <cmath>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "mesh_normals.h"

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
void fit_cell(const ConnectedBalls& balls, int cell, const MeshView& mesh,
              const std::vector<int>& targets, const std::vector<double>& normals,
              const FitSettings& settings, ConnectedBalls::Workspace& space, FitBuffer& buffer,
              Patience& patience, int thread, Use&& use) {
  balls.visit_cell(cell, space, [&](int t, const ConnectedBalls::Workspace& w) {
    if (patience.over(thread)) return false;
    std::size_t v = targets[t];
    LocalFit fit;
    fit.neighbours = static_cast<int>(w.selected.size());
    if (is_unit(&normals[3 * v]))
      fit = fit_surface(mesh.xyz + 3 * v, &normals[3 * v], w.x.data(), w.y.data(), w.z.data(),
                        w.selected.data(), fit.neighbours, settings, buffer);
    use(t, fit, w);
    return true;
  });
}

}  // namespace

Curvature curvature(const MeshView& mesh, const std::vector<int>& targets,
                    const FitSettings& settings, int threads,
                    const std::function<void()>& between) {
  std::size_t count = targets.size();
  Curvature out;
  for (auto* field : {&out.k1, &out.k2, &out.sigma}) field->assign(count, NAN);
  for (auto* field : {&out.direction1, &out.direction2, &out.normal}) field->assign(3 * count, NAN);
  out.order.assign(count, 0);
  out.neighbours.assign(count, 0);
  if (targets.empty()) return out;
  VertexGraph graph = vertex_graph(mesh.it, mesh.m, mesh.n);
  std::vector<double> normals = vertex_normals(mesh.xyz, 3, mesh.n, mesh.it, mesh.m, 0);
  ConnectedBalls balls(mesh.xyz, mesh.n, graph, settings.radius, targets);
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
      fit_cell(balls, cell, mesh, targets, normals, settings, spaces[thread], buffers[thread],
               patience, thread, [&](int t, const LocalFit& fit, const ConnectedBalls::Workspace&) {
                 store(fit, t, out);
               });
    }
    patience.wait_for_others(thread, team);
  }
  patience.finish();
  return out;
}

std::vector<double> curvature_variance(const MeshView& mesh, const std::vector<int>& targets,
                                       const double* directions, const double* jacobian,
                                       int functions, const double* sigma,
                                       const FitSettings& settings,
                                       const std::function<void()>& between) {
  VertexGraph graph = vertex_graph(mesh.it, mesh.m, mesh.n);
  std::vector<double> normals = vertex_normals(mesh.xyz, 3, mesh.n, mesh.it, mesh.m, 0), derivative,
                      total;
  ConnectedBalls balls(mesh.xyz, mesh.n, graph, settings.radius, targets);
  ConnectedBalls::Workspace space = balls.workspace();
  FitBuffer buffer;
  Patience patience(between);
  std::vector<int> column(mesh.n, -1), touched;  // column of `total` of each vertex
  for (int cell = 0; cell < balls.cells(); ++cell) {
    fit_cell(balls, cell, mesh, targets, normals, settings, space, buffer, patience, 0,
             [&](int t, const LocalFit& fit, const ConnectedBalls::Workspace& w) {
               if (!fit.ok) return;
               derivative.resize(fit.neighbours);
               curvature_derivative(fit, directions + 3 * static_cast<std::size_t>(t), settings,
                                    buffer, derivative.data());
               const double* j = jacobian + static_cast<std::size_t>(functions) * t;
               for (int i = 0; i < fit.neighbours; ++i) {
                 int v = w.candidate[w.selected[i]];
                 if (column[v] < 0) {
                   column[v] = static_cast<int>(touched.size());
                   touched.push_back(v);
                   total.resize(touched.size() * functions, 0.0);
                 }
                 double* row = &total[static_cast<std::size_t>(functions) * column[v]];
                 double slope = derivative[i];
#pragma omp simd
                 for (int g = 0; g < functions; ++g) row[g] += slope * j[g];
               }
             });
    patience.finish();
  }
  std::vector<double> variance(functions, 0.0);
  for (std::size_t c = 0; c < touched.size(); ++c)
    for (int g = 0; g < functions; ++g) {
      double error = total[functions * c + g] * sigma[touched[c]];
      variance[g] += error * error;
    }
  return variance;
}

}  // namespace crestline
