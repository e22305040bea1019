#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rad_parser/id.h"
#include "rad_parser/primitive.h"

namespace rad {

// The primitives of a description in order. They take about 10 bytes each if names and places are similar to
// those of the preceding primitive, as they are in large scenes. Primitives are stored as differences from
// the preceding one, in blocks of kBlock that are decoded from the start. Names are front-coded: only the end
// that differs from the preceding name is stored. Iterating takes constant time per primitive. Accessing a
// primitive decodes half a block on average, .25 microseconds; a name alone takes less than half of that.
class PrimitiveList {
 public:
  static constexpr size_t kBlock = 16;

  // Decodes primitives in sequence. The primitive that it refers to is overwritten by the next one.
  class Iterator;

  size_t size() const { return isSurface_.size(); }
  bool empty() const { return isSurface_.empty(); }
  IdRange<PrimitiveId> ids() const { return {0, size()}; }
  // The index of the last primitive. REQUIRES: not empty.
  PrimitiveId last() const { return PrimitiveId(size() - 1); }

  Primitive operator[](PrimitiveId id) const { return at(id.index()); }
  Primitive at(size_t index) const;
  Primitive back() const { return at(size() - 1); }
  // The name of a primitive, without decoding the rest.
  std::string name(PrimitiveId id) const;
  // Whether the primitive is a surface, without decoding it.
  bool isSurface(PrimitiveId id) const { return isSurface_[id.index()]; }

  Iterator begin() const;
  Iterator end() const;
  // Begins at this primitive.
  Iterator from(size_t index) const;

  void push_back(const Primitive& primitive);
  // Returns unused memory.
  void shrink();

 private:
  // The state for decoding a block: values of the preceding primitive, and the end of its arguments.
  struct State {
    uint64_t byte = 0, nameByte = 0;  // of the block in bytes_ and names_
    uint64_t nextReal = 0, nextVertex = 0;
    uint32_t nextString = 0;
    Place place;
    PrimitiveId modifier;

    void advance(const Primitive& p);
  };

  std::vector<uint8_t> bytes_, names_;
  std::vector<State> blocks_;
  std::vector<bool> isSurface_;
  State state_;           // after the last primitive
  std::string lastName_;  // of the last primitive of an incomplete block
};

class PrimitiveList::Iterator {
 public:
  using value_type = Primitive;
  using difference_type = std::ptrdiff_t;

  Iterator(const PrimitiveList& list, size_t index);
  const Primitive& operator*() const { return primitive_; }
  const Primitive* operator->() const { return &primitive_; }
  PrimitiveId id() const { return PrimitiveId(index_); }
  Iterator& operator++() {
    ++index_;
    decode();
    return *this;
  }
  bool operator==(const Iterator& other) const { return index_ == other.index_; }

 private:
  friend class PrimitiveList;
  void decode();

  const PrimitiveList* list_;
  size_t index_;
  State state_;  // byte, nameByte: of the next primitive
  Primitive primitive_;
};

inline PrimitiveList::Iterator PrimitiveList::begin() const { return from(0); }
inline PrimitiveList::Iterator PrimitiveList::end() const { return {*this, size()}; }

}  // namespace rad
