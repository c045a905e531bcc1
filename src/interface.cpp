// Every entry that R calls: arguments in, kernel, list out. R has validated them.
#include <Rcpp.h>

#include "curvature.h"
#include "mesh_topology.h"
#include "path_coordinates.h"
#include "path_plane.h"
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

// The parts of a triangulation, counted from 0, and the view of them that kernels take.
struct MeshArrays {
  NumericMatrix xyz;
  std::vector<int> it, twin;
  MeshArrays(const NumericMatrix& xyz, const IntegerMatrix& it, const IntegerMatrix& twin)
      : xyz(xyz), it(from_zero(it)), twin(from_zero(twin)) {}
  crestline::Triangulation view() const {
    return {xyz.begin(), it.data(), twin.data(), static_cast<int>(it.size() / 3)};
  }
};

// (face, w1, w2, w3), the face counted from 1.
crestline::SurfacePoint surface_point(const NumericVector& p) {
  return {static_cast<int>(p[0]) - 1, {p[1], p[2], p[3]}};
}

// Columns x, y, z, face, w1, w2, w3; each crossing in the face that it leaves.
NumericMatrix crossing_rows(const crestline::Triangulation& mesh,
                            const std::vector<crestline::Crossing>& crossings) {
  NumericMatrix out(crossings.size(), 7);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    int h = crossings[i].half_edge, c = h % 3;
    double share = crossings[i].share;
    const double *a = crestline::corner(mesh, mesh.it[h]),
                 *b = crestline::corner(mesh, mesh.it[crestline::next_half_edge(h)]);
    for (int k = 0; k < 3; ++k) out(i, k) = a[k] + share * (b[k] - a[k]);
    out(i, 3) = crestline::face_of(h) + 1;
    out(i, 4 + c) = 1 - share;
    out(i, 4 + (c + 1) % 3) = share;
  }
  return out;
}

// How a walk ended, in the words of the package.
std::string walk_end(crestline::WalkEnd end) {
  switch (end) {
    case crestline::WalkEnd::arrived: return "arrived";
    case crestline::WalkEnd::border: return "border";
    case crestline::WalkEnd::round: return "round";
    default: return "too far";
  }
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

// [[Rcpp::export]]
DataFrame cpp_plane_cuts(NumericMatrix xyz, IntegerMatrix it, IntegerMatrix twin,
                         NumericVector from, NumericVector to, NumericMatrix normals,
                         IntegerVector sides, double reach, NumericVector strength) {
  MeshArrays mesh(xyz, it, twin);
  int n = sides.size();
  NumericVector length(n), mean(n);
  CharacterVector end(n);
  for (int i = 0; i < n; ++i) {
    crestline::CutRequest request{surface_point(from), surface_point(to), &normals(0, i), sides[i],
                                  reach, strength.size() ? strength.begin() : nullptr, false};
    crestline::PlaneCut cut = crestline::plane_cut(mesh.view(), request);
    length[i] = cut.length;
    mean[i] = cut.strength;
    end[i] = walk_end(cut.end);
    checkUserInterrupt();
  }
  return DataFrame::create(_["length"] = length, _["strength"] = mean, _["end"] = end);
}

// [[Rcpp::export]]
List cpp_plane_path(NumericMatrix xyz, IntegerMatrix it, IntegerMatrix twin, NumericVector from,
                    NumericVector to, NumericVector normal, int side, double reach) {
  MeshArrays mesh(xyz, it, twin);
  crestline::CutRequest request{surface_point(from), surface_point(to), normal.begin(), side,
                                reach, nullptr, true};
  crestline::PlaneCut cut = crestline::plane_cut(mesh.view(), request);
  return List::create(_["end"] = walk_end(cut.end),
                      _["points"] = crossing_rows(mesh.view(), cut.crossings));
}

// [[Rcpp::export]]
List cpp_level_path(NumericMatrix xyz, IntegerMatrix it, IntegerMatrix twin, int from_face,
                    int to_face, NumericVector level, NumericVector towards) {
  MeshArrays mesh(xyz, it, twin);
  crestline::LevelPath path = crestline::level_path(mesh.view(), from_face - 1, to_face - 1,
                                                    level.begin(), towards.begin());
  return List::create(_["end"] = walk_end(path.end),
                      _["points"] = crossing_rows(mesh.view(), path.crossings));
}

// [[Rcpp::export]]
List cpp_path_coordinates(NumericMatrix points, NumericMatrix path, NumericMatrix normals) {
  crestline::PathCoordinates c = crestline::path_coordinates(
      points.begin(), points.ncol(), path.begin(), normals.begin(), path.ncol());
  return List::create(_["s"] = c.s, _["d"] = c.d, _["tangent"] = as_rows(c.tangent));
}

// [[Rcpp::export]]
LogicalVector cpp_joined_to(IntegerMatrix it, LogicalVector member, IntegerVector seeds) {
  std::vector<char> marked(member.begin(), member.end());
  std::vector<int> corners = from_zero(it);
  std::vector<char> joined =
      crestline::joined_to(corners.data(), it.ncol(), marked, from_zero(seeds));
  return LogicalVector(joined.begin(), joined.end());
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
