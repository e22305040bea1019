#include "rcontrib/contribution_options.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/support/command_line.h"
#include "tests/unit/support/manual_of.h"

namespace rsphere {
namespace {

ContributionOptions parsed(std::vector<std::string> words) {
  words.insert(words.begin(), "rcontrib");
  words.emplace_back("scene.oct");
  ContributionOptions options;
  parseCompanion(words, contributionCompanion(), options);
  finish(options);
  return options;
}

std::string fault(const std::vector<std::string>& words) {
  return faultOf([&] { trackedModifiers(parsed(words)); });
}

TEST(ContributionOptions, ManualIsTheGeneratedOne) {
  ContributionOptions defaults;
  contributionCompanion().defaults(defaults);
  manual::expectPage("rcontrib",
                     {{"OPTIONS", manual::optionsOf(contributionCompanion(), "rcontrib", defaults)}});
}

TEST(ContributionOptions, DefaultsAreThoseOfRadiance) {
  const ContributionOptions options = parsed({"-m", "a"});
  EXPECT_FALSE(options.sphereMode);
  EXPECT_EQ(options.ray.ambientBounces, 1);
  EXPECT_EQ(options.ray.ambientDivisions, 350);
  EXPECT_EQ(options.ray.directJitter, .9);
  EXPECT_EQ(options.ray.directRelays, 3);
  EXPECT_EQ(options.ray.specularThreshold, .02);
  EXPECT_EQ(options.ray.weightLimit, 2e-3);
  EXPECT_EQ(options.ray.reflectionLimit, -10);
  EXPECT_TRUE(options.numberedRays);
  EXPECT_FALSE(parsed({"-u-", "-m", "a"}).numberedRays);
  EXPECT_EQ(options.raysPerRecord, 1);
}

// `options` before and after the modifier a.
std::vector<std::string> unused(std::vector<std::string> before, const std::vector<std::string>& after) {
  before.insert(before.end(), {"-m", "a"});
  before.insert(before.end(), after.begin(), after.end());
  return warningsOfUnused(parsed(before));
}

TEST(ContributionOptions, OptionsThatNoModifierFollowsAreWarnings) {
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"-b", "Dx"}, {"-bn", "4"}, {"-p", "x=1"}, {"-o", "out"}, {"-oe", "out"}}) {
    const std::vector<std::string> warnings = unused({}, option);
    ASSERT_EQ(warnings.size(), 1u) << option[0];
    EXPECT_EQ(warnings[0].find(option[0] + " " + option[1] + " has no effect"), 0u) << warnings[0];
    EXPECT_TRUE(unused(option, {}).empty()) << option[0];
    EXPECT_TRUE(unused(option, option).empty()) << "what the modifier has";
  }
  EXPECT_EQ(unused({}, {"-o", "out", "-bn", "4"}).size(), 2u);
  EXPECT_TRUE(unused({}, {"-c", "2", "-V+", "-e", "x=1", "-f", "bins.cal"}).empty()) << "of all modifiers";
}

// As in RADIANCE, where expressions are evaluated after the command line is read.
TEST(ContributionOptions, DefinitionsAreCommonToAllModifiers) {
  const std::vector<std::string> later{"-bn", "2", "-b", "bin", "-m", "a", "-e", "bin=if(Dz,1,0)"};
  EXPECT_EQ(fault(later), "no fault");
  const std::vector<TrackedModifier> found = trackedModifiers(parsed(later));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].bins, 2u);
  EXPECT_NE(fault({"-bn", "n", "-b", "Dx", "-m", "a", "-e", "n=2"}).find("n"), std::string::npos)
      << "-bn is evaluated where it is given";
}

// Interpolated light and untested sources cannot be divided among modifiers.
TEST(ContributionOptions, NothingIsInterpolatedWhateverIsGiven) {
  const ContributionOptions options = parsed({"-aa", ".2", "-as", "64", "-dt", ".1", "-m", "a"});
  EXPECT_EQ(options.ray.ambientAccuracy, 0);
  EXPECT_EQ(options.ray.ambientSuperSamples, 0);
  EXPECT_EQ(options.ray.directThreshold, 0);
}

TEST(ContributionOptions, LettersAndFilesOfTheSameNameAreToldApart) {
  const ContributionOptions options =
      parsed({"-fo+", "-faf", "-f", "bins.cal", "-e", "MF:4", "-bv-", "-m", "a", "-V+", "-c", "10"});
  EXPECT_TRUE(options.overwrites && options.values);
  EXPECT_EQ(options.in, NumberFormat::ascii);
  EXPECT_EQ(options.out, NumberFormat::float32);
  EXPECT_FALSE(options.ray.backFacesVisible);
  EXPECT_EQ(options.raysPerRecord, 10);
  const std::vector<SharedDefinitions>& shared = options.tracked[0].definitions.shared;
  ASSERT_EQ(shared.size(), 2u);
  EXPECT_TRUE(shared[0].isFile && !shared[1].isFile);
  EXPECT_EQ(shared[0].text + " " + shared[1].text, "bins.cal MF:4");
  EXPECT_TRUE(options.ray.definitions.empty());
}

TEST(ContributionOptions, LatestOptionsBeforeAModifierHoldForIt) {
  const std::string file = testing::TempDir() + "modifiers";
  std::ofstream(file) << "c\n d\te";
  const auto modifiers = trackedModifiers(parsed({"-bn", "1", "-b", "0", "-m", "a", "-p", "n=3", "-bn", "n+1",
                                                  "-b", "if(Dz,n,0)", "-m", "b", "-p", "n=5", "-M", file}));
  ASSERT_EQ(modifiers.size(), 5u);
  EXPECT_EQ(modifiers[0].bins, 1u);
  EXPECT_FALSE(modifiers[0].bin);
  EXPECT_EQ(modifiers[1].bins, 4u);
  EXPECT_EQ(modifiers[4].bins, 4u);  // -bn was evaluated with n=3
  EXPECT_EQ(modifiers[4].name, "e");
}

TEST(ContributionOptions, FaultsSayWhatToDo) {
  EXPECT_EQ(fault({}), "missing required modifier argument: -m names one that is tracked, -M a file of them");
  EXPECT_EQ(fault({"-m", "void"}), "cannot track 'void' modifier");
  EXPECT_EQ(fault({"-m", "a", "-m", "a"}), "duplicate modifier 'a'");
  EXPECT_EQ(fault({"-b", "2", "-bn", "3", "-m", "a"}),
            "illegal non-zero constant for bin (2) of modifier 'a'");
  EXPECT_NE(fault({"-b", "Px", "-m", "a"}).find("unspecified or illegal bin count"), std::string::npos);
  EXPECT_NE(fault({"-b", "Px", "-bn", "0", "-m", "a"}).find("illegal bin count"), std::string::npos);
  // A billion bins used to take memory until none was left.
  EXPECT_NE(fault({"-b", "Px", "-bn", "1e9", "-m", "a"}).find("from 1 to 10000000"), std::string::npos);
  EXPECT_EQ(
      fault({"-b", "Px", "-bn", "6e6", "-m", "a", "-m", "b"}),
      "all modifiers together would have 12000000 bins: at most 10000000; run rcontrib several times, with "
      "some of the modifiers each");
  EXPECT_EQ(fault({"-b", "Px", "-bn", "Py", "-m", "a"}),
            "-bn 'Py': the number of bins must not depend on the ray");
  EXPECT_EQ(fault({"-r", "-fo", "-m", "a"}), "-r and -fo exclude each other");
  EXPECT_NE(fault({"-r", "-m", "a"}).find("needs binary output"), std::string::npos);
  EXPECT_NE(fault({"-r", "-ff", "-c", "0", "-m", "a"}).find("not supported"), std::string::npos);
  EXPECT_NE(fault({"-e", "f`=1", "-m", "a"}).find("not supported"), std::string::npos);
  EXPECT_NE(fault({"-p", "a:1", "-b", "Px", "-bn", "2", "-m", "a"}).find("bad parameter list"),
            std::string::npos);
  EXPECT_NE(fault({"-ap", "map", "-m", "a"}).find("not supported"), std::string::npos);
  for (const char* word : {"-S", "-Sn", "-pY", "-ti", "-ov", "-P", "-co+", "-Ss"})
    EXPECT_NE(fault({word, "1", "-m", "a"}).find("there is no such option"), std::string::npos) << word;
}

}  // namespace
}  // namespace rsphere
