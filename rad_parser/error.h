#pragma once
#include <cerrno>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "rad_parser/printable.h"

namespace rad {

// The exit status of a program that stops because of an error, as in rtrace(1).
enum class Status { input = 1, system = 2, signal = 3 };

// An error that stops the work. what() is one line that begins with the place of the error ("room.rad:12:
// undefined modifier "wall""), without the program's name and without a line end. It is printable regardless
// of the text (messageLine(), printable.h).
class Error : public std::runtime_error {
 public:
  explicit Error(std::string_view text, Status status = Status::input)
      : std::runtime_error(messageLine(text)), status_(status) {}
  Status status() const { return status_; }

 private:
  Status status_;
};

// The error of the last system call, which errno names: "TEXT: No such file or directory".
inline Error systemError(std::string_view text) {
  const char* const reason = std::strerror(errno);
  return Error(std::string(text) + ": " + reason, Status::system);
}

// Receives a warning: one line that begins with its place, without the program's name. It is called only from
// the thread that reads. An empty function ignores warnings.
using Warn = std::function<void(std::string_view)>;

}  // namespace rad
