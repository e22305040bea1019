#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// The expression language of function files (.cal): its text and its syntax trees. Source: RADIANCE file
// formats, "Function File Format"; the grammar in doc/notes/language.BNR.
//
//   definitions  { [definition] ";" }                       the last ";" may be missing
//   definition   name [ "(" name { "," name } ")" ] ( "=" | ":" ) sum
//   sum          product { ("+" | "-") product }
//   product      power { ("*" | "/") power }
//   power        sign [ "^" power ]
//   sign         [ "+" | "-" ] primary                      hence -2^2 is 4
//   primary      "(" sum ")" | number | "$" digits | name [ "(" sum { "," sum } ")" ]
//
// Names consist of letters, digits, '_', '.' and the context mark '`'. They begin with a letter or the mark.
// {Comments} may be nested.
namespace rad::calc {

inline constexpr char kContextMark = '`';

// Whether a character may be part of a name. The character classes of the C library are not used, because
// they depend on the locale.
bool isNamePart(char c);

struct Syntax {
  enum class Kind : uint8_t { number, channel, name, parameter, call, negate, sum, product, power };
  Kind kind = Kind::number;
  uint32_t line = 0;
  // channel: its number. parameter: its position, from 0. name: its symbol, set by SymbolTable::bind().
  int32_t index = -1;
  double number = 0;         // number: finite or +infinity; the parser creates no negative numbers
  std::string text;          // name, parameter: as written. sum, product: the operators between args ("+-")
  std::vector<Syntax> args;  // call: the callee (a name or parameter), then the arguments
};

struct Definition {
  std::string name;                     // as written, with its context marks
  std::vector<std::string> parameters;  // empty: a variable
  bool constant = false;                // defined with ':'
  Syntax body;
  std::string file;  // as shown in messages
  uint32_t line = 0;

  bool isFunction() const { return !parameters.empty(); }
};

// Limit on the depth of trees, because the stack is finite. A chain of + and -, or of * and /, is a single
// level regardless of its length.
inline constexpr int kMaxNesting = 400;

// Parses the definitions in a file whose first line has the number firstLine. Throws Error "FILE:LINE:
// expected ...".
std::vector<Definition> parseDefinitions(std::string_view text, std::string_view file,
                                         uint32_t firstLine = 1);

// Parses a single expression, which must be the whole text. Throws Error "PLACE: expected ... in "TEXT"".
Syntax parseExpression(std::string_view text, std::string_view place);

// Whether two trees are equal. Lines and symbols are not compared.
bool same(const Syntax& a, const Syntax& b);

}  // namespace rad::calc
