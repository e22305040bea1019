#include "importance/distribution.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "rad_parser/error.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;

struct Picture {
  int width = 0, height = 0;
  std::vector<float> pixels;
  float at(int x, int y, int channel = 0) const {
    return pixels[3 * (static_cast<size_t>(y) * width + x) + channel];
  }
};

Picture readBack(const std::string& name) {
  Picture picture;
  const auto file = OIIO::ImageInput::open(name);
  EXPECT_TRUE(file) << OIIO::geterror();
  if (!file) return picture;
  picture.width = file->spec().width;
  picture.height = file->spec().height;
  EXPECT_EQ(file->spec().nchannels, 3);
  picture.pixels.resize(size_t{3} * picture.width * picture.height);
  EXPECT_TRUE(file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.pixels.data()));
  file->close();
  return picture;
}

// The directions of the axes: +x -x +y -y +z -z have values 1 to 6.
std::vector<DirectionSample> axes() {
  std::vector<DirectionSample> samples;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1., -1.}) {
      V3d d(0, 0, 0);
      d[axis] = sign;
      const double value = static_cast<double>(samples.size()) + 1;
      samples.push_back({d, 4 * kPi / 6, Rgb(value, 2 * value, 3 * value)});
    }
  return samples;
}

float at(const DistributionPicture& p, int x, int y, int channel = 0) {
  return p.pixels[3 * (static_cast<size_t>(y) * p.width + x) + channel];
}

TEST(Distribution, ColumnsAreAzimuthsRowsGoDownFromTheZenith) {
  const DistributionPicture p = drawDistribution(axes());
  ASSERT_EQ(p.width, 1024);
  ASSERT_EQ(p.height, 512);
  EXPECT_EQ(at(p, 0, 256), 1);
  EXPECT_EQ(at(p, 1023, 256), 1);
  EXPECT_EQ(at(p, 256, 256), 3);
  EXPECT_EQ(at(p, 512, 256), 2);
  EXPECT_EQ(at(p, 768, 256), 4);
  for (const int x : {0, 100, 1023}) {
    EXPECT_EQ(at(p, x, 0), 5);
    EXPECT_EQ(at(p, x, 511), 6);
  }
  EXPECT_EQ(at(p, 256, 256, 1), 6);
  EXPECT_EQ(at(p, 256, 256, 2), 9);
  // The cells of +x and +y meet at 45 degrees.
  EXPECT_EQ(at(p, 127, 256), 1);
  EXPECT_EQ(at(p, 128, 256), 3);
}

TEST(Distribution, EachPixelIsItsNearestDirections) {
  Random random(1);
  std::vector<DirectionSample> samples;
  for (int i = 0; i < 300; ++i) samples.push_back({randomDirection(random), .01, Rgb(i, 0, 0)});
  // A crowd, a pair of the same direction, and one that stands for nothing.
  for (int i = 300; i < 500; ++i)
    samples.push_back({(V3d(0, .6, .8) + randomPoint(random, .02)).normalized(), 1e-5, Rgb(i, 0, 0)});
  samples.push_back({samples[7].direction, .01, Rgb(500, 0, 0)});
  samples.push_back({V3d(.6, 0, .8), 0, Rgb(501, 0, 0)});
  const int width = 256, height = 128;
  const DistributionPicture p = drawDistribution(samples, width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double polar = kPi * (y + .5) / height, azimuth = 2 * kPi * (x + .5) / width;
      const V3d d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      double least = 9;
      for (const DirectionSample& s : samples)
        if (s.solidAngle > 0) least = std::min(least, (s.direction - d).length());
      const auto shown = static_cast<size_t>(at(p, x, y));
      ASSERT_LT(shown, 501u);
      ASSERT_LE((samples[shown].direction - d).length(), least + 1e-9);
    }
}

TEST(Distribution, SourcesPaintTheirCaps) {
  auto samples = axes();
  const double solidAngle = 2 * kPi * (1 - std::cos(.1));
  samples.push_back({V3d(0, 1, 0), solidAngle, Rgb(100, 0, 0), true});
  samples.push_back({V3d(0, 0, 1), solidAngle, Rgb(200, 0, 0), true});
  samples.push_back({V3d(1, 0, 0), 1e-12, Rgb(300, 0, 0), true});
  samples.push_back({V3d(-1, 0, 0), 0, Rgb(400, 0, 0), true});  // hidden
  const DistributionPicture p = drawDistribution(samples);
  double painted[5] = {};
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const float value = at(p, x, y);
      const double pixel =
          2 * kPi / p.width * (std::cos(kPi * y / p.height) - std::cos(kPi * (y + 1) / p.height));
      if (value >= 100) painted[static_cast<int>(value / 100)] += pixel;
    }
  EXPECT_NEAR(painted[1] / solidAngle, 1, .02);
  EXPECT_NEAR(painted[2] / solidAngle, 1, .04);
  EXPECT_NEAR(painted[3], 4 * kPi * kPi / 1024 / 1024, 1e-6);  // a pixel
  EXPECT_EQ(painted[4], 0);
  EXPECT_EQ(at(p, 256, 256), 100);
  EXPECT_EQ(at(p, 500, 0), 200);
}

TEST(Distribution, CapOfTheWholeSphere) {
  const std::vector<DirectionSample> samples{{V3d(.6, 0, .8), 4 * kPi, Rgb(7, 0, 0), true}};
  const DistributionPicture p = drawDistribution(samples, 64, 32);
  for (size_t i = 0; i < p.pixels.size(); i += 3) ASSERT_EQ(p.pixels[i], 7);
}

TEST(Distribution, NoSamplesAreBlack) {
  const DistributionPicture p = drawDistribution({}, 8, 4);
  for (const float v : p.pixels) EXPECT_EQ(v, 0);
}

// 50 ms of a processor of 2020; the bound lets sanitizers pass.
TEST(Distribution, DrawsThousandsOfDirectionsInAMoment) {
  Random random(2);
  std::vector<DirectionSample> samples;
  for (int i = 0; i < 2048; ++i) samples.push_back({randomDirection(random), .006, Rgb(1, 1, 1)});
  for (int i = 0; i < 2048; ++i)
    samples.push_back({(V3d(0, .6, .8) + randomPoint(random, .05)).normalized(), 1e-5, Rgb(1, 1, 1)});
  const std::clock_t begin = std::clock();
  drawDistribution(samples);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  RecordProperty("milliseconds", static_cast<int>(1e3 * seconds));
  EXPECT_LT(seconds, 1);
}

TEST(Distribution, RadianceFormatsKeepRadiance) {
  for (const std::string suffix : {"exr", "hdr", "tif"}) {
    const std::string pattern = testing::TempDir() + "distribution%d." + suffix;
    writeDistribution(pattern, 3, axes());
    const std::string name = testing::TempDir() + "distribution3." + suffix;
    const Picture p = readBack(name);
    ASSERT_EQ(p.width, 1024) << suffix;
    ASSERT_EQ(p.height, 512) << suffix;
    EXPECT_NEAR(p.at(256, 256), 3, .03) << suffix;
    EXPECT_NEAR(p.at(256, 256, 2), 9, .05) << suffix;
    EXPECT_NEAR(p.at(0, 0, 1), 10, .05) << suffix;
    std::remove(name.c_str());
  }
}

TEST(Distribution, IntegerFormatsAreExposedByTheMean) {
  std::vector<DirectionSample> samples = axes();
  // The mean is 100, so that 200 is mid-bright; a source far above it is white.
  for (DirectionSample& s : samples) s.value = Rgb(100, 100, 100);
  samples[0].value = Rgb(200, 200, 200);
  samples[1].value = Rgb(0, 0, 0);
  for (const std::string suffix : {"png", "jpg", "bmp", "ppm"}) {
    const std::string name = testing::TempDir() + "distribution." + suffix;
    writeDistribution(name, 0, samples);
    const Picture p = readBack(name);
    ASSERT_EQ(p.width, 1024) << suffix;
    EXPECT_NEAR(p.at(0, 256), .5, .02) << suffix;
    EXPECT_NEAR(p.at(512, 256), 0, .01) << suffix;
    // sRGB of half of .214
    EXPECT_NEAR(p.at(256, 256), 1.055 * std::pow(.10702, 1 / 2.4) - .055, .02) << suffix;
    std::remove(name.c_str());
  }
}

TEST(Distribution, NamesCarryTheRecordNumber) {
  EXPECT_EQ(pictureName("a%d.png", 0), "a0.png");
  EXPECT_EQ(pictureName("a%04d.png", 12), "a0012.png");
  EXPECT_EQ(pictureName("a%4d.png", 12), "a  12.png");
  EXPECT_EQ(pictureName("a%2d.png", 1234), "a1234.png");
  EXPECT_EQ(pictureName("100%%/a%d", 5), "100%/a5");
  EXPECT_EQ(pictureName("a%d", 18446744073709551615u), "a18446744073709551615");
  EXPECT_EQ(pictureName("plain.hdr", 0), "plain.hdr");
}

TEST(Distribution, WrongNamesAreErrors) {
  for (const char* pattern : {"a%s.png", "a%d%d.png", "a%", "a%5", "a%-4d.png", "a%n", "a%99999999999999d"})
    EXPECT_THROW(pictureName(pattern, 1), rad::Error) << pattern;
  EXPECT_THROW(pictureName("plain.hdr", 1), rad::Error);
}

std::string faultOf(const std::string& name) {
  try {
    writeDistribution(name, 0, axes());
  } catch (const rad::Error& e) {
    EXPECT_EQ(e.status(), rad::Status::system);
    return e.what();
  }
  return "";
}

TEST(Distribution, WhatCannotBeWrittenIsASystemError) {
  for (const std::string name : {"/no/such/folder/a.png", "/no/such/folder/a.hdr", "/no/such/folder/a.exr",
                                 "a.nosuchformat", "nosuffix"}) {
    const std::string fault = faultOf(name);
    EXPECT_EQ(fault.find("cannot write picture \"" + name + "\": "), 0u) << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace rsphere
