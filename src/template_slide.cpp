#include "template_slide.h"

#include <algorithm>
#include <cmath>

#include "template_form.h"

namespace crestline {

namespace {

struct Place {
  double s;
  double xyz[3];
  double value;
};

// What one slider minimises: weight |x - centre|^2 + before (s - low)^2 + after (high - s)^2, low and high being where the
// spacings to its neighbours are at rest.
struct Objective {
  double weight, centre[3], before, low, after, high;

  double at(double s, const double* x) const {
    double off = 0;
    for (int k = 0; k < 3; ++k) off += (x[k] - centre[k]) * (x[k] - centre[k]);
    return weight * off + before * (s - low) * (s - low) + after * (high - s) * (high - s);
  }

  // The minimiser on the segment from node i, within [from, to].
  Place on_segment(const Track& track, int i, double from, double to) const {
    const double *a = &track.xyz[3 * i], *z = a + 3;
    double start = track.s[i], length = track.s[i + 1] - start, along = 0;
    for (int k = 0; k < 3 && length > 0; ++k) along += (centre[k] - a[k]) * (z[k] - a[k]) / length;
    double s = (weight * (start + along) + before * low + after * high) / (weight + before + after);
    s = std::min(std::max(s, std::max(from, start)), std::min(to, track.s[i + 1]));
    Place out;
    out.s = s;
    double share = length > 0 ? (s - start) / length : 0;
    for (int k = 0; k < 3; ++k) out.xyz[k] = (1 - share) * a[k] + share * z[k];
    out.value = at(s, out.xyz);
    return out;
  }

  // The best place within [from, to] on the mesh, or `here` if there is no better one.
  Place minimiser(const Track& track, double from, double to, Place here) const {
    int last = static_cast<int>(track.s.size()) - 2;
    int i = static_cast<int>(std::upper_bound(track.s.begin(), track.s.end(), from) - track.s.begin()) - 1;
    for (i = std::min(std::max(i, 0), last); i <= last && (track.s[i] < to || track.s[i] <= from); ++i) {
      if (track.face[i + 1] < 0) continue;
      Place there = on_segment(track, i, from, to);
      if (there.value < here.value) here = there;
    }
    return here;
  }
};

double place_before(const std::vector<Slider>& sliders, const Slider& p) {
  return p.before < 0 ? p.low : sliders[p.before].s - p.turn_before;
}

double place_after(const std::vector<Slider>& sliders, const Slider& p) {
  return p.after < 0 ? p.high : sliders[p.after].s + p.turn_after;
}

// Every spacing once: those before each slider, and those after the last ones.
double strain_of(const std::vector<Slider>& sliders, double weight) {
  double sum = 0;
  for (const Slider& p : sliders) {
    double left = p.s - place_before(sliders, p) - p.rest_before;
    double right = place_after(sliders, p) - p.s - p.rest_after;
    if (!std::isnan(left)) sum += left * left;
    if (p.after < 0 && !std::isnan(right)) sum += right * right;
  }
  return weight * sum;
}

// Slides one point; returns how far, as arc length.
double slide_one(QuadraticForm& form, const std::vector<Track>& tracks, std::vector<Slider>& sliders, int j,
                 double strain) {
  Slider& p = sliders[j];
  Objective goal;
  goal.weight = form.weight(p.point);
  form.minimiser(p.point, goal.centre);
  double from = place_before(sliders, p), to = place_after(sliders, p);
  bool free_before = std::isnan(p.rest_before), free_after = std::isnan(p.rest_after);
  goal.before = free_before ? 0 : strain;
  goal.low = free_before ? 0 : from + p.rest_before;
  goal.after = free_after ? 0 : strain;
  goal.high = free_after ? 0 : to - p.rest_after;
  if (!(goal.weight + goal.before + goal.after > 0)) return 0;
  Place here;
  here.s = p.s;
  form.position(p.point, here.xyz);
  here.value = goal.at(p.s, here.xyz);
  from = std::min(p.s, from + (free_before ? 0 : p.gap));
  to = std::max(p.s, to - (free_after ? 0 : p.gap));
  Place best = goal.minimiser(tracks[p.track], from, to, here);
  double moved = std::fabs(best.s - p.s);
  if (moved == 0) return 0;
  p.s = best.s;
  form.move(p.point, best.xyz);
  return moved;
}

}  // namespace

SlideTrace slide_on_tracks(const double* b, int n, double* x, const std::vector<Track>& tracks,
                           std::vector<Slider>& sliders, const SlideSettings& settings,
                           const std::function<void()>& pause) {
  QuadraticForm form(b, n, x, nullptr);
  SlideTrace trace;
  auto note = [&](double longest) {
    trace.energy.push_back(form.value());
    trace.strain.push_back(strain_of(sliders, settings.strain));
    trace.longest.push_back(longest);
  };
  note(0);
  while (!trace.converged && static_cast<int>(trace.longest.size()) <= settings.sweeps) {
    double longest = 0;
    trace.converged = true;
    for (std::size_t j = 0; j < sliders.size(); ++j) {
      double moved = slide_one(form, tracks, sliders, static_cast<int>(j), settings.strain);
      longest = std::max(longest, moved);
      if (moved > sliders[j].tolerance) trace.converged = false;
    }
    form.refresh();
    note(longest);
    pause();
  }
  return trace;
}

}  // namespace crestline
