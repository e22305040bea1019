#pragma once
#include <stdexcept>
#include <string>

#include "rsphere/version.h"

namespace RSPHERE_API_NAMESPACE {

// Thrown by every function of the library that fails; besides it, only std::bad_alloc is thrown. what() is
// the line that the command rsphere prints, without the program's name. It begins with the place if there is
// one:
//   room.rad:12: undefined modifier "wall"
class RSPHERE_API Error : public std::runtime_error {
 public:
  // input: the scene, the options or the records; status 1 of the command. system: a file cannot be opened,
  // memory or threads are short; status 2. stopped: Options::stop has returned true.
  enum class Cause { input, system, stopped };

  Error(const std::string& text, Cause cause);
  ~Error() override;

  Cause cause() const { return cause_; }
  // The file that the message begins with, and the line in it, from 1; 0 for a file that cannot be opened.
  // Empty and 0 if the message names no place.
  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  Cause cause_;
  std::string file_;
  int line_ = 0;
};

}  // namespace RSPHERE_API_NAMESPACE
