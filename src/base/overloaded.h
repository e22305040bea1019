#pragma once
#include <concepts>
#include <utility>
#include <variant>

namespace rsphere {

// Combines functions to one visitor of a variant.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

// Calls one of the functions with the value that a variant holds: the one that takes its type. Fails to
// compile for a type that none of them takes, as long as none takes plain `auto`. Types with the same answer
// share one function by OneOf, which lists them:
//   match(material, [](const Glass&) { return true; }, [](const OneOf<Light, Glow> auto&) { return false; })
// Inline, since functions that are called for each ray match their shapes.
template <class Variant, class... Functions>
[[gnu::always_inline]] inline decltype(auto) match(Variant&& variant, Functions... functions) {
  using std::visit;  // ShapeRef has its own
  return visit(Overloaded{std::move(functions)...}, std::forward<Variant>(variant));
}

template <class T, class... Types>
concept OneOf = (std::same_as<T, Types> || ...);

}  // namespace rsphere
