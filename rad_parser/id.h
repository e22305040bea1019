#pragma once
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace rad {

// The absence of an element. It converts to every type of Id.
struct None {};

// The index of an element in one sequence, or none. Each sequence has a separate Tag, so that an index in one
// sequence is convertible neither to an index in another nor to a number. Takes 4 bytes.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr Id(None) {}
  explicit constexpr Id(std::integral auto index) : number_(static_cast<int32_t>(index)) {}

  // REQUIRES: not none.
  constexpr size_t index() const { return static_cast<size_t>(number_); }
  // The index, or -1 for none, as used in seeds, hashes and files.
  constexpr int32_t number() const { return number_; }

  // The order of the sequence; none precedes all elements.
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  int32_t number_ = -1;
};

// Consecutive indices.
template <class Id>
class IdRange {
 public:
  class Iterator {
   public:
    constexpr explicit Iterator(size_t at) : at_(at) {}
    constexpr Id operator*() const { return Id(at_); }
    constexpr Iterator& operator++() {
      ++at_;
      return *this;
    }
    constexpr bool operator==(const Iterator&) const = default;

   private:
    size_t at_;
  };

  constexpr IdRange() = default;
  constexpr IdRange(size_t first, size_t size) : first_(first), size_(size) {}
  constexpr size_t size() const { return size_; }
  constexpr Id operator[](size_t i) const { return Id(first_ + i); }
  constexpr Iterator begin() const { return Iterator(first_); }
  constexpr Iterator end() const { return Iterator(first_ + size_); }

 private:
  size_t first_ = 0, size_ = 0;
};

// A vector indexed by Ids. at() still takes a number.
template <class Id, class T>
class ById : public std::vector<T> {
  using Base = std::vector<T>;

 public:
  using Base::Base;
  typename Base::reference operator[](Id id) { return Base::operator[](id.index()); }
  typename Base::const_reference operator[](Id id) const { return Base::operator[](id.index()); }
  IdRange<Id> ids() const { return {0, this->size()}; }
  // The index of the last element. REQUIRES: not empty.
  Id last() const { return Id(this->size() - 1); }
};

}  // namespace rad

template <class Tag>
struct std::hash<rad::Id<Tag>> {
  size_t operator()(rad::Id<Tag> id) const { return std::hash<int32_t>()(id.number()); }
};
