#pragma once
#include <stdexcept>
#include <string>

#include "rsphere/version.h"

namespace RSPHERE_API_NAMESPACE {

// Thrown if a function of the library fails. The only other exception is std::bad_alloc. what() is the line
// printed by the command rsphere, without the program's name. It begins with the place of the error, if there
// is one:
//   room.rad:12: undefined modifier "wall"
class RSPHERE_API Error : public std::runtime_error {
 public:
  // input: an error in the scene, the options or the records; exit status 1 of the command. system: a file
  // cannot be opened, or memory or threads are insufficient; exit status 2. stopped: Options::stop returned
  // true.
  enum class Cause { input, system, stopped };

  Error(const std::string& text, Cause cause);
  ~Error() override;

  Cause cause() const { return cause_; }
  // The file named at the beginning of the message, and the number of the line in this file, from 1. The line
  // is 0 if the file cannot be opened. If the message names no place, the file is empty and the line 0.
  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  Cause cause_;
  std::string file_;
  int line_ = 0;
};

}  // namespace RSPHERE_API_NAMESPACE
