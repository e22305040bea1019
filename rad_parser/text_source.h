#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "rad_parser/description_builder.h"

namespace rad {

// Reads the words of scene text in sequence, from a file descriptor or from memory. A descriptor is read in
// blocks, so that memory does not grow with the file. Words are separated by white space. Parts of a word in
// double or single quotes may contain white space; the quotes are removed. Errors contain their place.
class TextSource {
 public:
  // Limit on the length of words. A longer word indicates that the input is not scene text.
  static constexpr size_t kLongestWord = 1 << 16;

  // Reads `descriptor`, which the caller closes, as file `file` of the builder. ahead: data already read from
  // the descriptor, at most half a block (128 kB).
  TextSource(int descriptor, uint32_t file, const DescriptionBuilder& builder, std::string_view ahead = {});
  // Reads text, which must outlive this object.
  TextSource(std::string_view text, uint32_t file, const DescriptionBuilder& builder);

  // Skips white space. Returns the next character, or -1 at the end.
  int peek();

  // Skips white space and a byte order mark; some editors write this mark at the beginning of UTF-8 text.
  // Throws Error if the mark is that of UTF-16.
  void skipByteOrderMark();

  // Skips to the end of the line.
  void skipLine();

  // The rest of the line without its end, which may be "\n", "\r\n" or "\r". If the line ends with a
  // backslash, the next line is included; the backslash and the line end between them are kept, as a shell
  // expects.
  std::string line();

  // Reads the next word, which is valid until the next call. Returns false at the end of the text.
  bool word(std::string_view& word);

  // These read the next word as a real number or an integer. They return false at the end of the text, or if
  // the word is not a number of this kind; lastWord() distinguishes the two.
  bool real(double& value);
  bool integer(int64_t& value);

  // The word rejected by real() or integer(); empty at the end of the text.
  std::string_view lastWord() const { return lastWord_; }

  // The place of the last word or, after peek(), of the next one.
  Place place() const { return {file_, wordLine_}; }

 private:
  bool refill(const char*& keep);
  bool quotedWord(std::string_view& word, const char* start);
  [[noreturn]] void nulByte() const;

  int descriptor_ = -1;  // -1 at the end of the data
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
