#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/calc/program.h"
#include "rad_parser/calc/syntax.h"

// From bound trees to programs. For library.cpp; others use calc::Library.
namespace rad::calc {

// A function that the language always has. arity: the arguments that it needs; more are ignored, except by
// those that take any number (if they are named so: min, max, select).
struct LibraryFunction {
  std::string_view name;
  Op op;
  int arity;
};
const LibraryFunction* findLibraryFunction(std::string_view name);

// A name in its context. It may be referred to before, or without ever, being defined.
struct Symbol {
  std::string name;  // qualified: "mod", "mod`woodpat"
  const Definition* definition = nullptr;
  const LibraryFunction* library = nullptr;
  const HostFunction* host = nullptr;
};

struct CompileInput {
  std::span<const Symbol> symbols;
  size_t inputs = 0;           // number of the renderer's variables: $1 .. $inputs
  uint64_t available = ~0ull;  // bit i: $(i+1) has a meaning here; the others are undefined variables
  bool hasHosts = true;        // else the renderer's functions are undefined
  std::optional<std::span<const double>> reals;  // arg(n), where it is known now
  std::string place;                             // of the expressions, for messages
};

// A program for bound expressions. Throws Error where something undefined is certain to be evaluated.
std::shared_ptr<const Program> compileExpressions(const CompileInput& input,
                                                  std::span<const Syntax> expressions);

// A program for symbol(Point::arguments[0], .. [count-1]).
std::shared_ptr<const Program> compileCall(const CompileInput& input, int symbol, int count);

}  // namespace rad::calc
