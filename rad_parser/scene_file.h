#pragma once
#include <span>
#include <string>
#include <string_view>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "rad_parser/file_path.h"

namespace rad {

struct ReadOptions {
  bool commands = true;  // -Sc: whether '!command' lines may run through the shell (xform never needs it)
  Warn warn{};
  FileAccess files{};  // those that scene files may name; the names given to read first are not asked about
};

// Files and commands within each other beyond this are refused: a file that reads itself would never end.
inline constexpr int kDeepestNesting = 100;

// Reads scene text, in the order given, into one description; a later file may use modifiers of an earlier
// one. A name that begins with '!' is a command whose output is read. Names are found as they stand, or along
// RAYPATH (see file_path.h) unless they begin with '/', '.' or '~'.
//
// Commands. A plain xform command (no shell syntax, files named) is carried out here, with its files' own
// commands in turn: their arguments keep all digits where the program would round them to 12 (absorption to
// 6). Files are looked for along RAYPATH, and commands in them run in their file's directory unless -c is
// given. Every other command runs in /bin/sh with an empty standard input; its output is scene text, whose
// places name the command and count its own lines. A command that ends with a status other than 0 (127: the
// shell did not find it) is an error in a scene file, as is an xform that cannot be carried out: oconv(1)
// would go on without their surfaces. It is a warning, as in rtrace(1), where the command itself is the name
// given, and in the scene files of an octree that is not frozen. A file or command without any primitive is
// a warning.
//
// Throws Error with its place: a file that cannot be read or a command that cannot be started
// (Status::system), anything the language does not allow, commands where options forbid them, nesting beyond
// kDeepestNesting, NUL bytes, words of more than 65536 bytes. A modifier must be defined before its use; the
// last definition counts. Integer arguments must be 0 in number: no type has any. Memory is in proportion to
// the text read. Source: RADIANCE reference manual, "Scene description"; oconv(1), xform(1).
//
// A single name may be an octree, or a command whose output is one, which its content tells: it is read as
// readOctree() has it. One that is empty is refused where its name ends in ".oct" or it is a command's
// output.
Description readScene(std::span<const std::string> names, const ReadOptions& options = {});

// Reads an octree, frozen or not, of oconv(1). name is looked for along RAYPATH, as `instance` has it. Header
// and bounds are kept; the cells are passed over. Scene files that it names are opened as they stand, from
// the current directory, and its commands are subject to options. Throws Error: Status::system where a file
// cannot be found or read, Status::input for what is no octree, or is truncated, damaged or stale
// (octree_file.h). Real numbers of a frozen octree are within 2^-31 of themselves of those of the text; equal
// definitions of a modifier may have become one.
Description readOctree(const std::string& name, const ReadOptions& options = {});

// readScene() for one text in memory. name: as messages print it.
Description readSceneText(std::string_view text, std::string_view name, const ReadOptions& options = {});

}  // namespace rad
