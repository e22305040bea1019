#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/color.h"
#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "scene/placement.h"

namespace rsphere {

using Words = std::vector<std::string_view>;

// The arguments of one primitive as its file gives them, unconverted. Only modifier_arguments.h and
// shape_arguments.h know their meaning. Words refer to the description, which must outlive them.
class PrimitiveArguments {
 public:
  PrimitiveArguments(const rad::Description& description, rad::PrimitiveId primitive)
      : PrimitiveArguments(description, description.primitives[primitive]) {}
  PrimitiveArguments(const rad::Description& description, rad::Primitive primitive)
      : description_(description), primitive_(std::move(primitive)) {}

  rad::Type type() const { return primitive_.type; }
  size_t strings() const { return primitive_.strings; }
  std::span<const double> reals() const { return description_.reals(primitive_); }

  // For a polygon: the index of its first vertex in the vertices of the description.
  uint32_t firstVertex() const { return static_cast<uint32_t>(primitive_.firstReal); }

  // The string argument at an index. Throws rad::Error if there is none.
  std::string_view string(size_t i) const;
  // `count` string arguments, starting at index `first`. Throws rad::Error if there are fewer.
  Words strings(size_t first, size_t count) const;
  // All string arguments from index `first` on; there may be none.
  Words stringsFrom(size_t first) const;

  // Real arguments, starting at an index. REQUIRES that they exist: one of the checks below has passed.
  V3d vector(size_t at) const;
  Color color(size_t at) const;

  // Each throws rad::Error if the number of arguments is wrong.
  void needReals(size_t count) const;
  void needAtLeast(size_t strings, size_t reals = 0) const;
  void needAtMostStrings(size_t most) const;

  // Throws rad::Error with the file and line of the primitive.
  [[noreturn]] void fail(std::string_view what, rad::Status status = rad::Status::input) const;
  // Passes a warning with the file and line of the primitive to the receiver, if there is one.
  void warn(const rad::Warn& receiver, std::string_view what) const;

 private:
  const rad::Description& description_;
  rad::Primitive primitive_;
};

// 'room.rad:12: plastic "wall"', for messages.
std::string placeOf(const rad::Description& description, rad::PrimitiveId primitive);
std::string placeOf(const rad::Description& description, const rad::Primitive& primitive);

// The transform among the arguments: everything from the first word that can begin one. Empty if there is
// none.
Words transformAmong(std::span<const std::string_view> words);

// Reads a transform; the identity if it is empty. Throws rad::Error if it is not a transform.
Placement readPlacement(const PrimitiveArguments& arguments, std::span<const std::string_view> transform);

}  // namespace rsphere
