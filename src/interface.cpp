// Every entry that R calls: arguments in, kernel, list out. R has validated them.
#include <Rcpp.h>

#include "curvature.h"
#include "mesh_topology.h"

using namespace Rcpp;

namespace {

// R counts from 1.
std::vector<int> from_zero(const IntegerVector& x) {
  std::vector<int> out(x.begin(), x.end());
  for (int& value : out) --value;
  return out;
}

IntegerVector from_one(const std::vector<int>& x) {
  IntegerVector out(x.begin(), x.end());
  for (int& value : out) ++value;
  return out;
}

crestline::FitSettings fit_settings(const List& s) {
  crestline::FitSettings out;
  out.radius = s["radius"];
  out.lowest = s["lowest"];
  out.highest = s["highest"];
  out.forced = s["forced"];
  out.shrinkage = s["shrinkage"];
  out.points_per_term = s["points_per_term"];
  out.one_sided = s["one_sided"];
  return out;
}

// Three values a row.
NumericMatrix as_rows(const std::vector<double>& x) {
  int n = x.size() / 3;
  NumericMatrix out(n, 3);
  for (int i = 0; i < n; ++i)
    for (int a = 0; a < 3; ++a) out(i, a) = x[3 * i + a];
  return out;
}

}  // namespace

// [[Rcpp::export]]
List cpp_curvature(NumericMatrix xyz, IntegerMatrix it, IntegerVector targets, List settings,
                   int threads) {
  std::vector<int> corners = from_zero(it);
  crestline::MeshView mesh{xyz.begin(), xyz.ncol(), corners.data(), it.ncol()};
  crestline::Curvature c = crestline::curvature(mesh, from_zero(targets), fit_settings(settings),
                                                threads, [] { checkUserInterrupt(); });
  return List::create(_["k1"] = c.k1, _["k2"] = c.k2, _["direction1"] = as_rows(c.direction1),
                      _["direction2"] = as_rows(c.direction2), _["normal"] = as_rows(c.normal),
                      _["order"] = c.order, _["sigma"] = c.sigma, _["neighbours"] = c.neighbours);
}

// [[Rcpp::export]]
NumericVector cpp_curvature_variance(NumericMatrix xyz, IntegerMatrix it, IntegerVector targets,
                                     NumericMatrix directions, NumericMatrix jacobian,
                                     NumericVector sigma, List settings) {
  std::vector<int> corners = from_zero(it);
  crestline::MeshView mesh{xyz.begin(), xyz.ncol(), corners.data(), it.ncol()};
  return wrap(crestline::curvature_variance(mesh, from_zero(targets), directions.begin(),
                                            jacobian.begin(), jacobian.nrow(), sigma.begin(),
                                            fit_settings(settings), [] { checkUserInterrupt(); }));
}

// [[Rcpp::export]]
List cpp_mesh_topology(IntegerMatrix it, int n) {
  std::vector<int> corners = from_zero(it);
  crestline::Topology t = crestline::mesh_topology(corners.data(), it.ncol(), n);
  IntegerVector twin = from_one(t.twin);
  twin.attr("dim") = IntegerVector::create(3, it.ncol());
  return List::create(_["twin"] = twin, _["piece"] = from_one(t.piece), _["pieces"] = t.pieces,
                      _["border_edges"] = t.border_edges,
                      _["nonmanifold_edges"] = t.nonmanifold_edges);
}
