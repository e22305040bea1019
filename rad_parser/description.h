#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rad_parser/id.h"

namespace rad {

// A place in the scene files: an index of Description::files and a line, from 1; line 0 means the file as a
// whole. The output of a command has lines of its own. In a numbered file, which has no lines, `line` is the
// number of a primitive, from 1.
struct Place {
  uint32_t file = 0;
  uint32_t line = 0;
};

// The primitive types of the scene language (RADIANCE reference manual, "Scene description"), grouped for
// isSurface() and the functions after it.
// clang-format off
enum class Type : uint8_t {
  // surfaces
  source, sphere, bubble, polygon, cone, cup, cylinder, tube, ring, instance, mesh,
  // materials
  light, illum, glow, spotlight, mirror, prism1, prism2, mist, plastic, metal, trans, plastic2, metal2, trans2,
  ashik2, dielectric, interface, glass, plasfunc, metfunc, transfunc, brtdfunc, plasdata, metdata, transdata, bsdf,
  absdf, wgmdfunc, antimatter,
  // textures
  texfunc, texdata,
  // patterns
  colorfunc, brightfunc, specfunc, colordata, brightdata, specdata, colorpict, brighttext, colortext, spectrum,
  specfile, specpict,
  // mixtures
  mixfunc, mixdata, mixpict, mixtext,
  // another name for a modifier
  alias,
};
// clang-format on
inline constexpr int kTypes = static_cast<int>(Type::alias) + 1;

// The name of a type as scene files spell it ("BRTDfunc").
std::string_view typeName(Type type);

// Finds the type of this name, which must be spelled exactly. Returns false, and leaves `type`
// unchanged, if there is none.
bool findType(std::string_view name, Type& type);

// The nearest type of a misspelt name, as the end of a message (see NearestName::hint()).
std::string nearestType(std::string_view name);

bool isSurface(Type type);   // source .. mesh; all other types are modifiers, which others can name
bool isMaterial(Type type);  // light .. antimatter
bool isTexture(Type type);
bool isPattern(Type type);
bool isMixture(Type type);

using PrimitiveId = Id<struct PrimitiveTag>;  // index in Description::primitives

inline constexpr None kVoid;  // in place of a modifier: none

// One primitive as the file describes it. Arguments are kept as written. Whoever uses the primitive checks
// their number and meaning; a primitive that no surface uses is never checked.
//
// An alias is a copy of primitives[aliased] with a different modifier: its type and arguments are those of
// `aliased`, and its modifier is the alias's own `modifier`, never that of `aliased`. All forms of aliases
// are reduced to this when they are read:
//   M alias a b        `modifier` is the index of M (kVoid for void)
//   inherit alias a b  `modifier` is that of b
// If b is an alias itself, `aliased` is that of b, so it is never the index of an alias. An alias has one
// string argument: the name b as written.
struct Primitive {
  Type type = Type::alias;
  PrimitiveId modifier;                   // always before this primitive; kVoid for void
  PrimitiveId aliased;                    // of type alias only
  Place place;                            // of the primitive's first word
  uint32_t name = 0;                      // index in Description::words
  uint32_t firstString = 0, strings = 0;  // range in Description::stringArgs
  uint32_t reals = 0;                     // number of real arguments
  uint64_t firstReal = 0;                 // index of the first one in Description::realArgs
};

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
  ById<PrimitiveId, Primitive> primitives;
  // Names and string arguments. Each distinct word occurs once, except names of
  // surfaces, which may occur again.
  std::vector<std::string> words;
  std::vector<uint32_t> stringArgs;  // indices in words
  std::vector<double> realArgs;

  // Of an octree: the lines of its information header, except those that name the format.
  std::vector<std::string> header;
  std::optional<Cube> cube;  // of an octree: its bounds, which should contain all surfaces except sources

  std::string_view name(const Primitive& p) const { return words[p.name]; }
  std::string_view string(const Primitive& p, size_t i) const { return words[stringArgs[p.firstString + i]]; }
  std::span<const double> reals(const Primitive& p) const {
    return std::span<const double>(realArgs).subspan(p.firstReal, p.reals);
  }

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
// must outlive the index, and must keep its words and primitives.
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
  std::unordered_map<std::string_view, std::vector<PrimitiveId>> definitions_;
};

// The text on one line, for messages: control characters are replaced, and text beyond `longest`
// bytes is replaced by "...".
std::string printable(std::string_view text, size_t longest = 80);

// Whether a character is a printable ASCII character or a blank.
inline bool isPrintable(char c) { return c >= ' ' && c <= '~'; }

// The byte order mark, which some editors write at the beginning of UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace rad
