#pragma once
// Syntax trees of function files as text.
#include <fmt/ranges.h>

#include <string>

#include "rad_parser/calc/syntax.h"

namespace rad::calc {

// The precedence of a tree as an operand: 0 sum, 1 product, 2 power, 3 sign, 4 primary.
inline int binding(const Syntax& s) {
  switch (s.kind) {
    case Syntax::Kind::sum:
      return 0;
    case Syntax::Kind::product:
      return 1;
    case Syntax::Kind::power:
      return 2;
    case Syntax::Kind::negate:
      return 3;
    default:
      return 4;
  }
}

inline void printTo(std::string& out, const Syntax& s, int least) {
  const bool enclose = binding(s) < least;
  if (enclose) out += '(';
  switch (s.kind) {
    case Syntax::Kind::number:
      // Infinity has no notation of its own; 1e999 is read as infinity.
      out += s.number > 1.7976931348623157e308 ? "1e999" : fmt::format("{}", s.number);
      break;
    case Syntax::Kind::channel:
      out += fmt::format("${}", s.index);
      break;
    case Syntax::Kind::name:
    case Syntax::Kind::parameter:
      out += s.text;
      break;
    case Syntax::Kind::call:
      out += s.args[0].text + "(";
      for (size_t i = 1; i < s.args.size(); ++i) {
        if (i > 1) out += ", ";
        printTo(out, s.args[i], 0);
      }
      out += ')';
      break;
    case Syntax::Kind::negate:
      out += '-';
      printTo(out, s.args[0], 4);
      break;
    case Syntax::Kind::sum:
    case Syntax::Kind::product: {
      const int level = binding(s);
      for (size_t i = 0; i < s.args.size(); ++i) {
        if (i > 0) out += s.text[i - 1];
        // Also around the first operand, because a sum whose first operand is a sum is a different
        // tree from one sum of all.
        printTo(out, s.args[i], level + 1);
      }
      break;
    }
    case Syntax::Kind::power:
      printTo(out, s.args[0], 3);
      out += '^';
      printTo(out, s.args[1], 2);
      break;
  }
  if (enclose) out += ')';
}

// Text that parses to an equal tree. Numbers are printed with as many digits as it takes to
// read them back exactly.
inline std::string print(const Syntax& syntax) {
  std::string out;
  printTo(out, syntax, 0);
  return out;
}

inline std::string print(const Definition& d) {
  return fmt::format("{}{}{}{} {} {};", d.name, d.isFunction() ? "(" : "", fmt::join(d.parameters, ", "),
                     d.isFunction() ? ")" : "", d.constant ? ':' : '=', print(d.body));
}

}  // namespace rad::calc
