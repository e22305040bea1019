#pragma once
#include <functional>
#include <utility>

namespace rsphere {

// Lets the work of a thread be abandoned. While an object of this class exists, its function is called again
// and again by what takes long on this thread: before each path, and before each ray of a gather at the first
// diffuse surface of a path. It may throw to abandon the work, as for a signal; what it throws passes.
// The latest object on a thread counts.
class StopCheck {
 public:
  explicit StopCheck(std::function<void()> check) : check_(std::move(check)), before_(current_) {
    current_ = this;
  }
  ~StopCheck() { current_ = before_; }
  StopCheck(const StopCheck&) = delete;
  StopCheck& operator=(const StopCheck&) = delete;

  static void here() {
    if (current_) current_->check_();
  }

 private:
  std::function<void()> check_;
  const StopCheck* before_;
  static inline thread_local const StopCheck* current_ = nullptr;
};

}  // namespace rsphere
