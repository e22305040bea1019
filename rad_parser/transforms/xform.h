#pragma once
#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/description_builder.h"

namespace rad {

using Imath::V3d;

// A similarity transform p -> p * matrix, for row vectors; the translation is in matrix[3][0..2]. scale:
// factor on lengths; negative for a mirroring transform.
struct Similarity {
  Imath::M44d matrix;
  double scale = 1;

  V3d point(const V3d& p) const;
  V3d vector(const V3d& v) const;
  Similarity inverse() const;
};

// The transform that applies a first, then b.
Similarity operator*(const Similarity& a, const Similarity& b);

// Reads a transform from options such as "-t 1 0 0 -rz 90 -s 2 -mx -i 3", which are applied in order. Stops
// at the first word that is not part of a valid option; `used` becomes the number of words before it.
// Malformed options ("-t 1 0", "-s 0") also end it, so the caller must reject remaining words. Primitives
// with function files, instances and meshes contain their transforms in this form, after their string
// arguments. Source: xform(1), OPTIONS.
Similarity readTransform(std::span<const std::string_view> words, size_t& used);

// The changes that an xform command, or several nested ones, make to primitives.
struct Transform {
  Similarity similarity;                // of all nested commands
  bool reversed = false;                // whether the order of vertices of polygons is reversed
  bool inverted = false;                // whether surfaces face the opposite side (-I)
  std::string prefix;                   // for names of surfaces, "outer.inner"; may be empty
  std::optional<std::string> modifier;  // replaces the modifiers of surfaces (-m)
  // Words appended to the string arguments of instances, meshes and primitives with function files.
  std::vector<std::string> arguments;

  // The new type of a primitive. -I exchanges sphere and bubble, cone and cup, cylinder and tube.
  Type typeOf(Type type) const;
  // The new name of a primitive. If it differs from `written`, it is stored in `buffer`.
  std::string_view nameOf(Type type, std::string_view written, std::string& buffer) const;

  // Transforms the arguments of the primitive begun last, by the rules of xform(1) for its type:
  // - points, vectors and radii of surfaces, texts and spotlights;
  // - the radius of effect of a glow;
  // - the absorption along a length of dielectric, interface and mist;
  // - the names of the sources of mist.
  // Other types are unchanged, or get `arguments`. Throws Error with the place of the primitive if arguments
  // are missing that its type needs, or if a result is not a finite number.
  void apply(Primitive& p, DescriptionBuilder& builder) const;
};

// The transform that applies inner first, then outer.
Transform within(const Transform& outer, const Transform& inner);

}  // namespace rad
