#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rad {

// Exit status of a program that stops for this reason, as rtrace(1) has them.
enum class Status { input = 1, system = 2, signal = 3 };

// A fault that stops the work: what() is one line that begins with its place ("room.rad:12: undefined
// modifier "wall""), without the program's name and without a line end.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& text, Status status = Status::input)
      : std::runtime_error(text), status_(status) {}
  Status status() const { return status_; }

 private:
  Status status_;
};

// Receives a warning: one line with its place, without the program's name. May be called from the thread that
// reads only. An empty function drops warnings.
using Warn = std::function<void(std::string_view)>;

}  // namespace rad
