#include "rcontrib/contribution_outputs.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "rays/prepared_scene.h"
#include "rcontrib/record_sums.h"
#include "tests/unit/support/command_line.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

// Modifiers a, b and so on, with so many bins each, in a scene that has none of them.
class Columns {
 public:
  explicit Columns(const std::vector<uint32_t>& bins, int64_t size = 0)
      : size_(size),
        scene_(sceneOf("void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey sphere ball 0 0 4 0 0 0 1\n")),
        prepared_(scene_, {}, IrradianceAt::none) {
    std::vector<TrackedModifier> modifiers;
    for (size_t i = 0; i < bins.size(); ++i)
      modifiers.push_back({std::string(1, static_cast<char>('a' + i)), bins[i], std::nullopt});
    tracked.emplace(prepared_, modifiers, Contributed::coefficients);
  }

  ContributionOptions options(const std::string& output, NumberFormat format) const {
    ContributionOptions options;
    options.sphereMode = false;
    options.width = options.height = size_;
    options.out = format;
    for (const TrackedModifier& modifier : tracked->modifiers()) {
      options.tracked.push_back({});
      options.tracked.back().name = modifier.name;
      options.tracked.back().output = output;
    }
    return options;
  }

  std::string names(const std::string& output, NumberFormat format = NumberFormat::float32) const {
    std::string all;
    for (const OutputPlan& plan : planOutputs(options(output, format), *tracked)) {
      all += plan.name + '(' + plan.modifier + ',' + plan.bin + ')';
      for (const ColumnRange& range : plan.columns)
        for (uint32_t i = 0; i < range.count; ++i) all += std::to_string(range.first + i);
      all += ' ';
    }
    return all;
  }

 private:
  int64_t size_;  // of pictures; 0: none
  Scene scene_;
  PreparedScene prepared_;

 public:
  std::optional<Tracked> tracked;
};

TEST(OutputNames, HaveModifiersAndBins) {
  const Columns columns({2, 1});
  EXPECT_EQ(columns.names(""), "(,)012 ");
  EXPECT_EQ(columns.names("all.dat"), "all.dat(,)012 ");
  EXPECT_EQ(columns.names("x_%s"), "x_a(a,)01 x_b(b,)2 ");
  EXPECT_EQ(columns.names("%02d.%%"), "00.%(,0)02 01.%(a,1)1 ");
  EXPECT_EQ(columns.names("%s_%3d"), "a_  0(a,0)0 a_  1(a,1)1 b_  0(b,0)2 ");
}

TEST(OutputNames, NumbersOfPicturesGoOn) {
  const Columns columns({2, 2}, 3);
  EXPECT_EQ(columns.names("%d", NumberFormat::rgbe), "0(a,0)0 1(a,1)1 2(b,2)2 3(b,3)3 ");
  EXPECT_EQ(columns.names("%s%d", NumberFormat::rgbe), "a0(a,0)0 a1(a,1)1 b0(b,0)2 b1(b,1)3 ");
}

TEST(OutputNames, PixelsWithoutAPictureShareFilesByBin) {
  EXPECT_EQ(Columns({2, 1}).names("%d", NumberFormat::rgbe), "0(,0)02 1(a,1)1 ");
}

TEST(OutputNames, AHeaderNamesTheModifierThatTheNameOfTheFileHas) {
  const Columns columns({2, 1, 1});
  EXPECT_EQ(Columns({2}).names("bins"), "bins(,)01 ");
  EXPECT_EQ(Columns({1}).names("one"), "one(a,)0 ");
  ContributionOptions options = columns.options("x_%s", NumberFormat::float32);
  options.tracked[1].output = options.tracked[2].output = "x_a";
  EXPECT_EQ(planOutputs(options, *columns.tracked)[0].modifier, "a");
  options.tracked[0].output = options.tracked[1].output = "x_c";
  options.tracked[2].output = "x_%s";
  EXPECT_EQ(planOutputs(options, *columns.tracked)[0].modifier, "");
}

TEST(OutputNames, WrongOnesAreRefused) {
  const Columns columns({2});
  for (const char* spec : {"%x", "%", "%d%d", "%s%s", "%9999d", "%n"})
    EXPECT_NE(faultOf([&] { columns.names(spec); }).find("only %s"), std::string::npos) << spec;
  ContributionOptions picture = columns.options("%s.hdr", NumberFormat::rgbe);
  picture.width = picture.height = 2;
  EXPECT_NE(faultOf([&] { planOutputs(picture, *columns.tracked); }).find("2 values at a pixel"),
            std::string::npos);
}

// A folder that the destructor removes.
class Folder {
 public:
  Folder() { EXPECT_NE(mkdtemp(path.data()), nullptr); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path = testing::TempDir() + "outputs-XXXXXX";
};

std::string rayOf(uint32_t column, double value) {
  ContributionList list(3);
  list.add(column, std::array{value, 2 * value, 3 * value});
  std::string bytes;
  appendContributions(bytes, list);
  return bytes;
}

TEST(RecordSums, AreMeansOverRaysInTheirOrder) {
  const Columns columns({2, 1});
  const Folder folder;
  ContributionOptions options = columns.options(folder.path + "/%s.txt", NumberFormat::ascii);
  options.header = false;
  ContributionOutputs outputs(options, *columns.tracked, {});
  RecordSums sums(outputs, 3, 3, 2, 0, false);
  sums.write(rayOf(1, 1) + rayOf(1, 3) + rayOf(2, 1));
  sums.write("");
  sums.write(rayOf(0, 1) + rayOf(0, 5));
  EXPECT_EQ(sums.end(), 1u);
  outputs.close();
  const std::string zero = "0.000000e+00\t0.000000e+00\t0.000000e+00\t";
  EXPECT_EQ(contents(folder.path + "/a.txt"), zero + "2.000000e+00\t4.000000e+00\t6.000000e+00\t\n" +
                                                  "5.000000e-01\t1.000000e+00\t1.500000e+00\t" + zero + "\n" +
                                                  "5.000000e+00\t1.000000e+01\t1.500000e+01\t" + zero + "\n");
  EXPECT_EQ(contents(folder.path + "/b.txt"),
            zero + "\n5.000000e-01\t1.000000e+00\t1.500000e+00\t\n" + zero + "\n");
}

TEST(RecordSums, OfAllRaysAreOneRecord) {
  const Columns columns({1});
  const Folder folder;
  ContributionOptions options = columns.options(folder.path + "/x", NumberFormat::float32);
  options.header = false;
  ContributionOutputs outputs(options, *columns.tracked, {});
  RecordSums sums(outputs, 1, 3, 0, 0, false);
  sums.write(rayOf(0, 1) + rayOf(0, 2));
  EXPECT_EQ(sums.end(), 0u);
  outputs.close();
  EXPECT_EQ(contents(folder.path + "/x"), bytesOf({3.f, 6.f, 9.f}));
}

// One ray brings variances; the error of several rays follows from their spread.
TEST(RecordSums, HaveStandardErrorsOnRequest) {
  const Columns columns({1});
  const Folder folder;
  ContributionOptions options = columns.options(folder.path + "/x", NumberFormat::float64);
  options.tracked[0].errors = folder.path + "/e";
  options.header = false;
  const auto errorsOf = [&](uint64_t rays, const std::string& bytes) {
    options.overwrites = true;
    ContributionOutputs outputs(options, *columns.tracked, {});
    RecordSums sums(outputs, 1, 3, rays, 0, true);
    sums.write(bytes);
    sums.end();
    outputs.close();
    std::vector<double> errors(3);
    const std::string found = contents(folder.path + "/e");
    EXPECT_EQ(found.size(), 3 * sizeof(double));
    std::memcpy(errors.data(), found.data(), std::min(found.size(), 3 * sizeof(double)));
    return errors;
  };
  ContributionList list(3);
  list.add(0, std::array{1., 2., 3.});
  std::string one;
  appendContributions(one, list, std::array{.25, 0., 4.});
  EXPECT_EQ(errorsOf(1, one), (std::vector<double>{.5, 0, 2}));
  // 1, 3 and 5 have the mean 3, and its variance is 4 / 3.
  const std::string three = rayOf(0, 1) + rayOf(0, 3) + rayOf(0, 5);
  EXPECT_NEAR(errorsOf(3, three)[0], std::sqrt(4. / 3), 1e-12);
  EXPECT_NEAR(errorsOf(0, three)[0], 3 * std::sqrt(4. / 3), 1e-12) << "of the sum";
  EXPECT_NEAR(errorsOf(3, three)[2], 3 * std::sqrt(4. / 3), 1e-12);
}

TEST(ContributionOutputs, FilesThatExistAreKeptOverwrittenOrCompleted) {
  const Columns columns({1, 1});
  const Folder folder;
  ContributionOptions options;
  parseCompanion(
      std::vector<std::string>{"rcontrib", "-faf", "-o", folder.path + "/%s", "-m", "a", "-m", "b", "s.oct"},
      contributionCompanion(), options);
  finish(options);
  const std::string a = folder.path + "/a", b = folder.path + "/b";
  const auto run = [&](int from, int to) {
    ContributionOutputs outputs(options, *columns.tracked, {});
    RecordSums sums(outputs, 2, 3, 1, outputs.recovered(), false);
    for (int i = from; i < to; ++i) sums.write(rayOf(i % 2, i));
    sums.end();
    outputs.close();
    return outputs.recovered();
  };
  EXPECT_EQ(run(1, 6), 0u);
  const std::string wholeA = contents(a), wholeB = contents(b);
  EXPECT_NE(wholeA.find("\nNCOMP=3\nMODIFIER=a\nNCOLS=1\n"), std::string::npos);
  EXPECT_NE(faultOf([&] { run(1, 2); }, rad::Status::system).find("already exists"), std::string::npos);
  std::filesystem::resize_file(a, wholeA.size() - 13);  // 3 records and a part
  std::filesystem::resize_file(b, wholeB.size() - 24);  // 3 records
  options.recovers = true;
  EXPECT_EQ(run(1, 6), 3u);
  EXPECT_EQ(contents(a), wholeA);
  EXPECT_EQ(contents(b), wholeB);
  options.out = NumberFormat::float64;
  EXPECT_NE(faultOf([&] { run(1, 6); }).find("its header lacks FORMAT=double"), std::string::npos);
  options.recovers = false;
  options.overwrites = true;
  EXPECT_EQ(run(1, 3), 0u);
  EXPECT_LT(contents(a).size(), wholeA.size() + 40);
}

TEST(ContributionOutputs, ACommandThatReadsNothingIsAFaultWithItsStatus) {
  std::signal(SIGPIPE, SIG_IGN);
  const Columns columns({1});
  const auto run = [&](const std::string& command) {
    const ContributionOptions options = columns.options(command, NumberFormat::ascii);
    ContributionOutputs outputs(options, *columns.tracked, {});
    const std::vector<double> record(3);
    for (int i = 0; i < 10000; ++i) outputs.write(record, {});
    outputs.close();
  };
  EXPECT_EQ(faultOf([&] { run("!exit 3"); }, rad::Status::system),
            "the command 'exit 3' ended with status 3");
  EXPECT_EQ(faultOf([&] { run("!exec <&-; exit 0"); }, rad::Status::signal),
            "the command 'exec <&-; exit 0' did not read all records");
}

TEST(ContributionOutputs, AFullDiskIsReportedWithTheNameOfTheFile) {
  const Columns columns({1});
  ContributionOptions options = columns.options("/dev/full", NumberFormat::ascii);
  EXPECT_EQ(faultOf([&] { ContributionOutputs(options, *columns.tracked, {}); }, rad::Status::system),
            "/dev/full: write error: No space left on device");
}

TEST(ContributionOutputs, ASumOfAllRaysHasNoResolution) {
  const Columns columns({1}, 2);
  const Folder folder;
  ContributionOptions options = columns.options(folder.path + "/x", NumberFormat::ascii);
  options.raysPerRecord = 0;
  ContributionOutputs(options, *columns.tracked, {}).close();
  const std::string header = contents(folder.path + "/x");
  EXPECT_NE(header.find("NCOLS=1"), std::string::npos);
  EXPECT_EQ(header.find("NROWS"), std::string::npos);
  EXPECT_EQ(header.find("-Y"), std::string::npos);
}

TEST(ContributionOutputs, ACommandThatFailsIsAFault) {
  const Columns columns({1});
  ContributionOptions options = columns.options("!cat >/dev/null; exit 3", NumberFormat::ascii);
  ContributionOutputs outputs(options, *columns.tracked, {});
  EXPECT_NE(faultOf([&] { outputs.close(); }, rad::Status::system).find("status 3"), std::string::npos);
}

}  // namespace
}  // namespace rsphere
