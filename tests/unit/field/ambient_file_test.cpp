#include "field/ambient_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

class AmbientFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string path = testing::TempDir() + "ambientXXXXXX";
    ASSERT_TRUE(mkdtemp(path.data()));
    folder_ = path;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  std::unique_ptr<AmbientFile> open(const std::string& name, uint64_t scene = 1, uint64_t options = 2) {
    return AmbientFile::open(file(name), scene, options, [this](std::string_view text) { warning_ = text; });
  }
  std::string bytes(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }

  std::string folder_, warning_;
};

AmbientFile::Record numbered(int n) {
  AmbientFile::Record record{};
  std::memcpy(record.data(), &n, sizeof n);
  return record;
}

TEST_F(AmbientFiles, GivesBackWhatSeveralWritersAdded) {
  const auto one = open("a"), other = open("a");
  const AmbientFile::Record records[] = {numbered(1), numbered(2), numbered(3)};
  EXPECT_TRUE(one->add(std::span(records).first(2), true));
  EXPECT_TRUE(other->add(std::span(records).last(1), true));
  EXPECT_EQ(open("a")->take(), std::vector(std::begin(records), std::end(records)));
}

TEST_F(AmbientFiles, LooksPastEveryDamage) {
  const AmbientFile::Record records[] = {numbered(1), numbered(2)};
  open("a")->add(records, true);
  const std::string whole = bytes("a");
  for (size_t cut = 0; cut < whole.size(); ++cut) {
    write("b", whole.substr(0, cut));
    const auto cutOff = open("b");
    ASSERT_TRUE(cutOff) << cut;
    EXPECT_LE(cutOff->take().size(), 1u) << cut;
    cutOff->add(std::span(records).last(1), true);
    EXPECT_EQ(open("b")->take().back(), records[1]) << cut;
  }
  for (size_t at = whole.size() - 136; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] ^= 4;
    write("b", changed);
    EXPECT_EQ(open("b")->take().size(), 1u) << at;
  }
}

TEST_F(AmbientFiles, OfOthersAreLeftAsTheyAre) {
  open("a");
  const std::string ours = bytes("a");
  EXPECT_FALSE(open("a", 3, 2));
  EXPECT_NE(warning_.find("another scene"), std::string::npos) << warning_;
  EXPECT_FALSE(open("a", 1, 3));
  EXPECT_NE(warning_.find("other options"), std::string::npos) << warning_;
  EXPECT_EQ(bytes("a"), ours);
  for (const std::string text : {"#?RADIANCE\nFORMAT=Radiance_ambval\n\n", "x", "#?RSPHERE ambient 2\n"}) {
    write("b", text);
    EXPECT_FALSE(open("b"));
    EXPECT_EQ(bytes("b"), text);
  }
  EXPECT_THROW(open("nowhere/a"), rad::Error);
}

// The file named by -af may hold the ambient values of RADIANCE's programs.
TEST_F(AmbientFiles, GoBesideTheFileThatIsNamed) {
  const auto beside = [this](const std::string& given) {
    warning_.clear();
    return AmbientFile::openBeside(given, 1, 2, [this](std::string_view text) { warning_ = text; });
  };
  const AmbientFile::Record records[] = {numbered(1)};
  beside(file("a"))->add(records, true);
  EXPECT_FALSE(std::filesystem::exists(file("a")));
  EXPECT_EQ(open("a.rsphere")->take().size(), 1u);

  const std::string theirs = "#?RADIANCE\nSOFTWARE= RADIANCE\nFORMAT=Radiance_ambval\n\nrecords";
  write("a", theirs);
  const auto before = std::filesystem::last_write_time(file("a"));
  EXPECT_EQ(beside(file("a"))->take().size(), 1u);
  EXPECT_EQ(warning_, "");
  EXPECT_EQ(bytes("a"), theirs);
  EXPECT_EQ(std::filesystem::last_write_time(file("a")), before);

  EXPECT_FALSE(beside("/dev/null"));
  EXPECT_EQ(warning_, "");
  EXPECT_FALSE(std::filesystem::exists("/dev/null.rsphere"));
  std::filesystem::create_directory(file("folder"));
  EXPECT_THROW(beside(file("folder")), rad::Error);
  EXPECT_FALSE(std::filesystem::exists(file("folder.rsphere")));
  EXPECT_THROW(beside(file("nowhere/a")), rad::Error);
  // The file beside it cannot be opened, as in a folder that nobody may write to.
  write("b", theirs);
  std::filesystem::create_directory(file("b.rsphere"));
  EXPECT_FALSE(beside(file("b")));
  EXPECT_EQ(warning_, "cannot open ambient file \"" + file("b.rsphere") +
                          "\": Is a directory: indirect light is not kept");
}

// In this room, light at places that the file contains is taken from the file alone.
TEST_F(AmbientFiles, ValuesAreTakenFromThem) {
  constexpr const char* kRoom = R"(
void plastic wall 0 0 5 .5 .5 .5 0 0
void glow sky 0 0 4 1 1 1 0
sky source dome 0 0 4 0 0 1 180
wall polygon floor 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0
)";
  RayOptions o = unbiased(1);
  o.ambientAccuracy = .2;
  o.ambientResolution = 16;
  o.ambientDivisions = 64;
  o.ambientSuperSamples = 0;
  const V3d origin(.3, .2, 1), down(.1, 0, -1);
  const double anew = Traced(kRoom, o).value(origin, down);
  o.ambientFile = file("a");
  EXPECT_EQ(Traced(kRoom, o).value(origin, down), anew);
  EXPECT_EQ(Traced(kRoom, o).value(origin, down), anew);

  // The spoiled twin: twice the light in every record.
  const std::string whole = bytes("a.rsphere");
  const auto number = [&](size_t at) { return std::stoull(whole.substr(at, 16), nullptr, 16); };
  const uint64_t scene = number(whole.find("SCENE=") + 6), options = number(whole.find("OPTIONS=") + 8);
  std::vector<AmbientFile::Record> records = open("a.rsphere", scene, options)->take();
  ASSERT_FALSE(records.empty());
  for (AmbientFile::Record& record : records) {
    float mean[3];
    std::memcpy(mean, record.data() + 32, sizeof mean);
    for (float& x : mean) x *= 2;
    std::memcpy(record.data() + 32, mean, sizeof mean);
  }
  o.ambientFile = file("b");
  open("b.rsphere", scene, options)->add(records, true);
  EXPECT_NEAR(Traced(kRoom, o).value(origin, down), 2 * anew, .01 * anew);
}

// A file is only used with the same values of all options that light depends on. The values of the others
// may differ between runs.
TEST_F(AmbientFiles, AreOfTheirOptions) {
  constexpr const char* kRoom = "void plastic wall 0 0 5 .5 .5 .5 0 0 wall sphere ball 0 0 4 0 0 0 1";
  const auto made = [&](const RayOptions& o, IrradianceAt irradiance = IrradianceAt::none,
                        bool basic = false) {
    const Scene scene = sceneOf(kRoom);
    warning_.clear();
    Transport(scene, o, irradiance, basic, [this](std::string_view text) { warning_ = text; });
    return warning_.empty();
  };
  RayOptions o;
  o.ambientBounces = 1;
  o.ambientFile = file("a");
  EXPECT_TRUE(made(o));
  EXPECT_TRUE(made(o));
  EXPECT_TRUE(made(o, IrradianceAt::point));
  EXPECT_FALSE(made(o, IrradianceAt::none, true));
  EXPECT_NE(warning_.find("other options"), std::string::npos) << warning_;
  const auto other = [&](auto change) {
    RayOptions changed = o;
    change(changed);
    return !made(changed);
  };
  EXPECT_FALSE(other([](RayOptions& c) { c.ambientWeight = 3; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.directThreshold = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.directCertainty = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.directJitter = 1; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.sourceSubstructuring = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.directRelays = 1; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.chosenSources = 1; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.directPretest = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.sourcesVisible = false; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.specularSampling = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.specularThreshold = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientBounces = 2; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientAccuracy = .2; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientResolution = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientDivisions = 2; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientSuperSamples = 0; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientValue = Radiance(Color(0, 1, 0)); }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientExcluded = {"wall"}; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.ambientIncluded = {"wall"}; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.reflectionLimit = 3; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.weightLimit = .1; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.mediumExtinction = Color(1, 0, 0); }));
  EXPECT_TRUE(other([](RayOptions& c) { c.mediumAlbedo = Color(1, 0, 0); }));
  EXPECT_TRUE(other([](RayOptions& c) { c.mediumEccentricity = .5; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.mediumSampling = 1; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.definitions = {{false, "a=1;"}}; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.backFacesVisible = false; }));
  EXPECT_TRUE(other([](RayOptions& c) { c.uncorrelated = false; }));
}

}  // namespace
}  // namespace rsphere
