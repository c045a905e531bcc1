// A quadratic form of a configuration, kept up to date as its points move.
#pragma once
#include <cstddef>
#include <vector>

namespace crestline {

// trace(x' b x) + 2 trace(x' held); b: n x n, symmetric, positive semi-definite; x and held: n x 3, column major; held may
// be null (0). x is the caller's and changes with move().
class QuadraticForm {
 public:
  QuadraticForm(const double* b, int n, double* x, const double* held);

  double weight(int point) const { return column(point)[point]; }
  void position(int point, double* to) const;

  // Where the form is least over one point alone; where it stands if the form does not depend on it.
  void minimiser(int point, double* to) const;

  void move(int point, const double* to);
  double value() const;

  // Works the gradient out anew, free of what rounding adds up to.
  void refresh();

 private:
  const double* column(int point) const { return b_ + static_cast<std::size_t>(n_) * point; }

  const double* b_;
  int n_;
  double* x_;
  const double* held_;
  std::vector<double> gradient_;  // half of it: b x + held
};

}  // namespace crestline
