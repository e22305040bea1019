#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "rad_parser/id.h"

namespace rad {

// A place in the scene files: an index of Description::files and a line, from 1; line 0 is the file as a
// whole. Lines of a command are those of its output. In a numbered file, which has no lines, `line` is the
// number of a primitive, from 1.
struct Place {
  uint32_t file = 0;
  uint32_t line = 0;
};

// The primitive types of the scene language (RADIANCE reference manual, "Scene description"). isSurface(),
// isMixture() and xform rely on the groups. clang-format off
enum class Type : uint8_t {
  // surfaces
  source, sphere, bubble, polygon, cone, cup, cylinder, tube, ring, instance, mesh,
  // materials
  light, illum, glow, spotlight, mirror, prism1, prism2, mist, plastic, metal, trans, plastic2, metal2,
  trans2, ashik2, dielectric, interface, glass, plasfunc, metfunc, transfunc, brtdfunc, plasdata, metdata,
  transdata, bsdf, absdf, wgmdfunc, antimatter,
  // textures
  texfunc, texdata,
  // patterns
  colorfunc, brightfunc, specfunc, colordata, brightdata, specdata, colorpict, brighttext, colortext,
  spectrum, specfile, specpict,
  // mixtures
  mixfunc, mixdata, mixpict, mixtext,
  // another name for a modifier
  alias,
};
// clang-format on
inline constexpr int kTypes = static_cast<int>(Type::alias) + 1;

// The name of a type as spelled in scene files ("BRTDfunc").
std::string_view typeName(Type type);

// Finds the type of this name, in exact spelling. Returns false, and leaves `type` unchanged, if there is
// none.
bool findType(std::string_view name, Type& type);

// The most similar type for a misspelt name, as the end of a message (see NearestName::hint()).
std::string nearestType(std::string_view name);

// Surfaces come first in the enumeration. All other types are modifiers, which other primitives can name.
inline bool isSurface(Type type) { return type <= Type::mesh; }
inline bool isMixture(Type type) { return Type::mixfunc <= type && type <= Type::mixtext; }

using PrimitiveId = Id<struct PrimitiveTag>;  // index in Description::primitives

inline constexpr None kVoid;  // used instead of a modifier: none

// One primitive as the file describes it, with unconverted arguments. Their number and meaning are checked
// when the primitive is used; a primitive that no surface uses is never checked.
//
// An alias is a copy of primitives[aliased] with a different modifier: it has the type and arguments of
// `aliased`, but its own `modifier`. All forms of aliases are reduced to this when they are read:
//   M alias a b        `modifier` is the index of M (kVoid for void)
//   inherit alias a b  `modifier` is that of b
// If b itself is an alias, its `aliased` is used, so that `aliased` never refers to an alias. An alias has
// one string argument: the name b as written.
struct Primitive {
  Type type = Type::alias;
  PrimitiveId modifier;                   // precedes this primitive; kVoid for void
  PrimitiveId aliased;                    // of type alias only
  Place place;                            // of the primitive's first word
  uint32_t firstString = 0, strings = 0;  // range in Description::stringArgs
  uint32_t reals = 0;                     // number of real arguments
  uint64_t firstReal = 0;                 // index of the first one in Description::realArgs; for a polygon,
                                          // of the first vertex in Description::vertices
  std::string name;
};

}  // namespace rad
