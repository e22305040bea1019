#include "shade/picture.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "rad_parser/error.h"

namespace rsphere {
namespace {

using Code = std::array<uint8_t, 4>;

// A picture of w x h pixels in a file of its own.
class PictureFile {
 public:
  explicit PictureFile(const std::string& bytes, const char* suffix = ".pic")
      : path_(testing::TempDir() + "picture" + std::to_string(getpid()) + suffix) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~PictureFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

constexpr int kWidth = 11, kHeight = 5;

// Pixel (x, y) from the lower left; no two are alike.
Code pixel(int x, int y) {
  return {static_cast<uint8_t>(128 + 11 * y + x), static_cast<uint8_t>(2 * x),
          static_cast<uint8_t>(200 - x - y), static_cast<uint8_t>(128 + (x + y) % 3)};
}
// The middle of what a pixel stands for (RADIANCE file formats, "Picture File Format").
double channel(const Code& c, int i) { return std::ldexp(c[static_cast<size_t>(i)] + .5, c[3] - 136); }

std::string append(const std::vector<Code>& pixels) {
  std::string bytes;
  for (const Code& c : pixels)
    for (uint8_t b : c) bytes += static_cast<char>(b);
  return bytes;
}

// A row in the new code: each channel by itself, here in literal stretches and a run.
std::string runLengthCoded(const std::vector<Code>& row) {
  std::string bytes{2, 2, static_cast<char>(row.size() >> 8), static_cast<char>(row.size() & 255)};
  for (size_t c = 0; c < 4; ++c)
    for (size_t i = 0; i < row.size();) {
      size_t n = 1;
      while (n < 127 && i + n < row.size() && row[i + n][c] == row[i][c]) ++n;
      bytes += static_cast<char>(n > 1 ? 128 + n : 1);
      bytes += static_cast<char>(row[i][c]);
      i += n;
    }
  return bytes;
}

struct Order {
  const char *slow, *fast;
};
constexpr Order kOrders[] = {{"-Y", "+X"}, {"-Y", "-X"}, {"+Y", "-X"}, {"+Y", "+X"},
                             {"+X", "+Y"}, {"+X", "-Y"}, {"-X", "-Y"}, {"-X", "+Y"}};

std::string coded(const Order& order, bool runs,
                  const std::string& header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n") {
  const auto size = [](char axis) { return axis == 'X' ? kWidth : kHeight; };
  const int rows = size(order.slow[1]), columns = size(order.fast[1]);
  std::string bytes = header + "\n" + order.slow + " " + std::to_string(rows) + " " + order.fast + " " +
                      std::to_string(columns) + "\n";
  for (int i = 0; i < rows; ++i) {
    std::vector<Code> row;
    for (int j = 0; j < columns; ++j) {
      const int slow = order.slow[0] == '+' ? i : rows - 1 - i,
                fast = order.fast[0] == '+' ? j : columns - 1 - j;
      row.push_back(order.slow[1] == 'Y' ? pixel(fast, slow) : pixel(slow, fast));
    }
    bytes += runs && columns >= 8 ? runLengthCoded(row) : append(row);
  }
  return bytes;
}

void expectPixels(const Picture& picture, const std::string& what) {
  ASSERT_EQ(picture.width(), static_cast<size_t>(kWidth)) << what;
  ASSERT_EQ(picture.height(), static_cast<size_t>(kHeight)) << what;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Color got = picture.value(static_cast<double>(kWidth) / kHeight * x / (kWidth - 1.),
                                      static_cast<double>(y) / (kHeight - 1));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got[c], channel(pixel(x, y), c), 1e-6) << what << " pixel " << x << ' ' << y;
    }
}

TEST(Picture, EveryOrderOfPixelsInEveryCode) {
  for (const Order& order : kOrders)
    for (bool runs : {false, true}) {
      const PictureFile file(coded(order, runs));
      expectPixels(Picture::read(file.path()), std::string(order.slow) + order.fast);
    }
}

// Files are read in blocks of 256 kB, whose ends may be anywhere in a row.
TEST(Picture, FilesOfManyBlocks) {
  constexpr int kSize = 701;
  const auto code = [](int x, int y) {
    return Code{static_cast<uint8_t>(128 + (x * y) % 127), static_cast<uint8_t>(x),
                static_cast<uint8_t>(y / 9), static_cast<uint8_t>(120 + (x ^ y) % 16)};
  };
  for (bool runs : {false, true}) {
    std::string bytes = "#?RADIANCE\n\n+Y 701 +X 701\n";
    for (int y = 0; y < kSize; ++y) {
      std::vector<Code> row;
      for (int x = 0; x < kSize; ++x) row.push_back(code(x, y));
      bytes += runs ? runLengthCoded(row) : append(row);
    }
    const PictureFile file(bytes);
    const Picture picture = Picture::read(file.path());
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        ASSERT_NEAR(picture.value(x / (kSize - 1.), y / (kSize - 1.)).z, channel(code(x, y), 2), 1e-6)
            << "pixel " << x << ' ' << y << (runs ? " in runs" : "");
  }
}

// The size of what comes through a pipe is unknown before it has been read.
TEST(Picture, ComesThroughPipes) {
  for (const size_t length : {size_t{20}, std::string::npos}) {
    const PictureFile pipe("");
    std::remove(pipe.path().c_str());
    ASSERT_EQ(mkfifo(pipe.path().c_str(), 0600), 0);
    std::thread writer(
        [&] { std::ofstream(pipe.path(), std::ios::binary) << coded(kOrders[0], true).substr(0, length); });
    if (length == std::string::npos)
      expectPixels(Picture::read(pipe.path()), "pipe");
    else
      EXPECT_THROW(Picture::read(pipe.path()), rad::Error);
    writer.join();
  }
}

// Pictures of the first years have neither magic number nor format, and end in ".pic" as others do.
TEST(Picture, NeedsNoFormatLineAndNoSuffix) {
  for (const char* suffix : {".pic", ".hdr", ".exr", ""}) {
    const PictureFile file(coded(kOrders[0], true, "oconv room.rad\nEXPOSURE=5.3\n"), suffix);
    expectPixels(Picture::read(file.path()), suffix);
  }
}

TEST(Picture, OldRunLengthCode) {
  // One, then 304 more of it: 48 + 1 * 256.
  std::string bytes = "#?RADIANCE\n\n-Y 2 +X 305\n";
  for (int row = 0; row < 2; ++row) bytes += append({{100, 150, 200, 128}, {1, 1, 1, 48}, {1, 1, 1, 1}});
  const PictureFile file(bytes);
  const Picture picture = Picture::read(file.path());
  for (double x : {0., 30., 76.5})
    for (double y : {0., .5, 1.}) EXPECT_NEAR(picture.value(x, y).y, 150.5 / 256, 1e-6);
}

// The red mantissas of a picture of one row, between whose pixels is a distance of 1.
std::vector<double> redsOf(const std::string& bytes) {
  const PictureFile file(bytes);
  const Picture picture = Picture::read(file.path());
  std::vector<double> reds;
  for (size_t i = 0; i < picture.width(); ++i) {
    const auto x = static_cast<double>(i), last = std::max(1., static_cast<double>(picture.width()) - 1);
    reds.push_back(picture.value(x * static_cast<double>(picture.width()) / last, 0).x * 256 - .5);
  }
  return reds;
}

// rtrace 6.1a reads these rows alike.
TEST(Picture, NewRunLengthCodeInNarrowRows) {
  const std::string header = "#?RADIANCE\n\n-Y 1 +X ";
  EXPECT_EQ(redsOf(header + "1\n" + runLengthCoded({{100, 150, 200, 128}})), std::vector<double>{100});
  EXPECT_EQ(redsOf(header + "4\n" +
                   runLengthCoded({{1, 2, 3, 128}, {1, 2, 3, 128}, {7, 2, 3, 128}, {9, 2, 3, 128}})),
            (std::vector<double>{1, 1, 7, 9}));
  // A pixel that only begins like the mark of the new code.
  EXPECT_EQ(redsOf(header + "3\n" + append({{2, 2, 130, 128}, {100, 1, 1, 128}, {90, 1, 1, 128}})),
            (std::vector<double>{2, 100, 90}));
}

// rtrace 6.1a reads these rows alike.
TEST(Picture, OldRunsEndWithTheRow) {
  const std::string header = "#?RADIANCE\n\n-Y 1 +X 4\n";
  const std::vector<double> alike(4, 100);
  EXPECT_EQ(redsOf(header + append({{100, 0, 0, 128}, {1, 1, 1, 9}})), alike);
  EXPECT_EQ(redsOf(header + append({{100, 0, 0, 128}, {1, 1, 1, 1}, {1, 1, 1, 5}})), alike);
  EXPECT_EQ(redsOf(header + append({{100, 0, 0, 128},
                                    {1, 1, 1, 0},
                                    {1, 1, 1, 0},
                                    {1, 1, 1, 0},
                                    {1, 1, 1, 0},
                                    {1, 1, 1, 0},
                                    {1, 1, 1, 3}})),
            alike);
  // At the beginning of a row there is nothing to repeat, and the bytes are a pixel.
  EXPECT_EQ(redsOf(header + append({{1, 1, 1, 128}, {70, 1, 1, 128}, {80, 1, 1, 128}, {90, 1, 1, 128}})),
            (std::vector<double>{1, 70, 80, 90}));
}

// The file has a thirtieth of the bytes that the new code would need.
TEST(Picture, OldRunsMayBeLong) {
  std::string bytes = "#?RADIANCE\n\n-Y 1000 +X 4096\n";
  for (int row = 0; row < 1000; ++row) bytes += append({{100, 150, 200, 128}, {1, 1, 1, 255}, {1, 1, 1, 15}});
  const PictureFile file(bytes);
  EXPECT_NEAR(Picture::read(file.path()).value(2, .7).y, 150.5 / 256, 1e-6);
}

TEST(Picture, AspectOfPixelsSetsTheSize) {
  const PictureFile file(coded(kOrders[0], false, "#?RADIANCE\nPIXASPECT=4\nFORMAT=32-bit_rle_rgbe\n"));
  const Picture picture = Picture::read(file.path());
  // 11 wide and 5 * 4 high: the shorter side is 1.
  EXPECT_NEAR(picture.value(1, 20. / 11).x, channel(pixel(kWidth - 1, kHeight - 1), 0), 1e-6);
}

TEST(Picture, BetweenAndBeyondPixels) {
  const PictureFile file("#?RADIANCE\n\n-Y 2 +X 2\n" +
                         append({{140, 0, 0, 136}, {240, 0, 0, 136}, {140, 0, 0, 136}, {240, 0, 0, 136}}));
  const Picture picture = Picture::read(file.path());
  EXPECT_NEAR(picture.value(.5, .5).x, 190.5, 1e-4);
  EXPECT_NEAR(picture.value(1.5, 0).x, 290.5, 1e-4);  // one division on, the line goes on
  EXPECT_NEAR(picture.value(-1, .3).x, 40.5, 1e-4);
  // Further out it falls with the distance: position 4 of 0 and 1, weights 2/5 and -1/5.
  EXPECT_NEAR(picture.value(4, 0).x, 240.5 * 2 / 5 - 140.5 / 5, 1e-4);
}

// As rtrace 6.1a reads them.
TEST(Picture, ResolutionLinesOfEveryKind) {
  const Code lowerLeft = pixel(0, 0), upperRight = pixel(kWidth - 1, kHeight - 1);
  const auto expectCorners = [&](const char* resolution, const Order& order) {
    std::string bytes = coded(order, false, "#?RADIANCE\n");
    const size_t begin = bytes.find("\n\n") + 2;
    bytes.replace(begin, bytes.find('\n', begin) - begin, resolution);
    const PictureFile file(bytes);
    const Picture picture = Picture::read(file.path());
    EXPECT_NEAR(picture.value(0, 0).x, channel(lowerLeft, 0), 1e-6) << resolution;
    EXPECT_NEAR(picture.value(static_cast<double>(kWidth) / kHeight, 1).x, channel(upperRight, 0), 1e-6)
        << resolution;
  };
  const Order standard = kOrders[0], rising = kOrders[3];
  for (const char* resolution :
       {"-Y5+X11", "  -Y  5  +X  11  ", "-Y\t5\t+X\t11", "-Y +5 +X +11", "-Y 5.9 +X 11.2", "-Y 5e3 +X 11",
        "-Y 5 +X 11\r", "-Y 5 +X 11 at noon", "view -Y 5 , +X 11", "X 3 Y 3 -Y 5 +X 11"})
    expectCorners(resolution, standard);
  for (const char* resolution : {"Y 5 X 11", "*Y 5 *X 11"}) expectCorners(resolution, rising);
  expectCorners("X 11 -Y 5", kOrders[5]);
}

TEST(Picture, HeadersOfWindows) {
  const PictureFile file(
      coded(kOrders[0], false, "#?RADIANCE\r\nFORMAT=\t32-bit_rle_rgbe \r\nPIXASPECT=\t+1\r\n\r"));
  expectPixels(Picture::read(file.path()), "\\r\\n");
}

// A line without a name is none, and the same name may occur twice.
TEST(Picture, FormatLinesThatAgree) {
  const PictureFile file(
      coded(kOrders[0], true, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nFORMAT=\nFORMAT= 32-bit_rle_rgbe\n"));
  expectPixels(Picture::read(file.path()), "two formats");
}

std::string errorOf(const std::string& bytes) {
  const PictureFile file(bytes);
  try {
    Picture::read(file.path());
  } catch (const rad::Error& e) {
    const std::string what = e.what();
    EXPECT_EQ(what.find(file.path()), 0u) << what;
    return what.substr(file.path().size());
  }
  return "no error";
}

TEST(Picture, BadFilesAreSaidToBe) {
  EXPECT_EQ(errorOf("GIF89a"), ": bad picture file: its header does not end");
  EXPECT_EQ(errorOf("#?RADIANCE\nFORMAT=float\n\n-Y 1 +X 1\n1234"),
            ": bad picture file: expected RGBE (FORMAT=32-bit_rle_rgbe)");
  const char* const xyze = ": bad picture file: it is in XYZE; \"ra_xyze -r\" converts it to RGBE";
  EXPECT_EQ(errorOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\nEXPOSURE=2\n\n-Y 1 +X 1\n1234"), xyze);
  EXPECT_EQ(errorOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234"), xyze);
  EXPECT_EQ(errorOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n1234"), xyze);
  EXPECT_EQ(errorOf("#?RADIANCE\nFORMAT=Radiance_spectra\n\n-Y 1 +X 1\n1234"),
            ": bad picture file: it has spectra, which only specpict reads");
  EXPECT_EQ(errorOf("#?RADIANCE\n\n-Y 1 +Y 1\n1234"),
            ": bad picture file: expected a resolution such as \"-Y 480 +X 640\", got \"-Y 1 +Y 1\"");
  for (const char* resolution :
       {"", "-y 1 +x 1", "-Y -1 +X 1", "-Y 0 +X 1", "-Y 0x1 +X 1", "-Y +X 1", "1 1", "X Y"})
    EXPECT_EQ(errorOf(std::string("#?RADIANCE\n\n") + resolution + "\n1234"),
              std::string(": bad picture file: expected a resolution such as \"-Y 480 +X 640\", got \"") +
                  resolution + "\"");
  EXPECT_EQ(errorOf("#?RADIANCE\n\n-Y            1 +X            1\n1234"),
            ": bad picture file: its resolution line has more than 30 characters: "
            "\"-Y            1 +X            1\"");
  for (const char* resolution : {"-Y 65537 +X 1", "-Y 1 +X 4294967297", "-Y 1 +X 99999999999999999999"})
    EXPECT_EQ(errorOf(std::string("#?RADIANCE\n\n") + resolution + "\n1234"),
              ": bad picture file: it has more than 65536 rows or columns");
  EXPECT_EQ(errorOf("#?RADIANCE\n\n-Y 4 +X 4\n1234"), ": bad picture file: it ends too early");
  EXPECT_EQ(errorOf("#?RADIANCE\n\n-Y 60000 +X 60000\n1234"), ": bad picture file: it ends too early");
  // A row of four in the new code, in pictures of other widths.
  const std::string four = runLengthCoded({{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 1, 2, 3}, {4, 5, 6, 7}});
  for (const char* width : {"3", "7", "65000"})
    EXPECT_EQ(errorOf(std::string("#?RADIANCE\n\n-Y 1 +X ") + width + "\n" + four),
              ": bad picture file: the length of a row differs from the resolution line");
  EXPECT_EQ(errorOf("#?RADIANCE\n\n-Y 1 +X 2\n" + std::string("\2\2\0\2\3\3", 6)),
            ": bad picture file: a run is too long");
  const std::string whole = coded(kOrders[0], true);
  for (size_t cut = 60; cut < whole.size(); cut += 7)
    EXPECT_NE(errorOf(whole.substr(0, cut)), "no error") << cut << " bytes";
  try {
    Picture::read("/nonexistent.hdr");
    FAIL();
  } catch (const rad::Error& e) {
    EXPECT_EQ(e.status(), rad::Status::system);
  }
}

}  // namespace
}  // namespace rsphere
