#pragma once
#include <memory>

#include "rad_parser/calc/expand.h"
#include "rad_parser/calc/program.h"

namespace rad::calc {

// The code of expanded expressions: the second step of making a program. Throws the Error of an operation
// Op::fail that every evaluation would reach.
std::shared_ptr<const Program> writeProgram(Expansion expansion);

}  // namespace rad::calc
