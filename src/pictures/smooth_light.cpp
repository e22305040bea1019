#include "pictures/smooth_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rsphere {
namespace {

// Weights of a cubic B-spline at -2 to 2 steps. Its variance is one squared step.
constexpr std::array<float, 5> kSpline = {1 / 16.f, 1 / 4.f, 3 / 8.f, 1 / 4.f, 1 / 16.f};

struct Average {
  Imath::V3f light{0, 0, 0};
  float known = 0;
};

// The weight of light b in an average around light a: small if they differ by more than sameLight.
float similarity(const Imath::V3f& a, const Imath::V3f& b, float sameLight) {
  const Imath::V3f apart = (b - a) / (sameLight * (a + b) / 2 + Imath::V3f(1e-20f));
  return std::exp(-apart.length2() / 6);
}

Average averageAround(const SeenSurfaces& seen, const Smoothing& smoothing, const PixelLight& light,
                      int column, int row, int pass) {
  const int step = 1 << pass;
  const auto at = [&](int x, int y) { return static_cast<size_t>(y) * seen.width + x; };
  const SeenSurface& here = seen.pixels[at(column, row)];
  Imath::V3f sum(0, 0, 0);
  float known = 0, weights = 0;
  for (int i = -2; i <= 2; ++i) {
    const int y = row + i * step;
    if (y < 0 || y >= seen.height) continue;
    for (int k = -2; k <= 2; ++k) {
      int x = column + k * step;
      if (seen.wraps) x = (x + seen.width) % seen.width;
      if (x < 0 || x >= seen.width || !mayShare(here, seen.pixels[at(x, y)], smoothing)) continue;
      float weight = kSpline[static_cast<size_t>(i + 2)] * kSpline[static_cast<size_t>(k + 2)];
      if (pass >= smoothing.passes)
        weight *= similarity(light.light[at(column, row)], light.light[at(x, y)], smoothing.sameLight);
      weights += weight;
      known += weight * light.known[at(x, y)];
      sum += weight * light.known[at(x, y)] * light.light[at(x, y)];
    }
  }
  return known > 0 ? Average{sum / known, known / weights} : Average{};
}

}  // namespace

bool mayShare(const SeenSurface& a, const SeenSurface& b, const Smoothing& smoothing) {
  // The cosine of an angle as large as the roughness: the normals then differ less than those of the
  // microfacets that make the lobe.
  const float rough = smoothing.ofGloss ? 1 - a.roughness * a.roughness / 2 : 1;
  if (a.material != b.material || a.panes != b.panes || a.images != b.images ||
      a.normal.dot(b.normal) < std::min(smoothing.sameNormal, rough))
    return false;
  const Imath::V3f apart = b.point - a.point;
  const float square = apart.length2(), rise = apart.dot(a.normal);
  return rise * rise <= smoothing.near * smoothing.near * square &&
         square <= smoothing.near * smoothing.near * a.distance * a.distance;
}

void smoothLight(const SeenSurfaces& seen, const Smoothing& smoothing, PixelLight& light) {
  PixelLight next = light;
  for (int pass = 0; pass < smoothing.passes + smoothing.careful; ++pass) {
    for (int row = 0; row < seen.height; ++row)
      for (int column = 0; column < seen.width; ++column) {
        const size_t pixel = static_cast<size_t>(row) * seen.width + column;
        if (seen.pixels[pixel].material == kNone) continue;
        const Average average = averageAround(seen, smoothing, light, column, row, pass);
        next.light[pixel] = average.light;
        next.known[pixel] = average.known;
      }
    std::swap(light, next);
  }
}

}  // namespace rsphere
