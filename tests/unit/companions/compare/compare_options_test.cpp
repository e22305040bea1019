#include "companions/compare/compare_options.h"

#include <gtest/gtest.h>

#include "companions/compare/original.h"
#include "rad_parser/error.h"
#include "tests/unit/support/manual_of.h"

namespace rsphere {
namespace {

CompareOptions parse(std::vector<std::string> words, std::vector<UsedOption>* used = nullptr) {
  words.insert(words.begin(), "rsphere-compare");
  CompareOptions options;
  const auto all = parseCompanion(words, compareCompanion(), options);
  if (used != nullptr) *used = all;
  return options;
}

std::vector<std::string> passedOn(const std::vector<std::string>& words) {
  std::vector<UsedOption> used;
  const CompareOptions options = parse(words, &used);
  return originalOptions(options, used);
}

TEST(CompareOptions, ManualIsTheGeneratedOne) {
  CompareOptions defaults;
  manual::expectPage("rsphere-compare",
                     {{"OPTIONS", manual::optionsOf(compareCompanion(), "rsphere-compare", defaults)}});
}

TEST(CompareOptions, AreThoseOfRsphereAndItsOwn) {
  const CompareOptions options =
      parse({"-ab", "2", "-Ct", ".002", "-Cr", "3", "-I", "-Cp", "d.png", "a.oct", "rays"});
  EXPECT_EQ(options.tolerance, .002);
  EXPECT_EQ(options.repeats, 3);
  EXPECT_EQ(options.differences, "d.png");
  EXPECT_EQ(options.ray.ambientBounces, 2);
  EXPECT_EQ(options.irradiance, IrradianceAt::point);
  EXPECT_FALSE(options.sphereMode);
  EXPECT_EQ(options.scene, (std::vector<std::string>{"a.oct", "rays"}));
  EXPECT_TRUE(parse({"-S", "a.oct", "points"}).sphereMode);
  EXPECT_EQ(parse({"-S", "a.oct", "points"}).ray.ambientDivisions, modeDefaults(true).ray.ambientDivisions);
}

TEST(CompareOptions, RefuseWhatIsOutOfRange) {
  for (const auto& words :
       {std::vector<std::string>{"-Cr", "1", "a", "b"}, {"-Ct", "-1", "a", "b"}, {"-Cq", "a", "b"}})
    EXPECT_THROW(parse(words), rad::Error) << words[0];
}

// The companion's own options have names that neither rtrace nor rsphere uses, and all have a remark.
TEST(CompareOptions, AreTheirOwn) {
  for (const OptionEntry& entry : compareCompanion().own) {
    EXPECT_EQ(entry.name.substr(0, 2), "-C");
    EXPECT_FALSE(entry.remark.empty()) << entry.name;
    for (const OptionEntry& other : optionTable()) EXPECT_NE(entry.name, other.name);
  }
}

TEST(OriginalOptions, AreThoseThatConcernRays) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(passedOn({"-h",    "-ab", "2",    "-Cr", "3",   "-I+", "-n",      "4",  "-x",    "3",
                      "-y",    "8",   "-ff",  "-e",  "a=1", "-e",  "err.txt", "-f", "f.cal", "-ae",
                      "floor", "-ae", "wall", "-Sr", "2",   "-pY", "-w",      "a",  "b"}),
            (Words{"-ab", "2", "-I+", "-e", "a=1", "-f", "f.cal", "-ae", "floor", "-ae", "wall"}));
}

TEST(OriginalOptions, HaveTheDefaultsOfPoints) {
  const auto words = passedOn({"-S", "-ab", "2", "a", "b"});
  const auto divisions = std::find(words.begin(), words.end(), "-ad");
  ASSERT_NE(divisions, words.end());
  EXPECT_EQ(divisions[1], std::to_string(modeDefaults(true).ray.ambientDivisions));
  EXPECT_EQ(words[words.size() - 2], "-ab");
}

}  // namespace
}  // namespace rsphere
