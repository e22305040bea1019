#pragma once
#include <span>
#include <string>

#include "rad_parser/description.h"
#include "rad_parser/error.h"

namespace rad {

struct ReadOptions {
  bool commands = true;  // -Sc: whether '!command' lines may run through the shell (xform never needs it)
  Warn warn;
};

// Reads scene text, in the order given, into one description; a later file may use modifiers of an earlier one.
// A name that begins with '!' is a command whose output is read. Names are found as they stand, or along RAYPATH
// (see file_path.h) unless they begin with '/', './', '../' or '~'.
// Throws Error with its place: a file that cannot be opened (Status::system), anything the language does not allow.
// Source: RADIANCE reference manual, "Scene description"; oconv(1), xform(1).
Description readScene(std::span<const std::string> names, const ReadOptions& options = {});

}  // namespace rad
