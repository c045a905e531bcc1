#include "template_surface.h"

#include <algorithm>
#include <cmath>

#include "template_form.h"

namespace crestline {

SlideTrace slide_on_mesh(const Triangulation& mesh, const double* b, int n, double* x, const double* held,
                         std::vector<SurfacePoint>& at, double tolerance, int sweeps,
                         const std::function<void()>& pause) {
  NearSearch search(mesh);
  QuadraticForm form(b, n, x, held);
  SlideTrace trace;
  auto note = [&](double longest) {
    trace.energy.push_back(form.value());
    trace.strain.push_back(0);
    trace.longest.push_back(longest);
  };
  note(0);
  while (!trace.converged && static_cast<int>(trace.longest.size()) <= sweeps) {
    double longest = 0;
    for (int j = 0; j < n; ++j) {
      if (!(form.weight(j) > 0)) continue;
      double aim[3], here[3];
      form.minimiser(j, aim);
      form.position(j, here);
      ClosestPoint to = search.closest(at[j], aim);
      form.move(j, to.xyz);
      at[j] = to.at;
      double moved = 0;
      for (int k = 0; k < 3; ++k) moved += (to.xyz[k] - here[k]) * (to.xyz[k] - here[k]);
      longest = std::max(longest, std::sqrt(moved));
    }
    form.refresh();
    note(longest);
    trace.converged = longest < tolerance;
    pause();
  }
  return trace;
}

}  // namespace crestline
