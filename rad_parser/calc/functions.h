#pragma once
#include <string_view>

#include "rad_parser/calc/program.h"

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

}  // namespace rad::calc
