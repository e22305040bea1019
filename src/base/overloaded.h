#pragma once
#include <concepts>

namespace rsphere {

// Combines functions to one visitor of a variant. std::visit() fails to compile for an alternative that none of
// them takes, as long as none takes plain `auto`. Alternatives with the same answer share one function by
// OneOf, which lists them:
//   std::visit(Overloaded{[](const Glass&) { return true; },
//                         [](const OneOf<Light, Glow> auto&) { return false; }}, material)
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

template <class T, class... Types>
concept OneOf = (std::same_as<T, Types> || ...);

}  // namespace rsphere
