#include "field/patch_links.h"

namespace rsphere {
namespace {

// Adds a color to the element i.
void addAt(std::vector<LinearColor>& sums, std::vector<Bands>& bands, size_t i, const Color& color,
           const V2f& weight) {
  if (sums.size() <= i) sums.resize(i + 1);
  const Color before = colorAt(sums[i].mean, bands, i);
  sums[i].add(V3f(color.rgb()), weight);
  if (!color.bands() && i >= bands.size()) return;
  if (bands.size() <= i) bands.resize(i + 1);
  bands[i] = bandsBeside(sums[i].mean, before + color);
}

}  // namespace

void PatchLinks::addLink(const PatchPlace& to, const Coefficient& coefficient, int bounces) {
  if (coefficient.color.bands()) {
    bandsOfLinks.resize(links.size() + 1);
    bandsOfLinks.back() = bandsBeside(V3f(coefficient.color.rgb()), coefficient.color);
  }
  links.push_back({to, V3f(coefficient.color.rgb()), bounces, weight});
}

void PatchLinks::addLight(int bounces, const Radiance& radiance) {
  addAt(light, bandsOfLight, static_cast<size_t>(bounces), radiance.color, weight);
}

void PatchLinks::addEnd(int bounces, const Coefficient& coefficient) {
  addAt(ends, bandsOfEnds, static_cast<size_t>(bounces), coefficient.color, weight);
}

}  // namespace rsphere
