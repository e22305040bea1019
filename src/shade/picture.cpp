#include "shade/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "rad_parser/error.h"
#include "rad_parser/open_file.h"

namespace rsphere {
namespace {

// The order of the pixels in the file: the numbers of rows and columns, and their places in the picture.
struct Layout {
  size_t rows = 0, columns = 0;
  bool columnsAlongX = true;                  // otherwise each row of the file is a column of the picture
  bool rowsFall = true, columnsFall = false;  // whether they run against the direction of their axis
};

struct Header {
  Layout layout;
  double aspect = 1;
  std::string_view format;  // empty: not given
  int components = 3;
  std::array<double, 2> wavelengths{};  // nm, limits of the spectra; 0: not given
  size_t size = 0;                      // bytes up to the pixels
};

using Rgbe = std::array<uint8_t, 4>;

[[noreturn]] void bad(const std::string& path, std::string_view why) {
  throw rad::Error(fmt::format("{}: bad picture file: {}", path, why));
}

// "-Y 480 +X 640": the axis that changes slowest comes first.
std::optional<Layout> readLayout(std::string_view line) {
  struct Axis {
    char name = 0;
    bool falls = false;
    size_t length = 0;
  } axes[2];
  for (Axis& axis : axes) {
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    if (line.size() < 2 || (line[0] != '+' && line[0] != '-')) return std::nullopt;
    axis = {line[1], line[0] == '-', 0};
    line.remove_prefix(2);
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), axis.length);
    if (error != std::errc() || axis.length == 0) return std::nullopt;
    line.remove_prefix(static_cast<size_t>(end - line.data()));
  }
  const bool alongX = axes[0].name == 'Y' && axes[1].name == 'X';
  if (!alongX && !(axes[0].name == 'X' && axes[1].name == 'Y')) return std::nullopt;
  return Layout{axes[0].length, axes[1].length, alongX, axes[0].falls, axes[1].falls};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

// The next number of a text; 0 if there is none.
template <class T>
T nextNumber(std::string_view& text) {
  text = trimmed(text);
  T number{};
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number).ptr;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return number;
}

// The part of a header line behind its name; empty if it has another name.
std::optional<std::string_view> after(std::string_view name, std::string_view line) {
  if (!line.starts_with(name)) return {};
  return line.substr(name.size());
}

Header readHeader(std::string_view bytes, const std::string& path) {
  Header header;
  size_t at = 0;
  const auto line = [&]() -> std::optional<std::string_view> {
    const size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = bytes.substr(at, end - at);
    at = end + 1;
    return text;
  };
  while (true) {
    const auto text = line();
    if (!text) bad(path, "its header does not end");
    if (text->empty()) break;
    if (const auto format = after("FORMAT=", *text)) {
      header.format = trimmed(*format);
    } else if (auto aspect = after("PIXASPECT=", *text)) {
      header.aspect *= nextNumber<double>(*aspect);
    } else if (auto components = after("NCOMP=", *text)) {
      header.components = nextNumber<int>(*components);
    } else if (auto splits = after("WAVELENGTH_SPLITS=", *text)) {
      std::array<double, 4> limits{};
      for (double& limit : limits) limit = nextNumber<double>(*splits);
      header.wavelengths = {limits.front(), limits.back()};
    }
  }
  if (!(header.aspect > 1e-6 && header.aspect < 1e6)) bad(path, "pixel aspect ratio out of range");
  const auto resolution = line();
  const auto layout = resolution ? readLayout(*resolution) : std::nullopt;
  if (!layout) bad(path, "no resolution");
  header.layout = *layout;
  header.size = at;
  return header;
}

std::string readBytes(const std::string& path) {
  const rad::OpenFile file(path);
  if (file.descriptor() < 0)
    throw rad::Error(fmt::format("{}: cannot open picture file", path), rad::Status::system);
  return file.contents(path);
}

// The size of a picture whose shorter side is 1.
struct Size {
  double x, y;
};
Size sizeOf(size_t columns, size_t rows, double aspect) {
  const double height = static_cast<double>(rows) * aspect;
  const auto width = static_cast<double>(columns);
  return {std::max(1., width / height), std::max(1., height / width)};
}

// The pixel of the picture, counted from the lower left row by row, that a row and column of the file give.
size_t placeOf(const Layout& layout, size_t row, size_t column) {
  const size_t slow = layout.rowsFall ? layout.rows - 1 - row : row;
  const size_t fast = layout.columnsFall ? layout.columns - 1 - column : column;
  return layout.columnsAlongX ? slow * layout.columns + fast : fast * layout.rows + slow;
}

// Reads the pixels of a file, of four bytes each: three mantissas and their shared exponent.
class PixelReader {
 public:
  PixelReader(std::string_view coded, const std::string& path) : left_(coded), path_(path) {}

  // Reads the next row: either by channel, with run-length coding, or by pixel, with runs of the old code.
  void read(std::vector<Rgbe>& row) {
    const size_t count = row.size();
    if (count >= 8 && count < 32768 && left_.size() >= 4 && left_.starts_with("\2\2") && byteAt(2) < 128) {
      if ((static_cast<size_t>(byteAt(2)) << 8 | byteAt(3)) != count) bad(path_, "a row has another length");
      left_.remove_prefix(4);
      for (size_t channel = 0; channel < 4; ++channel) readChannel(row, channel);
    } else {
      readPixels(row);
    }
  }

 private:
  uint8_t byteAt(size_t i) const { return static_cast<uint8_t>(left_[i]); }
  uint8_t next() {
    if (left_.empty()) bad(path_, "it ends too early");
    const uint8_t byte = byteAt(0);
    left_.remove_prefix(1);
    return byte;
  }

  void readChannel(std::vector<Rgbe>& row, size_t channel) {
    for (size_t at = 0; at < row.size();) {
      const uint8_t code = next();
      const size_t count = code > 128 ? code - 128u : code;
      if (count > row.size() - at) bad(path_, "a run is too long");
      const uint8_t repeated = code > 128 ? next() : 0;
      for (const size_t end = at + count; at < end; ++at) row[at][channel] = code > 128 ? repeated : next();
    }
  }

  // In the old code, (1, 1, 1, n) repeats the preceding pixel n times. In successive ones, n is multiplied by
  // 1, 256, 256^2 and so on.
  void readPixels(std::vector<Rgbe>& row) {
    int shift = 0;
    for (size_t at = 0; at < row.size();) {
      Rgbe pixel;
      for (uint8_t& byte : pixel) byte = next();
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        row[at++] = pixel;
        shift = 0;
        continue;
      }
      const size_t count = shift > 16 ? row.size() + 1 : static_cast<size_t>(pixel[3]) << shift;
      if (at == 0 || count > row.size() - at) bad(path_, "a run is too long");
      for (const size_t end = at + count; at < end; ++at) row[at] = row[at - 1];
      shift += 8;
    }
  }

  std::string_view left_;
  const std::string& path_;
};

// The step of the mantissas with an exponent.
float stepOf(uint8_t exponent) {
  static const std::array<float, 256> steps = [] {
    std::array<float, 256> s{};
    for (int e = 1; e < 256; ++e) s[e] = std::ldexp(1.f, e - 136);
    return s;
  }();
  return steps[exponent];
}

// A mantissa is decoded to the middle of its step. Source: RADIANCE file formats, "Picture File Format".
void decode(const Rgbe& pixel, float* rgb) {
  const float step = stepOf(pixel[3]);
  for (size_t i = 0; i < 3; ++i) rgb[i] = (static_cast<float>(pixel[i]) + .5f) * step;
}

// Converts CIE XYZ, which RADIANCE's XYZE pictures give in lumens, to RADIANCE's RGB: primaries (.64,.33),
// (.29,.60), (.15,.06), equal-energy white, 179 lumens per watt. Source: RADIANCE file formats, "Picture File
// Format"; ra_xyze(1).
void rgbOfXyz(float* c) {
  constexpr double m[3][3] = {{2.5653124, -1.16684962, -.39846279},
                              {-1.02210817, 1.97828662, .04382155},
                              {.07472437, -.25193953, 1.17721516}};
  double rgb[3];
  for (int i = 0; i < 3; ++i) rgb[i] = std::max(0., (m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2]) / 179);
  for (int i = 0; i < 3; ++i) c[i] = static_cast<float>(rgb[i]);
}

// The two pixels next to a position (in pixels) and their weights, by the rule of rad::DataFile::value().
struct Weights {
  size_t index;
  double first, second;
};
Weights weightsAt(double position, size_t count) {
  if (count == 1) return {0, 1, 0};
  const double last = static_cast<double>(count - 2);
  const double i = position > 0 ? std::floor(std::min(position, last)) : 0;
  const auto index = static_cast<size_t>(i);
  if (position > i + 2) {
    const double w = 1 / (i - 1 - position);
    return {index, w, -2 * w};
  }
  if (position < i - 1) {
    const double w = 1 / (position - i);
    return {index, -2 * w, w};
  }
  return {index, i + 1 - position, position - i};
}

constexpr std::string_view kSpectra = "Radiance_spectra";
constexpr size_t kMostPixels = 65536;  // in a row or a column

}  // namespace

Picture Picture::read(const std::string& path) {
  const std::string bytes = readBytes(path);
  const Header header = readHeader(bytes, path);
  const bool xyz = header.format == "32-bit_rle_xyze";
  if (header.format == kSpectra) bad(path, "it has spectra, which only specpict reads");
  if (!xyz && !header.format.empty() && header.format != "32-bit_rle_rgbe")
    bad(path, "neither RGBE nor XYZE");
  const Layout& layout = header.layout;
  // Rejects sizes that the file is too short for. The new code packs at most 127 values of a channel into two
  // bytes, which is 16 pixels per byte. The old code could be denser, but no such files are known.
  const size_t coded = bytes.size() - header.size;
  if (layout.rows > kMostPixels || layout.columns > kMostPixels ||
      layout.rows * layout.columns > 32 * coded + 64)
    bad(path, "it ends too early");
  PixelReader reader(std::string_view(bytes).substr(header.size), path);
  std::vector<Rgbe> pixels(layout.columns);

  Picture picture;
  picture.width_ = layout.columnsAlongX ? layout.columns : layout.rows;
  picture.height_ = layout.columnsAlongX ? layout.rows : layout.columns;
  picture.pixels_.resize(picture.width_ * picture.height_);
  for (size_t row = 0; row < layout.rows; ++row) {
    reader.read(pixels);
    for (size_t column = 0; column < layout.columns; ++column) {
      float rgb[3];
      decode(pixels[column], rgb);
      if (xyz) rgbOfXyz(rgb);
      picture.pixels_[placeOf(layout, row, column)] = {rgb[0], rgb[1], rgb[2]};
    }
  }
  const Size size = sizeOf(picture.width_, picture.height_, header.aspect);
  picture.sizeX_ = size.x;
  picture.sizeY_ = size.y;
  return picture;
}

Color Picture::value(double x, double y) const {
  const Weights along = weightsAt(x / sizeX_ * static_cast<double>(width_ - 1), width_);
  const Weights up = weightsAt(y / sizeY_ * static_cast<double>(height_ - 1), height_);
  Color sum(0, 0, 0);
  const auto add = [&](size_t row, double weight) {
    if (std::abs(weight) <= 1e-6) return;
    const Pixel* p = &pixels_[row * width_ + along.index];
    const double a = weight * along.first, b = weight * along.second;
    sum += Color(a * p[0].r, a * p[0].g, a * p[0].b);
    if (width_ > 1) sum += Color(b * p[1].r, b * p[1].g, b * p[1].b);
  };
  add(up.index, up.first);
  if (height_ > 1) add(up.index + 1, up.second);
  return sum;
}

SpectralPicture SpectralPicture::read(const std::string& path) {
  const std::string bytes = readBytes(path);
  const Header header = readHeader(bytes, path);
  const auto [first, last] = header.wavelengths;
  if (!header.format.empty() && header.format != kSpectra)
    bad(path, fmt::format("expected spectra (FORMAT={})", kSpectra));
  constexpr int kLeastComponents = 4;  // three are red, green and blue, which colorpict reads
  if (header.components < kLeastComponents) bad(path, "expected at least 4 components (NCOMP=)");
  const auto isWavelength = [](double nm) { return nm >= 1 && nm <= 1e6; };
  if (!(isWavelength(first) && isWavelength(last) && first != last))
    bad(path, "expected four wavelengths (WAVELENGTH_SPLITS=)");
  const Layout& layout = header.layout;
  const std::string_view coded = std::string_view(bytes).substr(header.size);
  const auto components = static_cast<size_t>(header.components), stride = components + 1;
  if (layout.rows > kMostPixels || layout.columns > kMostPixels ||
      layout.rows * layout.columns > coded.size() / stride)
    bad(path, "it ends too early");

  SpectralPicture picture;
  picture.width_ = layout.columnsAlongX ? layout.columns : layout.rows;
  picture.height_ = layout.columnsAlongX ? layout.rows : layout.columns;
  picture.components_ = components;
  picture.first_ = first;
  picture.last_ = last;
  picture.pixels_.resize(layout.rows * layout.columns * stride);
  for (size_t row = 0; row < layout.rows; ++row)
    for (size_t column = 0; column < layout.columns; ++column)
      std::copy_n(coded.begin() + static_cast<ptrdiff_t>((row * layout.columns + column) * stride), stride,
                  picture.pixels_.begin() + static_cast<ptrdiff_t>(placeOf(layout, row, column) * stride));
  const Size size = sizeOf(picture.width_, picture.height_, header.aspect);
  picture.sizeX_ = size.x;
  picture.sizeY_ = size.y;
  return picture;
}

void SpectralPicture::value(double x, double y, std::span<double> spectrum) const {
  const Weights along = weightsAt(x / sizeX_ * static_cast<double>(width_ - 1), width_);
  const Weights up = weightsAt(y / sizeY_ * static_cast<double>(height_ - 1), height_);
  std::fill(spectrum.begin(), spectrum.end(), 0.);
  const auto add = [&](size_t row, size_t column, double weight) {
    if (std::abs(weight) <= 1e-6) return;
    const uint8_t* const pixel = &pixels_[(row * width_ + column) * (components_ + 1)];
    const double step = weight * stepOf(pixel[components_]);
    for (size_t i = 0; i < components_; ++i) spectrum[i] += step * (pixel[i] + .5);
  };
  const auto addRow = [&](size_t row, double weight) {
    add(row, along.index, weight * along.first);
    if (width_ > 1) add(row, along.index + 1, weight * along.second);
  };
  addRow(up.index, up.first);
  if (height_ > 1) addRow(up.index + 1, up.second);
}

}  // namespace rsphere
