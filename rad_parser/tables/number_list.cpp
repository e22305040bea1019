#include "rad_parser/tables/number_list.h"

#include <fmt/format.h>

#include "rad_parser/error.h"
#include "rad_parser/number.h"
#include "rad_parser/printable.h"

namespace rad {

void NumberList::fail(const std::string& problem) const {
  throw Error(fmt::format("{}:{}: {}", name_, line_, problem));
}

void NumberList::refuse(std::string_view what, std::string_view word) const {
  if (word.empty()) fail(fmt::format("expected {}, got the end of the file", what));
  fail(fmt::format("expected {}, got \"{}\"", what, printable(word, 40)));
}

void NumberList::skipBlank() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '#') {
      const size_t end = text_.find('\n', position_);
      position_ = end == text_.npos ? text_.size() : end;
    } else if (isBlank(c)) {
      if (c == '\n') ++line_;
      ++position_;
    } else {
      return;
    }
  }
}

bool NumberList::atEnd() {
  skipBlank();
  return position_ == text_.size();
}

std::string_view NumberList::word() {
  skipBlank();
  const size_t begin = position_;
  while (position_ < text_.size() && !isBlank(text_[position_]) && text_[position_] != '#') ++position_;
  return text_.substr(begin, position_ - begin);
}

double NumberList::real(std::string_view what) {
  const std::string_view w = word();
  const std::optional<double> value = parseReal(w);
  if (!value) refuse(what, w);
  return *value;
}

int64_t NumberList::integer(std::string_view what, int64_t least, int64_t most) {
  const std::string_view w = word();
  const std::optional<int64_t> value = parseInteger(w);
  if (!value || *value < least || *value > most) refuse(what, w);
  return *value;
}

}  // namespace rad
