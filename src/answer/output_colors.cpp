#include "answer/output_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rad_parser/error.h"

namespace rsphere {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// x y of red, green, blue and white: RADIANCE's nominal monitor, with equal-energy white.
constexpr std::array<double, 8> kStandard = {.640, .330, .290, .600, .150, .060, 1 / 3., 1 / 3.};

constexpr double kPhotopicEfficacy = 179;   // lm/W of equal-energy white, 380 to 780 nm
constexpr double kScotopicEfficacy = 412;   // the same for V'(lambda)
constexpr double kMelanopicEfficacy = 179;  // RADIANCE's choice

// Fractions of V'(lambda) and of the melanopic curve in the parts of the spectrum that red, green and blue
// represent, as rtrace -pS and -pM of RADIANCE 6.1a give them for pure red, green and blue.
const Color kScotopicWeights(740 / 65535., 46459 / 65535., 18336 / 65535.);
const Color kMelanopicWeights(120 / 65535., 39340 / 65535., 26075 / 65535.);

// Wavelengths (nm) of the limits between red, green and blue, and of the peaks of the
// outer channels' responses.
constexpr double kRedFrom = 588, kGreenFrom = 480;
constexpr double kRedPeak = 607, kBluePeak = 469;
constexpr double kLeastRange = 50;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

V3d product(const Matrix& a, const V3d& v) {
  return V3d(a[0][0] * v.x + a[0][1] * v.y + a[0][2] * v.z, a[1][0] * v.x + a[1][1] * v.y + a[1][2] * v.z,
             a[2][0] * v.x + a[2][1] * v.y + a[2][2] * v.z);
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Matrix inverse(const Matrix& m) {
  const double d = determinant(m);
  Matrix r{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      const size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, e = (i + 2) % 3;
      r[i][j] = (m[a][c] * m[b][e] - m[a][e] * m[b][c]) / d;
    }
  return r;
}

V3d xyzOf(double x, double y) { return V3d(x / y, 1, (1 - x - y) / y); }

// The matrix whose columns are X, Y, Z of one unit of each primary. Their sum is white with Y = 1.
Matrix xyzFromRgb(const std::array<double, 8>& p) {
  Matrix columns{};
  for (size_t i = 0; i < 3; ++i) {
    columns[0][i] = p[2 * i];
    columns[1][i] = p[2 * i + 1];
    columns[2][i] = 1 - p[2 * i] - p[2 * i + 1];
  }
  const V3d units = product(inverse(columns), xyzOf(p[6], p[7]));
  for (auto& row : columns) {
    row[0] *= units.x;
    row[1] *= units.y;
    row[2] *= units.z;
  }
  return columns;
}

// The matrix that adapts X, Y, Z from equal-energy white to this white.
Matrix adaptation(double xWhite, double yWhite) {
  // The "sharp" transform and its inverse, with the digits that RADIANCE gives them. Their product deviates
  // from the unit matrix by 9e-5, so that the colors of rtrace deviate too.
  constexpr Matrix sharp = {{{1.2694, -.0988, -.1706}, {-.8364, 1.8006, .0357}, {.0297, -.0315, 1.0018}}};
  constexpr Matrix sharpInverse = {{{.8156, .0472, .1372}, {.3791, .5769, .0440}, {-.0123, .0167, .9955}}};
  constexpr double kSameWhite = 1e-4;
  if (std::fabs(xWhite - 1 / 3.) <= kSameWhite && std::fabs(yWhite - 1 / 3.) <= kSameWhite)
    return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const V3d from = product(sharp, V3d(1, 1, 1)), to = product(sharp, xyzOf(xWhite, yWhite));
  Matrix gains{};
  gains[0][0] = to.x / from.x;
  gains[1][1] = to.y / from.y;
  gains[2][2] = to.z / from.z;
  return product(sharpInverse, product(gains, sharp));
}

// The color, mixed with just enough grey of the same luminance that no channel is negative.
V3d intoGamut(V3d color, double luminance) {
  if (luminance < 0) return V3d(0, 0, 0);
  double share = 1;
  for (const double channel : {color.x, color.y, color.z})
    if (channel < 0) share = std::min(share, luminance / (luminance - channel));
  return share < 1 ? color * share + V3d(luminance) * (1 - share) : color;
}

// The wavelengths of the limits between the channels.
std::array<double, 2> splits(const ColorOptions& o) {
  if (spectrumHoldsChannels(o)) return {kRedFrom, kGreenFrom};
  const double third = (o.longest - o.shortest) / 3;
  return {o.longest - third, o.longest - 2 * third};
}

bool primariesSpan(const std::array<double, 8>& p) {
  constexpr double kSame = 1e-4;  // as in RADIANCE
  if (!(p[6] > kSame && p[6] < 1 - kSame && p[7] > kSame && p[7] < 1 - kSame)) return false;
  for (size_t i = 0; i < 6; i += 2)
    for (const double value : {p[i], p[i + 1], p[i] + p[i + 1]})
      if (!(value > -2 && value < 3)) return false;
  for (size_t i = 0; i < 8; i += 2)
    for (size_t j = i + 2; j < 8; j += 2)
      if (std::fabs(p[i] - p[j]) <= kSame && std::fabs(p[i + 1] - p[j + 1]) <= kSame) return false;
  const Matrix columns = {
      {{p[0], p[2], p[4]}, {p[1], p[3], p[5]}, {1 - p[0] - p[1], 1 - p[2] - p[3], 1 - p[4] - p[5]}}};
  return std::fabs(determinant(columns)) > kSame;
}

}  // namespace

OutputColors::OutputColors(const ColorOptions& options) : options_(options) {
  const auto oneChannel = [&](const Color& weights, double scale) {
    count_ = 1;
    weights_ = weights;
    scale_ = scale;
  };
  switch (options.space) {
    case ColorSpace::rgb:
      break;
    case ColorSpace::xyz:
      fromRgb_ = xyzFromRgb(kStandard);
      scale_ = kPhotopicEfficacy;
      break;
    case ColorSpace::primaries: {
      const auto& p = options.primaries;
      fromRgb_ = product(inverse(xyzFromRgb(p)), product(adaptation(p[6], p[7]), xyzFromRgb(kStandard)));
      break;
    }
    case ColorSpace::photopic:
      oneChannel(Color(kRedWeight, kGreenWeight, kBlueWeight), kPhotopicEfficacy);
      break;
    case ColorSpace::scotopic:
      oneChannel(kScotopicWeights, kScotopicEfficacy);
      break;
    case ColorSpace::melanopic:
      oneChannel(kMelanopicWeights, kMelanopicEfficacy);
      break;
    case ColorSpace::average:
      oneChannel(Color(1 / 3., 1 / 3., 1 / 3.), 1);
      break;
    case ColorSpace::spectrum: {
      count_ = options.bands;
      const auto [red, green] = splits(options);
      const double step = (options.longest - options.shortest) / options.bands;
      for (int i = 0; i < options.bands; ++i) {
        const double middle = options.longest - (i + .5) * step;
        channel_.push_back(middle >= red ? 0 : middle >= green ? 1 : 2);
      }
      break;
    }
  }
}

void OutputColors::write(RecordText& text, const Color& color, double scale) const {
  switch (options_.space) {
    case ColorSpace::rgb:
      return text.color(color);
    case ColorSpace::xyz: {
      const V3d xyz = product(fromRgb_, color.rgb()) * scale;
      return text.color(Color(xyz.x, xyz.y, xyz.z));
    }
    case ColorSpace::primaries: {
      const V3d other = intoGamut(product(fromRgb_, color.rgb()), brightness(color));
      return text.color(Color(other.x, other.y, other.z));
    }
    case ColorSpace::photopic:
    case ColorSpace::scotopic:
    case ColorSpace::melanopic:
    case ColorSpace::average:
      return text.number(scale * (weights_.x * color.x + weights_.y * color.y + weights_.z * color.z));
    case ColorSpace::spectrum:
      return text.spectrum(color, channel_);
  }
}

std::string OutputColors::headerLines() const {
  if (options_.space == ColorSpace::spectrum) {
    const auto [red, green] = splits(options_);
    return fmt::format("WAVELENGTH_SPLITS= {:.6g} {:.6g} {:.6g} {:.6g}\n", options_.longest, red, green,
                       options_.shortest);
  }
  if (options_.space != ColorSpace::xyz && options_.space != ColorSpace::primaries) return "";
  constexpr std::array<double, 8> kXyz = {1, 0, 0, 1, 0, 0, 1 / 3., 1 / 3.};
  std::string line = "PRIMARIES=";
  for (const double x : options_.space == ColorSpace::xyz ? kXyz : options_.primaries)
    line += fmt::format(" {:.4f}", x);
  return line + '\n';
}

std::string_view OutputColors::pixelFormat() const {
  if (options_.space == ColorSpace::spectrum) return "Radiance_spectra";
  return options_.space == ColorSpace::xyz ? "32-bit_rle_xyze" : "32-bit_rle_rgbe";
}

void checkColors(const ColorOptions& options) {
  if (options.bands < 3 || options.longest - options.shortest < kLeastRange)
    throw rad::Error("unsupported spectral sampling");
  if (options.space == ColorSpace::primaries && !primariesSpan(options.primaries))
    throw rad::Error("illegal primary chromaticities");
  constexpr double kShortest = 380, kLongest = 780;
  const bool whole = options.shortest == kShortest && options.longest == kLongest;
  if (!whole && (options.space == ColorSpace::scotopic || options.space == ColorSpace::melanopic))
    throw rad::Error("-pS and -pM need the whole spectrum (-cw 380 780)");
}

bool spectrumHoldsChannels(const ColorOptions& options) {
  return options.shortest < kBluePeak && options.longest > kRedPeak;
}

bool areStandard(const std::array<double, 8>& primaries) {
  for (size_t i = 0; i < primaries.size(); ++i)
    if (std::fabs(primaries[i] - kStandard[i]) > .001) return false;
  return true;
}

}  // namespace rsphere
