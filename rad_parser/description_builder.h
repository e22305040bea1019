#pragma once
#include <string_view>
#include <vector>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "rad_parser/words.h"

namespace rad {

// Grows a description primitive by primitive, whatever format they come from, and knows which definition of
// each modifier is in force. String and real arguments of the next primitive are appended to description()
// before add().
class DescriptionBuilder {
 public:
  DescriptionBuilder() : words_(description_.words) {}
  DescriptionBuilder(const DescriptionBuilder&) = delete;
  DescriptionBuilder& operator=(const DescriptionBuilder&) = delete;

  Description& description() { return description_; }
  const Description& description() const { return description_; }

  // Adds a file or command; from as in SourceFile. Returns its index.
  uint32_t addFile(std::string_view name, Place from = {SourceFile::kNoFile, 0});

  uint32_t intern(std::string_view word) { return words_.intern(word); }

  // A primitive's name. Those of surfaces name nothing, and are not looked for.
  uint32_t internName(Type type, std::string_view word) {
    return isSurface(type) ? words_.append(word) : words_.intern(word);
  }

  // The definition of the modifier that is in force now; kVoid where there is none.
  int32_t modifier(std::string_view name) const;

  // A primitive whose arguments, none yet, will be the next ones of description().
  Primitive begin(Type type, Place place, uint32_t name, int32_t modifier) const;

  // Appends an argument of the primitive that was begun last.
  void addString(Primitive& p, std::string_view word);
  void addReal(Primitive& p, double value) {
    description_.realArgs.push_back(value);
    ++p.reals;
  }

  // Makes an alias of what `reference` stands for; inherit: its modifier too, else that of `p`. reference is
  // an index.
  void resolveAlias(Primitive& p, int32_t reference, bool inherit) const;

  // Appends the primitive that was begun last. A modifier is in force from here on.
  void add(const Primitive& p);

  // The error that says `text` at that place.
  Error error(Place place, std::string_view text, Status status = Status::input) const;

  Description take() { return std::move(description_); }

 private:
  Description description_;
  WordTable words_;
  std::vector<int32_t> inForce_;  // by word: the last modifier of that name
};

}  // namespace rad
