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

namespace rad {

// Where a thing stands: a file of Description::files and a line in it, from 1. Piped input counts its own
// lines. In a numbered file, which has no lines, `line` is the primitive's number, from 1. 0 is the file as a
// whole.
struct Place {
  uint32_t file = 0;
  uint32_t line = 0;
};

// Every primitive type of the scene language (RADIANCE reference manual, "Scene description"). The order is
// ours.
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

// The name as scene files spell it ("BRTDfunc").
std::string_view typeName(Type type);

// The type of that name, as spelled; false, and `type` untouched, where there is none.
bool findType(std::string_view name, Type& type);

bool isSurface(Type type);   // source .. mesh: everything else is a modifier, and can be named by others
bool isMaterial(Type type);  // light .. antimatter
bool isTexture(Type type);
bool isPattern(Type type);
bool isMixture(Type type);

inline constexpr int32_t kVoid = -1;  // the modifier that is none

// One primitive as the file has it. Arguments are kept as written: their number and meaning are checked by
// who uses them (a primitive that no surface uses is never looked at).
//
// An alias stands for a copy of primitives[aliased] whose modifier is `modifier`: whoever meets an alias
// takes type and arguments from `aliased` and goes on with the alias's own `modifier`, never with that of
// `aliased`. All the language's cases are resolved to this when read:
//   M alias a b        modifier is M's index (kVoid for void)
//   inherit alias a b  modifier is that of b
// and where b is an alias itself, `aliased` is what b stands for, so that it is never an alias. strings is 1:
// the reference b as written.
struct Primitive {
  Type type = Type::alias;
  int32_t modifier =
      kVoid;  // index in Description::primitives, always less than the primitive's own; kVoid for void
  int32_t aliased = kVoid;  // type alias only: index of the primitive that this one is another name for
  Place place;              // of the primitive's first word
  uint32_t name = 0;        // index in Description::words
  uint32_t firstString = 0, strings = 0;  // range in Description::stringArgs
  uint32_t reals = 0;                     // number of real arguments
  uint64_t firstReal = 0;                 // their begin in Description::realArgs
};

// A file (or command) that was read. name: as messages print it ("room.rad", "!genbox w b 1 2 3"). from: the
// place that named it, where a file did; else from.file is kNoFile.
struct SourceFile {
  static constexpr uint32_t kNoFile = std::numeric_limits<uint32_t>::max();
  std::string name;
  Place from{kNoFile, 0};
  bool numbered = false;  // an octree or a mesh: its places are numbers of primitives
};

// A cube along the axes, in units of the scene.
struct Cube {
  std::array<double, 3> origin{};  // its lowest corner
  double size = 0;                 // length of an edge
};

// A scene as its files say it, in their order: plain values, nothing looked up outside, nothing computed but
// the transforms of in-process xform commands, which are applied to the arguments.
struct Description {
  std::vector<SourceFile> files;
  std::vector<Primitive> primitives;
  std::vector<std::string>
      words;  // names and string arguments: each distinct one once, but for surfaces' names
  std::vector<uint32_t> stringArgs;  // indices in words
  std::vector<double> realArgs;

  std::vector<std::string>
      header;                // of an octree: its information header's lines, but those that name the format
  std::optional<Cube> cube;  // of an octree: its bounds, which are to hold all surfaces but sources

  std::string_view name(const Primitive& p) const { return words[p.name]; }
  std::string_view string(const Primitive& p, size_t i) const { return words[stringArgs[p.firstString + i]]; }
  std::span<const double> reals(const Primitive& p) const {
    return std::span<const double>(realArgs).subspan(p.firstReal, p.reals);
  }

  // "room.rad:12", with the files that led there where there are any, the nearest first:
  // "leg.rad:3 (from desk.rad:7, room.rad:12)". "scene.oct: object 12" in a numbered file. Long commands and
  // chains are cut. One line, always.
  std::string at(Place place) const;
};

// Appends the files, words and primitives of another description, numbered on from those there are; from:
// the place that named it. Header and cube stay as they are. A word that both have is there twice. Throws
// Error where there are more than can be numbered.
void append(Description& to, Description&& more, Place from);

// Finds the modifiers that string arguments name (mixtures, mirror, illum, antimatter). The description must
// outlive the index and keep its words and primitives.
class ModifierIndex {
 public:
  // Of the primitives from primitives[first] on.
  explicit ModifierIndex(const Description& description, size_t first = 0);

  // The last modifier of that name defined before primitives[index], which is what the name means there;
  // kVoid where there is none ("void" itself never names one). Logarithmic in the number of definitions of
  // the name.
  int32_t before(std::string_view name, int32_t index) const;

 private:
  std::unordered_map<std::string_view, std::vector<int32_t>> definitions_;
};

// The text made fit for a message of one line: control characters replaced, and cut after `longest` bytes,
// with "..." in place of the rest.
std::string printable(std::string_view text, size_t longest = 80);

// Whether a character is one of ASCII that prints, a blank included.
inline bool isPrintable(char c) { return c >= ' ' && c <= '~'; }

// What editors put at the beginning of UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace rad
