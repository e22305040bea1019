#include "importance/smooth_indirect.h"

#include <array>
#include <cmath>

#include "importance/tuning.h"

namespace rsphere {
namespace {

// Weights of a cubic B-spline at -2 to 2 steps. Its variance is one squared step, so that passes with steps
// of 1, 2 and 4 pixels together are like a Gaussian with a standard deviation of 4.6 pixels.
constexpr std::array<float, 5> kSpline = {1 / 16.f, 1 / 4.f, 3 / 8.f, 1 / 4.f, 1 / 16.f};
constexpr std::array<int, 3> kSteps = {1, 2, 4};

using Tuning = tuning::Pictures;

bool mayShare(const IndirectPixels::Pixel& a, const IndirectPixels::Pixel& b) {
  if (a.material != b.material || a.normal.dot(b.normal) < Tuning::kSameNormal) return false;
  const Imath::V3f apart = b.point - a.point;
  const float square = apart.length2(), rise = apart.dot(a.normal);
  return rise * rise <= Tuning::kSamePlane * Tuning::kSamePlane * square &&
         square <= Tuning::kNear * Tuning::kNear * a.distance * a.distance;
}

}  // namespace

void smoothIndirect(IndirectPixels& picture) {
  std::vector<Imath::V3f> smoothed(picture.pixels.size());
  const auto at = [&](int column, int row) { return static_cast<size_t>(row) * picture.width + column; };
  for (const int step : kSteps) {
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column) {
        const IndirectPixels::Pixel& here = picture.pixels[at(column, row)];
        if (here.material == kNone) continue;
        Imath::V3f sum(0, 0, 0);
        float weights = 0;
        for (int i = -2; i <= 2; ++i) {
          const int y = row + i * step;
          if (y < 0 || y >= picture.height) continue;
          for (int k = -2; k <= 2; ++k) {
            int x = column + k * step;
            if (picture.wraps) x = (x + picture.width) % picture.width;
            if (x < 0 || x >= picture.width) continue;
            const IndirectPixels::Pixel& there = picture.pixels[at(x, y)];
            if (!mayShare(here, there)) continue;
            const float weight = kSpline[static_cast<size_t>(i + 2)] * kSpline[static_cast<size_t>(k + 2)];
            sum += weight * there.light;
            weights += weight;
          }
        }
        smoothed[at(column, row)] = sum / weights;
      }
    for (size_t i = 0; i < smoothed.size(); ++i)
      if (picture.pixels[i].material != kNone) picture.pixels[i].light = smoothed[i];
  }
}

}  // namespace rsphere
