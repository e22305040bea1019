#include "rsphere/scene.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>
#include <thread>

namespace {

using rsphere::Error;
using rsphere::Options;
using rsphere::Quantity;
using rsphere::Scene;

const std::string kRoom = std::string(RSPHERE_TESTS) + "/cli/same-bytes-interpolated/small_room.rad";
const std::string kSpectral = std::string(RSPHERE_TESTS) + "/scenes/spectral/room.rad";
const std::string kFurnace = std::string(RSPHERE_TESTS) + "/../examples/minimal/furnace.rad";

// A folder that goes with the test.
class Folder {
 public:
  Folder() { EXPECT_TRUE(mkdtemp(path_.data())); }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ + "/" + name, std::ios::binary) << text;
    return path_ + "/" + name;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = "/tmp/rsphere_api_XXXXXX";
};

// The numbers that the command writes for binary records.
std::vector<double> command(const std::string& program, const std::string& options,
                            std::span<const double> records) {
  const Folder folder;
  const std::string input = folder.write(
      "in", std::string(reinterpret_cast<const char*>(records.data()), records.size() * sizeof(double)));
  const std::string output = folder.path() + "/out";
  const std::string line =
      std::string(RSPHERE_PROGRAMS) + "/" + program + " -h -fdd " + options + " <" + input + " >" + output;
  EXPECT_EQ(std::system(line.c_str()), 0) << line;
  std::ifstream file(output, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  std::vector<double> numbers(bytes.str().size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.str().data(), numbers.size() * sizeof(double));
  return numbers;
}

// Whether the quantities, side by side, are bit by bit the columns of the command's output.
void expectSame(const std::vector<double>& wanted, size_t records,
                const std::vector<const Quantity*>& quantities) {
  std::vector<double> found;
  for (size_t i = 0; i < records; ++i)
    for (const Quantity* q : quantities) found.insert(found.end(), (*q)[i].begin(), (*q)[i].end());
  ASSERT_EQ(found.size(), wanted.size());
  EXPECT_EQ(std::memcmp(found.data(), wanted.data(), found.size() * sizeof(double)), 0);
}

std::vector<rsphere::Ray> someRays() {
  std::vector<rsphere::Ray> rays;
  for (int i = 0; i < 60; ++i)
    rays.push_back({{.1 + i * .04, 1.3, .4 + i * .03}, {std::cos(i), std::sin(i), std::cos(3 * i)}});
  rays[20].direction = {0, 0, 0};  // as in rtrace: that of the ray before, as if it hit nothing
  return rays;
}
std::span<const double> numbersOf(std::span<const rsphere::Ray> rays) {
  return {rays[0].origin.data(), 6 * rays.size()};
}
std::span<const double> numbersOf(std::span<const rsphere::Point> points) {
  return {points[0].data(), 3 * points.size()};
}

std::string faultOf(const std::function<void()>& action, Error::Cause cause = Error::Cause::input) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.cause(), cause) << error.what();
    return error.what();
  }
  return "no fault";
}

TEST(Version, IsThatOfTheHeaders) {
  const std::string numbers = std::to_string(RSPHERE_VERSION_MAJOR) + "." +
                              std::to_string(RSPHERE_VERSION_MINOR) + "." +
                              std::to_string(RSPHERE_VERSION_PATCH);
  const std::string version = rsphere::version();
  EXPECT_EQ(version.substr(0, version.find('-')), numbers);
}

TEST(Scene, RaysHaveTheBytesOfTheCommand) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Ray> rays = someRays();
  Options options;
  options.ambientBounces = 2;
  options.ambientDivisions = 16;
  options.ambientAccuracy = .2;
  options.limitWeight = 1e-3;
  options.outputs = "vodpnNLlcwWVrRxX";
  const rsphere::RayAnswers a = scene.trace(rays, options);
  ASSERT_EQ(a.size, rays.size());
  EXPECT_TRUE(a.surface.empty());
  expectSame(
      command("rtrace", "-w -ab 2 -ad 16 -aa .2 -lw 1e-3 -ovodpnNLlcwWVrRxX " + kRoom, numbersOf(rays)),
      a.size,
      {&a.value, &a.origin, &a.direction, &a.point, &a.normal, &a.unperturbedNormal, &a.firstLength,
       &a.effectiveLength, &a.localCoordinates, &a.weight, &a.coefficient, &a.contribution, &a.mirroredValue,
       &a.mirroredLength, &a.unmirroredValue, &a.unmirroredLength});
}

TEST(Scene, PointsHaveTheBytesOfTheCommand) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}, {1.5, 2.5, 2}, {2, 1, .3}};
  Options options;
  options.ambientBounces = 1;
  options.directions = 256;
  options.mostDirections = 600;
  options.rotation = 3;
  const rsphere::PointAnswers a = scene.sphere(points, options);
  EXPECT_EQ(a.point.columns, 0u);
  EXPECT_EQ(a.faceIrradiance.columns, 18u);
  expectSame(command("rsphere", "-ab 1 -Sn 256 -Sx 600 -Sr 3 -oveECHuk " + kRoom, numbersOf(points)), a.size,
             {&a.mean, &a.meanStandardError, &a.scalarIrradiance, &a.cylindricalIrradiance, &a.faceIrradiance,
              &a.lightVector, &a.directions});
}

// A letter of the command without a member of PointAnswers would be read as a name.
TEST(Scene, EveryLetterOfAPointHasItsQuantity) {
  const Scene scene({kRoom});
  const rsphere::Point point{.5, .5, 1};
  Options options;
  options.directions = 64;
  options.zones = 2;
  options.outputs = "!";
  const std::string before = "the letters are ";
  std::string letters = faultOf([&] { scene.sphere({&point, 1}, options); });
  ASSERT_NE(letters.find(before), letters.npos) << letters;
  letters = letters.substr(letters.find(before) + before.size());
  letters =
      letters.substr(0, letters.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"));
  EXPECT_GT(letters.size(), 10u);
  for (const char letter : letters) {
    options.outputs = letter;
    const rsphere::PointAnswers a = scene.sphere({&point, 1}, options);
    int found = 0;
    for (const Quantity* q : {&a.mean, &a.meanStandardError, &a.scalarIrradiance, &a.cylindricalIrradiance,
                              &a.semicylindricalIrradiance, &a.hemisphericalIrradiance, &a.faceIrradiance,
                              &a.lightVector, &a.directions, &a.zones, &a.zonesStandardError, &a.point})
      found += q->columns > 0;
    EXPECT_EQ(found, 1) << letter;
  }
  // e is the error of the quantity before it, in as many columns.
  options.outputs = "EeCeSeheHeueze";
  const rsphere::PointAnswers a = scene.sphere({&point, 1}, options);
  const std::pair<const Quantity*, const Quantity*> errors[] = {
      {&a.scalarIrradiance, &a.scalarIrradianceStandardError},
      {&a.cylindricalIrradiance, &a.cylindricalIrradianceStandardError},
      {&a.semicylindricalIrradiance, &a.semicylindricalIrradianceStandardError},
      {&a.hemisphericalIrradiance, &a.hemisphericalIrradianceStandardError},
      {&a.faceIrradiance, &a.faceIrradianceStandardError},
      {&a.lightVector, &a.lightVectorStandardError},
      {&a.zones, &a.zonesStandardError}};
  for (const auto& [quantity, error] : errors) {
    EXPECT_GT(error->columns, 0);
    EXPECT_EQ(error->columns, quantity->columns);
  }
  EXPECT_EQ(a.meanStandardError.columns, 0);
}

TEST(Scene, TakesAllOptionsOfTheCommand) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Ray> rays = someRays();
  Options options;
  options.irradianceAtOrigin = true;
  options.ambientBounces = 3;  // the later one prevails
  options.arguments = {"-ab", "1", "-u+", "-ds", ".1"};
  const rsphere::RayAnswers colors = scene.trace(rays, options);
  options.arguments.push_back("-pY");
  const rsphere::RayAnswers a = scene.trace(rays, options);
  EXPECT_EQ(a.value.columns, 1u);
  expectSame(command("rtrace", "-I -ab 1 -pY -u+ -ds .1 " + kRoom, numbersOf(rays)), a.size, {&a.value});
  EXPECT_NEAR(rsphere::photometric(colors.value[5]), a.value[5][0], 1e-12 * a.value[5][0]);
}

TEST(Scene, ColorsWithoutStandardErrors) {
  const Scene scene({kFurnace});
  const rsphere::Point point{0, 0, 0};
  Options options;
  options.directions = 100;
  options.arguments = {"-pA"};
  const rsphere::PointAnswers a = scene.sphere({&point, 1}, options);
  EXPECT_EQ(a.meanStandardError.columns, 0u);
  EXPECT_NEAR(a.mean[0][0], 1, 1e-9);
  options.outputs = "ve";
  EXPECT_EQ(faultOf([&] { scene.sphere({&point, 1}, options); }).find("-oe needs -pRGB or -pY"), 0u);
}

// Function files, data and pictures are read when a ray first meets them.
TEST(Scene, ThreadsMeetAPatternForTheFirstTimeTogether) {
  setenv("RAYPATH", (std::string(RSPHERE_TESTS) + "/scenes/patterns").c_str(), 1);
  const Folder folder;
  const std::string file =
      folder.write("painted.rad",
                   "void colorpict P\n7 red green blue small.hdr . Px/4+.5 Py/4+.5\n0\n0\n"
                   "P mixfunc N\n4 void void wave shading.cal\n0\n0\nN glow M\n0\n0\n4 1 1 1 0\n"
                   "M polygon floor\n0\n0\n12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n");
  const std::vector<rsphere::Ray> rays(8, {{1, 1.5, 3}, {0, 0, -1}});
  for (int round = 0; round < 10; ++round) {
    const Scene scene({file});
    Options options;
    options.threads = 4;
    const auto answers = scene.trace(rays, options);
    EXPECT_GT(answers.value[0][0], 0);
    for (size_t i = 1; i < rays.size(); ++i) EXPECT_EQ(answers.value[i][0], answers.value[0][0]);
  }
  unsetenv("RAYPATH");
}

// In a spectral run, colors have as many columns as there are bands with -co, also when the same scene was
// asked in three channels before.
TEST(Scene, SpectraHaveTheBytesOfTheCommand) {
  const Scene scene({kSpectral});
  const std::vector<rsphere::Ray> rays = someRays();
  const std::vector<rsphere::Point> points{{1, 1, 1}, {3, 2.5, 2}};
  Options options;
  options.outputs = "vWL";
  EXPECT_EQ(scene.trace(rays, options).value.columns, 3u);
  options.arguments = {"-cs", "12", "-co"};
  const rsphere::RayAnswers a = scene.trace(rays, options);
  EXPECT_EQ(a.value.columns, 12u);
  EXPECT_EQ(a.coefficient.columns, 12u);
  expectSame(command("rtrace", "-w -cs 12 -co -ovWL " + kSpectral, numbersOf(rays)), a.size,
             {&a.value, &a.coefficient, &a.firstLength});
  options.outputs.clear();
  options.directions = 256;
  options.mostDirections = 600;
  const rsphere::PointAnswers bands = scene.sphere(points, options);
  EXPECT_EQ(bands.mean.columns, 12u);
  EXPECT_EQ(bands.meanStandardError.columns, 12u);
  EXPECT_EQ(bands.faceIrradiance.columns, 72u);
  EXPECT_EQ(bands.lightVector.columns, 3u);
  expectSame(command("rsphere", "-Sn 256 -Sx 600 -cs 12 -co -oveECHuk " + kSpectral, numbersOf(points)),
             bands.size,
             {&bands.mean, &bands.meanStandardError, &bands.scalarIrradiance, &bands.cylindricalIrradiance,
              &bands.faceIrradiance, &bands.lightVector, &bands.directions});
  options.arguments = {"-cs", "12"};
  const rsphere::PointAnswers colors = scene.sphere(points, options);
  EXPECT_EQ(colors.mean.columns, 3u);
  EXPECT_EQ(colors.meanStandardError.columns, 0u);
}

TEST(Scene, AnswersDependNeitherOnThreadsNorOnOtherCalls) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Ray> rays = someRays();
  Options options;
  options.ambientBounces = 2;
  options.ambientAccuracy = .2;
  options.ambientDivisions = 32;
  options.threads = 1;
  const std::vector<double> wanted = scene.trace(rays, options).value.numbers;
  EXPECT_EQ(scene.trace(rays, options).value.numbers, wanted);
  std::vector<std::vector<double>> found(6);
  {
    std::vector<std::jthread> callers;
    for (size_t i = 0; i < found.size(); ++i)
      callers.emplace_back([&, i] {
        Options own = options;
        own.threads = static_cast<int>(i / 2 + 1);
        found[i] = scene.trace(rays, own).value.numbers;
      });
  }
  for (const auto& numbers : found) EXPECT_EQ(numbers, wanted);
  Options others;
  others.rotation = 1;
  others.ambientBounces = 2;
  others.ambientDivisions = 32;
  EXPECT_NE(scene.trace(rays, others).value.numbers, wanted);
  const rsphere::RayAnswers one = scene.trace({&rays[7], 1}, options);
  EXPECT_EQ(one.value.numbers, std::vector<double>(wanted.begin() + 21, wanted.begin() + 24));
}

TEST(Scene, NamesWhatARayHits) {
  const Scene scene({kRoom});
  const rsphere::Ray rays[] = {
      {{1.5, 1.5, 2}, {0, 0, 1}}, {{1.5, 1.5, 2}, {0, 0, -1}}, {{9, 9, 9}, {1, 0, 0}}};
  Options options;
  options.outputs = "sL~mM";
  const rsphere::RayAnswers a = scene.trace(rays, options);
  EXPECT_EQ(a.surface, (std::vector<std::string>{"ceiling", "ball", "*"}));
  EXPECT_EQ(a.modifier, (std::vector<std::string>{"wall", "steel", "*"}));
  EXPECT_EQ(a.material, (std::vector<std::string>{"wall", "steel", "*"}));
  EXPECT_NEAR(a.firstLength[1][0], .6, 1e-9);
  EXPECT_EQ(a.firstLength[2][0], 1e10);
  EXPECT_TRUE(a.value.numbers.empty());
}

TEST(Scene, TheMeanInAFurnaceIsItsRadiance) {
  const Scene scene({kFurnace});
  const rsphere::Point point{0, 0, 0};
  Options options;
  options.directions = 100;
  const rsphere::PointAnswers a = scene.sphere({&point, 1}, options);
  EXPECT_NEAR(a.mean[0][1], 1, 1e-9);
  EXPECT_NEAR(a.scalarIrradiance[0][1], std::numbers::pi, 1e-8);
  EXPECT_NEAR(rsphere::photometric(a.mean[0]), 179, 1e-6);
  EXPECT_LT(a.meanStandardError[0][1], 1e-6);
}

TEST(Scene, NothingToAnswer) {
  const Scene scene({kFurnace});
  EXPECT_EQ(scene.trace({}).size, 0u);
  EXPECT_EQ(scene.sphere({}).size, 0u);
  EXPECT_EQ(scene.sphere({}).mean.columns, 3u);
}

TEST(Error, HasFileAndLine) {
  const Folder folder;
  const std::string file =
      folder.write("a:b 7.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0\n\nwall sphere ball 0 0 4 0 0 0 1\n");
  try {
    const Scene scene({file});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.cause(), Error::Cause::input);
    EXPECT_EQ(error.file(), file);
    EXPECT_EQ(error.line(), 3);
    EXPECT_EQ(std::string(error.what()).find(file + ":3: undefined modifier \"wall\""), 0u) << error.what();
  }
  for (const auto& [text, name] :
       {std::pair("room.rad: cannot open scene file: No such file", "room.rad"),
        std::pair("in.rad (from room.rad:3): cannot open scene file: No such file", "in.rad"),
        std::pair("room.oct: object 3: texfunc \"t\": cannot open function file", "")}) {
    const Error notOpened(text, Error::Cause::system);
    EXPECT_EQ(notOpened.file(), name);
    EXPECT_EQ(notOpened.line(), 0);
  }
  const Error without("cannot do it at 12:30", Error::Cause::system);
  EXPECT_EQ(without.file(), "");
  EXPECT_EQ(without.line(), 0);
}

TEST(Error, OfFilesThatAreNotThere) {
  const std::string fault = faultOf([] { Scene({"/no/such/room.rad"}); }, Error::Cause::system);
  EXPECT_NE(fault.find("/no/such/room.rad"), std::string::npos) << fault;
  EXPECT_NE(faultOf([] { Scene(std::vector<std::string>{}); }).find("at least one file"), std::string::npos);
}

TEST(Error, OfOptions) {
  const Scene scene({kFurnace});
  const rsphere::Point points[] = {{0, 0, 0}};
  const auto fault = [&](std::vector<std::string> arguments) {
    Options options;
    options.arguments = std::move(arguments);
    return faultOf([&] { scene.sphere(points, options); });
  };
  EXPECT_EQ(fault({"-ab", "x"}).find("command line error at '-ab': \"x\" is not a whole number"), 0u);
  EXPECT_EQ(fault({"-zz"}).find("command line error at '-zz'"), 0u);
  EXPECT_EQ(fault({"room.rad"}), "\"room.rad\" is not an option: options begin with a hyphen");
  EXPECT_EQ(fault({"-bv", "7"}),
            "\"7\" is not an option: options begin with a hyphen, and -bv takes no value");
  for (const std::string option : {"-S", "-Sd", "-Sl", "-Sc"})
    EXPECT_EQ(fault({option}).find("option '" + option + "': "), 0u) << fault({option});
  EXPECT_EQ(fault({"-Sg", "goal"}).find("option '-Sg': "), 0u);
  EXPECT_NE(fault({"-help"}).find("not for the library"), std::string::npos);
  EXPECT_EQ(fault({"-ov"}), "no fault");
  Options trees;
  trees.outputs = "v~tW";
  EXPECT_EQ(faultOf([&] { scene.trace({}, trees); }).find("option '-ot': "), 0u);
  trees.outputs = "vt";
  EXPECT_EQ(faultOf([&] { scene.trace({}, trees); }).find("option '-ot': "), 0u);
}

TEST(Error, OfTheFirstRecordThatIsNotFinite) {
  const Scene scene({kFurnace});
  std::vector<rsphere::Point> points(50, {0, 0, 0});
  points[40][1] = std::numeric_limits<double>::infinity();
  points[17][2] = std::numeric_limits<double>::quiet_NaN();
  Options options;
  options.directions = 16;
  options.threads = 3;
  for (int repeat = 0; repeat < 5; ++repeat)
    EXPECT_EQ(faultOf([&] { scene.sphere(points, options); }), "points[17]: nan is not a finite number");
  points[17][2] = points[40][1] = 0;
  EXPECT_EQ(scene.sphere(points, options).size, points.size());
}

TEST(Warn, GetsThemOnTheCallersThread) {
  const Folder folder;
  const std::string file =
      folder.write("dark.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey sphere ball 0 0 4 0 0 0 1\n");
  const Scene scene({file});
  std::vector<std::string> texts;
  Options options;
  options.warn = [&, caller = std::this_thread::get_id()](std::string_view text) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    texts.emplace_back(text);
  };
  const rsphere::Ray rays[] = {{{0, 0, 3}, {0, 0, -1}}};
  scene.trace(rays, options);
  EXPECT_EQ(texts, std::vector<std::string>{"no light sources found"});
}

TEST(SceneOptions, UntrustedScenesRunNoCommands) {
  const Folder folder;
  const std::string file = folder.write("scene.rad", "!echo void plastic grey 0 0 5 .5 .5 .5 0 0\n");
  EXPECT_EQ(faultOf([&] { Scene scene({file}); }), "no fault");
  rsphere::SceneOptions options;
  options.commands = false;
  EXPECT_EQ(faultOf([&] { Scene scene({file}, options); }).find(file + ":1: "), 0u);
}

TEST(SceneOptions, GoalsEmit) {
  rsphere::SceneOptions options;
  options.goals = {"steel"};
  const Scene scene({kRoom}, options);
  const rsphere::Ray rays[] = {{{1.5, 1.5, 2}, {0, 0, -1}}};
  EXPECT_GE(scene.trace(rays).value[0][0], 1);
}

TEST(Importance, HasTheBytesOfTheCommand) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}, {1.5, 2.5, 2}};
  Options options;
  options.ambientBounces = 1;
  options.directions = 256;
  options.zones = 12;
  const rsphere::PointAnswers a = scene.importance(points, {"steel", "wall"}, options);
  EXPECT_EQ(a.contributors, (std::vector<std::string>{"steel", "wall"}));
  EXPECT_EQ(a.mean.columns, 6u);
  EXPECT_EQ(a.zones.columns, 72u);
  EXPECT_EQ(a.zoneCount, 12u);
  expectSame(command("rsphere", "-ab 1 -Sn 256 -Sz 12 -Sg steel -Sg wall -Sp -oveECHukzZ " + kRoom,
                     numbersOf(points)),
             a.size,
             {&a.mean, &a.meanStandardError, &a.scalarIrradiance, &a.cylindricalIrradiance, &a.faceIrradiance,
              &a.lightVector, &a.directions, &a.zones, &a.zonesStandardError});
}

TEST(Importance, OfSensorsHasTheBytesOfTheCommand) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}, {1.5, 2.5, 2}};
  const std::vector<rsphere::Sensor> sensors{{{1, 1, .8}, {0, 0, 2}}, {{1, 2, 1.2}, {1, 0, 0}}};
  const Folder folder;
  const std::string file = folder.write("sensors", "1 1 .8  0 0 2\n1 2 1.2  1 0 0\n");
  Options options;
  options.ambientBounces = 1;
  options.directions = 256;
  options.zones = 12;
  const rsphere::PointAnswers a = scene.importanceOfSensors(points, sensors, options);
  EXPECT_EQ(a.contributors, (std::vector<std::string>{"sensor1", "sensor2"}));
  EXPECT_EQ(a.zones.columns, 72u);
  expectSame(
      command("rsphere", "-ab 1 -Sn 256 -Sz 12 -SG " + file + " -Sp -oveECHukzZ " + kRoom, numbersOf(points)),
      a.size,
      {&a.mean, &a.meanStandardError, &a.scalarIrradiance, &a.cylindricalIrradiance, &a.faceIrradiance,
       &a.lightVector, &a.directions, &a.zones, &a.zonesStandardError});
}

TEST(Importance, RefusesSensorsThatAreNone) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}};
  const std::vector<rsphere::Sensor> nowhere{{{1, 1, 1}, {0, 0, 1}}, {{1, 1, 1}, {0, 0, 0}}};
  EXPECT_EQ(faultOf([&] { scene.importanceOfSensors(points, {}); }),
            "importanceOfSensors() needs at least one sensor");
  EXPECT_EQ(faultOf([&] { scene.importanceOfSensors(points, nowhere); }),
            "sensors: sensor 2: the direction that it faces is 0 0 0");
  Options options;
  options.arguments = {"-Sw", "h"};
  EXPECT_EQ(faultOf([&] { scene.importanceOfSensors(points, std::span(nowhere).first(1), options); }),
            "sensors need -Sw c, which aims at them");
}

// Goals belong to a call: the scene has its lamps before and after it.
TEST(Importance, LeavesTheSceneAsItIs) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}};
  Options options;
  options.ambientBounces = 1;
  options.directions = 64;
  const auto light = [&] { return scene.sphere(points, options).mean.numbers; };
  const auto before = light();
  const auto steel = scene.importance(points, {"steel"}, options).mean.numbers;
  const auto both = scene.importance(points, {"wall", "steel"}, options);
  EXPECT_EQ(scene.importance(points, {"steel"}, options).mean.numbers, steel);
  EXPECT_EQ(light(), before);
  EXPECT_EQ(both.mean.columns, 6u);
}

TEST(Importance, OfLampsIsWhatTheyGive) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}};
  Options options;
  options.directions = 64;
  options.outputs = "v";
  const rsphere::PointAnswers sum = scene.sphere(points, options);
  options.arguments = {"-Sp"};
  const rsphere::PointAnswers parts = scene.sphere(points, options);
  EXPECT_EQ(parts.contributors, std::vector<std::string>{"bulb"});
  EXPECT_NEAR(parts.mean[0][0], sum.mean[0][0], 1e-12 * sum.mean[0][0]);
}

TEST(Importance, RefusesGoalsThatAreNone) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points{{.5, .5, 1}};
  EXPECT_EQ(faultOf([&] { scene.importance(points, {}); }),
            "importance() needs the modifier of at least one goal");
  EXPECT_EQ(faultOf([&] {
              scene.importance(points, {"stee"});
            }).find("no surface has the goal's modifier \"stee\""),
            0u);
  EXPECT_EQ(faultOf([&] {
              scene.importance(points, {"steel", "steel"});
            }),
            "-Sg steel: the goal is given twice");
}

// Eyes in the middle of the room; the lamp is a glare source for those who look at it.
std::vector<rsphere::Ray> someEyes() {
  std::vector<rsphere::Ray> eyes;
  for (int i = 0; i < 6; ++i) eyes.push_back({{.5 + .2 * i, 1.3, 1.2}, {std::cos(i), std::sin(i), .5}});
  return eyes;
}

TEST(Glare, HasTheBytesOfTheCommand) {
  const Scene scene({kRoom});
  Options options;
  options.ambientBounces = 1;
  options.directions = 64;
  const rsphere::GlareAnswers a = scene.glare(someEyes(), options);
  ASSERT_EQ(a.size, 6u);
  const std::string line = "-Su -ab 1 -Sn 64 ";
  expectSame(
      command("rsphere", line + "-ouUvVbBgGt " + kRoom, numbersOf(someEyes())), a.size,
      {&a.unifiedGlareRating, &a.ugrStandardError, &a.illuminance, &a.illuminanceStandardError, &a.background,
       &a.backgroundStandardError, &a.daylightGlareProbability, &a.dgpStandardError, &a.threshold});
  std::vector<double> sources;
  for (const auto& ofEye : a.sources)
    for (const rsphere::GlareSource& s : ofEye) {
      sources.insert(sources.end(), s.direction.begin(), s.direction.end());
      sources.insert(sources.end(), {s.luminance, s.luminanceStandardError, s.solidAngle,
                                     s.solidAngleStandardError, s.positionIndex});
      EXPECT_TRUE(s.surface == "lamp1" || s.surface == "lamp2" || s.surface == "ball") << s.surface;
    }
  EXPECT_FALSE(sources.empty());
  EXPECT_EQ(sources, command("rsphere", line + "-Sd -odlLwWp " + kRoom, numbersOf(someEyes())));
  options.outputs = "g";
  const rsphere::GlareAnswers one = scene.glare(someEyes(), options);
  EXPECT_EQ(one.daylightGlareProbability.numbers, a.daylightGlareProbability.numbers);
  EXPECT_TRUE(one.unifiedGlareRating.numbers.empty());
  EXPECT_EQ(one.sources.size(), 6u);
}

TEST(Glare, RefusesWhatItCannotAnswer) {
  const Scene scene({kRoom});
  const auto fault = [&](const rsphere::Ray& eye, const Options& options = {}) {
    return faultOf([&] { scene.glare(std::vector{eye}, options); });
  };
  EXPECT_EQ(fault({{1, 1, 1}, {0, 0, 1}}),
            "record 1: the gaze 0 0 1 is vertical, so that the view has no upward direction: tilt it");
  EXPECT_EQ(fault({{1, 1, 1}, {0, 0, 0}}),
            "record 1: the gaze 0 0 0 has no length: it is a direction, not a point");
  EXPECT_EQ(fault({{1, 1, 1}, {0, NAN, 0}}), "eyes[0]: nan is not a finite number");
  Options options;
  options.outputs = "n";
  EXPECT_NE(fault({{1, 1, 1}, {0, 1, 0}}, options).find("'-o'"), std::string::npos);
  options.outputs.clear();
  options.zones = 3;
  EXPECT_NE(fault({{1, 1, 1}, {0, 1, 0}}, options).find("'-Sz'"), std::string::npos);
  options = {};
  options.arguments = {"-Su"};
  EXPECT_NE(faultOf([&] {
              scene.sphere(std::vector<rsphere::Point>{{1, 1, 1}}, options);
            }).find("'-Su'"),
            std::string::npos);
  EXPECT_TRUE(scene.glare({}).sources.empty());
}

TEST(Contributions, AddUpToTheValueOfTheRay) {
  const Scene scene({kRoom});
  std::vector<rsphere::Ray> rays = someRays();
  rsphere::ContributionOptions options;
  options.ambientBounces = 2;
  options.ambientDivisions = 16;
  options.samples = 1;
  options.arguments = {"-u+"};  // rcontrib's default
  const rsphere::Contributions one = scene.contributions(rays, {"bulb", "nothing"}, options);
  ASSERT_EQ(one.size, rays.size());
  EXPECT_EQ(one.standardError.columns, 0u);
  // The same random numbers as the command's.
  const std::vector<double> wanted =
      command("rcontrib", "-V+ -ab 2 -ad 16 -m bulb -m nothing " + kRoom, numbersOf(rays));
  expectSame(wanted, one.size, {&one.value});

  options.bins.zones = 12;
  const rsphere::Contributions divided = scene.contributions(rays, {"bulb"}, options);
  EXPECT_EQ(divided.bins, 12u);
  double all = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    double sum = 0;
    for (size_t bin = 0; bin < 12; ++bin) sum += divided.value[i][3 * bin];
    EXPECT_NEAR(sum, one.value[i][0], 1e-12 * (1 + one.value[i][0]));
    all += sum;
  }
  EXPECT_GT(all, 0);
}

// Calls with other random numbers (-Sr) share what is prepared, which changes no number.
TEST(Contributions, DoNotDependOnEarlierCalls) {
  const std::vector<rsphere::Ray> rays = someRays();
  rsphere::ContributionOptions options;
  options.ambientBounces = 2;
  options.ambientDivisions = 16;
  options.samples = 1;
  const Scene used({kRoom});
  const rsphere::Contributions first = used.contributions(rays, {"bulb"}, options);
  options.rotation = 1;
  const rsphere::Contributions second = used.contributions(rays, {"bulb"}, options);
  EXPECT_EQ(second.value.numbers, Scene({kRoom}).contributions(rays, {"bulb"}, options).value.numbers);
  EXPECT_NE(second.value.numbers, first.value.numbers);
  EXPECT_EQ(command("rcontrib", "-V+ -u- -Sr 1 -ab 2 -ad 16 -m bulb " + kRoom, numbersOf(rays)),
            second.value.numbers);
}

TEST(Contributions, StateTheirErrors) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Ray> rays(200, rsphere::Ray{{1.2, 1.9, .1}, {0, 0, 1}});
  rsphere::ContributionOptions options;
  options.irradianceAtOrigin = true;
  options.ambientDivisions = 4;
  options.samples = 8;
  options.arguments = {"-u+"};
  const rsphere::Contributions a = scene.contributions(rays, {"bulb"}, options);
  double mean = 0, squares = 0, stated = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    mean += a.value[i][0] / 200;
    squares += a.value[i][0] * a.value[i][0] / 200;
    stated += a.standardError[i][0] * a.standardError[i][0] / 200;
  }
  const double found = (squares - mean * mean) / stated;
  EXPECT_GT(found, .7);
  EXPECT_LT(found, 1.4);
  EXPECT_GT(2.25 * found, 1.4);  // errors that are a third too small would be rejected
}

TEST(Contributions, RefuseWhatIsNone) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Ray> rays = someRays();
  rsphere::ContributionOptions options;
  const auto fault = [&](const std::vector<std::string>& of) {
    return faultOf([&] { scene.contributions(rays, of, options); });
  };
  EXPECT_EQ(fault({}), "contributions() needs at least one modifier");
  EXPECT_EQ(fault({"bulb", "bulb"}), "duplicate modifier 'bulb'");
  options.samples = 0;
  EXPECT_EQ(fault({"bulb"}), "0 samples: expected at least 1");
  options.samples = 1;
  options.bins.expression = "Dx";
  EXPECT_EQ(fault({"bulb"}), "the count of bins, '', must be a constant from 1 to 1000000");
  options.bins.count = "4";
  EXPECT_EQ(fault({"bulb"}), "no fault");
  options.bins.zones = 3;
  EXPECT_EQ(fault({"bulb"}), "zones and an expression of bins exclude each other");
  options.bins = {};
  options.bins.zones = 0;
  EXPECT_EQ(fault({"bulb"}), "0 zones: expected 1 to 1000000");
  options.bins = {};
  options.arguments = {"-pY"};
  EXPECT_EQ(fault({"bulb"}), "option '-p': contributions are red, green and blue, or bands (-cs)");
}

TEST(ZoneMiddles, AreUnitVectors) {
  for (const std::array<double, 3>& d : rsphere::zoneMiddles(33))
    EXPECT_NEAR(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-12);
}

TEST(Stop, EndsACall) {
  const Scene scene({kRoom});
  const std::vector<rsphere::Point> points(100000, {1, 1, 1});
  Options options;
  options.ambientBounces = 2;
  options.directions = 64;
  int asked = 0;
  options.stop = [&, caller = std::this_thread::get_id()] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++asked > 2;
  };
  EXPECT_EQ(faultOf([&] { scene.sphere(points, options); }, Error::Cause::stopped), "stopped");
  EXPECT_EQ(asked, 3);
  // The scene is as good as before, and a call that is not stopped has its answers.
  options.stop = [] { return false; };
  EXPECT_EQ(scene.sphere(std::span(points).first(2), options).size, 2u);
}

// In the midst of one gather.
TEST(Stop, EndsARecord) {
  const Scene scene({kFurnace});
  const std::vector<rsphere::Ray> ray{{{0, 0, 0}, {0, 0, 1}}};
  Options options;
  options.ambientBounces = 3;
  options.arguments = {"-I", "-ad", "50000000"};
  options.stop = [asked = 0]() mutable { return ++asked > 1; };
  EXPECT_EQ(faultOf([&] { scene.trace(ray, options); }, Error::Cause::stopped), "stopped");
  options.stop = {};
  options.arguments = {"-I", "-ad", "64"};
  EXPECT_EQ(scene.trace(ray, options).value.numbers, Scene({kFurnace}).trace(ray, options).value.numbers);
}

}  // namespace
