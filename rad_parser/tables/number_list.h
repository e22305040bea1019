#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rad {

// Reads the numbers of a data or font file in sequence. They are separated by white space; '#' begins a
// comment. Errors are thrown as Error "NAME:LINE: expected WHAT, got ..".
class NumberList {
 public:
  // Both must outlive this object.
  NumberList(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  double real(std::string_view what);
  int64_t integer(std::string_view what, int64_t least, int64_t most);

  // Whether only blanks and comments are left.
  bool atEnd();

  // The number of bytes not yet read. At most this many numbers can follow, so counts can be checked before
  // memory is allocated.
  size_t left() const { return text_.size() - position_; }

  // Throws an Error with the line of the last number that was read.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void skipBlank();
  std::string_view word();
  [[noreturn]] void refuse(std::string_view what, std::string_view word) const;

  std::string_view text_, name_;
  size_t position_ = 0;
  uint32_t line_ = 1;
};

}  // namespace rad
