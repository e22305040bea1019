#pragma once
#include <bit>
#include <cstdint>
#include <string_view>

#include "base/random.h"
#include "scene/scene.h"

namespace rsphere {

// A 64-bit hash of a sequence of values and their order. It is equal on all machines that have the same byte
// order.
class Fingerprint {
 public:
  void add(uint64_t x) { value_ = mixBits(value_ ^ x); }
  void add(double x) { add(std::bit_cast<uint64_t>(x)); }
  void add(std::string_view text);
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0;
};

// Adds the contents of a file on RAYPATH, or the fact that it does not exist.
void addFile(Fingerprint& print, std::string_view name, const rad::FileAccess& access = {});

// A hash of everything that determines the light in a scene: its description, its octrees and meshes, and the
// contents of the files that its modifiers may name, which are read here. Line numbers are excluded.
uint64_t fingerprint(const Scene& scene);

}  // namespace rsphere
