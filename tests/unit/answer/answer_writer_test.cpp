#include "answer/answer_writer.h"

#include "answer/column_names.h"
#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

RayAnswer someRay() {
  RayAnswer a;
  a.origin = V3d(1, 2, 3);
  a.direction = V3d(0, 0, -1);
  a.value = Radiance(Color(4, 5, 6));
  a.mirroredContribution = Radiance(Color(7, 8, 9));
  a.unmirroredContribution = Radiance(Color(10, 11, 12));
  a.mirroredLength = 13;
  a.unmirroredLength = 14;
  a.effectiveLength = 15;
  a.firstLength = 16;
  a.u = 17;
  a.v = 18;
  a.point = V3d(19, 20, 21);
  a.normal = V3d(22, 23, 24);
  a.unperturbedNormal = V3d(25, 26, 27);
  a.surface = "ball";
  a.modifier = "paint";
  a.material = "white";
  a.contribution = Coefficient(Color(.5, .25, .125));
  a.rayWeight = 27;
  a.solidAngle = 28;
  return a;
}

std::string written(std::initializer_list<const char*> words, const RayAnswer& answer, uint64_t record = 0) {
  const Options options = parse(words);
  std::string bytes;
  AnswerWriter(options).write(bytes, answer, record);
  return bytes;
}

TEST(AnswerWriter, EveryLetterOfARay) {
  const std::pair<const char*, const char*> expected[] = {
      {"-oo", "1.000000e+00\t2.000000e+00\t3.000000e+00\t\n"},
      {"-od", "0.000000e+00\t0.000000e+00\t-1.000000e+00\t\n"},
      {"-ov", "4.000000e+00\t5.000000e+00\t6.000000e+00\t\n"},
      {"-oV", "2.000000e+00\t1.250000e+00\t7.500000e-01\t\n"},
      {"-or", "7.000000e+00\t8.000000e+00\t9.000000e+00\t\n"},
      {"-ox", "1.000000e+01\t1.100000e+01\t1.200000e+01\t\n"},
      {"-oR", "1.300000e+01\t\n"},
      {"-oX", "1.400000e+01\t\n"},
      {"-ol", "1.500000e+01\t\n"},
      {"-oL", "1.600000e+01\t\n"},
      {"-oc", "1.700000e+01\t1.800000e+01\t\n"},
      {"-op", "1.900000e+01\t2.000000e+01\t2.100000e+01\t\n"},
      {"-on", "2.200000e+01\t2.300000e+01\t2.400000e+01\t\n"},
      {"-oN", "2.500000e+01\t2.600000e+01\t2.700000e+01\t\n"},
      {"-os", "ball\t\n"},
      {"-om", "paint\t\n"},
      {"-oM", "white\t\n"},
      {"-oW", "5.000000e-01\t2.500000e-01\t1.250000e-01\t\n"},
      {"-o~", "~\t\n"},
      {"-oLsL~", "1.600000e+01\tball\t1.600000e+01\t~\t\n"},
  };
  for (const auto& [letters, text] : expected)
    EXPECT_EQ(written({"rtrace", letters, "s.oct"}, someRay()), text);
}

TEST(AnswerWriter, WeightIsThatOfARayAndTheSolidAngleOfADirection) {
  const RayAnswer answer = someRay();
  EXPECT_EQ(written({"rtrace", "-ow", "s.oct"}, answer), "2.700000e+01\t\n");
  EXPECT_EQ(written({"rsphere", "-Sd", "-oiwv", "s.oct"}, answer, 12345678),
            "12345678\t2.800000e+01\t4.000000e+00\t5.000000e+00\t6.000000e+00\t\n");
}

// The output of echo 1 2 30 0 0 5 | rtrace -h -oodlLpnNsmMcwWRX~ if the ray hits nothing (RADIANCE 6.1a).
TEST(AnswerWriter, ARayThatHitsNothing) {
  const double numbers[] = {1, 2, 30, 0, 0, 5};
  EXPECT_EQ(
      written({"rtrace", "-oodlLpnNsmMcwWRX~", "s.oct"}, bogusAnswer(inputRay(numbers, IrradianceAt::none))),
      "1.000000e+00\t2.000000e+00\t3.000000e+01\t0.000000e+00\t0.000000e+00\t1.000000e+00\t1.000000e+10\t"
      "1.000000e+10\t1.000000e+00\t2.000000e+00\t3.000000e+01\t0.000000e+00\t0.000000e+00\t0.000000e+00\t"
      "0.000000e+00\t0.000000e+00\t0.000000e+00\t*\t*\t*\t0.000000e+00\t0.000000e+00\t1.000000e+00\t1."
      "000000e+00\t"
      "1.000000e+00\t1.000000e+00\t1.000000e+10\t1.000000e+10\t~\t\n");
}

TEST(AnswerWriter, RaysOfATreeAreIndented) {
  const auto branch = [](std::initializer_list<const char*> words, int ancestors) {
    const Options options = parse(words);
    std::string bytes;
    AnswerWriter(options).writeBranch(bytes, someRay(), ancestors);
    return bytes;
  };
  EXPECT_EQ(branch({"rtrace", "-ov~tmL", "s.oct"}, 2), "\t\tpaint\t1.600000e+01\t\n");
  EXPECT_EQ(branch({"rtrace", "-oTw", "s.oct"}, 0), "2.700000e+01\t\n");
  // As in rtrace, binary output has the TABs too.
  EXPECT_EQ(branch({"rtrace", "-faf", "-otX", "s.oct"}, 1), std::string("\t\0\0\x60\x41", 5));
  EXPECT_EQ(branch({"rtrace", "-otm", "-te", "paint", "s.oct"}, 1), "");
  EXPECT_EQ(branch({"rtrace", "-otm", "-te", "white", "s.oct"}, 0), "paint\t\n");
  EXPECT_EQ(branch({"rtrace", "-otm", "-ti", "paint", "s.oct"}, 0), "paint\t\n");
  EXPECT_EQ(branch({"rtrace", "-otm", "-tiother", "s.oct"}, 0), "");
  EXPECT_EQ(branch({"rtrace", "-otm", "-ti", "other", "-te", "other", "s.oct"}, 0), "paint\t\n");
  EXPECT_EQ(written({"rtrace", "-ov~tmL", "s.oct"}, someRay()),
            "4.000000e+00\t5.000000e+00\t6.000000e+00\t~\t\n");
  EXPECT_EQ(written({"rtrace", "-otmL", "s.oct"}, someRay()), "");
}

// Rays that hit nothing have no modifier to include or exclude.
TEST(AnswerWriter, RaysThatHitNothingAreOnlyInTreesWithoutAList) {
  const auto branch = [](std::initializer_list<const char*> words) {
    const Options options = parse(words);
    std::string bytes;
    AnswerWriter(options).writeBranch(bytes, RayAnswer{}, 0);
    return bytes;
  };
  EXPECT_EQ(branch({"rtrace", "-otm", "s.oct"}), "*\t\n");
  EXPECT_EQ(branch({"rtrace", "-otm", "-te", "paint", "s.oct"}), "*\t\n");
  EXPECT_EQ(branch({"rtrace", "-otm", "-ti", "paint", "s.oct"}), "");
}

TEST(AnswerWriter, EveryLetterOfAPoint) {
  PointAnswer a;
  a.point = V3d(1, 2, 3);
  a.mean = Radiance(Color(4, 5, 6));
  a.standardError = Radiance(Color(7, 8, 9));
  a.scalarIrradiance = Irradiance(Color(10, 11, 12));
  a.cylindricalIrradiance = Irradiance(Color(13, 14, 15));
  for (int i = 0; i < 6; ++i) a.facing[i] = Irradiance(Color(20 + i, 30 + i, 40 + i));
  a.lightVector = V3d(16, 17, 18);
  a.directions = 123456789;
  const Options options = parse({"rsphere", "-fad", "-ooveECHu", "s.oct"});
  EXPECT_EQ(componentCount(options), 36);
  std::string bytes;
  AnswerWriter(options).write(bytes, a);
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(numbers.data()));
  EXPECT_EQ(numbers,
            (std::vector<double>{1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 20, 30, 40,
                                 21, 31, 41, 22, 32, 42, 23, 33, 43, 24, 34, 44, 25, 35, 45, 16, 17, 18}));
  bytes.clear();
  const Options count = parse({"rsphere", "-ok", "s.oct"});
  AnswerWriter(count).write(bytes, a);
  EXPECT_EQ(bytes, "123456789\t\n");
}

// In bands each has its own standard error; that of luminance is that of the brightness.
TEST(AnswerWriter, PointsInBands) {
  const Options options = parse({"rsphere", "-fad", "-cs", "4", "-co", "-oveHu", "s.oct"});
  const auto bandsOf = [&](std::initializer_list<double> values) {
    Bands bands(*options.ray.sampling);
    std::copy(values.begin(), values.end(), bands.values().begin());
    return Color(bands);
  };
  PointAnswer a;
  a.mean = Radiance(bandsOf({1, 2, 3, 4}));
  a.standardError = Radiance(bandsOf({5, 6, 7, 8}));
  a.brightnessError = 2;
  for (Irradiance& face : a.facing) face = Irradiance(Color(3, 2, 1));  // red, red, green, blue
  a.lightVector = V3d(16, 17, 18);
  const auto numbersOf = [&](const Options& given) {
    std::string bytes;
    AnswerWriter(given).write(bytes, a);
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(numbers.data()));
    EXPECT_EQ(static_cast<size_t>(componentCount(given)), numbers.size());
    return numbers;
  };
  std::vector<double> expected{1, 2, 3, 4, 5, 6, 7, 8};
  for (int i = 0; i < 6; ++i) expected.insert(expected.end(), {3, 3, 2, 1});
  expected.insert(expected.end(), {16, 17, 18});
  EXPECT_EQ(numbersOf(options), expected);
  EXPECT_EQ(numbersOf(parse({"rsphere", "-fad", "-cs", "4", "-pY", "-oe", "s.oct"})),
            (std::vector<double>{358}));
}

TEST(AnswerWriter, PixelsAreFourBytes) {
  std::string bytes;
  const Options options = parse({"rsphere", "-fac", "s.oct"});
  PointAnswer answer;
  answer.mean = Radiance(Color(1, 1, 1));
  AnswerWriter(options).write(bytes, answer);
  EXPECT_EQ(bytes, "\x80\x80\x80\x81");
}

// rtrace -ovodwWcsmMlLpnNrRxX of RADIANCE 6.1a writes NCOMP=37.
TEST(AnswerWriter, ComponentsAreCountedAsInRtrace) {
  EXPECT_EQ(componentCount(parse({"rtrace", "-ovodwWcsmMlLpnNrRxX~", "s.oct"})), 37);
  EXPECT_EQ(componentCount(parse({"rtrace", "s.oct"})), 3);
  EXPECT_EQ(componentCount(parse({"rsphere", "-Sd", "s.oct"})), 10);
}

// printf '0 0 0 0 0 0 0 0 5 0 0 -2 0 0 0 0 0 0' | rtrace -h -I -oodpv (6.1a): the answer to a bogus record
// shows the ray before it as it was traced, or zeros if there is none.
// A letter that the command line accepts but the writer does not know would leave out its columns without a
// message.
TEST(AnswerWriter, EveryLetterThatIsAcceptedIsWrittenAndInTheManual) {
  const std::string manual = contents(std::string(RSPHERE_TESTS) + "/../man/rsphere.1");
  const std::vector<std::string> modes[] = {{"rtrace"}, {"rsphere"}, {"rsphere", "-Sd"}};
  for (const std::vector<std::string>& mode : modes) {
    int accepted = 0;
    for (char letter = '!'; letter <= '~'; ++letter) {
      std::vector<std::string> words = mode;
      words.insert(words.end(), {std::string("-o") + letter, "s.oct"});
      Options options;
      try {
        options = parseOptions(words);
      } catch (const rad::Error&) {
        continue;
      }
      if (options.outputs.empty()) continue;  // t and T begin the letters of a tree
      ++accepted;
      std::string record;
      if (options.sphereMode && !options.sphere.everyDirection)
        AnswerWriter(options).write(record, PointAnswer{});
      else
        AnswerWriter(options).write(record, someRay());
      const int columns = componentCount(options);
      EXPECT_EQ(std::count(record.begin(), record.end(), '\t'), letter == '~' ? 1 : columns) << letter;
      if (options.sphere.everyDirection) continue;  // the manual describes these in sentences
      const std::string row = letter + std::string(options.sphereMode && columns < 10 ? "  " : " ") +
                              std::to_string(columns) + "  ";
      EXPECT_NE(manual.find(row), std::string::npos) << letter;
    }
    EXPECT_GT(accepted, 7);
  }
}

TEST(InputRay, SensorsAreTracedFromAboveThem) {
  const double sensor[] = {0, 0, 5, 0, 0, -2}, nothing[] = {0, 0, 0, 0, 0, 0};
  const InputRay ray = inputRay(sensor, IrradianceAt::point);
  EXPECT_EQ(ray.origin, V3d(0, 0, 5 - 1.1e-4));
  EXPECT_EQ(ray.direction, V3d(0, 0, 1));
  EXPECT_EQ(ray.length, 2);
  EXPECT_EQ(
      written({"rtrace", "-I", "-oodpv", "s.oct"}, bogusAnswer(ray)),
      "0.000000e+00\t0.000000e+00\t4.999890e+00\t-0.000000e+00\t-0.000000e+00\t1.000000e+00\t0.000000e+00\t"
      "0.000000e+00\t4.999890e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t\n");
  EXPECT_EQ(
      written({"rtrace", "-I", "-oodv", "s.oct"}, bogusAnswer(inputRay(nothing, IrradianceAt::point))),
      "0.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t"
      "0.000000e+00\t0.000000e+00\t\n");
  EXPECT_EQ(inputRay(sensor, IrradianceAt::none).direction, V3d(0, 0, -1));
}

}  // namespace
}  // namespace rsphere
