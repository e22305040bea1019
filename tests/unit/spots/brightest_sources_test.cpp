#include "spots/brightest_sources.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/random.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// Lamps of several shapes in a tall building, a sun, and a lamp that does not shine.
std::string lampsOfATower() {
  std::string text =
      "void light lamp 0 0 3 9 9 9\nvoid light bright 0 0 3 90 90 90\nvoid light black 0 0 3 0 0 0\n"
      "lamp source sun 0 0 4 1 1 1 .5\nblack sphere none 0 0 4 5 5 5 .5\n";
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double x = 20 * random.uniform(), y = 20 * random.uniform(), z = 100 * random.uniform();
    const char* const material = i % 7 == 0 ? "bright" : "lamp";
    if (i % 3 == 0)
      text += fmt::format("{} sphere s 0 0 4 {} {} {} .1\n", material, x, y, z);
    else if (i % 3 == 1)
      text += fmt::format("{0} polygon p 0 0 12 {1} {2} {3} {1} {4} {3} {5} {4} {3} {5} {2} {3}\n", material,
                          x, y, z, y + .3, x + 1.2);
    else
      text += fmt::format("{} cylinder c 0 0 7 {} {} {} {} {} {} .02\n", material, x, y, z, x + 1, y, z);
  }
  return text;
}

double lightOf(const LightingPart& part, const V3d& place) { return part.radiance * part.solidAngle(place); }

TEST(BrightestSources, AreTheBrightestOfAll) {
  const Traced t(lampsOfATower(), {});
  const LightSources& lights = t.prepared().lights();
  const BrightestSources sources(t.scene(), lights);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const V3d place(20 * random.uniform(), 20 * random.uniform(), 100 * random.uniform());
    const size_t most = i % 2 ? 5 : 64;
    std::vector<double> all, found;
    for (const LightSource& source : lights.all())
      for (const LightingPart& part : partsThatLight(source, place, .1, t.scene()))
        all.push_back(lightOf(part, place));
    const auto parts = sources.at(Box3d(place), .1, most, [&](const LightSource&) { return place; });
    for (const LightingPart& part : parts) found.push_back(lightOf(part, place));
    EXPECT_TRUE(std::ranges::is_sorted(parts, {}, &LightingPart::source)) << "in the order of the sources";
    std::ranges::sort(all, std::greater());
    std::ranges::sort(found, std::greater());
    ASSERT_GE(found.size(), most);
    EXPECT_LT(found.size(), all.size() / (most == 5 ? 4 : 1));
    EXPECT_EQ(std::vector(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(most)),
              std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most)));
  }
}

// With fewer parts than are asked for, all are returned.
TEST(BrightestSources, AreAllIfTheyAreFew) {
  const Traced t("void light lamp 0 0 3 9 9 9\nlamp sphere s 0 0 4 0 0 9 .1\nlamp sphere t 0 0 4 9 0 9 .1\n",
                 {});
  const BrightestSources sources(t.scene(), t.prepared().lights());
  const V3d place(0, 0, 0);
  EXPECT_EQ(sources.at(Box3d(place), .1, 64, [&](const LightSource&) { return place; }).size(), 2u);
}

}  // namespace
}  // namespace rsphere
