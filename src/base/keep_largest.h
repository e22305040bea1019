#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace rsphere {

// Keeps the `most` elements with the largest keys, the largest first.
template <class T, class Key>
void keepLargest(std::vector<T>& all, std::size_t most, Key key) {
  std::stable_sort(all.begin(), all.end(), [&](const T& a, const T& b) { return key(a) > key(b); });
  if (all.size() > most) all.resize(most);
}

}  // namespace rsphere
