#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"
#include "rad_parser/file_path.h"
#include "rad_parser/xform.h"

namespace rad {

// The words of a command, if a shell would pass them on unchanged: the command contains none
// of |&;<>()$`\*?[]{}!, quotes only in pairs, and a comment (#) only at its end. Empty if
// the command needs a shell.
std::optional<std::vector<std::string>> plainWords(std::string_view command);

// One pass of xform over its files.
struct XformPass {
  Transform transform;
  std::vector<std::string> files;  // as named
  bool changesDirectory = true;    // commands in the files run in the files' directories (not with -c)
};

// A fault of an xform command. what() begins with "xform: ". The caller adds the place of the command.
class XformFault : public Error {
 public:
  using Error::Error;
};

// Calls `pass` for each pass that an xform command makes, in order: one pass, or one for each element of its
// arrays (-a) and for each line of its argument files (-f). words: the command's, "xform" first. directory:
// the directory that names of argument files are relative to. Throws XformFault
//   - for errors that xform(1) reports,
//   - for standard input in place of a file ("-f -", or no file named),
//   - for argument files that `access` does not allow,
//   - for more than kMostPasses passes, before the first of an array with more.
// Exceptions of `pass` are passed on.
void forEachPass(std::span<const std::string> words, const std::string& directory, const FileAccess& access,
                 const std::function<void(const XformPass&)>& pass);

// Limit on the passes of a command and of a scene. Each reads its files again: more would take many minutes,
// and gigabytes even where a file has one surface.
inline constexpr int64_t kMostPasses = 10'000'000;

// The fault of more.
XformFault tooMany();

// The number of copies that the arrays (-a) of a command make of its files: the product of their counts.
// Counts that forEachPass() refuses are left out. Throws XformFault if the product times `outside`, the
// copies that the commands around it make of this command, is above kMostPasses: before anything is copied.
int64_t copiesOfArrays(std::span<const std::string> words, int64_t outside = 1);

}  // namespace rad
