#include "records/output_colors.h"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "base/colorimetry.h"
#include "base/constants.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

constexpr double kScotopicEfficacy = 412;   // lm/W, like kPhotopicEfficacy, but for V'(lambda)
constexpr double kMelanopicEfficacy = 179;  // RADIANCE's choice

// Fractions of V'(lambda) and of the melanopic curve in the parts of the spectrum represented by red, green
// and blue. They are the values that rtrace -pS and -pM of RADIANCE 6.1a print for pure red, green and blue.
const Color kScotopicWeights(740 / 65535., 46459 / 65535., 18336 / 65535.);
const Color kMelanopicWeights(120 / 65535., 39340 / 65535., 26075 / 65535.);

// EDI of light of equal energy at all wavelengths, in units of its illuminance: the ratio of the integrals of
// action spectrum and V(lambda), by D65's efficacy: .8173, 1.4558, 1.6289, 1.4497, 1.3262 mW/lm (CIE S 026).
constexpr std::array<double, 5> kEdiOfEqualEnergy = {.9255, .9594, 1.0061, .9175, .9058};

constexpr double kLeastRange = 50;  // nm, between the limits of -cw

// The matrix that adapts X, Y, Z from equal-energy white to the given white.
M33d adaptation(double xWhite, double yWhite) {
  constexpr double kSameWhite = 1e-4;
  if (std::fabs(xWhite - 1 / 3.) <= kSameWhite && std::fabs(yWhite - 1 / 3.) <= kSameWhite) return {};
  const V3d from = V3d(1, 1, 1) * kSharpFromXyz, to = xyzOfChromaticity(xWhite, yWhite) * kSharpFromXyz;
  M33d gains;
  for (int i = 0; i < 3; ++i) gains[i][i] = to[i] / from[i];
  return kSharpFromXyz * gains * kXyzFromSharp;
}

bool primariesSpan(const Primaries& p) {
  constexpr double kSame = 1e-4;  // as in RADIANCE
  if (!(p[6] > kSame && p[6] < 1 - kSame && p[7] > kSame && p[7] < 1 - kSame)) return false;
  for (size_t i = 0; i < 6; i += 2)
    for (const double value : {p[i], p[i + 1], p[i] + p[i + 1]})
      if (!(value > -2 && value < 3)) return false;
  for (size_t i = 0; i < 8; i += 2)
    for (size_t j = i + 2; j < 8; j += 2)
      if (std::fabs(p[i] - p[j]) <= kSame && std::fabs(p[i + 1] - p[j + 1]) <= kSame) return false;
  const M33d rows(p[0], p[1], 1 - p[0] - p[1], p[2], p[3], 1 - p[2] - p[3], p[4], p[5], 1 - p[4] - p[5]);
  return std::fabs(rows.determinant()) > kSame;
}

}  // namespace

OutputColors::OutputColors(const ColorOptions& options) : options_(options), sampling_(options.sampling()) {
  if (sampling_) bandWeights_ = bandWeights(*sampling_);
  const auto oneChannel = [&](const Color& weights, double scale) {
    count_ = 1;
    weights_ = weights;
    scale_ = scale;
  };
  switch (options.space) {
    case ColorSpace::rgb: break;
    case ColorSpace::xyz:
      matrix_ = xyzFromRgb(kStandardPrimaries);
      scale_ = kPhotopicEfficacy;
      break;
    case ColorSpace::primaries: {
      const auto& p = options.primaries;
      const M33d adapted = adaptation(p[6], p[7]);
      matrix_ = (sampling_ ? adapted : xyzFromRgb(kStandardPrimaries) * adapted) * xyzFromRgb(p).inverse();
      break;
    }
    case ColorSpace::photopic:
      oneChannel(Color(kRedWeight, kGreenWeight, kBlueWeight), kPhotopicEfficacy);
      break;
    case ColorSpace::scotopic: oneChannel(kScotopicWeights, kScotopicEfficacy); break;
    case ColorSpace::melanopic: oneChannel(kMelanopicWeights, kMelanopicEfficacy); break;
    case ColorSpace::edi: {
      // Unlike those of rtrace's options, these curves and limits of bands are not shifted.
      static constexpr std::array<double, 1> kOne{1};
      const auto seen = [&](double from, double to) { return seenBy(options.receptor, {kOne, from, to}); };
      const auto [red, green] = spectralSampling(3, 380, 780).splits;
      oneChannel(Color(seen(780, red), seen(red, green), seen(green, 380)),
                 kPhotopicEfficacy * kEdiOfEqualEnergy[static_cast<size_t>(options.receptor)]);
      for (int i = 0; sampling_ && i < options.bands; ++i) {
        const double from = sampling_->longest - i * sampling_->width();
        seen_.push_back(seen(from, from - sampling_->width()));
      }
      break;
    }
    case ColorSpace::average: oneChannel(Color(1 / 3., 1 / 3., 1 / 3.), 1); break;
    case ColorSpace::spectrum: count_ = options.bands; break;
  }
}

void OutputColors::write(RecordText& text, const Color& color, double scale) const {
  if (sampling_) return writeBands(text, color.bandsIn(*sampling_), scale);
  switch (options_.space) {
    case ColorSpace::rgb:
    case ColorSpace::spectrum: return text.color(color);
    case ColorSpace::xyz: return text.color(Color(color.rgb() * matrix_ * scale));
    case ColorSpace::primaries: return text.color(Color(intoGamut(color.rgb() * matrix_, brightness(color))));
    case ColorSpace::photopic:
    case ColorSpace::scotopic:
    case ColorSpace::melanopic:
    case ColorSpace::edi:
    case ColorSpace::average:
      return text.number(scale * (weights_.x * color.x + weights_.y * color.y + weights_.z * color.z));
  }
}

void OutputColors::writeBands(RecordText& text, const Bands& bands, double scale) const {
  const std::span<const double> values = bands.values();
  const auto sum = [&](const std::vector<double>& weights) {
    return std::inner_product(values.begin(), values.end(), weights.begin(), 0.);
  };
  switch (options_.space) {
    case ColorSpace::rgb: return text.color(Color(standardRgb(bandWeights_.tristimulus(values))));
    case ColorSpace::spectrum: return text.spectrum(values);
    case ColorSpace::xyz: return text.color(Color(bandWeights_.tristimulus(values) * scale));
    case ColorSpace::primaries: {
      const V3d xyz = bandWeights_.tristimulus(values);
      return text.color(Color(intoGamut(xyz * matrix_, xyz.y)));
    }
    case ColorSpace::photopic: return text.number(scale * sum(sampling_->photopic));
    case ColorSpace::scotopic: return text.number(scale * sum(bandWeights_.scotopic));
    case ColorSpace::melanopic: return text.number(scale * sum(bandWeights_.melanopic));
    case ColorSpace::edi: return text.number(scale * sum(seen_));
    case ColorSpace::average:
      return text.number(std::accumulate(values.begin(), values.end(), 0.) /
                         static_cast<double>(values.size()));
  }
}

void OutputColors::writeError(RecordText& text, const Radiance& error, double brightness) const {
  if (options_.space == ColorSpace::photopic) return text.number(scale_ * brightness);
  if (sampling_) return text.spectrum(std::as_const(error).color.bandsIn(*sampling_).values());
  text.color(error.color);
}

std::string OutputColors::headerLines() const {
  if (options_.space == ColorSpace::spectrum) {
    const auto [red, green] = spectralSampling(options_.bands, options_.shortest, options_.longest).splits;
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
  if (options.bands < 3)
    throw rad::Error(fmt::format("-cs {}: expected 3 to {} bands", options.bands, kMostBands));
  if (options.shortest < 0)
    throw rad::Error(
        fmt::format("-cw {} {}: expected wavelengths (nm) of 0 or more", options.shortest, options.longest));
  if (!(options.longest - options.shortest >= kLeastRange))
    throw rad::Error(fmt::format("-cw {} {}: expected wavelengths at least {} nm apart", options.shortest,
                                 options.longest, kLeastRange));
  if (options.space == ColorSpace::primaries && !primariesSpan(options.primaries))
    throw rad::Error("illegal primary chromaticities");
  constexpr double kShortest = 380, kLongest = 780;
  const bool whole = options.shortest == kShortest && options.longest == kLongest;
  const bool sums = options.space >= ColorSpace::scotopic && options.space <= ColorSpace::edi;
  if (options.bands == 3 && !whole && sums)
    throw rad::Error(
        "-pS, -pM and -pE of three channels need the whole spectrum (-cw 380 780, or -cs above 3)");
}

bool haveStandardErrors(const ColorOptions& options) {
  const ColorSpace computed = options.bands > 3 ? ColorSpace::spectrum : ColorSpace::rgb;
  return options.space == computed || options.space == ColorSpace::photopic;
}

bool areStandard(const Primaries& primaries) {
  for (size_t i = 0; i < primaries.size(); ++i)
    if (std::fabs(primaries[i] - kStandardPrimaries[i]) > .001) return false;
  return true;
}

}  // namespace rsphere
