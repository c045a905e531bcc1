// Every entry that R calls: arguments in, kernel, list out. R has validated them.
#include <Rcpp.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "analysis_align.h"
#include "analysis_lm.h"
#include "analysis_rows.h"
#include "analysis_spread.h"
#include "analysis_sums.h"
#include "curvature.h"
#include "placing_match.h"
#include "placing_rigid.h"
#include "placing_starts.h"
#include "placing_warp.h"
#include "mesh_bend.h"
#include "mesh_crop.h"
#include "mesh_door.h"
#include "mesh_geodesic.h"
#include "mesh_normals.h"
#include "mesh_join.h"
#include "mesh_key.h"
#include "mesh_locate.h"
#include "mesh_obj.h"
#include "mesh_ply.h"
#include "mesh_read.h"
#include "mesh_size.h"
#include "mesh_topology.h"
#include "path_coordinates.h"
#include "path_crest.h"
#include "path_plane.h"
#include "path_resample.h"
#include "draw_render.h"
#include "ridge_kernel.h"
#include "ridge_surface.h"
#include "shape_column.h"
#include "template_joint.h"
#include "template_slide.h"
#include "template_surface.h"

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
  out.widen = s["widen"];
  out.growth = s["growth"];
  return out;
}

// vb has three rows or more, the first three x, y, z.
crestline::Triangulation triangulation(const NumericMatrix& vb, const IntegerMatrix& it,
                                       const IntegerMatrix& twin) {
  return {vb.begin(), vb.nrow(), vb.ncol(), it.begin(), twin.begin(), it.ncol(), 1};
}

// For what does not walk over edges.
crestline::Triangulation triangulation(const NumericMatrix& vb, const IntegerMatrix& it) {
  return {vb.begin(), vb.nrow(), vb.ncol(), it.begin(), nullptr, it.ncol(), 1};
}

using GraphPointer = XPtr<crestline::MeshGraph>;

// (face, w1, w2, w3), the face counted from 1.
crestline::SurfacePoint surface_point(const NumericVector& p) {
  return {static_cast<int>(p[0]) - 1, {p[1], p[2], p[3]}};
}

crestline::SurfacePoint surface_point(const NumericMatrix& rows, int i) {
  return {static_cast<int>(rows(i, 0)) - 1, {rows(i, 1), rows(i, 2), rows(i, 3)}};
}

// One row of x, y, z, face, w1, w2, w3.
void fill_row(const crestline::Triangulation& mesh, const crestline::SurfacePoint& p, int i,
              NumericMatrix& out) {
  double xyz[3];
  crestline::position(mesh, p, xyz);
  for (int k = 0; k < 3; ++k) {
    out(i, k) = xyz[k];
    out(i, 4 + k) = p.w[k];
  }
  out(i, 3) = p.face + 1;
}

// Columns x, y, z, face, w1, w2, w3; each crossing in the face that it leaves.
NumericMatrix crossing_rows(const crestline::Triangulation& mesh,
                            const std::vector<crestline::Crossing>& crossings) {
  NumericMatrix out(crossings.size(), 7);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    int h = crossings[i].half_edge, c = h % 3;
    double xyz[3];
    crestline::position(mesh, crossings[i], xyz);
    for (int k = 0; k < 3; ++k) out(i, k) = xyz[k];
    out(i, 3) = crestline::face_of(h) + 1;
    out(i, 4 + c) = 1 - crossings[i].share;
    out(i, 4 + (c + 1) % 3) = crossings[i].share;
  }
  return out;
}

// xyz: k x 3; face: k, counted from 1.
crestline::Track track(const NumericMatrix& xyz, const NumericVector& s, const IntegerVector& face) {
  crestline::Track out;
  for (int i = 0; i < xyz.nrow(); ++i)
    for (int a = 0; a < 3; ++a) out.xyz.push_back(xyz(i, a));
  out.s.assign(s.begin(), s.end());
  out.face = from_zero(face);
  return out;
}

// Columns s, x, y, z, face.
NumericMatrix track_rows(const crestline::Track& track) {
  NumericMatrix out(track.s.size(), 5);
  for (int i = 0; i < out.nrow(); ++i) {
    out(i, 0) = track.s[i];
    for (int k = 0; k < 3; ++k) out(i, 1 + k) = track.xyz[3 * i + k];
    out(i, 4) = track.face[i] + 1;
  }
  return out;
}

crestline::ChordSettings chord_settings(const List& s) {
  return {s["tolerance"], s["iterations"], s["slowest"]};
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

// Matrices of columns s, x, y, z, face (0: the segment that ends there is no part of the mesh).
std::vector<crestline::Track> tracks(const List& paths) {
  std::vector<crestline::Track> out(paths.size());
  for (int p = 0; p < paths.size(); ++p) {
    NumericMatrix nodes = paths[p];
    for (int i = 0; i < nodes.nrow(); ++i) {
      out[p].s.push_back(nodes(i, 0));
      for (int k = 1; k < 4; ++k) out[p].xyz.push_back(nodes(i, k));
      out[p].face.push_back(static_cast<int>(nodes(i, 4)) - 1);
    }
  }
  return out;
}

// Columns point, track, s, before, after, low, high, rest_before, rest_after, gap, tolerance, turn_before, turn_after; point, track, before and after
// counted from 1, before and after 0 where there is none.
std::vector<crestline::Slider> sliders_of(const NumericMatrix& rows) {
  std::vector<crestline::Slider> out;
  auto index = [&](int i, int column) { return static_cast<int>(rows(i, column)) - 1; };
  for (int i = 0; i < rows.nrow(); ++i)
    out.push_back({index(i, 0), index(i, 1), rows(i, 2), index(i, 3), index(i, 4), rows(i, 5), rows(i, 6),
                   rows(i, 7), rows(i, 8), rows(i, 9), rows(i, 10), rows(i, 11), rows(i, 12)});
  return out;
}

List slide_trace(const crestline::SlideTrace& trace) {
  return List::create(_["energy"] = trace.energy, _["strain"] = trace.strain, _["longest"] = trace.longest,
                      _["converged"] = trace.converged);
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

// The graph of a mesh, which keeps the arrays that it points into.
// [[Rcpp::export]]
SEXP cpp_mesh_graph(NumericMatrix vb, IntegerMatrix it) {
  return GraphPointer(new crestline::MeshGraph(crestline::mesh_graph(triangulation(vb, it))), true, R_NilValue,
                      List::create(vb, it));
}

// Not NULL, nor a pointer that came from a file or another process.
// [[Rcpp::export]]
bool cpp_points_somewhere(SEXP pointer) {
  return TYPEOF(pointer) == EXTPTRSXP && R_ExternalPtrAddr(pointer) != nullptr;
}

// graph: as of cpp_mesh_graph().
// [[Rcpp::export]]
List cpp_curvature(SEXP graph, IntegerVector targets, List settings, int threads) {
  crestline::Curvature c = crestline::curvature(*GraphPointer(graph).checked_get(), from_zero(targets),
                                                fit_settings(settings), threads, [] { checkUserInterrupt(); });
  return List::create(_["k1"] = c.k1, _["k2"] = c.k2, _["direction1"] = as_rows(c.direction1),
                      _["direction2"] = as_rows(c.direction2), _["normal"] = as_rows(c.normal),
                      _["order"] = c.order, _["sigma"] = c.sigma, _["neighbours"] = c.neighbours);
}

// along, across: two margins of a tensor product, rows x functions each; target: of each of their rows, from 1;
// sigma: of each vertex named, `other` of the rest; smooth: standard deviation and range of the correlated part, and
// a unit vector if all errors have one direction.
// [[Rcpp::export]]
List cpp_curvature_covariance(SEXP graph, IntegerVector targets, NumericMatrix directions, List margins,
                              IntegerVector target, IntegerVector vertex, NumericVector sigma, double other,
                              NumericVector smooth, List settings) {
  const crestline::MeshGraph& mesh = *GraphPointer(graph).checked_get();
  std::vector<double> known(mesh.mesh.n, other);
  for (int i = 0; i < vertex.size(); ++i) known[vertex[i] - 1] = sigma[i];
  NumericMatrix along = margins["along"], across = margins["across"];
  int size = along.ncol() * across.ncol();
  std::vector<double> design = crestline::summed_tensor(along.begin(), along.ncol(), across.begin(), across.ncol(),
                                                        from_zero(target), targets.size());
  const double* axis = smooth.size() > 2 ? &smooth[2] : nullptr;
  crestline::CurvatureCovariance c = crestline::curvature_covariance(
      mesh, from_zero(targets), directions.begin(), design.data(), size, {known.data(), smooth[0], smooth[1], axis},
      fit_settings(settings), [] { checkUserInterrupt(); });
  return List::create(_["matrix"] = NumericMatrix(size, size, c.matrix.begin()), _["trace"] = c.trace);
}

// knots rising, x within them; half 0: no kernel; derivative 0 to 3, with a kernel to 2.
// [[Rcpp::export]]
NumericMatrix cpp_spline_design(NumericVector knots, NumericVector x, double half, int derivative) {
  int k = knots.size() - 4, n = x.size();
  std::vector<double> design =
      half > 0 ? crestline::biweight_design(knots.begin(), k, x.begin(), n, half, derivative)
               : crestline::spline_design(knots.begin(), k, x.begin(), n, derivative);
  return NumericMatrix(n, k, design.begin());
}

// vb has three rows or more, it three.
// [[Rcpp::export]]
std::string cpp_mesh_key(NumericMatrix vb, IntegerMatrix it) {
  crestline::MeshKey key = crestline::mesh_key(vb.begin(), vb.nrow(), vb.ncol(), it.begin(), it.size());
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(key.high),
                static_cast<unsigned long long>(key.low));
  return text;
}

// vb has three rows or more, it three: the only entry that trusts no index.
// [[Rcpp::export]]
List cpp_mesh_faults(NumericMatrix vb, IntegerMatrix it) {
  crestline::MeshFaults found = crestline::mesh_faults(vb.begin(), vb.nrow(), vb.ncol(), it.begin(), it.ncol());
  return List::create(_["faces"] = found.faces, _["vertices"] = found.vertices);
}

// [[Rcpp::export]]
double cpp_box_diagonal(NumericMatrix vb) { return crestline::box_diagonal(vb.begin(), vb.nrow(), vb.ncol()); }

// it of a sound mesh, twin of the same size.
// [[Rcpp::export]]
int cpp_twin_faults(IntegerMatrix it, IntegerMatrix twin) {
  return crestline::twin_faults(it.begin(), twin.begin(), it.ncol());
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

// Pairs as two rows, counted from 1.
// [[Rcpp::export]]
IntegerMatrix cpp_near_pairs(NumericMatrix vb, double reach, int most) {
  std::vector<crestline::Pair> pairs = crestline::near_pairs(vb.begin(), vb.nrow(), vb.ncol(), reach, most);
  IntegerMatrix out(2, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    out(0, i) = pairs[i].first + 1;
    out(1, i) = pairs[i].second + 1;
  }
  return out;
}

// [[Rcpp::export]]
IntegerVector cpp_pair_groups(IntegerMatrix pairs, int n) {
  std::vector<crestline::Pair> all;
  for (int i = 0; i < pairs.ncol(); ++i) all.push_back({pairs(0, i) - 1, pairs(1, i) - 1});
  return from_one(crestline::pair_groups(all, n));
}

// [[Rcpp::export]]
List cpp_vertices_on_edges(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, IntegerVector sides,
                           double reach, int most) {
  std::vector<crestline::VertexOnEdge> found =
      crestline::vertices_on_edges(triangulation(vb, it, twin), from_zero(sides), reach, most);
  IntegerVector side(found.size()), vertex(found.size());
  NumericVector along(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    side[i] = found[i].side + 1;
    vertex[i] = found[i].vertex + 1;
    along[i] = found[i].along;
  }
  return List::create(_["side"] = side, _["vertex"] = vertex, _["along"] = along);
}

// [[Rcpp::export]]
NumericVector cpp_other_sheets(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, IntegerVector piece,
                               IntegerVector sample, double reach, double parallel, double hollow) {
  return wrap(crestline::other_sheets(triangulation(vb, it, twin), piece.begin(), from_zero(sample), reach,
                                      parallel, hollow));
}

// [[Rcpp::export]]
NumericVector cpp_numbers_at(RawVector raw, NumericVector places, bool real, bool sign, int size, bool big) {
  crestline::Kind kind = real ? crestline::Kind::real : sign ? crestline::Kind::whole : crestline::Kind::natural;
  return wrap(crestline::numbers_at(raw.begin(), places.begin(), places.size(), kind, size, big));
}

// The bytes of a text end with a line end.
// [[Rcpp::export]]
List cpp_read_numbers(RawVector text, int from) {
  const char* begin = reinterpret_cast<const char*>(text.begin());
  crestline::NumberText t = crestline::read_numbers(begin + from, begin + text.size());
  return List::create(_["number"] = t.number, _["start"] = t.start, _["line"] = t.line,
                      _["bad"] = t.bad, _["bad_line"] = t.bad_line);
}

// [[Rcpp::export]]
List cpp_read_stl(RawVector text) {
  const char* begin = reinterpret_cast<const char*>(text.begin());
  crestline::StlText t = crestline::read_stl_text(begin, begin + text.size());
  return List::create(_["vertex"] = t.vertex, _["bad"] = t.bad, _["bad_line"] = t.bad_line,
                      _["ended"] = t.ended);
}

// [[Rcpp::export]]
List cpp_read_obj(RawVector text) {
  const char* begin = reinterpret_cast<const char*>(text.begin());
  crestline::ObjText t = crestline::read_obj_text(begin, begin + text.size());
  return List::create(_["vertex"] = t.vertex, _["colour"] = t.colour, _["coloured"] = t.coloured,
                      _["uv"] = t.uv, _["corner"] = t.corner, _["texture"] = t.corner_uv,
                      _["sides"] = t.sides, _["material"] = t.material,
                      _["materials"] = t.materials, _["libraries"] = t.libraries,
                      _["bad"] = t.bad, _["bad_line"] = t.bad_line);
}

// [[Rcpp::export]]
List cpp_border_loops(IntegerMatrix twin) {
  std::vector<std::vector<int>> loops = crestline::border_loops(from_zero(twin));
  List out(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) out[i] = from_one(loops[i]);
  return out;
}

// [[Rcpp::export]]
List cpp_cut_axis(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericVector from,
                  NumericVector to) {
  crestline::CutAxis axis = crestline::cut_axis(triangulation(vb, it, twin), surface_point(from),
                                                surface_point(to));
  return List::create(_["axis"] = NumericVector(axis.axis, axis.axis + 3),
                      _["across"] = NumericVector(axis.across, axis.across + 3),
                      _["span"] = axis.span);
}

// Cuts are given up that will be longer than `limit`, or than `longest` times the shortest before them.
// [[Rcpp::export]]
List cpp_plane_cuts(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericVector from,
                    NumericVector to, NumericMatrix normals, IntegerVector sides, double reach,
                    double longest, double limit) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  int n = sides.size();
  NumericVector length(n);
  CharacterVector end(n);
  for (int i = 0; i < n; ++i) {
    crestline::PlaneCut cut = crestline::plane_cut(
        mesh, {surface_point(from), surface_point(to), &normals(0, i), sides[i], reach, false, limit});
    if (cut.end == crestline::WalkEnd::arrived) limit = std::min(limit, longest * cut.length);
    length[i] = cut.length;
    end[i] = walk_end(cut.end);
    checkUserInterrupt();
  }
  return List::create(_["length"] = length, _["end"] = end);
}

// [[Rcpp::export]]
List cpp_cut_weights(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericVector from,
                          NumericVector to, NumericMatrix normals, IntegerVector sides, double reach,
                          double step) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  std::vector<int> cut_of, vertex;
  std::vector<double> weight;
  for (int i = 0; i < sides.size(); ++i) {
    crestline::CutRequest request{surface_point(from), surface_point(to), &normals(0, i), sides[i],
                                  reach, true};
    crestline::PlaneCut cut = crestline::plane_cut(mesh, request);
    crestline::Track path = crestline::track_of(mesh, cut, request.from, request.to);
    for (const auto& w : crestline::mean_weights(mesh, path, step)) {
      cut_of.push_back(i + 1);
      vertex.push_back(w.vertex + 1);
      weight.push_back(w.weight);
    }
    checkUserInterrupt();
  }
  return List::create(_["cut"] = cut_of, _["vertex"] = vertex, _["weight"] = weight);
}

// [[Rcpp::export]]
List cpp_plane_path(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericVector from,
                    NumericVector to, NumericVector normal, int side, double reach) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  crestline::PlaneCut cut = crestline::plane_cut(
      mesh, {surface_point(from), surface_point(to), normal.begin(), side, reach, true});
  return List::create(_["end"] = walk_end(cut.end), _["points"] = crossing_rows(mesh, cut.crossings));
}

// level: of each vertex named; the others have none.
// [[Rcpp::export]]
List cpp_level_path(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, int from_face,
                    int to_face, IntegerVector vertex, NumericVector level, NumericVector towards) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  std::vector<double> everywhere(vb.ncol(), NAN);
  for (int i = 0; i < vertex.size(); ++i) everywhere[vertex[i] - 1] = level[i];
  crestline::LevelPath path = crestline::level_path(mesh, from_face - 1, to_face - 1, everywhere.data(),
                                                    towards.begin());
  return List::create(_["end"] = walk_end(path.end), _["points"] = crossing_rows(mesh, path.crossings));
}

// angle: of no length where the path may go anywhere.
// [[Rcpp::export]]
List cpp_crest_path(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericVector from,
                    NumericVector to, NumericVector cost, NumericVector angle, bool round) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  crestline::CrestRequest request{surface_point(from), surface_point(to), cost.begin(),
                                  angle.size() ? angle.begin() : nullptr, round};
  crestline::CrestPath path = crestline::crest_path(mesh, request, [] { checkUserInterrupt(); });
  NumericMatrix places(path.places.size(), 7);
  for (std::size_t i = 0; i < path.places.size(); ++i) fill_row(mesh, path.places[i], i, places);
  return List::create(_["arrived"] = path.arrived, _["cost"] = path.cost, _["places"] = places);
}

// [[Rcpp::export]]
List cpp_equal_chords(NumericMatrix xyz, NumericVector s, int n, List settings) {
  crestline::Spacing spacing = crestline::equal_chords(track(xyz, s, IntegerVector()), n,
                                                       chord_settings(settings));
  return List::create(_["s"] = spacing.s, _["converged"] = spacing.converged);
}

// [[Rcpp::export]]
NumericMatrix cpp_place_along(NumericMatrix vb, IntegerMatrix it, NumericMatrix xyz, NumericVector s,
                              IntegerVector face, NumericVector at) {
  crestline::Triangulation mesh = triangulation(vb, it);
  crestline::Track path = track(xyz, s, face);
  NumericMatrix out(at.size(), 7);
  for (int i = 0; i < at.size(); ++i) {
    double point[3];
    int segment = crestline::point_along(path, at[i], point);
    fill_row(mesh, crestline::place_in_face(mesh, path.face[segment], point), i, out);
  }
  return out;
}

// [[Rcpp::export]]
List cpp_fit_columns(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericMatrix from,
                     NumericMatrix to, NumericMatrix outside, IntegerVector rows, List settings,
                     List chords) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  crestline::ColumnSettings s{settings["angle"], settings["angles"], settings["reach"],
                              settings["rim"], settings["inside"], chord_settings(chords)};
  const char* words[] = {"arrived", "border", "round", "too far", "no axis"};
  CharacterVector end(rows.size());
  List points(rows.size()), cuts(rows.size());
  for (int i = 0; i < rows.size(); ++i) {
    const double* outer = ISNAN(outside(0, i)) ? nullptr : &outside(0, i);
    crestline::Column column = crestline::fit_column(mesh, surface_point(from, i),
                                                     surface_point(to, i), outer, rows[i], s);
    end[i] = words[static_cast<int>(column.end)];
    NumericMatrix at(column.points.size(), 7);
    for (std::size_t r = 0; r < column.points.size(); ++r) fill_row(mesh, column.points[r], r, at);
    points[i] = at;
    cuts[i] = track_rows(column.track);
    checkUserInterrupt();
  }
  return List::create(_["end"] = end, _["points"] = points, _["cuts"] = cuts);
}

// [[Rcpp::export]]
NumericVector cpp_face_bend(NumericMatrix vb, NumericMatrix normals, IntegerMatrix it) {
  return wrap(crestline::face_bend(triangulation(vb, it), normals.begin()));
}

// Bytes from the system's random numbers, for a secret; R's own are not touched.
// [[Rcpp::export]]
RawVector cpp_random_bytes(int n) {
  std::random_device device;
  RawVector out(n);
  for (auto& byte : out) byte = static_cast<Rbyte>(device() & 0xffu);
  return out;
}

// [[Rcpp::export]]
double cpp_half_area_radius(NumericMatrix vb, IntegerMatrix it, LogicalVector used, double cap, int steps) {
  return crestline::half_area_radius(triangulation(vb, it), used.begin(), cap, steps);
}

// [[Rcpp::export]]
IntegerVector cpp_vertices_in_box(NumericMatrix vb, NumericVector low, NumericVector high) {
  return from_one(crestline::vertices_in_box(vb.begin(), vb.nrow(), vb.ncol(), low.begin(), high.begin()));
}

// [[Rcpp::export]]
List cpp_path_coordinates(NumericMatrix points, NumericMatrix path, NumericMatrix normals,
                          bool closed = false) {
  crestline::PathCoordinates c =
      crestline::path_coordinates(points.begin(), points.ncol(), path.begin(), normals.begin(), path.ncol(),
                                  closed, [] { checkUserInterrupt(); });
  return List::create(_["s"] = c.s, _["d"] = c.d, _["tangent"] = as_rows(c.tangent));
}

// faces: of the path, from 1; rows of the result ascend by vertex.
// [[Rcpp::export]]
List cpp_near_path(SEXP graph, NumericMatrix path, NumericMatrix normals, bool closed, IntegerVector faces,
                   double width, double margin, double length) {
  crestline::NearPath near = crestline::near_path(*GraphPointer(graph).checked_get(), path.begin(), normals.begin(),
                                                  path.ncol(), closed, from_zero(faces), {width, margin, length},
                                                  [] { checkUserInterrupt(); });
  return List::create(_["vertex"] = from_one(near.vertex), _["s"] = near.at.s, _["d"] = near.at.d,
                      _["tangent"] = as_rows(near.at.tangent));
}

// [[Rcpp::export]]
LogicalVector cpp_joined_to(IntegerMatrix it, LogicalVector member, IntegerVector seeds) {
  std::vector<char> marked(member.begin(), member.end());
  crestline::Triangulation mesh{nullptr, 0, static_cast<int>(member.size()), it.begin(), nullptr, it.ncol(), 1};
  std::vector<char> joined = crestline::joined_to(mesh, marked, from_zero(seeds));
  return LogicalVector(joined.begin(), joined.end());
}

// [[Rcpp::export]]
List cpp_tensor_moments(NumericMatrix along, NumericMatrix across, NumericVector y) {
  crestline::TensorMoments m = crestline::tensor_moments(along.begin(), along.ncol(), across.begin(),
                                                         across.ncol(), y.begin(), y.size());
  int size = m.right.size();
  return List::create(_["matrix"] = NumericMatrix(size, size, m.matrix.begin()), _["right"] = m.right);
}

// [[Rcpp::export]]
List cpp_render_mesh(NumericMatrix xyz, NumericMatrix rgb, IntegerMatrix it, int width, int height,
                     int samples) {
  std::vector<int> corners = from_zero(it);
  crestline::Picture p = crestline::render_mesh(xyz.begin(), rgb.begin(), corners.data(), it.ncol(),
                                                width, height, samples, [] { checkUserInterrupt(); });
  NumericVector rgba(p.rgba.begin(), p.rgba.end());
  rgba.attr("dim") = IntegerVector::create(height, width, 4);
  return List::create(_["rgba"] = rgba, _["depth"] = NumericMatrix(height, width, p.depth.begin()));
}

// [[Rcpp::export]]
List cpp_slide_on_tracks(NumericMatrix b, NumericMatrix x, List paths, NumericMatrix rows, double strain,
                         int sweeps) {
  NumericMatrix moved = clone(x);
  std::vector<crestline::Slider> sliders = sliders_of(rows);
  crestline::SlideTrace trace =
      crestline::slide_on_tracks(b.begin(), b.nrow(), moved.begin(), tracks(paths), sliders, {strain, sweeps},
                                 [] { checkUserInterrupt(); });
  NumericVector s(sliders.size());
  for (std::size_t i = 0; i < sliders.size(); ++i) s[i] = sliders[i].s;
  return List::create(_["x"] = moved, _["s"] = s, _["trace"] = slide_trace(trace));
}

// [[Rcpp::export]]
List cpp_slide_on_mesh(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericMatrix b, NumericMatrix x,
                       NumericMatrix held, NumericMatrix places, double tolerance, int sweeps) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  NumericMatrix moved = clone(x), out(x.nrow(), 7);
  std::vector<crestline::SurfacePoint> at;
  for (int i = 0; i < x.nrow(); ++i) at.push_back(surface_point(places, i));
  crestline::SlideTrace trace =
      crestline::slide_on_mesh(mesh, b.begin(), b.nrow(), moved.begin(), held.begin(), at, tolerance, sweeps,
                               [] { checkUserInterrupt(); });
  for (int i = 0; i < x.nrow(); ++i) fill_row(mesh, at[i], i, out);
  return List::create(_["points"] = out, _["trace"] = slide_trace(trace));
}

// rows: point, before, after (0: none), from_before x y z, to_after x y z, anchor x y z, across x y z, error; places: face,
// w1, w2, w3 of the same points.
// [[Rcpp::export]]
List cpp_slide_jointly(NumericMatrix vb, IntegerMatrix it, IntegerMatrix twin, NumericMatrix b, NumericMatrix x,
                       NumericMatrix rows, NumericMatrix places, List settings) {
  crestline::Triangulation mesh = triangulation(vb, it, twin);
  std::vector<double> normals = crestline::vertex_normals(triangulation(vb, it));
  NumericMatrix moved = clone(x), out(rows.nrow(), 7);
  std::vector<crestline::JointPoint> points(rows.nrow());
  std::vector<crestline::SurfacePoint> at;
  for (int i = 0; i < rows.nrow(); ++i) {
    crestline::JointPoint& p = points[i];
    p.point = rows(i, 0) - 1;
    p.before = rows(i, 1) - 1;
    p.after = rows(i, 2) - 1;
    for (int k = 0; k < 3; ++k) {
      p.from_before[k] = rows(i, 3 + k);
      p.to_after[k] = rows(i, 6 + k);
      p.anchor[k] = rows(i, 9 + k);
      p.across[k] = rows(i, 12 + k);
    }
    p.error = rows(i, 15);
    at.push_back(surface_point(places, i));
  }
  crestline::JointSettings chosen{settings["scale"], settings["reach"], settings["relaxation"], settings["gap"],
                                  settings["tolerance"], settings["halvings"], settings["sweeps"]};
  crestline::SlideTrace trace = crestline::slide_jointly(mesh, normals.data(), b.begin(), b.nrow(), moved.begin(), points, at,
                                                         chosen, [] { checkUserInterrupt(); });
  for (int i = 0; i < rows.nrow(); ++i) fill_row(mesh, at[i], i, out);
  return List::create(_["points"] = out, _["trace"] = slide_trace(trace));
}

// xyz: n x 3. Rows with a co-ordinate that is not finite, or too far for a squared distance, give NA.
// [[Rcpp::export]]
List cpp_locate(NumericMatrix vb, IntegerMatrix it, NumericMatrix xyz, int leaf) {
  crestline::Triangulation mesh = triangulation(vb, it);
  crestline::FaceTree tree(mesh, leaf);
  int n = xyz.nrow();
  IntegerVector face(n, NA_INTEGER);
  NumericMatrix at(n, 6);
  NumericVector distance(n, NA_REAL);
  std::fill(at.begin(), at.end(), NA_REAL);
  for (int i = 0; i < n; ++i) {
    double to[3] = {xyz(i, 0), xyz(i, 1), xyz(i, 2)};
    if (!std::isfinite(to[0]) || !std::isfinite(to[1]) || !std::isfinite(to[2])) continue;
    crestline::ClosestPoint found = tree.closest(to);
    if (!std::isfinite(found.distance)) continue;
    face[i] = found.at.face + 1;
    distance[i] = found.distance;
    for (int k = 0; k < 3; ++k) {
      at(i, k) = found.xyz[k];
      at(i, 3 + k) = found.at.w[k];
    }
    checkUserInterrupt();
  }
  return List::create(_["face"] = face, _["at"] = at, _["distance"] = distance);
}

// [[Rcpp::export]]
NumericMatrix cpp_geodesic_distances(NumericMatrix vb, IntegerMatrix it, NumericMatrix places) {
  int n = vb.ncol();
  NumericMatrix out(n, places.nrow());
  for (int i = 0; i < places.nrow(); ++i) {
    std::vector<double> d = crestline::geodesic_distances(triangulation(vb, it), n, surface_point(places, i),
                                                             [] { checkUserInterrupt(); });
    std::copy(d.begin(), d.end(), out.begin() + static_cast<R_xlen_t>(n) * i);
    checkUserInterrupt();
  }
  return out;
}

// scaling: 0 none, 1 to unit size, 2 full.
// [[Rcpp::export]]
List cpp_align(NumericVector x, IntegerVector size, NumericVector weight, NumericMatrix reference, int scaling,
               double tolerance, int rounds) {
  std::vector<double> coords(x.begin(), x.end());
  crestline::Aligned aligned =
      crestline::align_configurations(coords, size[0], size[1], size[2], weight.begin(), reference.begin(),
                                      {static_cast<crestline::Scaling>(scaling), tolerance, rounds},
                                      [] { checkUserInterrupt(); });
  return List::create(_["coords"] = coords, _["mean"] = aligned.mean, _["size"] = aligned.size,
                      _["moved"] = aligned.moved, _["converged"] = aligned.converged);
}

// Each configuration laid onto a mean, which is centred and, where scaled, of unit size.
// [[Rcpp::export]]
List cpp_lay_onto(NumericVector x, IntegerVector size, NumericVector weight, NumericMatrix mean, int scaling) {
  std::vector<double> coords(x.begin(), x.end());
  std::vector<double> sizes =
      crestline::lay_onto(coords, size[0], size[1], size[2], weight.begin(), mean.begin(),
                          static_cast<crestline::Scaling>(scaling), [] { checkUserInterrupt(); });
  return List::create(_["coords"] = coords, _["size"] = sizes);
}

// xyz, normal: 3 x n; feature: features x n. Indices from 1, NA where there is none; distances in xyz.
// [[Rcpp::export]]
List cpp_match_clouds(NumericMatrix xyz, NumericMatrix normal, NumericMatrix feature, NumericMatrix to_xyz,
                      NumericMatrix to_normal, NumericMatrix to_feature, double reach, double cosine) {
  crestline::CloudGrid fixed({to_xyz.begin(), to_normal.begin(), to_feature.begin(), to_xyz.ncol(), to_feature.nrow()}, reach / 4);
  IntegerVector index(xyz.ncol(), NA_INTEGER);
  NumericVector distance(xyz.ncol(), NA_REAL);
  for (int i = 0; i < xyz.ncol(); ++i) {
    if (i % 1024 == 0) checkUserInterrupt();
    double d2 = 0;
    int found = fixed.nearest(&xyz(0, i), &normal(0, i), feature.begin() + static_cast<R_xlen_t>(feature.nrow()) * i, reach,
                              cosine, &d2);
    if (found < 0) continue;
    index[i] = found + 1;
    distance[i] = std::sqrt(d2);
  }
  return List::create(_["index"] = index, _["distance"] = distance);
}

// starts: 13 x s, a column a pose: rotation (by column), shift, scale. The fitted poses in the same form, and their scores.
// [[Rcpp::export]]
List cpp_fit_poses(NumericMatrix xyz, NumericMatrix normal, NumericMatrix to_xyz, NumericMatrix to_normal, NumericMatrix starts,
                   List settings) {
  NumericVector reach = settings["reach"], scale = settings["scale"];
  crestline::RigidSettings rigid{{reach[0], reach[1]}, settings["steps"], settings["cosine"], settings["kept"],
                                 {scale[0], scale[1]}, settings["saturation"], settings["more"], settings["rest"],
                                 settings["spacing"]};
  crestline::Cloud moving{xyz.begin(), normal.begin(), nullptr, xyz.ncol(), 0};
  crestline::CloudGrid fixed({to_xyz.begin(), to_normal.begin(), nullptr, to_xyz.ncol(), 0}, rigid.spacing);
  NumericMatrix poses(13, starts.ncol());
  NumericVector score(starts.ncol());
  LogicalVector rests(starts.ncol());
  for (int i = 0; i < starts.ncol(); ++i) {
    crestline::Pose pose;
    std::copy(&starts(0, i), &starts(0, i) + 9, pose.rotation);
    std::copy(&starts(9, i), &starts(9, i) + 3, pose.shift);
    pose.scale = starts(12, i);
    bool at_rest = false;
    pose = crestline::fit_pose(moving, fixed, pose, rigid, &at_rest);
    rests[i] = at_rest;
    score[i] = crestline::pose_score(moving, fixed, pose, rigid);
    std::copy(pose.rotation, pose.rotation + 9, &poses(0, i));
    std::copy(pose.shift, pose.shift + 3, &poses(9, i));
    poses(12, i) = pose.scale;
    checkUserInterrupt();
  }
  return List::create(_["poses"] = poses, _["score"] = score, _["rests"] = rests);
}

// xyz, normal: 3 x n, at: 3 x m. Columns: the mean normal about a place and its height.
// [[Rcpp::export]]
NumericMatrix cpp_mounds(NumericMatrix xyz, NumericMatrix normal, NumericMatrix at, double radius) {
  std::vector<crestline::Mound> found =
      crestline::mounds({xyz.begin(), normal.begin(), nullptr, xyz.ncol(), 0}, at.begin(), at.ncol(), radius);
  NumericMatrix out(4, at.ncol());
  for (int i = 0; i < at.ncol(); ++i) {
    std::copy(found[i].normal, found[i].normal + 3, &out(0, i));
    out(3, i) = found[i].height;
  }
  return out;
}

// points: list of xyz, normal in the anchor's frame; cloud: the same in its own axes; at: 3 x m; mound: 4 x m.
// Columns: pose (13 numbers, of the anchor's frame), score, place (from 1).
// [[Rcpp::export]]
NumericMatrix cpp_search_starts(List points, List cloud, NumericMatrix at, NumericMatrix mound, List settings) {
  auto view = [](const NumericMatrix& xyz, const NumericMatrix& normal) {
    return crestline::Cloud{xyz.begin(), normal.begin(), nullptr, xyz.ncol(), 0};
  };
  NumericMatrix xyz = points["xyz"], normal = points["normal"], to = cloud["xyz"], to_normal = cloud["normal"];
  std::vector<crestline::Mound> places(at.ncol());
  for (int i = 0; i < at.ncol(); ++i) {
    std::copy(&mound(0, i), &mound(0, i) + 3, places[i].normal);
    places[i].height = mound(3, i);
  }
  crestline::StartSettings search{settings["turns"], settings["scales"], settings["voxel"], settings["reach"],
                                  settings["spacing"], settings["cosine"], settings["each"]};
  std::vector<crestline::Start> found = crestline::search_starts(view(xyz, normal), view(to, to_normal), at.begin(),
                                                                 places, search, [] { checkUserInterrupt(); });
  NumericMatrix out(15, found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const crestline::Pose& pose = found[i].pose;
    std::copy(pose.rotation, pose.rotation + 9, &out(0, i));
    std::copy(pose.shift, pose.shift + 3, &out(9, i));
    out(12, i) = pose.scale;
    out(13, i) = found[i].score;
    out(14, i) = found[i].place + 1;
  }
  return out;
}

// [[Rcpp::export]]
NumericMatrix cpp_warp_gram(List basis, IntegerVector used, NumericMatrix normal, NumericVector weight,
                            double along, double across) {
  crestline::Basis functions[3];
  int p = 0;
  for (int k = 0; k < 3; ++k) {
    NumericMatrix values = basis[k];
    functions[k] = {values.begin(), values.nrow(), values.ncol()};
    p += values.ncol();
  }
  std::vector<double> gram = crestline::warp_gram(functions, from_zero(used), normal.begin(), weight.begin(), along,
                                                  across, [] { checkUserInterrupt(); });
  return NumericMatrix(p, p, gram.begin());
}

// [[Rcpp::export]]
NumericMatrix cpp_face_normals(NumericMatrix vb, IntegerMatrix it) {
  NumericMatrix out(it.ncol(), 3);
  crestline::face_normals(triangulation(vb, it), out.begin());
  return out;
}

// [[Rcpp::export]]
NumericMatrix cpp_vertex_normals(NumericMatrix vb, IntegerMatrix it) {
  std::vector<double> normals = crestline::vertex_normals(triangulation(vb, it));
  NumericMatrix out(4, vb.ncol());
  for (int v = 0; v < vb.ncol(); ++v) {
    for (int i = 0; i < 3; ++i) out(i, v) = normals[3 * static_cast<std::size_t>(v) + i];
    out(3, v) = 1;
  }
  return out;
}

// orders: n x b, from 1. Two rows: in the span of the term, in that of the model.
// [[Rcpp::export]]
NumericMatrix cpp_permuted_forms(NumericMatrix gram, NumericMatrix own, NumericMatrix whole, IntegerMatrix orders) {
  std::vector<int> order = from_zero(orders);
  NumericMatrix out(2, orders.ncol());
  crestline::permuted_forms(gram.begin(), own.begin(), whole.begin(), gram.nrow(), order.data(), orders.ncol(),
                            out.begin(), [] { checkUserInterrupt(); });
  return out;
}

// The numbers of every specimen, a matrix each.
static std::vector<const double*> numbers_of(List specimens) {
  std::vector<const double*> out;
  for (R_xlen_t i = 0; i < specimens.size(); ++i) out.push_back(REAL(specimens[i]));
  return out;
}

// x: a matrix of doubles by specimen. from: the first variable that is taken, from 1. factor: of
// those that are taken, whose number it gives.
// [[Rcpp::export]]
NumericMatrix cpp_centred_rows(List x, int from, NumericVector factor) {
  NumericMatrix out = no_init(x.size(), factor.size());
  crestline::centred_rows(numbers_of(x), from - 1, factor.size(), factor.begin(), out.begin(),
                          [] { checkUserInterrupt(); });
  return out;
}

// x: a matrix of doubles by specimen. weight: of each specimen.
// [[Rcpp::export]]
NumericVector cpp_weighted_sum(List x, NumericVector weight) {
  NumericVector out(Rf_xlength(x[0]));
  crestline::weighted_sum(numbers_of(x), out.size(), weight.begin(), out.begin());
  return out;
}

// y: n x q. means: groups x q. group: n, from 1.
// [[Rcpp::export]]
NumericVector cpp_squared_distances(NumericMatrix y, NumericMatrix means, IntegerVector group) {
  std::vector<int> own = from_zero(group);
  NumericVector out(y.nrow());
  crestline::squared_distances(y.begin(), y.nrow(), y.ncol(), means.begin(), means.nrow(),
                               own.data(), out.begin(), [] { checkUserInterrupt(); });
  return out;
}

// x: q x m. member: m x b, other than 0 where it is one. Gives q x b.
// [[Rcpp::export]]
NumericMatrix cpp_member_sums(NumericMatrix x, IntegerMatrix member) {
  NumericMatrix out(x.nrow(), member.ncol());
  crestline::member_sums(x.begin(), x.nrow(), x.ncol(), member.begin(), member.ncol(), out.begin(),
                         [] { checkUserInterrupt(); });
  return out;
}

// x: m x n. labels: n x b, from 1. Gives t2 (b) and scale (groups x b).
// [[Rcpp::export]]
List cpp_common_form_t2(NumericMatrix x, IntegerMatrix labels, int groups, int count, int rounds,
                        double least, double rounding) {
  std::vector<int> label = from_zero(labels);
  NumericVector t2(labels.ncol());
  NumericMatrix scale(groups, labels.ncol());
  crestline::common_form_t2(x.begin(), x.nrow(), x.ncol(), label.data(), labels.ncol(), groups,
                            count, rounds, least, rounding, t2.begin(), scale.begin(),
                            [] { checkUserInterrupt(); });
  return List::create(_["t2"] = t2, _["scale"] = scale);
}

// y: q x n. basis: n x p. without (n x r), fitted (q x r), own (p x df): lists by term. orders: n x b, from 1. Gives a list
// by term of own, whole (b x q).
// [[Rcpp::export]]
List cpp_permuted_squares(NumericMatrix y, NumericMatrix basis, List without, List fitted, List own, IntegerMatrix orders) {
  std::vector<int> order = from_zero(orders);
  std::vector<crestline::PermutedTerm> terms;
  List out;
  for (R_xlen_t t = 0; t < own.size(); ++t) {
    NumericMatrix w = without[t], f = fitted[t], o = own[t];
    NumericMatrix in_own(orders.ncol(), y.nrow()), in_whole(orders.ncol(), y.nrow());
    terms.push_back({w.begin(), w.ncol(), f.begin(), o.begin(), o.ncol(), in_own.begin(), in_whole.begin()});
    out.push_back(List::create(_["own"] = in_own, _["whole"] = in_whole));
  }
  crestline::permuted_squares(y.begin(), y.nrow(), y.ncol(), basis.begin(), basis.ncol(), terms, order.data(),
                              orders.ncol(), [] { checkUserInterrupt(); });
  return out;
}
