#include "image/picture_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "image/picture_formats.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

constexpr const char* kHeader = "#?RADIANCE\nrsphere -Si a.hdr\nVIEW= -vta -vh 360 -vv 360\n";

// Four quarters, with values that vary along each row.
Raster quarters(int width, int height) {
  Raster raster{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float base = (y < height / 2 ? 1.f : 4.f) * (x < width / 2 ? 1.f : 100.f);
      raster.pixels.insert(raster.pixels.end(), {base, base * .5f, x % 7 == 0 ? 0 : base / (1 + x % 7)});
    }
  return raster;
}

Raster readBack(const std::string& name) {
  Raster raster;
  OIIO::ImageSpec how;
  how.attribute("pnm:pfmflip", name.ends_with(".pfm") ? 1 : 0);  // PFM begins with the lowest row
  const auto file = OIIO::ImageInput::open(name, &how);
  EXPECT_TRUE(file) << name << ": " << OIIO::geterror();
  if (!file) return raster;
  raster.width = file->spec().width;
  raster.height = file->spec().height;
  EXPECT_EQ(file->spec().nchannels, 3);
  raster.pixels.resize(size_t{3} * raster.width * raster.height);
  EXPECT_TRUE(file->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, raster.pixels.data()));
  file->close();
  return raster;
}

class PictureFiles : public testing::Test {
 protected:
  PictureFiles() { std::filesystem::create_directory(folder); }
  ~PictureFiles() override { std::filesystem::remove_all(folder); }
  std::string contents(const std::string& name) const {
    std::ifstream file(folder + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string folder = testing::TempDir() + "rsphere_pictures_" + std::to_string(getpid()) + "/";
};

std::string faultOf(const std::string& name) {
  try {
    PictureFile(name).write(quarters(64, 32), kHeader);
  } catch (const rad::Error& e) {
    EXPECT_EQ(e.status(), rad::Status::system);
    return e.what();
  }
  return "";
}

TEST_F(PictureFiles, RadianceFormatsKeepRadiance) {
  const Raster given = quarters(64, 32);
  std::vector<std::string> suffixes = {"hdr", "rgbe", "exr", "tif"};
  if (OIIO::ImageOutput::create("a.pfm")) suffixes.push_back("pfm");  // from OpenImageIO 2.5 on
  static_cast<void>(OIIO::geterror());  // at exit, OpenImageIO prints errors that were not fetched
  for (const std::string& suffix : suffixes) {
    PictureFile(folder + "a." + suffix).write(given, kHeader);
    const Raster read = readBack(folder + "a." + suffix);
    ASSERT_EQ(read.width, 64) << suffix;
    ASSERT_EQ(read.height, 32) << suffix;
    const bool exact = suffix != "hdr" && suffix != "rgbe";
    for (size_t i = 0; i < given.pixels.size(); ++i) {
      const float largest = given.pixels[i - i % 3];
      ASSERT_NEAR(read.pixels[i], given.pixels[i], exact ? 0 : largest / 100) << suffix << ' ' << i;
    }
  }
}

TEST_F(PictureFiles, ScreenFormatsTakeColoursFromZeroToOne) {
  Raster given = quarters(64, 32);
  for (float& p : given.pixels) p = std::min(p / 400, 1.f);
  for (const std::string suffix : {"png", "bmp", "ppm", "tga", "sgi", "jpg"}) {
    PictureFile(folder + "a." + suffix).write(given, kHeader);
    const Raster read = readBack(folder + "a." + suffix);
    ASSERT_EQ(read.width, 64) << suffix;
    // JPEG blurs what varies from pixel to pixel.
    for (size_t i = 0; i < given.pixels.size(); i += suffix == "jpg" ? 3 * 21 : 1)
      ASSERT_NEAR(read.pixels[i], given.pixels[i], suffix == "jpg" ? .1 : .5 / 255 + 1e-6) << suffix;
  }
}

TEST_F(PictureFiles, RadiancePicturesHaveTheirHeader) {
  for (const std::string name : {"a.hdr", "a.pic"}) {
    PictureFile(folder + name).write(quarters(64, 32), kHeader);
    const std::string head = kHeader + std::string("FORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n");
    EXPECT_EQ(contents(name).substr(0, head.size()), head);
    EXPECT_EQ(contents(name).substr(head.size(), 4), std::string("\2\2\0\100", 4));
  }
}

// Runs across the whole row, none at all, both at once, and rows that are too narrow to be coded.
TEST_F(PictureFiles, ScanlinesOfAllKindsAreReadBack) {
  for (const int width : {1, 7, 8, 9, 127, 128, 129, 300, 1000})
    for (const int period : {1, 2, 3, 130, 100000}) {
      Raster given{width, 2, {}};
      for (int i = 0; i < 2 * width; ++i) {
        const float x = period == 100000 ? 1 : static_cast<float>(1 + i / period % 5);
        given.pixels.insert(given.pixels.end(), {x, i % 50 < 25 ? 2.f : .5f, 5});
      }
      PictureFile(folder + "a.hdr").write(given, kHeader);
      const Raster read = readBack(folder + "a.hdr");
      ASSERT_EQ(read.width, width);
      for (size_t i = 0; i < given.pixels.size(); ++i)
        ASSERT_NEAR(read.pixels[i], given.pixels[i], .04) << width << ' ' << period << ' ' << i;
    }
  const std::string even = radiancePicture({1000, 1, std::vector<float>(3000, 1)}, "");
  EXPECT_LT(even.size(), 130u) << "runs are not coded";
}

TEST_F(PictureFiles, AFullDiskIsASystemErrorWithTheNameInEveryFormat) {
  for (const std::string suffix : {"hdr", "pic", "exr", "tif", "png", "jpg", "bmp", "ppm", "tga", "sgi"}) {
    const std::string name = folder + "full." + suffix;
    std::filesystem::create_symlink("/dev/full", name);
    EXPECT_EQ(faultOf(name), "cannot write picture \"" + name + "\": No space left on device");
  }
}

// They used to be empty from the time when the picture was begun, and cut after a fault.
TEST_F(PictureFiles, AreNeverEmptyOrCut) {
  const auto names = [&] {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      found.push_back(entry.path().filename());
    return found;
  };
  const std::string name = folder + "a.hdr", old = "the picture before";
  { const PictureFile abandoned(name); }
  EXPECT_TRUE(names().empty());
  std::ofstream(name) << old;
  { const PictureFile abandoned(name); }
  EXPECT_EQ(contents("a.hdr"), old);

  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = 100;
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_EQ(faultOf(name), "cannot write picture \"" + name + "\": File too large");
  EXPECT_EQ(faultOf(folder + "b.png"), "cannot write picture \"" + folder + "b.png\": File too large");
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(contents("a.hdr"), old);
  EXPECT_EQ(names(), std::vector<std::string>{"a.hdr"});
}

TEST_F(PictureFiles, ReplaceAFileWithItsLinksAndPermissions) {
  const std::string name = folder + "a.hdr", link = folder + "link.hdr";
  std::ofstream(name) << "the picture before";
  chmod(name.c_str(), 0640);
  std::filesystem::create_symlink(name, link);
  PictureFile(link).write(quarters(64, 32), kHeader);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(contents("a.hdr").substr(0, 2), "#?");
  EXPECT_EQ(std::filesystem::status(name).permissions(), std::filesystem::perms(0640));
}

// The suffix is named, and suffixes that there are; OpenImageIO's text had none of them.
TEST_F(PictureFiles, ASuffixOfNoFormatIsAnError) {
  EXPECT_EQ(
      faultOf("v.jpgg"),
      "cannot write picture \"v.jpgg\": its suffix is that of no picture format; usual ones are .hdr, .exr, "
      ".tif, "
      ".png and .jpg");
}

TEST_F(PictureFiles, WhatCannotBeWrittenIsASystemError) {
  for (const std::string name : {"/no/such/folder/a.png", "/no/such/folder/a.hdr", "/no/such/folder/a.exr"})
    EXPECT_EQ(faultOf(name), "cannot write picture \"" + name + "\": No such file or directory");
  for (const std::string name : {"a.nosuchformat", "nosuffix"}) {
    const std::string fault = faultOf(name);
    EXPECT_EQ(fault.find("cannot write picture \"" + name + "\": "), 0u) << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace rsphere
