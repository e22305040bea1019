#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rad {

// The numbers of a data or font file, one after the other: white space separates, '#' begins a comment.
// Faults are thrown as Error "NAME:LINE: expected WHAT, got ..".
class NumberList {
 public:
  // Both must outlive this.
  NumberList(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  double real(std::string_view what);
  int64_t integer(std::string_view what, int64_t least, int64_t most);

  // Whether nothing but blanks and comments is left.
  bool atEnd();

  // Bytes that have not been read: no fewer than the numbers that may follow, for a check of counts before
  // memory is taken for them.
  size_t left() const { return text_.size() - position_; }

  // Throws with the place of the number read last.
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
