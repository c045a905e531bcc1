#include "mesh_read.h"

#include <R_ext/Utils.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace crestline {

namespace {

bool is_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }

// A backslash with nothing but blanks up to the end of the line.
bool goes_on(const char* at, const char* end) {
  if (*at != '\\') return false;
  for (++at; at < end && is_blank(*at);) ++at;
  return at >= end || is_end(*at);
}

// "1.#QNAN", "-1.#IND00", "nan(ind)", "inf", "NA" and their like: not finite, which is all that
// matters.
bool special_number(const char* begin, const char* stop, double& number) {
  if (*begin == '-' || *begin == '+') ++begin;
  const char* digits = begin;
  while (digits < stop && std::isdigit(static_cast<unsigned char>(*digits))) ++digits;
  bool windows = digits > begin && stop - digits > 2 && digits[0] == '.' && digits[1] == '#';
  number = std::numeric_limits<double>::quiet_NaN();
  if (windows || same_word(begin, stop, "na") || same_word(begin, stop, "nan")) return true;
  if (stop - begin > 4 && stop[-1] == ')' && same_word(begin, begin + 4, "nan(")) return true;
  if (!same_word(begin, stop, "inf") && !same_word(begin, stop, "infinity")) return false;
  number = std::numeric_limits<double>::infinity();
  return true;
}

}  // namespace

void TextWalk::next_line() {
  while (at_ < end_ && !is_end(*at_)) ++at_;
  if (at_ < end_ && *at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n') ++at_;
  if (at_ < end_) ++at_;
  ++line_;
}

bool TextWalk::word(const char*& begin, const char*& stop, bool comments) {
  while (at_ < end_) {
    if (is_blank(*at_)) {
      ++at_;
    } else if (comments && goes_on(at_, end_)) {
      next_line();
    } else {
      break;
    }
  }
  if (at_ >= end_ || is_end(*at_) || (comments && *at_ == '#')) return false;
  begin = at_;
  while (at_ < end_ && !is_end(*at_) && !is_blank(*at_)) {
    // "1.#IND" is a number; a comment may stand close behind one.
    if (comments && ((*at_ == '#' && at_[-1] != '.') || goes_on(at_, end_))) break;
    ++at_;
  }
  stop = at_;
  return true;
}

std::string TextWalk::rest() {
  const char* begin = at_;
  while (at_ < end_ && !is_end(*at_)) ++at_;
  const char* stop = at_;
  while (begin < stop && is_blank(*begin)) ++begin;
  while (stop > begin && is_blank(stop[-1])) --stop;
  return std::string(begin, stop);
}

bool number_of(const char* begin, const char* stop, double& number) {
  if (std::isdigit(static_cast<unsigned char>(*begin)) || *begin == '-' || *begin == '+' ||
      *begin == '.') {
    // A copy, since R_strtod() measures the whole text at every call.
    char copy[64];
    std::size_t size = std::min<std::size_t>(stop - begin, sizeof copy - 1);
    std::copy(begin, begin + size, copy);
    copy[size] = '\0';
    char* after;
    number = R_strtod(copy, &after);
    if (after == copy + (stop - begin)) return true;
  }
  return special_number(begin, stop, number);
}

bool same_word(const char* begin, const char* stop, const char* key) {
  for (; begin < stop && *key; ++begin, ++key)
    if (std::tolower(static_cast<unsigned char>(*begin)) != *key) return false;
  return begin == stop && !*key;
}

NumberText read_numbers(const char* begin, const char* end) {
  NumberText out;
  TextWalk text(begin, end);
  const char *from, *stop;
  for (; !text.done(); text.next_line()) {
    bool first = true;
    while (text.word(from, stop)) {
      double number;
      if (!number_of(from, stop, number)) {
        out.bad.assign(from, stop);
        out.bad_line = text.line();
        return out;
      }
      if (first) {
        out.start.push_back(static_cast<int>(out.number.size()));
        out.line.push_back(text.line());
        first = false;
      }
      out.number.push_back(number);
    }
  }
  return out;
}

namespace {

// One word of an STL text and what belongs to it. `corners`: of the facet begun last. False where
// it has not three.
bool read_stl_word(TextWalk& text, const char* from, const char* stop, int& corners, StlText& out) {
  if (same_word(from, stop, "solid") || same_word(from, stop, "endsolid")) {
    out.ended = same_word(from, stop, "endsolid");
    text.rest();  // a name, which may hold any word
  } else if (same_word(from, stop, "facet")) {
    if (corners != 3) return false;
    corners = 0;
    out.ended = false;
  } else if (same_word(from, stop, "vertex")) {
    for (int i = 0; i < 3; ++i) {
      double x;
      if (!text.word(from, stop) || !number_of(from, stop, x)) {
        if (from < stop) out.bad.assign(from, stop);
        return false;
      }
      out.vertex.push_back(x);
    }
    return ++corners <= 3;
  }
  return true;
}

}  // namespace

StlText read_stl_text(const char* begin, const char* end) {
  StlText out;
  TextWalk text(begin, end);
  const char *from, *stop;
  int corners = 3;
  bool good = true;
  for (; good && !text.done(); text.next_line())
    while (good && text.word(from, stop)) {
      good = read_stl_word(text, from, stop, corners, out);
      if (!good) out.bad_line = text.line();
    }
  if (good && corners != 3) out.bad_line = text.line() - 1;
  return out;
}

}  // namespace crestline
