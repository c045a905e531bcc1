#include "template_slide.h"

#include <algorithm>
#include <cmath>

namespace crestline {

namespace {

// The configuration with its form's gradient b x, kept up to date.
struct Configuration {
  const double* b;
  int n;
  double* x;
  std::vector<double> gradient;

  Configuration(const double* b, int n, double* x) : b(b), n(n), x(x), gradient(3 * n) { refresh(); }

  const double* column(int point) const { return b + static_cast<std::size_t>(n) * point; }

  void refresh() {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) gradient[k * n + i] += column(j)[i] * x[k * n + j];
  }

  void move(int point, const double* to) {
    const double* weight = column(point);
    for (int k = 0; k < 3; ++k) {
      double step = to[k] - x[k * n + point];
      for (int i = 0; i < n; ++i) gradient[k * n + i] += weight[i] * step;
      x[k * n + point] = to[k];
    }
  }

  double energy() const {
    double sum = 0;
    for (int i = 0; i < 3 * n; ++i) sum += x[i] * gradient[i];
    return sum;
  }
};

struct Place {
  double s;
  double xyz[3];
  double value;
};

// The function that one slider minimises: weight |x - centre|^2 + strain ((s - from - rest)^2 + (to - s - rest)^2).
struct Objective {
  double weight, strain, centre[3], from, to, rest;

  double at(double s, const double* x) const {
    double off = 0;
    for (int k = 0; k < 3; ++k) off += (x[k] - centre[k]) * (x[k] - centre[k]);
    double left = s - from - rest, right = to - s - rest;
    return weight * off + strain * (left * left + right * right);
  }

  // The minimiser on segment i of the path, within [low, high].
  Place on_segment(const Track& path, int i, double low, double high) const {
    const double *a = &path.xyz[3 * i], *z = a + 3;
    double start = path.s[i], length = path.s[i + 1] - start, along = 0;
    for (int k = 0; k < 3 && length > 0; ++k) along += (centre[k] - a[k]) * (z[k] - a[k]) / length;
    double s = (weight * (start + along) + strain * (from + to)) / (weight + 2 * strain);
    s = std::min(std::max(s, std::max(low, start)), std::min(high, path.s[i + 1]));
    Place out;
    out.s = s;
    double share = length > 0 ? (s - start) / length : 0;
    for (int k = 0; k < 3; ++k) out.xyz[k] = (1 - share) * a[k] + share * z[k];
    out.value = at(s, out.xyz);
    return out;
  }

  Place minimiser(const Track& path, double low, double high) const {
    int last = static_cast<int>(path.s.size()) - 2;
    int i = static_cast<int>(std::upper_bound(path.s.begin(), path.s.end(), low) - path.s.begin()) - 1;
    i = std::min(std::max(i, 0), last);
    Place best = on_segment(path, i, low, high);
    for (++i; i <= last && path.s[i] < high; ++i) {
      Place here = on_segment(path, i, low, high);
      if (here.value < best.value) best = here;
    }
    return best;
  }
};

double place_before(const std::vector<Slider>& sliders, const std::vector<Track>& paths, const Slider& p) {
  return p.before < 0 ? paths[p.path].s.front() : sliders[p.before].s;
}

double place_after(const std::vector<Slider>& sliders, const std::vector<Track>& paths, const Slider& p) {
  return p.after < 0 ? paths[p.path].s.back() : sliders[p.after].s;
}

// Every spacing once: those before each slider, and the last of each path.
double strain_of(const std::vector<Slider>& sliders, const std::vector<Track>& paths, double weight) {
  double sum = 0;
  for (const Slider& p : sliders) {
    double left = p.s - place_before(sliders, paths, p) - p.rest;
    sum += left * left;
    if (p.after >= 0) continue;
    double right = place_after(sliders, paths, p) - p.s - p.rest;
    sum += right * right;
  }
  return weight * sum;
}

// Slides one point; returns how far, as arc length.
double slide_one(Configuration& form, const std::vector<Track>& paths, std::vector<Slider>& sliders, int j,
                 const SlideSettings& settings) {
  Slider& p = sliders[j];
  const Track& path = paths[p.path];
  Objective goal;
  goal.weight = form.column(p.point)[p.point];
  goal.strain = settings.strain;
  if (!(goal.weight + goal.strain > 0)) return 0;
  double here[3];
  for (int k = 0; k < 3; ++k) {
    int at = k * form.n + p.point;
    here[k] = form.x[at];
    goal.centre[k] = goal.weight > 0 ? here[k] - form.gradient[at] / goal.weight : here[k];
  }
  goal.from = place_before(sliders, paths, p);
  goal.to = place_after(sliders, paths, p);
  goal.rest = p.rest;
  double gap = settings.gap * p.rest;
  Place best = goal.minimiser(path, std::min(p.s, goal.from + gap), std::max(p.s, goal.to - gap));
  if (!(best.value < goal.at(p.s, here))) return 0;
  double moved = std::fabs(best.s - p.s);
  p.s = best.s;
  form.move(p.point, best.xyz);
  return moved;
}

}  // namespace

SlideTrace slide_on_paths(const double* b, int n, double* x, const std::vector<Track>& paths,
                          std::vector<Slider>& sliders, const SlideSettings& settings,
                          const std::function<void()>& pause) {
  Configuration form(b, n, x);
  SlideTrace trace;
  auto note = [&](double longest) {
    trace.energy.push_back(form.energy());
    trace.strain.push_back(strain_of(sliders, paths, settings.strain));
    trace.longest.push_back(longest);
  };
  note(0);
  while (!trace.converged && static_cast<int>(trace.longest.size()) <= settings.sweeps) {
    double longest = 0;
    trace.converged = true;
    for (std::size_t j = 0; j < sliders.size(); ++j) {
      double moved = slide_one(form, paths, sliders, static_cast<int>(j), settings);
      longest = std::max(longest, moved);
      if (moved > settings.tolerance * sliders[j].rest) trace.converged = false;
    }
    form.refresh();
    note(longest);
    pause();
  }
  return trace;
}

}  // namespace crestline
