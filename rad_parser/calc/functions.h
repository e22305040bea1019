#pragma once
#include <string_view>

#include "rad_parser/calc/program.h"

namespace rad::calc {

// A function that the language itself provides. `arity` is the number of arguments that it needs. Further
// arguments are ignored, except by min, max and select, which take any number.
struct LibraryFunction {
  std::string_view name;
  Op op;
  int arity;
};

// The library function of this name, or null.
const LibraryFunction* findLibraryFunction(std::string_view name);

// The operation of one of the operators + - * /.
Op operatorOf(char c);

}  // namespace rad::calc
