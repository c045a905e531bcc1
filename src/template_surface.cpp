#include "template_surface.h"

#include <algorithm>
#include <cmath>

namespace crestline {

SlideTrace slide_on_mesh(const Triangulation& mesh, const double* b, int n, double* x, const double* held,
                         std::vector<SurfacePoint>& at, double tolerance, int sweeps,
                         const std::function<void()>& pause) {
  NearSearch search(mesh);
  std::vector<double> gradient(3 * static_cast<std::size_t>(n));
  auto column = [&](int j) { return b + static_cast<std::size_t>(n) * j; };
  auto refresh = [&] {
    std::copy(held, held + gradient.size(), gradient.begin());
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) gradient[k * n + i] += column(j)[i] * x[k * n + j];
  };
  SlideTrace trace;
  auto note = [&](double longest) {
    double sum = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i) sum += x[i] * (gradient[i] + held[i]);
    trace.energy.push_back(sum);
    trace.strain.push_back(0);
    trace.longest.push_back(longest);
  };
  refresh();
  note(0);
  while (!trace.converged && static_cast<int>(trace.longest.size()) <= sweeps) {
    double longest = 0;
    for (int j = 0; j < n; ++j) {
      double weight = column(j)[j];
      if (!(weight > 0)) continue;
      double centre[3];
      for (int k = 0; k < 3; ++k) centre[k] = x[k * n + j] - gradient[k * n + j] / weight;
      ClosestPoint to = search.closest(at[j], centre);
      double moved = 0;
      for (int k = 0; k < 3; ++k) {
        double step = to.xyz[k] - x[k * n + j];
        moved += step * step;
        for (int i = 0; i < n; ++i) gradient[k * n + i] += column(j)[i] * step;
        x[k * n + j] = to.xyz[k];
      }
      at[j] = to.at;
      longest = std::max(longest, std::sqrt(moved));
    }
    refresh();
    note(longest);
    trace.converged = longest < tolerance;
    pause();
  }
  return trace;
}

}  // namespace crestline
