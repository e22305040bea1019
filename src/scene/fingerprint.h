#pragma once
#include <bit>
#include <cstdint>
#include <string_view>

#include "scene/random.h"
#include "scene/scene.h"

namespace rsphere {

// 64 bits that tell values in their order from others; the same on every machine of its byte order.
class Fingerprint {
 public:
  void add(uint64_t x) { value_ = mixBits(value_ ^ x); }
  void add(double x) { add(std::bit_cast<uint64_t>(x)); }
  void add(std::string_view text);
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0;
};

// Of the contents of a file that is found along RAYPATH, or that there is none.
void addFile(Fingerprint& print, std::string_view name, const rad::FileAccess& access = {});

// Of all that the light in a scene follows from: its description with octrees and meshes, and the contents of
// files that its modifiers may name. Reads these. Where things stand in the files does not count.
uint64_t fingerprint(const Scene& scene);

}  // namespace rsphere
