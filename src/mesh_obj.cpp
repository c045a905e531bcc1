#include "mesh_obj.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh_read.h"

namespace crestline {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// A whole number, counted back from `before` where negative.
int index_of(const char* begin, const char* stop, std::size_t before) {
  double number;
  if (begin == stop || !number_of(begin, stop, number)) return no_index;
  if (!(std::abs(number) < 2147483647.0) || number != std::floor(number)) return no_index;
  if (number < 0) number += static_cast<double>(before) + 1;
  return static_cast<int>(number);
}

// x, y, z, and three colours where there are six numbers or more. False where one of the first
// three is none.
bool read_vertex(TextWalk& text, ObjText& out) {
  double number[6];
  int found = 0;
  const char *from = nullptr, *stop = nullptr;
  while (found < 6 && text.word(from, stop, true)) {
    if (number_of(from, stop, number[found])) {
      ++found;
    } else if (found < 3) {
      out.bad.assign(from, stop);
      return false;
    } else {
      break;
    }
  }
  if (found < 3) return false;
  out.vertex.insert(out.vertex.end(), number, number + 3);
  if (found < 6) {
    out.coloured = false;
    std::fill(number + 3, number + 6, nan_value);
  }
  if (out.coloured) out.colour.insert(out.colour.end(), number + 3, number + 6);
  return true;
}

void read_uv(TextWalk& text, ObjText& out) {
  for (int i = 0; i < 2; ++i) {
    double number;
    const char *from, *stop;
    if (!text.word(from, stop, true) || !number_of(from, stop, number)) number = nan_value;
    out.uv.push_back(number);
  }
}

// Corners as v, v/vt, v//vn or v/vt/vn.
void read_face(TextWalk& text, ObjText& out) {
  int sides = 0;
  const char *from, *stop;
  while (text.word(from, stop, true)) {
    const char* slash = std::find(from, stop, '/');
    out.corner.push_back(index_of(from, slash, out.vertex.size() / 3));
    const char* uv = slash < stop ? slash + 1 : stop;
    out.corner_uv.push_back(index_of(uv, std::find(uv, stop, '/'), out.uv.size() / 2));
    ++sides;
  }
  out.sides.push_back(sides);
  out.material.push_back(static_cast<int>(out.materials.size()));
}

}  // namespace

ObjText read_obj_text(const char* begin, const char* end) {
  ObjText out;
  TextWalk text(begin, end);
  const char *from, *stop;
  for (; !text.done(); text.next_line()) {
    if (!text.word(from, stop)) continue;
    if (same_word(from, stop, "v")) {
      if (!read_vertex(text, out)) {
        out.bad_line = text.line();
        return out;
      }
    } else if (same_word(from, stop, "vt")) {
      read_uv(text, out);
    } else if (same_word(from, stop, "f") || same_word(from, stop, "fo")) {
      read_face(text, out);
    } else if (same_word(from, stop, "usemtl")) {
      out.materials.push_back(text.rest());
    } else if (same_word(from, stop, "mtllib")) {
      out.libraries.push_back(text.rest());
    }
  }
  return out;
}

}  // namespace crestline
