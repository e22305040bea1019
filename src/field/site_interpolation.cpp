#include "field/site_interpolation.h"

#include <algorithm>
#include <cmath>

#include "base/color.h"
#include "field/tuning.h"

namespace rsphere {
namespace {

float luminance(const V3f& color) { return static_cast<float>(brightness(Color(color.x, color.y, color.z))); }
V3f luminanceOf(const V3f (&change)[3]) {
  return static_cast<float>(kRedWeight) * change[0] + static_cast<float>(kGreenWeight) * change[1] +
         static_cast<float>(kBlueWeight) * change[2];
}

}  // namespace

void blend(GatheredLight& into, const GatheredLight& light, float share) {
  const V3f mean = into.mean + share * light.mean;
  if (into.bands || light.bands) into.bands = bandsBeside(mean, into.color() + light.color() * share);
  into.mean = mean;
  into.tilted.add(light.tilted, share);
}

double SitesAround::roughness(double tolerance) const {
  double level = 0, error = 0;
  for (int a = 0; a < count; ++a) level += luminance(light[a]->mean) / count;
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      const V3f way(site[b]->point - site[a]->point);
      const double before = luminanceOf(light[a]->perLength).dot(way);
      const double after = luminanceOf(light[b]->perLength).dot(way);
      const double step = luminance(light[b]->mean) - luminance(light[a]->mean);
      const double chance = tuning::SiteInterpolation::kChance * std::hypot(light[a]->noise, light[b]->noise);
      const double slopeChance = tuning::SiteInterpolation::kChance *
                                 std::hypot(light[a]->noisePerLength, light[b]->noisePerLength) *
                                 way.length();
      error =
          std::max({error, (std::abs(after - before) - slopeChance) / tuning::SiteInterpolation::kBySlopes,
                    (std::abs(step - (before + after) / 2) - chance - slopeChance / 2) /
                        tuning::SiteInterpolation::kByStep,
                    (std::abs(step) - chance) / tuning::SiteInterpolation::kByStep});
    }
  return level > 0 ? error / (tolerance * level) : 0;
}

GatheredLight SitesAround::at(const V3d& place, double& extrapolationError) const {
  GatheredLight result;
  V3d middle(0, 0, 0);
  float inverseReach = 0;
  for (int a = 0; a < count; ++a) {
    const auto w = static_cast<float>(weight[a] / served);
    middle += site[a]->point * (weight[a] / served);
    inverseReach += w / light[a]->reach;
    for (int k = 0; k < 3; ++k) result.perLength[k] += light[a]->perLength[k] * w;
  }
  V3f mean(0, 0, 0);
  for (int a = 0; a < count; ++a) {
    const auto w = static_cast<float>(weight[a] / served);
    const V3f way(middle - site[a]->point);
    blend(result, *light[a], w);
    mean += w * light[a]->mean;
    for (int k = 0; k < 3; ++k) {
      const float there = light[a]->mean[k];
      mean[k] +=
          w * tuning::SiteInterpolation::kSlopes * std::clamp(light[a]->perLength[k].dot(way), -there, there);
    }
  }
  const V3f aside(place - middle);
  const float level = luminance(mean);
  extrapolationError = 0;
  if (level > 0) {
    const double linear = std::abs(luminanceOf(result.perLength).dot(aside)) / level;
    const double margin = tuning::IrradianceField::kNoneAbove;
    extrapolationError = margin * std::max(linear, margin * static_cast<double>(aside.length2()) *
                                                       inverseReach * inverseReach);
  }
  for (int k = 0; k < 3; ++k)
    mean[k] = std::max(mean[k] + result.perLength[k].dot(aside), tuning::SiteInterpolation::kLeast * mean[k]);
  result.setMean(mean);
  return result;
}

}  // namespace rsphere
