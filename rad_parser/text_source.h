#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "rad_parser/description_builder.h"

namespace rad {

// The words of a scene text, one after the other, from a file descriptor (read in blocks, so that memory does
// not grow with the file) or from memory. Words are separated by white space; parts of them in double or
// single quotes may hold white space, and the quotes fall away. Faults are thrown with their place.
class TextSource {
 public:
  // A word longer than this is taken for a sign that the input is no scene text.
  static constexpr size_t kLongestWord = 1 << 16;

  // Reads `descriptor`, which stays the caller's, as the builder's file `file`. ahead: what was read from it
  // already; at most half a block (128 kB).
  TextSource(int descriptor, uint32_t file, const DescriptionBuilder& builder, std::string_view ahead = {});
  // Reads text, which must outlive this.
  TextSource(std::string_view text, uint32_t file, const DescriptionBuilder& builder);

  // Skips white space. The first character behind it, or -1 at the end.
  int peek();

  // Skips a byte order mark, which editors put at the beginning of UTF-8 text, and white space before it.
  void skipByteOrderMark();

  // Skips to the end of the line.
  void skipLine();

  // The rest of the line; a backslash before the line's end makes the next line part of it (both characters
  // are kept, as a shell expects them). The line's end may be written "\r\n" or "\r" and is not part of the
  // text.
  std::string line();

  // The next word, valid until the next call. False at the end of the text.
  bool word(std::string_view& word);

  // The next word as a real or integer number; false where it is none or the text ends: lastWord() says
  // which.
  bool real(double& value);
  bool integer(int64_t& value);

  // The word that real() or integer() refused; empty at the end of the text.
  std::string_view lastWord() const { return lastWord_; }

  // Where the word just read began, or, after peek(), where the next begins.
  Place place() const { return {file_, wordLine_}; }

 private:
  bool refill(const char*& keep);
  bool quotedWord(std::string_view& word, const char* start);
  [[noreturn]] void nulByte() const;

  int descriptor_ = -1;  // -1: nothing more to read
  uint32_t file_;
  uint32_t line_ = 1, wordLine_ = 1;
  const DescriptionBuilder& builder_;
  std::unique_ptr<char[]> block_;
  const char* next_ = nullptr;
  const char* end_ = nullptr;
  std::string unquoted_;
  std::string_view lastWord_;
};

}  // namespace rad
