#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/calc/graph.h"
#include "rad_parser/calc/program.h"
#include "rad_parser/calc/syntax.h"

// Converts syntax trees, whose names are bound to symbols, to graphs: the first step of making a program. The
// second step is writeProgram() (code_writer.h).
//
// Function files consist of many small definitions that refer to each other. Therefore every call is replaced
// by the body of the function, and a parameter by the node of its argument. A recursive call is expanded as
// long as some argument is a new constant each time, as in the octaves of turbulence; otherwise it becomes a
// call of a frame, which is compiled separately. If arguments are functions, each combination of functions
// has a separate frame.
namespace rad::calc {

// A built-in function of the language. `arity`: number of arguments that it needs. Further arguments are
// ignored, except by min, max and select, which take any number.
struct LibraryFunction {
  std::string_view name;
  Op op;
  int arity;
};

const LibraryFunction* findLibraryFunction(std::string_view name);

// The operation of one of the operators + - * /.
Op operatorOf(char c);

// A name in its context. It may be used before its definition, or without any definition.
struct Symbol {
  std::string name;  // qualified: "mod", "mod`woodpat"
  const Definition* definition = nullptr;
  const LibraryFunction* library = nullptr;
  const HostFunction* host = nullptr;
};

struct CompileInput {
  std::span<const Symbol> symbols;               // indexed by Syntax::index of names
  size_t inputs = 0;                             // number of the renderer's variables: $1 .. $inputs
  uint64_t available = ~0ull;                    // bit i: $(i+1) has a value here; other inputs are undefined
  bool hasHosts = true;                          // false: the renderer's functions are undefined
  std::optional<std::span<const double>> reals;  // values of arg(n), if they are already known
  std::string place;                             // of the expressions, for messages
};

struct Expansion {
  std::deque<FrameGraph> frames;  // the first one evaluates the expressions
  std::vector<std::string> messages;
  std::vector<HostFunction> hosts;  // those that are called
};

// The graphs of bound expressions. The trees may be destroyed after the call. An expression that cannot be
// evaluated, such as an undefined variable, becomes the operation Op::fail. Throws Error if definitions are
// nested too deeply.
Expansion expandExpressions(const CompileInput& input, std::span<const Syntax> expressions);

// The graphs of symbol(Point::arguments[0], .. [count-1]).
Expansion expandCall(const CompileInput& input, int symbol, int count);

}  // namespace rad::calc
