#include "field/patch_links.h"

#include "field/hemisphere.h"

namespace rsphere {
namespace {

// Adds a color to the element i.
void addAt(std::vector<V3f>& channels, std::vector<Bands>& bands, size_t i, const Color& color) {
  if (channels.size() <= i) channels.resize(i + 1, V3f(0, 0, 0));
  const V3f sum = channels[i] + V3f(color.rgb());
  if (color.bands() || i < bands.size()) {
    if (bands.size() <= i) bands.resize(i + 1);
    bands[i] = bandsBeside(sum, colorAt(channels[i], bands, i) + color);
  }
  channels[i] = sum;
}

}  // namespace

void PatchLinks::add(Patch* patch, const Coefficient& coefficient, int bounces) {
  if (coefficient.color.bands()) {
    bandsOfLinks.resize(links.size() + 1);
    bandsOfLinks.back() = bandsBeside(V3f(coefficient.color.rgb()), coefficient.color);
  }
  links.push_back({patch, V3f(coefficient.color.rgb()), bounces});
}

void PatchLinks::addLight(int bounces, const Radiance& radiance) {
  addAt(light, bandsOfLight, static_cast<size_t>(bounces), radiance.color);
}

void PatchLinks::addEnd(int bounces, const Coefficient& coefficient) {
  addAt(ends, bandsOfEnds, static_cast<size_t>(bounces), coefficient.color);
}

}  // namespace rsphere
