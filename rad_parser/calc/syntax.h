#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// The expression language of function files (.cal): its text and its trees. Source: RADIANCE file formats,
// "Function File Format"; the grammar in doc/notes/language.BNR.
//
//   definitions  { [definition] ";" }                       the last ";" may be missing
//   definition   name [ "(" name { "," name } ")" ] ( "=" | ":" ) sum
//   sum          product { ("+" | "-") product }
//   product      power { ("*" | "/") power }
//   power        sign [ "^" power ]
//   sign         [ "+" | "-" ] primary                      so -2^2 is 4
//   primary      "(" sum ")" | number | "$" digits | name [ "(" sum { "," sum } ")" ]
//
// Names are letters, digits, '_', '.' and the context mark '`', and begin with a letter or the mark.
// {Comments nest}.
namespace rad::calc {

inline constexpr char kContextMark = '`';

// Whether a character may be part of a name. The C library's character classes depend on the locale; the
// language does not.
bool isNamePart(char c);

struct Syntax {
  enum class Kind : uint8_t { number, channel, name, parameter, call, negate, sum, product, power };
  Kind kind = Kind::number;
  uint32_t line = 0;
  // channel: its number. parameter: which one, from 0. name: the symbol, set by the library that binds it.
  int32_t index = -1;
  double number = 0;         // number: finite or +inf, never negative as parsed
  std::string text;          // name, parameter: as written. sum, product: the operators between args ("+-")
  std::vector<Syntax> args;  // call: the callee (a name or parameter), then the arguments
};

struct Definition {
  std::string name;                     // as written, with its context marks
  std::vector<std::string> parameters;  // a function where there are any
  bool constant = false;                // defined with ':'
  Syntax body;
  std::string file;  // as messages name it
  uint32_t line = 0;

  bool isFunction() const { return !parameters.empty(); }
};

// Trees deeper than this are refused: the stack is finite. Chains of + and * of any length are one level.
inline constexpr int kMaxNesting = 400;

// Reads the definitions of a file, whose first line is firstLine. Throws Error "FILE:LINE: expected ...".
std::vector<Definition> parseDefinitions(std::string_view text, std::string_view file,
                                         uint32_t firstLine = 1);

// Reads one expression: all of text. Throws Error "PLACE: expected ... in "TEXT"".
Syntax parseExpression(std::string_view text, std::string_view place);

// Text that parses to an equal tree. Numbers are printed with all their digits.
std::string print(const Syntax& syntax);
std::string print(const Definition& definition);

// Equal trees; lines and symbols do not count.
bool same(const Syntax& a, const Syntax& b);

}  // namespace rad::calc
