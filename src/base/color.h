#pragma once
// Colors: red, green and blue, and besides them in a spectral run (-cs above 3) the bands of a spectrum, or
// the parts of the color that contributors give (-Sp).
#include <Imath/ImathVec.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace rsphere {

using Imath::V3d;

struct BandScheme;
struct SpectralSampling;

// The bands of a color (band_scheme.h), or none. A value like any other: copies are independent of each
// other. Of the parts of contributors, only those from the first to the last that may differ from 0 take
// memory and time.
class Bands {
 public:
  constexpr Bands() = default;
  // All 0. The scheme must exist as long as the bands and all copies of them.
  explicit Bands(const BandScheme& scheme);
  Bands(const Bands& other) : block_(nullptr) {
    if (other.block_) [[unlikely]]
      assign(other);
  }
  constexpr Bands(Bands&& other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  Bands& operator=(const Bands& other) {
    if (block_ || other.block_) [[unlikely]]
      assign(other);
    return *this;
  }
  constexpr Bands& operator=(Bands&& other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  constexpr ~Bands() {
    if (block_) [[unlikely]]
      release();
  }

  explicit operator bool() const { return block_ != nullptr; }
  // REQUIRES bands, as do the next four.
  const BandScheme& scheme() const;
  const SpectralSampling& sampling() const;  // REQUIRES bands of a spectrum
  // All values. Those of a spectrum begin with the longest wavelength. REQUIRES, if it is constant: bands of
  // a spectrum, or a result of Color::bandsIn().
  std::span<double> values();
  std::span<const double> values() const;

 private:
  friend class Color;
  struct Block;
  struct Spares;
  double* cover(size_t first, size_t end);
  double* cover(const Block& like);
  void addScaled(const Block& other, double factor);
  void assign(const Bands& other);
  void release();

  Block* block_ = nullptr;
};

// A color without bands has in each band the value of the band's channel (BandScheme::channel), so that gray
// is the same in all of them, and arithmetic that mixes both kinds of colors is exact. Where a color has the
// bands of a spectrum, red, green and blue are what the same arithmetic makes of the means of their bands:
// estimates for decisions that change no expected value (weights, samples), which are 0 only where all of the
// bands are. What is written is computed from the bands.
//
// Where a color has the parts of contributors, red, green and blue are the same as without them. A color
// without parts that is added has no contributor; one that is a factor applies to all parts alike.
class Color {
 public:
  double x = 0, y = 0, z = 0;  // red, green, blue

  constexpr Color() = default;
  constexpr Color(double red, double green, double blue) : x(red), y(green), z(blue) {}
  explicit constexpr Color(double gray) : x(gray), y(gray), z(gray) {}
  explicit constexpr Color(const V3d& rgb) : x(rgb.x), y(rgb.y), z(rgb.z) {}
  // REQUIRES bands of a spectrum. Red, green and blue are the means of theirs.
  explicit Color(Bands bands);
  // With bands, or without any if they are none.
  Color(const V3d& rgb, Bands bands) : x(rgb.x), y(rgb.y), z(rgb.z), bands_(std::move(bands)) {}

  double& operator[](int channel) { return (&x)[channel]; }
  const double& operator[](int channel) const { return (&x)[channel]; }
  // Red, green and blue alone.
  V3d rgb() const { return V3d(x, y, z); }

  const Bands& bands() const { return bands_; }
  // Those of the color as a term of a sum: without bands, those of its channels, or parts that are 0.
  // REQUIRES that its bands, if it has any, have this scheme.
  Bands bandsIn(const BandScheme& scheme) const;
  // A color that one contributor gives. The scheme must exist as long as Bands() says.
  static Color ofContributor(const V3d& rgb, size_t contributor, const BandScheme& parts);
  // The part that a contributor gives, without bands; black if the color has no parts.
  Color part(size_t contributor) const;
  // The color with parts in the proportions of those of another color, which has some.
  Color dividedAs(const Color& other) const;
  // The smallest and the largest value of its bands, or of its channels if it has parts. REQUIRES bands.
  std::pair<double, double> extremesOfBands() const;
  // Has the processor fetch the bands, which a later use will not wait for then.
  void prefetch() const {
    if (bands_) [[unlikely]]
      __builtin_prefetch(bands_.block_);
  }
  // Replaces the value in each channel and band by f(value).
  template <class F>
  void transform(const F& f) {
    x = f(x), y = f(y), z = f(z);
    if (bands_) [[unlikely]] {
      for (double& v : bands_.values()) v = f(v);
    }
  }

  Color& operator+=(const Color& o) {
    if (bands_ || o.bands_) [[unlikely]]
      addBands(o, 1);
    x += o.x, y += o.y, z += o.z;
    return *this;
  }
  Color& operator-=(const Color& o) {
    if (bands_ || o.bands_) [[unlikely]]
      addBands(o, -1);
    x -= o.x, y -= o.y, z -= o.z;
    return *this;
  }
  Color& operator*=(const Color& o) {
    if (bands_ || o.bands_) [[unlikely]]
      multiplyBands(o);
    x *= o.x, y *= o.y, z *= o.z;
    return *this;
  }
  Color& operator/=(const Color& o) {
    if (bands_ || o.bands_) [[unlikely]]
      divideBands(o);
    x /= o.x, y /= o.y, z /= o.z;
    return *this;
  }
  Color& operator*=(double factor) {
    if (bands_) [[unlikely]]
      scaleBands(factor);
    x *= factor, y *= factor, z *= factor;
    return *this;
  }
  Color& operator/=(double divisor) {
    if (bands_) [[unlikely]]
      scaleBands(1 / divisor);
    x /= divisor, y /= divisor, z /= divisor;
    return *this;
  }

  // Adds a * factor or a * b, for sums that most of the time goes into.
  void addScaled(const Color& a, double factor) {
    if (bands_ || a.bands_) [[unlikely]]
      addBands(a, factor);
    x += a.x * factor, y += a.y * factor, z += a.z * factor;
  }
  void addProduct(const Color& a, const Color& b) {
    if (bands_ || a.bands_ || b.bands_) [[unlikely]]
      addBands(a * b, 1);
    x += a.x * b.x, y += a.y * b.y, z += a.z * b.z;
  }
  // Adds a * b * f * g, multiplied in this order.
  void addProduct(const Color& a, const Color& b, double f, double g) {
    if (bands_ || a.bands_ || b.bands_) [[unlikely]]
      addBands(a * b * f * g, 1);
    x += a.x * b.x * f * g, y += a.y * b.y * f * g, z += a.z * b.z * f * g;
  }

  friend Color operator+(const Color& a, const Color& b) {
    Color sum(a.x + b.x, a.y + b.y, a.z + b.z);
    if (a.bands_ || b.bands_) [[unlikely]]
      sum.setSum(a, b, 1);
    return sum;
  }
  friend Color operator-(const Color& a, const Color& b) {
    Color difference(a.x - b.x, a.y - b.y, a.z - b.z);
    if (a.bands_ || b.bands_) [[unlikely]]
      difference.setSum(a, b, -1);
    return difference;
  }
  friend Color operator*(const Color& a, const Color& b) {
    Color product(a.x * b.x, a.y * b.y, a.z * b.z);
    if (a.bands_ || b.bands_) [[unlikely]]
      product.setProduct(a, b);
    return product;
  }
  friend Color operator/(const Color& a, const Color& b) {
    Color quotient(a.x / b.x, a.y / b.y, a.z / b.z);
    if (a.bands_ || b.bands_) [[unlikely]]
      quotient.bands_ = (Color(a) /= b).bands_;
    return quotient;
  }
  friend Color operator*(const Color& a, double factor) {
    Color product(a.x * factor, a.y * factor, a.z * factor);
    if (a.bands_) [[unlikely]]
      product.setScaled(a, factor);
    return product;
  }
  friend Color operator*(double factor, const Color& a) { return a * factor; }
  friend Color operator/(const Color& a, double divisor) {
    Color quotient(a.x / divisor, a.y / divisor, a.z / divisor);
    if (a.bands_) [[unlikely]]
      quotient.setScaled(a, 1 / divisor);
    return quotient;
  }
  // Whether all channels and bands are the same.
  friend bool operator==(const Color& a, const Color& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && (!(a.bands_ || b.bands_) || sameBands(a, b));
  }

 private:
  // Each of these leaves red, green and blue as they are, and is called before they change.
  void addBands(const Color& other, double factor);
  void multiplyBands(const Color& other);
  void divideBands(const Color& other);
  void scaleBands(double factor);
  void setSum(const Color& a, const Color& b, double factor);
  void setProduct(const Color& a, const Color& b);
  void setScaled(const Color& a, double factor);
  static bool sameBands(const Color& a, const Color& b);
  Bands factorsIn(const BandScheme& scheme) const;
  Bands termsIn(const BandScheme& scheme) const;
  void setProductOfBands(const Bands::Block& a, const Bands::Block& b);

  Bands bands_;
};

// The color whose value in each channel and band is f(value of a, value of b), and the same for three.
template <class F>
Color combined(const Color& a, const Color& b, const F& f) {
  const V3d rgb(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z));
  if (!a.bands() && !b.bands()) [[likely]]
    return Color(rgb);
  const BandScheme& scheme = (a.bands() ? a : b).bands().scheme();
  Bands result = a.bandsIn(scheme);
  const Bands second = b.bandsIn(scheme);
  for (size_t i = 0; i < second.values().size(); ++i)
    result.values()[i] = f(result.values()[i], second.values()[i]);
  return Color(rgb, std::move(result));
}
template <class F>
Color combined(const Color& a, const Color& b, const Color& c, const F& f) {
  const V3d rgb(f(a.x, b.x, c.x), f(a.y, b.y, c.y), f(a.z, b.z, c.z));
  if (!a.bands() && !b.bands() && !c.bands()) [[likely]]
    return Color(rgb);
  const BandScheme& scheme = (a.bands() ? a : b.bands() ? b : c).bands().scheme();
  Bands result = a.bandsIn(scheme);
  const Bands second = b.bandsIn(scheme), third = c.bandsIn(scheme);
  for (size_t i = 0; i < second.values().size(); ++i)
    result.values()[i] = f(result.values()[i], second.values()[i], third.values()[i]);
  return Color(rgb, std::move(result));
}

// Weights of the channels in the brightness, for RADIANCE's primaries and its white point (1/3, 1/3). rtrace
// -pY, thresholds and the light vector use this brightness.
inline constexpr double kRedWeight = .265105820, kGreenWeight = .670105820, kBlueWeight = .064788360;
inline double brightness(const Color& c) { return kRedWeight * c.x + kGreenWeight * c.y + kBlueWeight * c.z; }
inline double brightnessOfProduct(const Color& a, const Color& b) {
  return kRedWeight * (a.x * b.x) + kGreenWeight * (a.y * b.y) + kBlueWeight * (a.z * b.z);
}
// The largest and the smallest value of the bands of a spectrum, or of red, green and blue where there are
// none: a mean that is dark may hide a bright band.
inline double maxChannel(const Color& c) {
  if (c.bands()) [[unlikely]]
    return c.extremesOfBands().second;
  return c.x > c.y ? (c.x > c.z ? c.x : c.z) : (c.y > c.z ? c.y : c.z);
}
inline double minChannel(const Color& c) {
  if (c.bands()) [[unlikely]]
    return c.extremesOfBands().first;
  return std::min({c.x, c.y, c.z});
}
// Whether red, green, blue and all bands are 0 or less. The bands are looked at last, since few colors are
// black: a band may be bright where the mean of its channel is not, if others are negative.
inline bool isBlack(const Color& c) {
  return !(c.x > 0 || c.y > 0 || c.z > 0) && (!c.bands() || !(c.extremesOfBands().second > 0));
}

}  // namespace rsphere
