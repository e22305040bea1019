#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rad_parser/description.h"
#include "rad_parser/error.h"

namespace rad {

// Builds a description from any format, one primitive after the other, and tracks the current definition of
// each modifier. The arguments of the next primitive are appended between begin() and add().
class DescriptionBuilder {
 public:
  DescriptionBuilder() = default;
  DescriptionBuilder(const DescriptionBuilder&) = delete;
  DescriptionBuilder& operator=(const DescriptionBuilder&) = delete;

  Description& description() { return description_; }
  const Description& description() const { return description_; }

  // Adds a file or command and returns its index. from: as in SourceFile.
  uint32_t addFile(std::string_view name, Place from = {SourceFile::kNoFile, 0});

  // The index of a word in Description::words; a new word is appended.
  uint32_t intern(std::string_view word);

  // The current definition of this modifier, or kVoid if there is none.
  PrimitiveId modifier(std::string_view name) const;

  // The most similar modifier that is currently defined, or void, as the end of a message (see
  // NearestName::hint()). The time is proportional to the number of primitives.
  std::string nearestModifier(std::string_view name) const;

  // A primitive without arguments. Arguments appended to description() next belong to it.
  Primitive begin(Type type, Place place, std::string_view name, PrimitiveId modifier) const;

  // These append an argument to the primitive begun last.
  void addString(Primitive& p, std::string_view word);
  void addReal(Primitive& p, double value) {
    if (p.type == Type::polygon) {
      if (p.reals % 3 == 0) description_.vertices.emplace_back(0, 0, 0);
      description_.vertices.back()[static_cast<int>(p.reals % 3)] = value;
    } else {
      description_.realArgs.push_back(value);
    }
    ++p.reals;
  }

  // Makes p an alias of the primitive `reference`; if that is an alias itself, of its target. inherit: p also
  // gets the modifier of `reference`; otherwise p keeps its own.
  void resolveAlias(Primitive& p, PrimitiveId reference, bool inherit) const;

  // Appends the primitive begun last. If it is a modifier, it becomes the current definition of its name.
  void add(const Primitive& p);

  Error error(Place place, std::string_view text, Status status = Status::input) const;

  Description take() { return std::move(description_); }

 private:
  Description description_;
  std::unordered_map<std::string_view, uint32_t> words_;  // indices; the keys are in description_.words
  std::vector<PrimitiveId> inForce_;  // by word: the current modifier of that name, or kVoid
};

}  // namespace rad
