#include "rad_parser/calc/syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "rad_parser/error.h"
#include "rad_parser/printable.h"

namespace rad::calc {
namespace {

using Kind = Syntax::Kind;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

class Parser {
 public:
  // oneExpression: text is a single expression, and `file` is its place for messages. Otherwise text is a
  // file, and messages contain its lines.
  Parser(std::string_view text, std::string_view file, uint32_t line, bool oneExpression)
      : text_(text), file_(file), line_(line), oneExpression_(oneExpression) {
    skipBlank();
  }

  std::vector<Definition> definitions() {
    std::vector<Definition> all;
    while (!atEnd()) {
      if (!accept(';')) {
        all.push_back(definition());
        if (!atEnd()) expect(';');
      }
    }
    return all;
  }

  Syntax expression() {
    Syntax whole = sum();
    if (!atEnd()) fail("an operator or the end");
    return whole;
  }

 private:
  bool atEnd() const { return position_ == text_.size(); }
  char next() const { return atEnd() ? '\0' : text_[position_]; }

  [[noreturn]] void failAt(uint32_t line, const std::string& problem) const {
    if (oneExpression_)
      throw Error(fmt::format("{}: {} in \"{}\"", file_, problem, printable(text_, kLongestName)));
    throw Error(fmt::format("{}:{}: {}", file_, line, problem));
  }

  [[noreturn]] void fail(std::string_view expected) const {
    std::string found = "the end";
    if (!atEnd()) {
      size_t end = position_ + 1;
      const auto part =
          isNamePart(next()) ? isNamePart : +[](char c) { return (c & 0xc0) == 0x80; };  // of UTF-8
      while (end < text_.size() && end < position_ + 40 && part(text_[end])) ++end;
      found = "\"" + printable(text_.substr(position_, end - position_)) + "\"";
    }
    failAt(line_, fmt::format("expected {}, got {}", expected, found));
  }

  void step() {
    if (text_[position_] == '\n') ++line_;
    ++position_;
  }

  void skipBlank() {
    while (!atEnd()) {
      if (isBlank(next())) {
        step();
      } else if (next() == '{') {
        const uint32_t begin = line_;
        int open = 0;
        do {
          if (atEnd()) failAt(begin, "expected '}' to end the comment that begins here");
          if (next() == '{') ++open;
          if (next() == '}') --open;
          step();
        } while (open > 0);
      } else {
        return;
      }
    }
  }

  bool accept(char c) {
    if (atEnd() || next() != c) return false;
    step();
    skipBlank();
    return true;
  }

  void expect(char c) {
    if (!accept(c)) fail(fmt::format("'{}'", c));
  }

  std::string name() {
    const size_t begin = position_;
    while (!atEnd() && isNamePart(next())) ++position_;
    std::string word(text_.substr(begin, position_ - begin));
    skipBlank();
    return word;
  }

  Definition definition() {
    Definition d;
    d.file = file_;
    d.line = line_;
    if (!isLetter(next()) && next() != '`') fail("a name to define");
    d.name = name();
    if (d.name.find_first_not_of('`') == std::string::npos) fail("a name to define");
    if (accept('(')) {
      do {
        if (!isLetter(next())) fail("a parameter's name");
        const uint32_t line = line_;
        d.parameters.push_back(name());
        if (d.parameters.back().find('`') != std::string::npos) {
          failAt(line,
                 fmt::format("expected a parameter's name without '`', got \"{}\"", d.parameters.back()));
        }
      } while (accept(','));
      expect(')');
    }
    if (accept(':')) {
      d.constant = true;
    } else if (!accept('=')) {
      fail("'=' or ':'");
    }
    parameters_ = &d.parameters;
    d.body = sum();
    parameters_ = nullptr;
    return d;
  }

  Syntax make(Kind kind) const {
    Syntax s;
    s.kind = kind;
    s.line = line_;
    return s;
  }

  template <class Operand>
  Syntax chain(Kind kind, char first, char second, Operand operand) {
    Syntax left = (this->*operand)();
    if (atEnd() || (next() != first && next() != second)) return left;
    Syntax whole = make(kind);
    whole.line = left.line;
    whole.args.push_back(std::move(left));
    while (!atEnd() && (next() == first || next() == second)) {
      whole.text += next();
      accept(next());
      whole.args.push_back((this->*operand)());
    }
    return whole;
  }

  Syntax sum() {
    if (++depth_ > kMaxNesting) failAt(line_, fmt::format("nested more than {} deep", kMaxNesting));
    Syntax s = chain(Kind::sum, '+', '-', &Parser::product);
    --depth_;
    return s;
  }

  Syntax product() { return chain(Kind::product, '*', '/', &Parser::power); }

  Syntax power() {
    Syntax base = sign();
    if (!accept('^')) return base;
    if (++depth_ > kMaxNesting) failAt(line_, fmt::format("nested more than {} deep", kMaxNesting));
    Syntax whole = make(Kind::power);
    whole.line = base.line;
    whole.args.push_back(std::move(base));
    whole.args.push_back(power());
    --depth_;
    return whole;
  }

  Syntax sign() {
    if (accept('-')) {
      Syntax whole = make(Kind::negate);
      whole.args.push_back(primary());
      return whole;
    }
    accept('+');
    return primary();
  }

  Syntax primary() {
    if (accept('(')) {
      Syntax inner = sum();
      expect(')');
      return inner;
    }
    if (atEnd()) fail("a number, a name or '('");
    if (next() == '$') return channel();
    if (isDigit(next()) || next() == '.') return number();
    if (isLetter(next()) || next() == '`') return reference();
    fail("a number, a name or '('");
  }

  Syntax channel() {
    Syntax s = make(Kind::channel);
    accept('$');
    s.index = 0;
    if (!isDigit(next())) fail("a channel's number");
    while (!atEnd() && isDigit(next())) {
      s.index = std::min(s.index * 10 + (next() - '0'), 1000000);
      ++position_;
    }
    skipBlank();
    return s;
  }

  Syntax number() {
    Syntax s = make(Kind::number);
    const size_t begin = position_;
    const auto digits = [&] {
      const size_t from = position_;
      while (!atEnd() && isDigit(next())) ++position_;
      return position_ > from;
    };
    bool any = digits();
    if (next() == '.') {
      ++position_;
      any |= digits();
    }
    if (!any) fail("a digit");
    if (next() == 'e' || next() == 'E') {
      ++position_;
      if (next() == '-' || next() == '+') ++position_;
      if (!digits()) fail("an exponent");
    }
    const std::string word(text_.substr(begin, position_ - begin));
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), s.number);
    // strtod distinguishes overflow from underflow, but from_chars does not.
    if (error == std::errc::result_out_of_range) s.number = std::strtod(word.c_str(), nullptr);
    skipBlank();
    return s;
  }

  Syntax reference() {
    Syntax s = make(Kind::name);
    s.text = name();
    if (s.text.find_first_not_of('`') == std::string::npos) fail("a name after '`'");
    if (parameters_ != nullptr) {
      const auto found = std::ranges::find(*parameters_, s.text);
      if (found != parameters_->end()) {
        s.kind = Kind::parameter;
        s.index = static_cast<int32_t>(found - parameters_->begin());
      }
    }
    if (!accept('(')) return s;
    Syntax whole = make(Kind::call);
    whole.line = s.line;
    whole.args.push_back(std::move(s));
    do {
      whole.args.push_back(sum());
    } while (accept(','));
    expect(')');
    return whole;
  }

  std::string_view text_;
  std::string file_;
  uint32_t line_;
  bool oneExpression_;
  size_t position_ = 0;
  int depth_ = 0;
  const std::vector<std::string>* parameters_ = nullptr;
};

}  // namespace

bool isNamePart(char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '.' || c == kContextMark; }

std::vector<Definition> parseDefinitions(std::string_view text, std::string_view file, uint32_t firstLine) {
  return Parser(text, file, firstLine, false).definitions();
}

Syntax parseExpression(std::string_view text, std::string_view place) {
  return Parser(text, place, 1, true).expression();
}

bool same(const Syntax& a, const Syntax& b) {
  return a.kind == b.kind && a.text == b.text && a.args.size() == b.args.size() &&
         (a.kind != Kind::number || a.number == b.number) &&
         ((a.kind != Kind::channel && a.kind != Kind::parameter) || a.index == b.index) &&
         std::equal(a.args.begin(), a.args.end(), b.args.begin(), same);
}

}  // namespace rad::calc
