#pragma once
#include <optional>
#include <string_view>

#include "rad_parser/calc/library.h"
#include "rad_parser/file_path.h"
#include "rad_parser/rayinit/inputs.h"

// The names available to every function file: variables and functions of rtrace, and the definitions of its
// rayinit.cal. The renderer supplies the values of the variables. Source: RADIANCE reference manual,
// "Function files"; the names in rayinit.cal.
namespace rad::calc {

// The inputs in the order of the enumeration; the functions that rtrace adds to the language:
// source_corr(value, kind), source_theta(any) and source_phi(symmetry) of ies2rad's luminaires, and
// fprism_val(value, which, rank) of prism panels; and rayinit.cal: the file found along RAYPATH, or else
// the built-in one. access: the files that the scene may name, for messages about missing function files.
Interface sceneInterface(const FileAccess& access = {});

// The text of a function file in this program, which is used if no such file is found: rayinit.cal, and those
// for bins of rcontrib: reinhart.cal, reinhartb.cal, tregenza.cal, klems_full.cal, klems_half.cal,
// klems_quarter.cal. Empty for other names.
std::optional<std::string_view> builtInFile(std::string_view name);

}  // namespace rad::calc
