#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "rad_parser/file_path.h"

namespace rad {

struct ReadOptions {
  bool commands = true;  // -Sc: whether lines '!command' may run in a shell; xform does not need a shell
  Warn warn{};
  FileAccess files{};  // files that scene files may name; the scene files themselves may be anywhere
};

// Limit on the nesting of files and commands, because a file that includes itself would never end.
inline constexpr int kDeepestNesting = 100;

// Reads scene text into a description. Files are read in the given order, so a file may use the modifiers of
// earlier ones. A name that begins with '!' is a command whose output is read. If a file with the given name
// exists, it is read; otherwise the name is searched along RAYPATH (file_path.h), unless it begins with '/',
// '.' or '~'.
//
// Commands. An xform command that names files and contains no shell syntax is executed in this process,
// together with the commands in its files. Arguments keep all digits, whereas the program xform rounds them
// to 12 digits, and absorption to 6. Its files are searched along RAYPATH, and commands in them run in the
// directory of their file unless -c is given. Any other command runs in /bin/sh with empty standard input;
// its output must be scene text, and places in it consist of the command and the line of output. If a command
// ends with a status other than 0 (127 if the shell does not find it), or an xform cannot be executed, this
// is an error, whereas oconv(1) would continue without its surfaces. It is only a warning, as in rtrace(1),
// in the scene files of an octree that is not frozen. A file or command without primitives causes a warning.
//
// Throws Error with its place
// - for a file that cannot be read, and for a command that cannot be started (Status::system);
// - for anything that the language does not allow, for NUL bytes, and for words of more than 65536 bytes;
// - for commands if the options forbid them;
// - for nesting deeper than kDeepestNesting.
// A modifier must be defined before it is used; its last definition before the use applies. The number of
// integer arguments must be 0, because no type has any. Memory is in proportion to the text. Source: RADIANCE
// reference manual, "Scene description"; oconv(1), xform(1).
//
// A single name may be an octree, or a command that writes one. Octrees are recognized by their contents and
// read by readOctree(). An empty file is an error if its name ends with ".oct"; so is a command without
// output.
Description readScene(std::span<const std::string> names, const ReadOptions& options = {});

// Reads an octree of oconv(1), frozen or not. name is searched along RAYPATH, as for the type instance.
// Header and bounds are stored, cells are not. The scene files named in the octree are opened relative to the
// current directory, and their commands are subject to the options. Throws Error with Status::system if a
// file cannot be found or read, and with Status::input if the file is not an octree, or is truncated, damaged
// or stale (octree_file.h). Real numbers of a frozen octree differ from those of the text by a relative error
// of at most 2^-31. Equal definitions of a modifier may have been merged.
Description readOctree(const std::string& name, const ReadOptions& options = {});

// readScene() for text in memory. name: for messages.
Description readSceneText(std::string_view text, std::string_view name, const ReadOptions& options = {});

// The path of a file of this relative name in the folder of the scene file at `place`; for the output of a
// command, of the file with the command. Begins with '/' or '.', so that findFile() uses it as it is. Empty
// if `access` allows no such file, and for a command that no file contains. RADIANCE does not look there: use
// it for files that are not found along RAYPATH.
std::optional<std::string> fileBeside(const Description& description, Place place, std::string_view name,
                                      const FileAccess& access);

// The path of a file that a primitive names: found along RAYPATH, or else beside the scene file.
std::optional<std::string> findNamedFile(const Description& description, Place place, std::string_view name,
                                         const FileAccess& access);
// The name by which findFile() finds it: the given one, unless it is found only beside the scene file.
std::string nameOfFile(const Description& description, Place place, std::string_view name,
                       const FileAccess& access);

}  // namespace rad
