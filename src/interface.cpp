// Every entry that R calls: arguments in, kernel, list out. R has validated them.
#include <Rcpp.h>

#include "mesh_topology.h"
#include "plot_render.h"

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

}  // namespace

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

// [[Rcpp::export]]
List cpp_render_mesh(NumericMatrix xyz, NumericMatrix rgb, IntegerMatrix it, int width, int height,
                     int samples) {
  std::vector<int> corners = from_zero(it);
  crestline::Picture p = crestline::render_mesh(xyz.begin(), rgb.begin(), corners.data(), it.ncol(),
                                                width, height, samples);
  NumericVector rgba(p.rgba.begin(), p.rgba.end());
  rgba.attr("dim") = IntegerVector::create(height, width, 4);
  return List::create(_["rgba"] = rgba, _["depth"] = NumericMatrix(height, width, p.depth.begin()));
}
