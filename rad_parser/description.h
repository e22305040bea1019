#pragma once
#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
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

// A file or command that was read. name: for messages ("room.rad", "!genbox w b 1 2 3"). from: the place in
// another file that named it; from.file is kNoFile if no file did.
struct SourceFile {
  static constexpr uint32_t kNoFile = std::numeric_limits<uint32_t>::max();
  std::string name;
  Place from{kNoFile, 0};
  bool numbered = false;  // true for octrees and meshes, whose places are numbers of primitives
};

// A cube with edges parallel to the axes, in units of the scene.
struct Cube {
  std::array<double, 3> origin{};  // the corner with the smallest coordinates
  double size = 0;                 // length of an edge
};

// The contents of the scene files in their order, as plain values. Files that arguments name have not been
// looked up. Nothing has been computed, except that the transforms of xform commands that were executed in
// this process have been applied to the arguments.
struct Description {
  std::vector<SourceFile> files;
  PrimitiveList primitives;
  std::vector<std::string> words;    // string arguments and names of modifiers, each distinct word once
  std::vector<uint32_t> stringArgs;  // indices in words
  std::vector<double> realArgs;      // of all primitives but polygons
  std::vector<Imath::V3d> vertices;  // the real arguments of polygons, in threes; a last incomplete three
                                     // is filled with zeros

  // Of an octree: the lines of its information header, except those that name the format.
  std::vector<std::string> header;
  std::optional<Cube> cube;  // of an octree: its bounds, which should contain all surfaces except sources

  std::string_view string(const Primitive& p, size_t i) const { return words[stringArgs[p.firstString + i]]; }
  // Empty for a polygon whose vertices have been moved elsewhere.
  std::span<const double> reals(const Primitive& p) const;
  std::span<double> reals(const Primitive& p);

  // The place as text for messages, "room.rad:12", or "scene.oct: object 12" in a numbered file. It is
  // followed by the files that led there, if any, the nearest first: "leg.rad:3 (from desk.rad:7,
  // room.rad:12)". Long commands and long chains are shortened. Always one line.
  std::string at(Place place) const;
};

// Appends the files, words and primitives of another description; their numbers follow those that are there.
// from: the place that named the other description. Header and cube of `to` are unchanged. A word that both
// descriptions contain occurs twice afterwards. Throws Error if there are more than can be numbered.
void append(Description& to, Description&& more, Place from);

// Finds the modifiers that string arguments name (of mixtures, mirror, illum, antimatter). The description
// may change afterwards.
class ModifierIndex {
 public:
  // Indexes the primitives from primitives[first] on.
  explicit ModifierIndex(const Description& description, size_t first = 0);

  // The last modifier of this name that is defined before primitives[index], which is the one that the name
  // refers to there. kVoid if there is none, and for "void". Takes logarithmic time in the number of
  // definitions of the name.
  PrimitiveId before(std::string_view name, PrimitiveId index) const;

  // The nearest modifier that is defined before primitives[index], or void, as the end of a message (see
  // NearestName::hint()). Takes time in proportion to the number of modifiers.
  std::string nearest(std::string_view name, PrimitiveId index) const;

 private:
  std::map<std::string, std::vector<PrimitiveId>, std::less<>> definitions_;
};

// The byte order mark, which some editors write at the beginning of UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace rad
