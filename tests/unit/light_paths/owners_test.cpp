#include "light_paths/owners.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace rsphere {
namespace {

// A class of paths: what a path from the eye meets, from the first surface on.
//   D, H, K  a known diffuse surface, without a rough highlight, with a weak and with a strong one
//   U        a diffuse surface that is not known
//   S        a known mirror
//   L, P     at the end: a lamp, or the light beyond a portal
using Rule = std::function<Owner(LightPart, const OwnedRay&)>;

bool isDiffuse(char c) { return c == 'D' || c == 'H' || c == 'K' || c == 'U'; }

// Whether the light paths of vertices at surface i reach it: from the source on, they have met only known
// surfaces.
bool isReached(const std::string& path, size_t i) { return path.find('U', i) == std::string::npos; }

// How often the light at the end of a path is counted in the answer of sphere mode: by a glance from the eye
// and the joins that belong to it, by light vertices at each surface, and by the path from the eye itself.
double timesCounted(const std::string& path, const Rule& owner) {
  double times = isDiffuse(path[0]) && isReached(path, 0) ? 1 : 0;  // a glance
  OwnedRay ray{.known = Known::joined};
  const size_t last = path.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    if (path[i] == 'U') ray.known = Known::no;
    if (path[i] == 'S') ray.isMirrored = true;
    if (!isDiffuse(path[i])) continue;
    ray.hasHighlight = path[i] == 'H' || path[i] == 'K';
    ray.isStrong = path[i] == 'K';
    const Owner indirect = owner(LightPart::indirect, ray);
    const bool atEnd = i + 1 == last && path[last] == 'L';
    // Vertices of the next surface are connected by straight lines.
    if (!atEnd && indirect == Owner::here) times += path[i + 1] != 'S' && isReached(path, i + 1);
    if (atEnd) times += owner(LightPart::ofSources, ray) != Owner::earlier;
    if (indirect != Owner::eye) ray.known = knownAfter(indirect);
    ++ray.ambientLevel;
    ray.isMirrored = false;
  }
  // The emission of lamps counts for the rays that see them from the eye; after a diffuse surface, the shadow
  // rays counted above stand for it.
  if (path[last] == 'L' && ray.ambientLevel == 0) times += owner(LightPart::emitted, ray) == Owner::eye;
  if (path[last] == 'P') times += owner(LightPart::throughPortal, ray) == Owner::eye;
  return times;
}

// All classes with up to `most` surfaces. Where light is mirrored between the last diffuse surface and a
// lamp, an image of the lamp is the source.
std::vector<std::string> classes(size_t most) {
  std::vector<std::string> found, ends{""};
  for (size_t n = 0; n <= most; ++n) {
    std::vector<std::string> longer;
    for (const std::string& start : ends) {
      const bool byImage = start.find_first_of("DHKU") != std::string::npos && start.back() == 'S';
      if (!byImage) found.push_back(start + "L");
      if (!start.empty()) found.push_back(start + "P");
      for (const char c : {'D', 'H', 'K', 'U', 'S'}) longer.push_back(start + c);
    }
    ends = std::move(longer);
  }
  return found;
}

TEST(Owners, CountTheLightOfEachClassOfPathsOnce) {
  for (const std::string& path : classes(5)) EXPECT_EQ(timesCounted(path, ownerOf), 1) << path;
}

// The test would see each rule that is wrong.
TEST(Owners, AreWrongIfARuleIsChanged) {
  const auto counts = [](const Rule& spoiled) {
    size_t wrong = 0;
    for (const std::string& path : classes(4)) wrong += timesCounted(path, spoiled) != 1;
    return wrong;
  };
  EXPECT_EQ(counts(ownerOf), 0u);
  for (const LightPart part :
       {LightPart::emitted, LightPart::ofSources, LightPart::indirect, LightPart::throughPortal})
    for (const Owner to : {Owner::eye, Owner::here, Owner::earlier}) {
      const auto spoiled = [&](LightPart p, const OwnedRay& ray) {
        return p == part && ray.isMirrored ? to : ownerOf(p, ray);
      };
      // The eye keeps what it owns: all emission, and direct light by either of two estimates.
      if (part == LightPart::emitted && to == Owner::eye) continue;
      EXPECT_GT(counts(spoiled), 0u) << "part " << static_cast<int>(part) << " to " << static_cast<int>(to);
    }
}

// The direct light of a rough highlight is added together with diffuse light, or by itself at a surface whose
// diffuse light an earlier place has.
TEST(Owners, OfHighlights) {
  for (const Known known : {Known::no, Known::joined, Known::unjoined})
    for (const int bounces : {0, 1})
      for (const bool mirrored : {false, true})
        for (const bool strong : {false, true}) {
          const OwnedRay ray{known, false, bounces, mirrored, true, strong};
          const Owner highlight = ownerOf(LightPart::highlight, ray);
          const Owner diffuse = ownerOf(LightPart::ofSources, ray);
          if (highlight == diffuse) continue;
          EXPECT_EQ(highlight, Owner::here);
          EXPECT_EQ(diffuse, Owner::earlier);
          EXPECT_EQ(known, Known::unjoined);
          EXPECT_FALSE(mirrored);
        }
}

}  // namespace
}  // namespace rsphere
