#include "scene/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rad_parser/transforms/xform.h"

namespace rsphere {
namespace {

bool beginsTransform(std::string_view word) {
  if (word == "-t" || word == "-s" || word == "-i") return true;
  return word.size() == 3 && word[0] == '-' && (word[1] == 'r' || word[1] == 'm') && word[2] >= 'x' &&
         word[2] <= 'z';
}

}  // namespace

std::string_view PrimitiveArguments::string(size_t i) const {
  if (i >= strings()) fail(fmt::format("expected at least {} string arguments, got {}", i + 1, strings()));
  return description_.string(primitive_, i);
}

Words PrimitiveArguments::strings(size_t first, size_t count) const {
  Words words;
  for (size_t i = 0; i < count; ++i) words.push_back(string(first + i));
  return words;
}

Words PrimitiveArguments::stringsFrom(size_t first) const {
  return first < strings() ? strings(first, strings() - first) : Words{};
}

V3d PrimitiveArguments::vector(size_t at) const {
  const auto r = reals();
  return V3d(r[at], r[at + 1], r[at + 2]);
}

Color PrimitiveArguments::color(size_t at) const { return Color(vector(at)); }

void PrimitiveArguments::needReals(size_t count) const {
  if (reals().size() != count) fail(fmt::format("expected {} real arguments, got {}", count, reals().size()));
}

void PrimitiveArguments::needAtLeast(size_t leastStrings, size_t leastReals) const {
  if (strings() < leastStrings)
    fail(fmt::format("expected at least {} string arguments, got {}", leastStrings, strings()));
  if (reals().size() < leastReals)
    fail(fmt::format("expected at least {} real arguments, got {}", leastReals, reals().size()));
}

void PrimitiveArguments::needAtMostStrings(size_t most) const {
  if (strings() > most) fail(fmt::format("expected at most {} string arguments, got {}", most, strings()));
}

void PrimitiveArguments::fail(std::string_view what, rad::Status status) const {
  throw rad::Error(fmt::format("{}: {}", placeOf(description_, primitive_), what), status);
}

void PrimitiveArguments::warn(const rad::Warn& receiver, std::string_view what) const {
  if (receiver) receiver(fmt::format("{}: {}", placeOf(description_, primitive_), what));
}

std::string placeOf(const rad::Description& description, const rad::Primitive& p) {
  return fmt::format("{}: {} \"{}\"", description.at(p.place), rad::typeName(p.type), p.name);
}

std::string placeOf(const rad::Description& description, rad::PrimitiveId primitive) {
  return placeOf(description, description.primitives[primitive]);
}

Words transformAmong(std::span<const std::string_view> words) {
  return Words(std::ranges::find_if(words, beginsTransform), words.end());
}

Placement readPlacement(const PrimitiveArguments& arguments, std::span<const std::string_view> transform) {
  size_t used = 0;
  Placement placement;
  placement.toOuter = rad::readTransform(transform, used);
  if (used != transform.size()) arguments.fail("bad transform");
  placement.toInner = placement.toOuter.inverse();
  placement.toOuter.scale = std::abs(placement.toOuter.scale);
  placement.toInner.scale = std::abs(placement.toInner.scale);
  return placement;
}

}  // namespace rsphere
