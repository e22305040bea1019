#pragma once
#include <vector>

#include "rad_parser/calc/program.h"

namespace rad::calc {

// The functions that rtrace adds to the language: source_corr(value, kind), source_theta(any) and
// source_phi(symmetry) of ies2rad's luminaires, and fprism_val(value, which, rank) of prism panels.
std::vector<HostFunction> sceneHostFunctions();

}  // namespace rad::calc
