#pragma once
#include <concepts>
#include <utility>
#include <variant>

namespace rsphere {

// Combines functions into one visitor of a variant.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

// Calls the function that accepts the type of a variant's value. Does not compile if no function accepts one
// of the types, as long as none takes plain `auto`. Types with a common function are listed with OneOf:
//   match(material, [](const Glass&) { return true; }, [](const OneOf<Light, Glow> auto&) { return false; })
// Inline, because functions called for each ray match their shapes.
template <class Variant, class... Functions>
[[gnu::always_inline]] inline decltype(auto) match(Variant&& variant, Functions... functions) {
  using std::visit;  // ShapeRef has a separate visit()
  return visit(Overloaded{std::move(functions)...}, std::forward<Variant>(variant));
}

template <class T, class... Types>
concept OneOf = (std::same_as<T, Types> || ...);

}  // namespace rsphere
