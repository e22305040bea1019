#pragma once
// Chooses the surfaces that are examined for highlights.
#include <vector>

#include "base/keep_largest.h"
#include "spots/highlight_lobe.h"

namespace rsphere {

template <class Shape>
struct Reflector {
  const Shape* shape;
  const Opaque* material;
};

// The largest shapes of one kind that show highlights. Contents of instances are excluded. size: returns the
// size of a shape; zero or less excludes the shape. The result refers to the scene.
template <class Shape, class Size>
std::vector<Reflector<Shape>> largestReflectors(const Scene& scene, size_t most, Size size) {
  std::vector<Reflector<Shape>> found;
  for (const Surface& surface : scene.outermost()) {
    const auto* shape = surface.shape.as<Shape>();
    if (!shape || !(size(*shape) > 0)) continue;
    if (const Opaque* material = roughReflector(scene, surface)) found.push_back({shape, material});
  }
  keepLargest(found, most, [&](const Reflector<Shape>& r) { return size(*r.shape); });
  return found;
}

}  // namespace rsphere
