#include "shade/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "rad_parser/block.h"
#include "rad_parser/error.h"
#include "rad_parser/open_file.h"
#include "rad_parser/printable.h"

namespace rsphere {
namespace {

// The order of pixels in the file: numbers of rows and columns, and their orientation in the picture.
struct Layout {
  size_t rows = 0, columns = 0;
  bool columnsAlongX = true;                  // otherwise a row of the file is a column of the picture
  bool rowsFall = true, columnsFall = false;  // whether they run opposite to their axis
};

struct Header {
  Layout layout;
  double aspect = 1;
  std::vector<std::string> formats;  // of all FORMAT= lines, usually one
  int components = 3;
  std::array<double, 2> wavelengths{};  // nm, limits of the spectra; 0: not given
};

[[noreturn]] void bad(const std::string& path, std::string_view why) {
  throw rad::Error(fmt::format("{}: bad picture file: {}", path, why));
}

// Reads the bytes of a file in sequence. Regular files are read in blocks, because the largest pictures have
// gigabytes. Other files, whose size is unknown, are read as a whole.
class Bytes {
 public:
  explicit Bytes(const std::string& path) : path_(path), file_(path), descriptor_(file_.descriptor()) {
    if (descriptor_ < 0)
      throw rad::Error(fmt::format("{}: cannot open picture file", path), rad::Status::system);
    if (file_.isRegular()) {
      block_.resize(kBlock);
      unread_ = file_.size();
    } else {
      block_ = file_.contents(path);
      descriptor_ = -1;
    }
    next_ = block_.data();
    end_ = next_ + (descriptor_ < 0 ? block_.size() : 0);
  }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

  const std::string& path() const { return path_; }
  // The number of bytes not yet taken.
  size_t left() const { return static_cast<size_t>(end_ - next_) + unread_; }

  uint8_t next() { return static_cast<uint8_t>(take(1)[0]); }
  // Takes the next bytes, at most this many and at least one. They are valid until the next call.
  std::string_view take(size_t most) {
    if (next_ == end_ && !readOn()) bad(path_, "it ends too early");
    const std::string_view taken(next_, std::min(static_cast<size_t>(end_ - next_), most));
    next_ += taken.size();
    return taken;
  }
  // Looks at the next bytes without taking them; fewer than `count` only at the end of the file.
  std::string_view ahead(size_t count) {
    while (static_cast<size_t>(end_ - next_) < count && readOn()) {
    }
    return {next_, std::min(static_cast<size_t>(end_ - next_), count)};
  }
  // The next line without its line end; empty if the file ends first.
  std::optional<std::string> line() {
    std::string text;
    while (!ahead(1).empty()) {
      const auto c = static_cast<char>(next());
      if (c == '\n') return text;
      text += c;
    }
    return std::nullopt;
  }

 private:
  static constexpr size_t kBlock = 1 << 18;

  bool readOn() {
    if (descriptor_ < 0) return false;
    const char* keep = next_;
    const auto kept = end_ - keep;
    const bool more = rad::readOn(descriptor_, block_.data(), kBlock, keep, next_, end_,
                                  [&] { return rad::printable(path_, rad::kLongestName); });
    unread_ -= std::min(unread_, static_cast<size_t>(end_ - keep - kept));
    return more;
  }

  const std::string& path_;
  rad::OpenFile file_;
  int descriptor_;  // -1 at the end of the file
  std::string block_;
  const char* next_;
  const char* end_;
  size_t unread_ = 0;  // bytes of the file after this block
};

// rtrace reads resolution lines only up to this length, and takes the rest of a longer one for pixels.
constexpr size_t kLongestResolution = 30;
constexpr size_t kMostPixels = 65536;  // in a row or a column

// The whole number at the beginning of a text, limited to kMostPixels + 1; none if it is below 1.
std::optional<size_t> lengthAt(std::string_view text) {
  text = rad::trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  size_t length = 0;
  const auto error = std::from_chars(text.data(), text.data() + text.size(), length).ec;
  if (error == std::errc::result_out_of_range) return kMostPixels + 1;
  if (error != std::errc() || length == 0) return std::nullopt;
  return std::min(length, kMostPixels + 1);
}

// Parses "-Y 480 +X 640": the slowest axis comes first. As in rtrace, an axis without a sign is ascending,
// the last X and the last Y are used, and text between and after the numbers is ignored.
std::optional<Layout> readLayout(std::string_view line) {
  const size_t x = line.rfind('X'), y = line.rfind('Y');
  if (x == line.npos || y == line.npos) return std::nullopt;
  const auto width = lengthAt(line.substr(x + 1)), height = lengthAt(line.substr(y + 1));
  if (!width || !height) return std::nullopt;
  const auto falls = [&](size_t axis) { return axis > 0 && line[axis - 1] == '-'; };
  if (y < x) return Layout{*height, *width, true, falls(y), falls(x)};
  return Layout{*width, *height, false, falls(x), falls(y)};
}

// The next number of a text; 0 if there is none.
template <class T>
T nextNumber(std::string_view& text) {
  text = rad::trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  T number{};
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number).ptr;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return number;
}

// The rest of a header line after its name; empty if it has another name.
std::optional<std::string_view> after(std::string_view name, std::string_view line) {
  if (!line.starts_with(name)) return {};
  return line.substr(name.size());
}

Header readHeader(Bytes& bytes) {
  const std::string& path = bytes.path();
  Header header;
  while (true) {
    const auto text = bytes.line();
    if (!text) bad(path, "its header does not end");
    if (text->empty() || *text == "\r") break;
    if (const auto format = after("FORMAT=", *text)) {
      if (!rad::trimmed(*format).empty()) header.formats.emplace_back(rad::trimmed(*format));
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
  const std::string resolution = bytes.line().value_or("");
  if (resolution.size() > kLongestResolution)
    bad(path, fmt::format("its resolution line has more than {} characters: \"{}\"", kLongestResolution,
                          rad::printable(resolution)));
  const auto layout = readLayout(resolution);
  if (!layout)
    bad(path, fmt::format("expected a resolution such as \"-Y 480 +X 640\", got \"{}\"",
                          rad::printable(resolution)));
  header.layout = *layout;
  if (header.layout.rows > kMostPixels || header.layout.columns > kMostPixels)
    bad(path, fmt::format("it has more than {} rows or columns", kMostPixels));
  return header;
}

PictureSize sizeOf(size_t columns, size_t rows, double aspect) {
  const double height = static_cast<double>(rows) * aspect;
  const auto width = static_cast<double>(columns);
  return {std::max(1., width / height), std::max(1., height / width)};
}

// The pixel of the picture at a row and column of the file. Pixels are numbered row by row from the lower
// left.
size_t placeOf(const Layout& layout, size_t row, size_t column) {
  const size_t slow = layout.rowsFall ? layout.rows - 1 - row : row;
  const size_t fast = layout.columnsFall ? layout.columns - 1 - column : column;
  return layout.columnsAlongX ? slow * layout.columns + fast : fast * layout.rows + slow;
}

// A pixel of a file has four bytes: three mantissas and a shared exponent.
void readChannel(Bytes& bytes, std::vector<Rgbe>& row, size_t channel) {
  for (size_t at = 0; at < row.size();) {
    const uint8_t code = bytes.next();
    const size_t count = code > 128 ? code - 128u : code;
    if (count > row.size() - at) bad(bytes.path(), "a run is too long");
    const size_t end = at + count;
    if (code > 128) {
      for (const uint8_t repeated = bytes.next(); at < end; ++at) row[at][channel] = repeated;
    } else {
      while (at < end)
        for (const char byte : bytes.take(end - at)) row[at++][channel] = static_cast<uint8_t>(byte);
    }
  }
}

// In the old code, (1, 1, 1, n) repeats the preceding pixel n times; directly after another such code, n is
// multiplied by 256, 256^2 and so on. As in rtrace, a run ends with the row, and at the start of a row these
// four bytes are a pixel.
void readPixels(Bytes& bytes, std::vector<Rgbe>& row) {
  int shift = 0;
  for (size_t at = 0; at < row.size();) {
    Rgbe pixel;
    const std::string_view coded = bytes.ahead(pixel.size());
    if (coded.size() < pixel.size()) bad(bytes.path(), "it ends too early");
    std::memcpy(pixel.data(), coded.data(), pixel.size());
    bytes.take(pixel.size());
    if (at == 0 || pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[at++] = pixel;
      shift = 0;
      continue;
    }
    const size_t count = std::min(static_cast<size_t>(pixel[3]) << shift, row.size() - at);
    for (const size_t end = at + count; at < end; ++at) row[at] = row[at - 1];
    shift = std::min(shift + 8, 24);  // 2^24 is more than any row
  }
}

// Reads the next row: channel by channel in the new run-length code, or pixel by pixel in the old one.
// Programs write the new code for rows of 8 to 32767 pixels; as in rtrace, its mark is accepted at any
// length.
void readRow(Bytes& bytes, std::vector<Rgbe>& row) {
  const std::string_view mark = bytes.ahead(4);
  if (mark.size() == 4 && mark.starts_with("\2\2") && static_cast<uint8_t>(mark[2]) < 128) {
    if ((static_cast<size_t>(mark[2]) << 8 | static_cast<uint8_t>(mark[3])) != row.size())
      bad(bytes.path(), "the length of a row differs from the resolution line");
    bytes.take(mark.size());
    for (size_t channel = 0; channel < 4; ++channel) readChannel(bytes, row, channel);
  } else {
    readPixels(bytes, row);
  }
}

// The step between mantissas, for a given exponent.
float stepOf(uint8_t exponent) {
  static constexpr std::array<float, 256> steps = [] {
    std::array<float, 256> s{};  // 2^(exponent - 136), but 0 for 0
    s[136] = 1;
    for (size_t e = 137; e < 256; ++e) s[e] = 2 * s[e - 1];
    for (size_t e = 135; e > 0; --e) s[e] = s[e + 1] / 2;
    return s;
  }();
  return steps[exponent];
}

// A mantissa is decoded as the middle of its step. Source: RADIANCE file formats, "Picture File Format".
void decode(const Rgbe& pixel, float* rgb) {
  const float step = stepOf(pixel[3]);
  for (size_t i = 0; i < 3; ++i) rgb[i] = (static_cast<float>(pixel[i]) + .5f) * step;
}

// The two pixels beside a position (in pixels) and their weights, by the rule of rad::DataFile::value().
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

// Calls use(pixel, weight of its row, weight of its column) for the pixels among which the value at fractions
// (u, v) of the size is interpolated.
template <class Use>
void eachNearby(double u, double v, size_t width, size_t height, const Use& use) {
  const Weights along = weightsAt(u * static_cast<double>(width - 1), width);
  const Weights up = weightsAt(v * static_cast<double>(height - 1), height);
  for (size_t row = 0; row < std::min<size_t>(height, 2); ++row)
    for (size_t column = 0; column < std::min<size_t>(width, 2); ++column)
      use((up.index + row) * width + along.index + column, row == 0 ? up.first : up.second,
          column == 0 ? along.first : along.second);
}

constexpr std::string_view kColors = "32-bit_rle_rgbe", kSpectra = "Radiance_spectra";

// Rejects a picture whose file is too short, before memory is allocated. In the new code, two bytes hold at
// most 127 values of one of four channels: 16 pixels per byte. In the old code, 12 bytes may hold a whole
// row. A picture of up to 64 million pixels (256 MB) is therefore only required to have 4 bytes per row; a
// larger one may have at most twice the pixels that its bytes can hold in the new code.
void checkLength(const Layout& layout, const Bytes& bytes) {
  constexpr size_t kAnyCode = size_t{1} << 26, kLeastRow = 4;
  const size_t left = bytes.left();
  if (layout.rows > left / kLeastRow || layout.rows * layout.columns > std::max(kAnyCode, 32 * left + 64))
    bad(bytes.path(), "it ends too early");
}

}  // namespace

Picture Picture::read(const std::string& path) {
  Bytes bytes(path);
  const Header header = readHeader(bytes);
  Picture picture;
  for (const std::string& format : header.formats) {
    if (format == kSpectra) bad(path, "it has spectra, which only specpict reads");
    if (format == "32-bit_rle_xyze") bad(path, "it is in XYZE; \"ra_xyze -r\" converts it to RGBE");
    if (format != kColors) bad(path, fmt::format("expected RGBE (FORMAT={})", kColors));
  }
  const Layout& layout = header.layout;
  checkLength(layout, bytes);
  std::vector<Rgbe> row(layout.columns);
  picture.width_ = layout.columnsAlongX ? layout.columns : layout.rows;
  picture.height_ = layout.columnsAlongX ? layout.rows : layout.columns;
  picture.pixels_.resize(picture.width_ * picture.height_);
  for (size_t i = 0; i < layout.rows; ++i) {
    readRow(bytes, row);
    for (size_t j = 0; j < layout.columns; ++j) picture.pixels_[placeOf(layout, i, j)] = row[j];
  }
  picture.size_ = sizeOf(picture.width_, picture.height_, header.aspect);
  return picture;
}

Color Picture::value(double x, double y) const {
  Color sum(0, 0, 0);
  eachNearby(x / size_.x, y / size_.y, width_, height_, [&](size_t i, double ofRow, double ofColumn) {
    if (std::abs(ofRow) <= 1e-6) return;
    float rgb[3];
    decode(pixels_[i], rgb);
    const double weight = ofRow * ofColumn;
    sum += Color(weight * rgb[0], weight * rgb[1], weight * rgb[2]);
  });
  return sum;
}

SpectralPicture SpectralPicture::read(const std::string& path) {
  Bytes bytes(path);
  const Header header = readHeader(bytes);
  const auto [first, last] = header.wavelengths;
  if (std::ranges::any_of(header.formats, [](auto& f) { return f != kSpectra; }))
    bad(path, fmt::format("expected spectra (FORMAT={})", kSpectra));
  constexpr int kLeastComponents = 4;  // three components are red, green and blue, which are read by
                                       // colorpict
  if (header.components < kLeastComponents) bad(path, "expected at least 4 components (NCOMP=)");
  const auto isWavelength = [](double nm) { return nm >= 1 && nm <= 1e6; };
  if (!(isWavelength(first) && isWavelength(last) && first != last))
    bad(path, "expected four wavelengths (WAVELENGTH_SPLITS=)");
  const Layout& layout = header.layout;
  const auto components = static_cast<size_t>(header.components), stride = components + 1;
  if (!layout.columnsAlongX || !layout.rowsFall || layout.columnsFall)
    bad(path, "expected rows from above, each from left to right (-Y ... +X ...)");
  if (layout.rows * layout.columns > bytes.left() / stride) bad(path, "it ends too early");

  SpectralPicture picture;
  picture.width_ = layout.columns;
  picture.height_ = layout.rows;
  picture.components_ = components;
  picture.first_ = first;
  picture.last_ = last;
  picture.pixels_.resize(layout.rows * layout.columns * stride);
  for (size_t row = 0; row < layout.rows; ++row)
    for (size_t column = 0; column < layout.columns; ++column) {
      uint8_t* const pixel = &picture.pixels_[placeOf(layout, row, column) * stride];
      for (size_t i = 0; i < stride;)
        for (const char byte : bytes.take(stride - i)) pixel[i++] = static_cast<uint8_t>(byte);
    }
  picture.size_ = sizeOf(picture.width_, picture.height_, header.aspect);
  return picture;
}

void SpectralPicture::value(double x, double y, std::span<double> spectrum) const {
  std::ranges::fill(spectrum, 0.);
  eachNearby(x / size_.x, y / size_.y, width_, height_, [&](size_t i, double ofRow, double ofColumn) {
    const double weight = ofRow * ofColumn;
    if (std::abs(weight) <= 1e-6) return;
    const uint8_t* const pixel = &pixels_[i * (components_ + 1)];
    const double step = weight * stepOf(pixel[components_]);
    for (size_t c = 0; c < components_; ++c) spectrum[c] += step * (pixel[c] + .5);
  });
}

}  // namespace rsphere
