#include "answer/header.h"

#include "base/version.h"
#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

constexpr std::time_t kNow = 1000000000;  // 2001-09-09 01:46:40 UTC

std::string headerText(std::initializer_list<const char*> words, std::vector<std::string> scene = {}) {
  setenv("TZ", "XYZ-2", 1);
  tzset();
  const TemporaryFile file;
  RecordWriter writer(file.descriptor);
  writeHeader(writer, parse(words), scene, kNow);
  writer.flush();
  return contents(file.path);
}

const std::string kSoftware = std::string("SOFTWARE= rsphere ") + kVersion +
                              "\nCAPDATE= 2001:09:09 03:46:40\nGMT= 2001:09:09 01:46:40\n";

TEST(Header, HasTheLinesOfRtraceInItsOrder) {
  EXPECT_EQ(
      headerText({"/bin/rtrace", "-ovs", "-ae", "a b", "s.oct"}, {"#?RADIANCE", "oconv -f s.rad"}),
      "#?RADIANCE\noconv -f s.rad\nrtrace -ovs -ae \"a b\"\n" + kSoftware + "NCOMP=4\nFORMAT=ascii\n\n");
}

// The lines that rtrace (6.1a) writes for colors other than RGB.
TEST(Header, TellsOfColors) {
  const auto lines = [](std::initializer_list<const char*> words) {
    const std::string text = headerText(words);
    return text.substr(text.find("NCOMP="));
  };
  EXPECT_EQ(lines({"rtrace", "-pXYZ", "-fac", "s.oct"}),
            "NCOMP=3\nPRIMARIES= 1.0000 0.0000 0.0000 1.0000 0.0000 0.0000 0.3333 0.3333\n"
            "FORMAT=32-bit_rle_xyze\n\n");
  EXPECT_EQ(
      lines({"rtrace", "-pc", ".68", ".32", ".265", ".69", ".15", ".06", ".3127", ".329", "-fac", "s.oct"}),
      "NCOMP=3\nPRIMARIES= 0.6800 0.3200 0.2650 0.6900 0.1500 0.0600 0.3127 0.3290\n"
      "FORMAT=32-bit_rle_rgbe\n\n");
  EXPECT_EQ(lines({"rtrace", "-pY", "-oov", "s.oct"}), "NCOMP=4\nFORMAT=ascii\n\n");
  EXPECT_EQ(lines({"rtrace", "-co", "-cs", "6", "-fac", "s.oct"}),
            "NCOMP=6\nWAVELENGTH_SPLITS= 780 588 480 380\nFORMAT=Radiance_spectra\n\n");
  EXPECT_EQ(lines({"rtrace", "-co", "-cs", "4", "-cw", "500", "600", "s.oct"}),
            "NCOMP=4\nWAVELENGTH_SPLITS= 600 566.667 533.333 500\nFORMAT=ascii\n\n");
}

TEST(Header, OfTreesHasNoNumberOfComponents) {
  for (const char* letters : {"-ovtm", "-oTm", "-ot"})
    EXPECT_EQ(headerText({"rtrace", letters, "s.oct"}).find("NCOMP"), std::string::npos);
}

TEST(Header, NamesSceneFilesThatHaveNoHeader) {
  EXPECT_EQ(
      headerText({"rsphere", "-h+", "a.rad", "!genbox m n 1 1 1"}),
      "#?RADIANCE\nrsphere -h+ a.rad \"!genbox m n 1 1 1\"\n" + kSoftware + "NCOMP=3\nFORMAT=ascii\n\n");
}

TEST(Header, QuotesWordsAsRtraceDoes) {
  const Options options =
      parse({"rsphere", "-ae", "it's", "-ae", "a\"b", "-ae", "\"", "-ae", "plain", "s s"});
  EXPECT_EQ(commandLine(options, false), "rsphere -ae \"it's\" -ae 'a\"b' -ae \" -ae plain");
  EXPECT_EQ(commandLine(options, true), "rsphere -ae \"it's\" -ae 'a\"b' -ae \" -ae plain \"s s\"");
}

TEST(Header, CanBeSwitchedOffButNotTheResolution) {
  EXPECT_EQ(headerText({"rtrace", "-h", "s.oct"}), "");
  EXPECT_EQ(headerText({"rtrace", "-h", "-x", "5", "s.oct"}), "");
  EXPECT_EQ(headerText({"rtrace", "-h", "-x", "640", "-y", "48", "s.oct"}), "-Y       48 +X      640\n");
  EXPECT_TRUE(headerText({"rtrace", "-x", "640", "-y", "48", "s.oct"})
                  .ends_with("FORMAT=ascii\n\n-Y       48 +X      640\n"));
}

TEST(Header, BinaryRecordsBeginAligned) {
  for (int extra = 0; extra < 9; ++extra) {
    const std::string line(static_cast<size_t>(extra), 'x');
    const std::string floats = headerText({"rtrace", "-ff", "s.oct"}, {"#?RADIANCE", line});
    const std::string last = floats.substr(0, floats.find_last_not_of(" \n") + 1);
    EXPECT_TRUE(last.ends_with("\nNCOMP=3\nBigEndian=0\nFORMAT=float"));
    EXPECT_TRUE(floats.ends_with("\n\n"));
    EXPECT_LE(floats.size() - last.size(), 5u);
    EXPECT_EQ(floats.size() % 4, 0u);
    EXPECT_EQ(headerText({"rtrace", "-fd", "s.oct"}, {"#?RADIANCE", line}).size() % 8, 0u);
  }
  EXPECT_TRUE(headerText({"rtrace", "-ffc", "s.oct"}).ends_with("NCOMP=3\nFORMAT=32-bit_rle_rgbe\n\n"));
}

TEST(Header, PipesAreNotPadded) {
  for (const char* line : {"", "x", "xx", "xxx"}) {
    Pipe pipe;
    RecordWriter writer(pipe.in);
    const std::vector<std::string> scene{"#?RADIANCE", line};
    writeHeader(writer, parse({"rtrace", "-ff", "s.oct"}), scene, kNow);
    writer.flush();
    EXPECT_TRUE(pipe.get().ends_with("FORMAT=float\n\n"));
  }
}

TEST(Version, IsThatOfTheProject) {
  const std::string lists = contents(std::string(RSPHERE_TESTS) + "/../CMakeLists.txt");
  const std::string version = kVersion;
  const size_t dash = version.find('-');
  EXPECT_NE(lists.find("project(rsphere VERSION " + version.substr(0, dash) + " "), std::string::npos);
  const std::string candidate = dash == std::string::npos ? "" : version.substr(dash + 1);
  EXPECT_NE(lists.find("set(RSPHERE_PRERELEASE " + candidate + ")"), std::string::npos) << candidate;
  EXPECT_NE(contents(std::string(RSPHERE_TESTS) + "/../CHANGELOG.md").find("## " + version + ","),
            std::string::npos);
  EXPECT_EQ(versionLine(), std::string("rsphere ") + kVersion);
  EXPECT_EQ(versionAnswer("rsphere"), versionLine());
  EXPECT_EQ(versionAnswer("rsphere-trade"), versionLine());
}

}  // namespace
}  // namespace rsphere
