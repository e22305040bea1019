#pragma once
// Colors: red, green and blue, and in addition the bands of a spectrum (-cs above 3), or the parts due to
// contributors (-Sp).
#include <Imath/ImathVec.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace rsphere {

using Imath::V3d;

struct BandScheme;
struct SpectralSampling;

// The bands of a color (band_scheme.h), or none. Copies are independent of each other. For parts of
// contributors, only the range from the first to the last part that may differ from 0 takes memory and time.
class Bands {
 public:
  constexpr Bands() = default;
  // All 0. The scheme must exist as long as any copy of the bands.
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
  // The following four functions REQUIRE bands.
  const BandScheme& scheme() const;
  const SpectralSampling& sampling() const;  // REQUIRES bands of a spectrum
  // All values; those of a spectrum begin with the longest wavelength. The constant version REQUIRES bands of
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

// In arithmetic with colors that have bands, a color without bands has in each band the value of its channel
// (BandScheme::channel). Gray is therefore equal in all bands, and mixed arithmetic is exact. In a color with
// bands of a spectrum, red, green and blue result from the same arithmetic on the means of their bands. They
// are estimates, used for decisions that do not change expected values (weights, samples), and are 0 only if
// all bands are. Output is computed from the bands.
//
// In a color with parts of contributors, red, green and blue are the same as without parts. An added color
// without parts has no contributor; a factor without parts applies to all parts equally.
class Color {
 public:
  double x = 0, y = 0, z = 0;  // red, green, blue

  constexpr Color() = default;
  constexpr Color(double red, double green, double blue) : x(red), y(green), z(blue) {}
  explicit constexpr Color(double gray) : x(gray), y(gray), z(gray) {}
  explicit constexpr Color(const V3d& rgb) : x(rgb.x), y(rgb.y), z(rgb.z) {}
  // REQUIRES bands of a spectrum. Red, green and blue become the means of their bands.
  explicit Color(Bands bands);
  // If `bands` is empty, the color has none.
  Color(const V3d& rgb, Bands bands) : x(rgb.x), y(rgb.y), z(rgb.z), bands_(std::move(bands)) {}

  double& operator[](int channel) { return (&x)[channel]; }
  const double& operator[](int channel) const { return (&x)[channel]; }
  // Only red, green and blue.
  V3d rgb() const { return V3d(x, y, z); }

  const Bands& bands() const { return bands_; }
  // The bands of the color as a term of a sum. A color without bands has those of its channels, or parts that
  // are 0. REQUIRES that existing bands have this scheme.
  Bands bandsIn(const BandScheme& scheme) const;
  // A color due to one contributor. The scheme must exist as long as any copy of the color.
  static Color ofContributor(const V3d& rgb, size_t contributor, const BandScheme& parts);
  // The part due to a contributor, without bands; black if the color has no parts.
  Color part(size_t contributor) const;
  // The smallest and the largest value of its bands; of its channels if it has parts. REQUIRES bands.
  std::pair<double, double> extremesOfBands() const;
  // Prefetches the bands into the processor's cache for later use.
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

  // Adds a * factor or a * b. These functions take most of the time spent on colors.
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
  // These functions do not change red, green and blue, and are called before those change.
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

// The color whose value in each channel and band is f of the values of two, or three, colors.
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
template <class F>
Color combined(const Color& a, const Color& b, const F& f) {
  return combined(a, b, b, [&](double x, double y, double) { return f(x, y); });
}

// Weights of the channels in the brightness, for RADIANCE's primaries and its white point (1/3, 1/3). rtrace
// -pY, thresholds and the light vector use this brightness.
inline constexpr double kRedWeight = .265105820, kGreenWeight = .670105820, kBlueWeight = .064788360;
inline double brightness(const Color& c) { return kRedWeight * c.x + kGreenWeight * c.y + kBlueWeight * c.z; }
inline double brightnessOfProduct(const Color& a, const Color& b) {
  return kRedWeight * (a.x * b.x) + kGreenWeight * (a.y * b.y) + kBlueWeight * (a.z * b.z);
}
// The largest and the smallest value of the bands of a spectrum, or of red, green and blue if there are none.
// Bands are examined because a dark mean may hide a bright band.
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
// Whether red, green, blue and all bands are 0 or less. If some bands are negative, a band may be bright
// although the mean of its channel is not. Bands are examined last, because few colors are black.
inline bool isBlack(const Color& c) {
  return !(c.x > 0 || c.y > 0 || c.z > 0) && (!c.bands() || !(c.extremesOfBands().second > 0));
}

}  // namespace rsphere
