#include "template_joint.h"

#include <algorithm>
#include <cmath>

#include "template_form.h"

namespace crestline {

namespace {

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double share_of(const double* wanted, const double* from, const double* to) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += wanted[k] * (to[k] - from[k]);
  return sum;
}

// Tukey's biweight of an offset in standard errors, and the loss that it belongs to.
double weight_at(double u, double reach) {
  double v = u / reach;
  return std::fabs(v) < 1 ? (1 - v * v) * (1 - v * v) : 0;
}

double loss_at(double u, double reach) {
  double v = std::min(std::fabs(u / reach), 1.0), w = v * v;
  return reach * reach * w * (1 - w + w * w / 3);
}

double offset_of(const JointPoint& p, const double* x) { return share_of(p.across, p.anchor, x); }

void normal_at(const Triangulation& mesh, const double* normals, const SurfacePoint& at, double* out) {
  for (int k = 0; k < 3; ++k) out[k] = 0;
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) out[k] += at.w[c] * normals[3 * static_cast<std::size_t>(vertex_at(mesh, 3 * at.face + c)) + k];
  double length = std::sqrt(dot(out, out));
  for (int k = 0; k < 3 && length > 0; ++k) out[k] /= length;
}

// What one point minimises: weight |x - centre|^2 + scale loss(offset / error).
struct Goal {
  const JointPoint& point;
  const JointSettings& settings;
  double weight, centre[3];

  double at(const double* x) const {
    double off = 0;
    for (int k = 0; k < 3; ++k) off += (x[k] - centre[k]) * (x[k] - centre[k]);
    double sum = weight * off;
    if (!std::isnan(point.error)) sum += settings.scale * loss_at(offset_of(point, x) / point.error, settings.reach);
    return sum;
  }

  // Step to the minimiser, the loss taken as the parabola that touches it from above; the line draws within the surface.
  void step(const double* x, const double* normal, double* out) const {
    for (int k = 0; k < 3; ++k) out[k] = centre[k] - x[k];
    if (std::isnan(point.error)) return;
    double off = offset_of(point, x);
    double pull = settings.scale * weight_at(off / point.error, settings.reach) / (point.error * point.error);
    if (!(pull > 0)) return;
    double q[3], tilt = dot(point.across, normal);
    for (int k = 0; k < 3; ++k) q[k] = point.across[k] - tilt * normal[k];
    double goes = (weight * dot(q, out) - pull * dot(q, q) * off) / (weight + pull * dot(q, q));
    for (int k = 0; k < 3; ++k) out[k] -= pull / weight * q[k] * (off + goes);
  }
};

// Whether a point may go from one place to another: no nearer to a neighbour than the gap, or than it was.
bool in_order(const QuadraticForm& form, const JointPoint& p, const double* from, const double* to, double gap) {
  double other[3];
  if (p.before >= 0) {
    form.position(p.before, other);
    if (share_of(p.from_before, other, to) < std::min(gap, share_of(p.from_before, other, from))) return false;
  }
  if (p.after >= 0) {
    form.position(p.after, other);
    if (share_of(p.to_after, to, other) < std::min(gap, share_of(p.to_after, from, other))) return false;
  }
  return true;
}

double pull_of(const QuadraticForm& form, const std::vector<JointPoint>& points, const JointSettings& settings) {
  double sum = 0, x[3];
  for (const JointPoint& p : points) {
    if (std::isnan(p.error)) continue;
    form.position(p.point, x);
    sum += loss_at(offset_of(p, x) / p.error, settings.reach);
  }
  return settings.scale * sum;
}

}  // namespace

SlideTrace slide_jointly(const Triangulation& mesh, const double* normals, const double* b, int n, double* x,
                         const std::vector<JointPoint>& points, std::vector<SurfacePoint>& at,
                         const JointSettings& settings, const std::function<void()>& pause) {
  NearSearch search(mesh);
  QuadraticForm form(b, n, x, nullptr);
  SlideTrace trace;
  auto note = [&](double longest) {
    trace.energy.push_back(form.value());
    trace.strain.push_back(pull_of(form, points, settings));
    trace.longest.push_back(longest);
  };
  note(0);
  while (!trace.converged && static_cast<int>(trace.longest.size()) <= settings.sweeps) {
    double longest = 0, squares = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const JointPoint& p = points[j];
      Goal goal{p, settings, form.weight(p.point), {0, 0, 0}};
      if (!(goal.weight > 0)) continue;
      double here[3], normal[3], step[3];
      form.minimiser(p.point, goal.centre);
      form.position(p.point, here);
      normal_at(mesh, normals, at[j], normal);
      goal.step(here, normal, step);
      double now = goal.at(here), factor = settings.relaxation;
      for (int tried = 0; tried <= settings.halvings; ++tried, factor /= 2) {
        double aim[3];
        for (int k = 0; k < 3; ++k) aim[k] = here[k] + factor * step[k];
        ClosestPoint to = search.closest(at[j], aim);
        if (goal.at(to.xyz) > now || !in_order(form, p, here, to.xyz, settings.gap)) continue;
        form.move(p.point, to.xyz);
        at[j] = to.at;
        double moved = 0;
        for (int k = 0; k < 3; ++k) moved += (to.xyz[k] - here[k]) * (to.xyz[k] - here[k]);
        squares += moved;
        longest = std::max(longest, std::sqrt(moved));
        break;
      }
    }
    note(longest);
    trace.converged = std::sqrt(squares / std::max<std::size_t>(points.size(), 1)) < settings.tolerance;
    pause();
  }
  return trace;
}

}  // namespace crestline
