#include "template_form.h"

#include <algorithm>

namespace crestline {

QuadraticForm::QuadraticForm(const double* b, int n, double* x, const double* held)
    : b_(b), n_(n), x_(x), held_(held), gradient_(3 * static_cast<std::size_t>(n)) {
  refresh();
}

void QuadraticForm::position(int point, double* to) const {
  for (int k = 0; k < 3; ++k) to[k] = x_[k * n_ + point];
}

void QuadraticForm::minimiser(int point, double* to) const {
  position(point, to);
  if (!(weight(point) > 0)) return;
  for (int k = 0; k < 3; ++k) to[k] -= gradient_[k * n_ + point] / weight(point);
}

void QuadraticForm::move(int point, const double* to) {
  const double* weights = column(point);
  for (int k = 0; k < 3; ++k) {
    double step = to[k] - x_[k * n_ + point];
    for (int i = 0; i < n_; ++i) gradient_[k * n_ + i] += weights[i] * step;
    x_[k * n_ + point] = to[k];
  }
}

double QuadraticForm::value() const {
  double sum = 0;
  for (std::size_t i = 0; i < gradient_.size(); ++i) sum += x_[i] * (gradient_[i] + (held_ ? held_[i] : 0));
  return sum;
}

void QuadraticForm::refresh() {
  if (held_) {
    std::copy(held_, held_ + gradient_.size(), gradient_.begin());
  } else {
    std::fill(gradient_.begin(), gradient_.end(), 0.0);
  }
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) gradient_[k * n_ + i] += column(j)[i] * x_[k * n_ + j];
}

}  // namespace crestline
