#include "rad_parser/binary/octree_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>

#include "rad_parser/binary/binary_scene.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

constexpr std::string_view kFormat = "Radiance_octree";
constexpr std::string_view kFirst = "#?";  // the first characters of most information headers
constexpr int kOctreeMagic = 283;          // the format number minus the width of object numbers
constexpr size_t kBeginning = 1 << 16;

// The offset after the empty line that ends the header; npos if there is none.
size_t headerEnd(std::string_view data) {
  const size_t unix = data.find("\n\n"), dos = data.find("\n\r\n");
  if (unix == data.npos && dos == data.npos) return data.npos;
  return unix < dos ? unix + 2 : dos + 3;
}

// Reserves memory for the largest possible contents of the rest of a regular file, so that vertices of a
// large scene are not moved repeatedly. Pages that are never written take no memory.
void reserve(Description& d, int64_t objects, int width, uint64_t bytes) {
  // Bytes of the shortest object: type, modifier, empty name, and two counts.
  const uint64_t shortest = 6 + static_cast<uint64_t>(width);
  // Most numbers in a large scene are coordinates of polygons, of 5 bytes each.
  d.vertices.reserve((bytes - std::min(bytes, static_cast<uint64_t>(objects) * shortest)) / 15);
}

}  // namespace

std::string readBeginning(int descriptor) {
  std::string data;
  const auto enough = [&] {
    if (data.size() >= kBeginning) return true;
    if (!data.empty() && !isPrintable(data[0])) return true;
    const size_t end = headerEnd(data);
    return end != data.npos && data.size() >= end + 2;
  };
  while (!enough()) {
    const size_t before = data.size();
    data.resize(kBeginning);
    const ssize_t got = read(descriptor, data.data() + before, kBeginning - before);
    const bool interrupted = got < 0 && errno == EINTR;
    data.resize(before + static_cast<size_t>(std::max<ssize_t>(got, 0)));
    if (got <= 0 && !interrupted) break;
  }
  return data;
}

bool isOctree(std::string_view beginning, std::string_view name) {
  if (beginning.empty() || !isPrintable(beginning[0])) return false;
  const size_t end = headerEnd(beginning);
  const std::string_view header = beginning.substr(0, end);
  std::optional<std::string_view> format;
  for (const std::string_view line : split(header, "\n"))
    if (const auto named = headerFormat(line)) format = named;
  if (format == kFormat) return true;
  // A text file may contain an empty line, but not the magic number of an octree after it.
  bool hasNumber = false;
  if (end != beginning.npos && beginning.size() >= end + 2) {
    const int number = static_cast<uint8_t>(beginning[end]) << 8 | static_cast<uint8_t>(beginning[end + 1]);
    hasNumber = number > kOctreeMagic && number <= kOctreeMagic + 8;
  }
  if (format && (hasNumber || beginning.starts_with(kFirst)))
    throw Error(fmt::format("{}: not an octree: its header says FORMAT={}", printable(name, kLongestName),
                            printable(*format)));
  return hasNumber;
}

void readOctree(BinaryReader& input, uint32_t file, DescriptionBuilder& builder, const Warn& warn,
                const std::function<void(const std::string&)>& sceneFile) {
  Description& d = builder.description();
  d.files[file].numbered = true;
  BinaryReader::Header header = input.header();
  if (!header.format.empty() && header.format != kFormat) throw input.otherFormat(header.format);
  d.header = std::move(header.lines);
  const int width = readIndexWidth(input, kOctreeMagic);
  d.cube = readCube(input);
  bool frozen = true;
  for (std::string name; !(name = input.string()).empty(); frozen = false) sceneFile(name);
  const int64_t objects = input.integer(width);
  if (objects < 0 || objects > std::numeric_limits<int32_t>::max())
    throw input.fault(fmt::format("damaged octree: {} objects", objects));

  bool modifierInTree = false;
  const auto present = static_cast<int64_t>(d.primitives.size());
  passOverCells(input, width, [&](int64_t object) {
    if (object < 0 || object >= objects)
      throw input.fault(fmt::format("damaged octree: object {} of {}", object + 1, objects));
    if (object < present && !d.primitives.isSurface(PrimitiveId(object))) modifierInTree = true;
  });

  const auto stale = [&](std::string_view text) {
    return Error(fmt::format("{}: {}; octree stale?", printable(input.name(), kLongestName), text));
  };
  if (frozen) {
    reserve(d, objects, width, input.remaining());
    const int64_t found = readPrimitives(input, width, file, builder, warn);
    if (found != objects)
      throw input.fault(fmt::format("damaged octree: {} objects instead of {}", found, objects));
  } else if (present != objects) {
    throw stale(
        fmt::format("bad object count: {} in its scene files, {} when it was made", present, objects));
  } else if (modifierInTree) {
    throw stale("modifier in tree");
  }
}

}  // namespace rad
