// Reads octrees of any bytes. The result is a consistent description or rad::Error, never a crash, a hang, or
// more memory than the bytes justify. Scene files that an octree names are not opened.
#include <cstdlib>

#include "memory_file.h"
#include "rad_parser/binary/octree_file.h"

// Whether the real arguments are there.
static bool isWithin(const rad::Description& d, const rad::Primitive& p) {
  if (p.type == rad::Type::polygon) return p.firstReal + (p.reals + 2) / 3 <= d.vertices.size();
  return p.firstReal + p.reals <= d.realArgs.size();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const MemoryFile file(data, size);
  rad::DescriptionBuilder builder;
  const uint32_t index = builder.addFile("fuzz.oct");
  try {
    const std::string ahead = rad::readBeginning(file.descriptor());
    if (!rad::isOctree(ahead, "fuzz.oct")) return 0;
    rad::BinaryReader input(file.descriptor(), "fuzz.oct", "octree", ahead);
    rad::readOctree(input, index, builder, {}, [](const std::string&) {});
  } catch (const rad::Error&) {
    return 0;
  }
  const rad::Description d = builder.take();
  for (const rad::PrimitiveId i : d.primitives.ids()) {
    const rad::Primitive p = d.primitives[i];
    const bool whole = p.modifier < i && isWithin(d, p) && p.firstString + p.strings <= d.stringArgs.size() &&
                       (p.type == rad::Type::alias) == (p.aliased != rad::kVoid);
    if (!whole) std::abort();
  }
  return 0;
}
