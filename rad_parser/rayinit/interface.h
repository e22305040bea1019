#pragma once
#include "rad_parser/calc/library.h"
#include "rad_parser/file_path.h"
#include "rad_parser/rayinit/inputs.h"

// The names that every function file may use: the variables and functions of rtrace, and the definitions of
// its rayinit.cal. The renderer supplies the values of the variables and needs not know how they are used.
// Source: RADIANCE reference manual, "Function files"; the names in rayinit.cal.
namespace rad::calc {

// The inputs in the order of the enumeration, the functions of host_functions.h, and rayinit.cal: the file
// found along RAYPATH, otherwise kRayinit. access: the files that the scene may name, for the message about a
// function file that was not found.
Interface sceneInterface(const FileAccess& access = {});

// This program's own text of rayinit.cal.
extern const std::string_view kRayinit;

}  // namespace rad::calc
