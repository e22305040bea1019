#include "rad_parser/text_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "rad_parser/block.h"
#include "rad_parser/number.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

// Block size: has room for the longest word, and fits into the second-level cache.
constexpr size_t kTextBlock = 1 << 18;
static_assert(kTextBlock > 2 * TextSource::kLongestWord);

enum Kind : uint8_t { plain, space, quote, nul };

constexpr auto kKinds = [] {
  std::array<Kind, 256> kinds{};
  for (unsigned char c : {' ', '\t', '\n', '\v', '\f', '\r'}) kinds[c] = space;
  kinds['"'] = kinds['\''] = quote;
  kinds[0] = nul;
  return kinds;
}();

Kind kindOf(char c) { return kKinds[static_cast<unsigned char>(c)]; }

}  // namespace

TextSource::TextSource(int descriptor, uint32_t file, const DescriptionBuilder& builder,
                       std::string_view ahead)
    : descriptor_(descriptor), file_(file), builder_(builder), block_(new char[kTextBlock]) {
  std::copy(ahead.begin(), ahead.end(), block_.get());
  next_ = block_.get();
  end_ = next_ + ahead.size();
}

TextSource::TextSource(std::string_view text, uint32_t file, const DescriptionBuilder& builder)
    : file_(file), builder_(builder), next_(text.data()), end_(text.data() + text.size()) {}

// Moves the text starting at keep to the front of the block and appends newly read text. At the end of the
// text, returns false and moves nothing.
bool TextSource::refill(const char*& keep) {
  if (descriptor_ < 0) return false;
  return readOn(descriptor_, block_.get(), kTextBlock, keep, next_, end_, [&] {
    return builder_.description().at({file_, 0});
  });
}

void TextSource::nulByte() const { throw builder_.error({file_, line_}, "NUL byte: this is not scene text"); }

int TextSource::peek() {
  for (;;) {
    while (next_ != end_ && kindOf(*next_) == space) line_ += *next_++ == '\n';
    wordLine_ = line_;
    if (next_ != end_) return static_cast<unsigned char>(*next_);
    const char* keep = next_;
    if (!refill(keep)) return -1;
  }
}

void TextSource::skipByteOrderMark() {
  if (peek() < 0x80) return;
  while (end_ - next_ < static_cast<ptrdiff_t>(kByteOrderMark.size()))
    if (const char* keep = next_; !refill(keep)) break;
  if (isUtf16({next_, end_})) throw builder_.error({file_, line_}, kUtf16);
  if (std::string_view(next_, end_).starts_with(kByteOrderMark)) next_ += kByteOrderMark.size();
}

void TextSource::skipLine() {
  for (;;) {
    const void* found = next_ == end_ ? nullptr : std::memchr(next_, '\n', static_cast<size_t>(end_ - next_));
    if (found) {
      next_ = static_cast<const char*>(found) + 1;
      ++line_;
      return;
    }
    next_ = end_;
    const char* keep = next_;
    if (!refill(keep)) return;
  }
}

std::string TextSource::line() {
  constexpr size_t kLongestLine = 1 << 20;
  std::string text;
  bool sawReturn = false;  // "\r" ends the line; a following "\n" is part of that line end
  for (;;) {
    if (next_ == end_) {
      const char* keep = next_;
      if (!refill(keep)) return text;
    }
    char c = *next_;
    if (sawReturn && c != '\n') {
      sawReturn = false;
      if (!text.ends_with('\\')) return text;
      text += '\n';
    }
    ++next_;
    if (c == '\0') nulByte();
    if (c == '\r') {
      sawReturn = true;
      continue;
    }
    sawReturn = false;
    if (c == '\n') {
      ++line_;
      if (!text.ends_with('\\')) return text;
    }
    text += c;
    if (text.size() > kLongestLine)
      throw builder_.error(place(), fmt::format("command longer than {} bytes", kLongestLine));
  }
}

bool TextSource::word(std::string_view& word) {
  if (peek() < 0) return false;
  const char* start = next_;
  for (;;) {
    while (next_ != end_ && kindOf(*next_) == plain) ++next_;
    const auto length = static_cast<size_t>(next_ - start);
    if (length > kLongestWord)
      throw builder_.error(place(), fmt::format("word longer than {} bytes: \"{}\"", kLongestWord,
                                                printable({start, length}, 20)));
    if (next_ != end_) {
      if (*next_ == '\0') nulByte();
      if (kindOf(*next_) == quote) return quotedWord(word, start);
    } else if (refill(start)) {
      continue;
    }
    word = {start, length};
    return true;
  }
}

// Reads the rest of a word from the quote at next_. The word begins at start.
bool TextSource::quotedWord(std::string_view& word, const char* start) {
  unquoted_.assign(start, next_);
  char open = '\0';
  for (;;) {
    if (next_ == end_) {
      const char* keep = next_;
      if (!refill(keep)) {
        if (open != '\0') throw builder_.error(place(), fmt::format("unclosed quote: {}", open));
        break;
      }
    }
    const char c = *next_;
    if (c == '\0') nulByte();
    if (open == '\0' && kindOf(c) == space) break;
    ++next_;
    line_ += c == '\n';
    if (c == open) {
      open = '\0';
    } else if (open == '\0' && kindOf(c) == quote) {
      open = c;
    } else {
      unquoted_ += c;
      if (unquoted_.size() > kLongestWord)
        throw builder_.error(place(), fmt::format("word longer than {} bytes: \"{}\"", kLongestWord,
                                                  printable(unquoted_, 20)));
    }
  }
  word = unquoted_;
  return true;
}

bool TextSource::real(double& value) {
  // Almost every number ends within the block. It can be read without first searching for its end.
  if (peek() >= 0) {
    const char* digits = next_ + (*next_ == '+');
    const char* first = digits + (digits == next_ && *digits == '-');
    if (first < end_ && (('0' <= *first && *first <= '9') || *first == '.')) {
      const auto [last, fault] = readReal(digits, end_, value);
      if (fault == std::errc() && last != end_ && kindOf(*last) == space) {
        next_ = last;
        return true;
      }
    }
  }
  lastWord_ = {};
  if (!word(lastWord_)) return false;
  const auto parsed = parseReal(lastWord_);
  if (parsed) value = *parsed;
  return parsed.has_value();
}

bool TextSource::integer(int64_t& value) {
  lastWord_ = {};
  if (!word(lastWord_)) return false;
  const auto parsed = parseInteger(lastWord_);
  if (parsed) value = *parsed;
  return parsed.has_value();
}

}  // namespace rad
