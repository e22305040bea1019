#pragma once
#include <memory>

#include "rad_parser/calc/expand.h"
#include "rad_parser/calc/program.h"

namespace rad::calc {

// Writes the code of expanded expressions: the second step of making a program. Throws the Error of an
// operation Op::fail if every evaluation would reach it.
std::shared_ptr<const Program> writeProgram(Expansion expansion);

}  // namespace rad::calc
