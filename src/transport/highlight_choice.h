#pragma once
// How highlights on balls and on cylinders are chosen: the surfaces that are looked at, and those that rays
// are aimed at from a point.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/constants.h"
#include "transport/highlight_lobe.h"

namespace rsphere {

// Keeps the `most` elements with the largest keys, the largest first.
template <class T, class Key>
void keepLargest(std::vector<T>& all, size_t most, Key key) {
  std::stable_sort(all.begin(), all.end(), [&](const T& a, const T& b) { return key(a) > key(b); });
  if (all.size() > most) all.resize(most);
}

template <class Shape>
struct Reflector {
  const Shape* shape;
  const Opaque* material;
};

// The largest shapes of one kind that show highlights and belong to the scene itself, not to octrees in it.
// size: gets a shape; at most 0 if it is not to be used. Refers to the scene.
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

// What rays from a point of a diffuse surface are aimed at: the numbers of surfaces, each with its
// contribution to the light, by which one is chosen.
template <size_t kRoom>
struct HighlightAim {
  double mean = 0;  // radiance over the hemisphere from these highlights, W/sr/m2, without occlusion
  size_t count = 0;
  V3d point{0, 0, 0};
  std::array<uint32_t, kRoom> surface;
  std::array<double, kRoom> upTo;  // cumulative contributions

  void clear() {
    count = 0;
    mean = 0;
  }
  // REQUIRES: count < kRoom.
  void add(uint32_t number, double contribution) {
    surface[count] = number;
    upTo[count] = before(count) + contribution;
    ++count;
  }
  void finish(const V3d& from) {
    point = from;
    mean = before(count) / kPi;
  }
  // The sum of the contributions before one of them; of all, before(count).
  double before(size_t i) const { return i > 0 ? upTo[i - 1] : 0; }
  // The one that is chosen by u, uniform in [0, 1). REQUIRES: count > 0.
  size_t chosen(double u) const {
    const double due = u * upTo[count - 1];
    size_t i = 0;
    while (i + 1 < count && !(due < upTo[i])) ++i;
    return i;
  }
};

}  // namespace rsphere
