#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace rsphere {

// Keeps the `most` elements with the largest keys, the largest first.
template <class T, class Key>
void keepLargest(std::vector<T>& all, std::size_t most, Key key) {
  std::ranges::stable_sort(all, std::greater(), key);
  if (all.size() > most) all.resize(most);
}

}  // namespace rsphere
