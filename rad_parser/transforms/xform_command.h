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
#include "rad_parser/transforms/xform.h"

namespace rad {

// The words of a command, if a shell would pass them unchanged: the command contains none of
// |&;<>()$`\*?[]{}!, quotes only in pairs, and a comment (#) only at its end. Empty if the command needs a
// shell.
std::optional<std::vector<std::string>> plainWords(std::string_view command);

// One pass of xform over its files.
struct XformPass {
  Transform transform;
  std::vector<std::string> files;  // as given
  bool changesDirectory = true;    // whether commands in the files run in the directories of the files
                                   // (without -c)
};

// An error of an xform command. what() begins with "xform: ". The caller adds the place of the command.
class XformFault : public Error {
 public:
  using Error::Error;
};

// Calls `pass` for each pass of an xform command, in order: there is one pass, or one for each element of its
// arrays (-a) and each line of its argument files (-f). words: of the command, beginning with "xform".
// directory: names of argument files are relative to it. Throws XformFault
//   - for errors that xform(1) reports,
//   - for standard input instead of a file ("-f -", or no file named),
//   - for argument files that `access` does not allow,
//   - for more than kMostPasses passes; if an array has that many, before its first pass.
// Exceptions thrown by `pass` are passed on.
void forEachPass(std::span<const std::string> words, const std::string& directory, const FileAccess& access,
                 const std::function<void(const XformPass&)>& pass);

// Limit on the passes of a command and of a scene. Each pass reads its files again, so that more passes would
// take many minutes, and gigabytes even if a file has only one surface.
inline constexpr int64_t kMostPasses = 10'000'000;

// The error if there are more passes.
XformFault tooMany();

// The number of copies of its files that the arrays (-a) of a command make: the product of their counts.
// Counts that forEachPass() rejects are ignored. Throws XformFault, before anything is copied, if the product
// times `outside` is above kMostPasses. outside: number of copies of this command that enclosing commands
// make.
int64_t copiesOfArrays(std::span<const std::string> words, int64_t outside = 1);

}  // namespace rad
