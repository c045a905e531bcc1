// The lines of an OBJ file that a surface needs: v, vt, f, usemtl, mtllib.
#pragma once
#include <string>
#include <vector>

namespace crestline {

// An index that is no whole number; R's NA.
constexpr int no_index = -2147483647 - 1;

struct ObjText {
  std::vector<double> vertex;    // 3 x n
  std::vector<double> colour;    // 3 x n, NaN where a vertex has none
  bool coloured = true;          // every vertex has one
  std::vector<double> uv;        // 2 x texture places, NaN where damaged
  std::vector<int> corner;       // vertex of every corner of the polygons in turn, from 1
  std::vector<int> corner_uv;    // its texture place, from 1, no_index where none
  std::vector<int> sides;        // corners of each polygon
  std::vector<int> material;  // of each polygon: number of `materials` from 1, 0 before the first
  std::vector<std::string> materials, libraries;
  std::string bad;               // the first word that should be a co-ordinate and is not
  int bad_line = 0;
};

// Lines go on behind a backslash, a '#' begins a comment, negative indices count back.
ObjText read_obj_text(const char* begin, const char* end);

}  // namespace crestline
