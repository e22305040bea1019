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

// A transform without distortion: p -> p * matrix, for row vectors (the translation is matrix[3][0..2]).
// scale is its factor for lengths, negative where it mirrors.
struct Similarity {
  Imath::M44d matrix;
  double scale = 1;

  V3d point(const V3d& p) const;
  V3d vector(const V3d& v) const;
  Similarity inverse() const;
};

// a, then b.
Similarity operator*(const Similarity& a, const Similarity& b);

// The transform that words as "-t 1 0 0 -rz 90 -s 2 -mx -i 3 ..." spell, in their order, up to the first word
// that belongs to none; `used` words belong to it. This is also how function files' primitives, instances and
// meshes carry theirs, behind their string arguments. A word that is wrong ends it ("-t 1 0", "-s 0"): the
// caller refuses what is left over. Source: xform(1), OPTIONS.
Similarity readTransform(std::span<const std::string_view> words, size_t& used);

// What one xform command, or several within each other, do to a primitive.
struct Transform {
  Similarity similarity;                // of all
  bool reversed = false;                // polygons turn their order of vertices
  bool inverted = false;                // surfaces face the other way (-I)
  std::string prefix;                   // of surfaces' names, "outer.inner"; empty: none
  std::optional<std::string> modifier;  // of all surfaces (-m)
  std::vector<std::string>
      arguments;  // what function files' primitives, instances and meshes get behind their strings

  // A primitive's type: -I makes a bubble of a sphere, a cup of a cone, a tube of a cylinder, and back.
  Type typeOf(Type type) const;
  // A primitive's name, written to `buffer` where it changes.
  std::string_view nameOf(Type type, std::string_view written, std::string& buffer) const;

  // Transforms the arguments of the primitive that was begun last, by its type's rules (those of xform(1)'s
  // program): points, vectors and radii of surfaces, texts and spotlights; a glow's radius of effect; what
  // dielectric, interface and mist absorb along a length; the sources that mist names. Others are left alone.
  // Throws Error with the primitive's place where it has not the arguments that its type needs here, or where
  // the result is no finite number.
  void apply(Primitive& p, DescriptionBuilder& builder) const;
};

// First inner, then outer.
Transform within(const Transform& outer, const Transform& inner);

}  // namespace rad
