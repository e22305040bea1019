#pragma once
#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/primitive.h"
#include "rad_parser/primitive_list.h"

namespace rad {

// A file or command that was read. name: for messages ("room.rad", "!genbox w b 1 2 3"). from: its place in
// the file that named it; from.file is kNoFile if no file named it.
struct SourceFile {
  static constexpr uint32_t kNoFile = std::numeric_limits<uint32_t>::max();
  std::string name;
  Place from{kNoFile, 0};
  bool numbered = false;  // true for octrees and meshes, in which places are numbers of primitives
};

// A cube with edges parallel to the axes, in units of the scene.
struct Cube {
  std::array<double, 3> origin{};  // the corner with the smallest coordinates
  double size = 0;                 // length of an edge
};

// The contents of the scene files in their order, as plain values. Files named in arguments have not been
// looked up. Nothing has been computed, except that xform commands executed in this process have transformed
// arguments.
struct Description {
  std::vector<SourceFile> files;
  PrimitiveList primitives;
  // String arguments and names of modifiers; each distinct word is stored once. Views of a word remain valid
  // if words are added or the description is moved.
  std::deque<std::string> words;
  std::vector<uint32_t> stringArgs;  // indices in words
  std::vector<double> realArgs;      // of all primitives except polygons
  std::vector<Imath::V3d> vertices;  // the real arguments of polygons, in threes; a last incomplete three
                                     // is filled with zeros

  // For an octree: the lines of its information header, except FORMAT lines.
  std::vector<std::string> header;
  std::optional<Cube> cube;  // for an octree: its bounds, which should contain all surfaces except sources

  std::string_view string(const Primitive& p, size_t i) const { return words[stringArgs[p.firstString + i]]; }
  // Empty for a polygon whose vertices have been moved elsewhere.
  std::span<const double> reals(const Primitive& p) const;
  std::span<double> reals(const Primitive& p);

  // The place as text for messages, "room.rad:12", or "scene.oct: object 12" in a numbered file, followed by
  // the chain of files that led there, nearest first: "leg.rad:3 (from desk.rad:7, room.rad:12)". Long
  // commands and long chains are shortened. Always one line.
  std::string at(Place place) const;
};

// Appends the files, words and primitives of another description, which get the next numbers. from: the place
// that named the other description. Header and cube of `to` are unchanged. A word that both
// descriptions contain is stored twice afterwards. Throws Error if there are too many to be numbered.
void append(Description& to, Description&& more, Place from);

// Finds modifiers named in string arguments (of mixtures, mirror, illum, antimatter). The description may
// change afterwards.
class ModifierIndex {
 public:
  // Indexes all primitives starting with primitives[first].
  explicit ModifierIndex(const Description& description, size_t first = 0);

  // The last modifier of this name that is defined before primitives[index]; this is the one to which the
  // name refers there. kVoid if there is none, and for "void". The time is logarithmic in the number of
  // definitions of the name.
  PrimitiveId before(std::string_view name, PrimitiveId index) const;

  // The most similar modifier that is defined before primitives[index], or void, as the end of a message (see
  // NearestName::hint()). The time is proportional to the number of modifiers.
  std::string nearest(std::string_view name, PrimitiveId index) const;

 private:
  std::map<std::string, std::vector<PrimitiveId>, std::less<>> definitions_;
};

// The byte order mark that some editors write at the beginning of UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Whether text begins with a byte order mark of UTF-16, which Windows PowerShell writes with `>`.
inline bool isUtf16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}
inline constexpr std::string_view kUtf16 =
    "the text is in UTF-16; convert it to UTF-8: iconv -f UTF-16 -t UTF-8";

}  // namespace rad
