// Words and numbers of a text file, whatever ends its lines.
#pragma once
#include <string>
#include <vector>

namespace crestline {

// A text of bytes that ends with a line end, walked word by word.
class TextWalk {
 public:
  TextWalk(const char* begin, const char* end) : at_(begin), end_(end) {}

  bool done() const { return at_ >= end_; }
  int line() const { return line_; }  // of the place reached, from 1

  // Steps over the end of this line: LF, CR or both.
  void next_line();

  // The next word of this line, false where there is none. A '#' begins a comment and a backslash
  // at the end of a line goes on with the next, where `comments` asks for it.
  bool word(const char*& begin, const char*& stop, bool comments = false);

  // What is left of this line, without blanks about it.
  std::string rest();

 private:
  const char* at_;
  const char* end_;
  int line_ = 1;
};

// The number that a word is: decimal point, `nan` and `inf` of all systems, `NA`. False where it is
// none, or longer than 63 signs.
bool number_of(const char* begin, const char* stop, double& number);

// The word in small letters equals `key`.
bool same_word(const char* begin, const char* stop, const char* key);

struct NumberText {
  std::vector<double> number;  // all numbers in turn
  std::vector<int> start;      // of every line with words: how many numbers stand before it
  std::vector<int> line;       // its number in the text, from 1
  std::string bad;             // the first word that is no number: reading ends there
  int bad_line = 0;            // 0 where there is none
};
NumberText read_numbers(const char* begin, const char* end);

struct StlText {
  std::vector<double> vertex;  // 3 x n
  std::string bad;             // a word there that should be a number and is not
  int bad_line = 0;            // line at which a triangle has not three corners of three numbers
  bool ended = false;          // `endsolid` stands behind the last triangle
};
StlText read_stl_text(const char* begin, const char* end);

}  // namespace crestline
