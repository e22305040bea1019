#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace rad {

// The number of changes that turn a into b: letters that are replaced, added or removed, and pairs of
// neighboring letters that are exchanged. The time is proportional to the product of the lengths.
size_t editDistance(std::string_view a, std::string_view b);

// The most probable intended name for a misspelt one, among those passed to consider(). Only a few letters
// may differ: one in names of three to five letters, two in longer ones. Names of one or two letters resemble
// too many others to be guessed, and names of more than kLongest letters are not compared.
class NearestName {
 public:
  static constexpr size_t kLongest = 64;

  explicit NearestName(std::string_view wanted);

  // The misspelt name itself is ignored.
  void consider(std::string_view name);

  // The nearest name; empty if none is similar enough, or if several are equally near. A difference only in
  // upper and lower case is smaller than any other.
  std::string_view name() const { return tied_ ? std::string_view() : std::string_view(nearest_); }

  // The name as the end of a message, '; the nearest is "plastic"', or nothing.
  std::string hint() const;

 private:
  std::string_view wanted_;
  std::string nearest_, lowercase_;
  size_t most_ = 0;  // letters that may differ
  size_t cost_ = std::numeric_limits<size_t>::max();
  bool tied_ = false;
};

}  // namespace rad
