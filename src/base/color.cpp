#include "base/color.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <new>

#include "base/spectral_sampling.h"

namespace rsphere {

// The values follow the block.
struct Bands::Block {
  const SpectralSampling* sampling;
  Block* next;  // while it is not in use

  double* values() { return reinterpret_cast<double*>(this + 1); }
  size_t count() const { return sampling->count(); }
};

// Blocks that a thread has given back, since a path makes and drops dozens of them at each surface. All have
// room for kMostBands. What outlives the thread's objects, such as colors of static ones, is given back to
// the heap.
struct Bands::Spares {
  static thread_local Block* first;
  static thread_local bool closed;

  struct Closer {
    bool open = true;
    ~Closer() {
      closed = true;
      while (first) ::operator delete(std::exchange(first, first->next));
    }
  };
  static Block* take() {
    if (first) return std::exchange(first, first->next);
    static thread_local Closer closer;
    closer.open = true;  // so that it is made
    return static_cast<Block*>(::operator new(sizeof(Block) + kMostBands * sizeof(double)));
  }
  static void give(Block* block) {
    if (closed) return ::operator delete(block);
    block->next = first;
    first = block;
  }
};
thread_local Bands::Block* Bands::Spares::first = nullptr;
thread_local bool Bands::Spares::closed = false;

Bands::Bands(const SpectralSampling& sampling) : block_(Spares::take()) {
  block_->sampling = &sampling;
  std::fill_n(block_->values(), sampling.count(), 0.);
}

void Bands::assign(const Bands& other) {
  if (!other.block_) return release();
  if (!block_) block_ = Spares::take();
  block_->sampling = other.block_->sampling;
  if (block_ != other.block_) std::copy_n(other.block_->values(), other.block_->count(), block_->values());
}

void Bands::release() { Spares::give(std::exchange(block_, nullptr)); }

const SpectralSampling& Bands::sampling() const { return *block_->sampling; }

std::span<double> Bands::values() { return {block_->values(), block_->count()}; }

Color::Color(Bands bands) : bands_(std::move(bands)) {
  std::array<double, 3> sum{}, count{};
  const std::span<const double> values = std::as_const(bands_).values();
  for (size_t i = 0; i < values.size(); ++i) {
    sum[bands_.sampling().channel[i]] += values[i];
    ++count[bands_.sampling().channel[i]];
  }
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<size_t>(c);
    (*this)[c] = count[i] > 0 ? sum[i] / count[i] : 0;
  }
}

Bands Color::bandsIn(const SpectralSampling& sampling) const {
  if (bands_) {
    assert(&bands_.sampling() == &sampling);
    return bands_;
  }
  Bands expanded(sampling);
  const std::span<double> values = expanded.values();
  for (size_t i = 0; i < values.size(); ++i) values[i] = (*this)[sampling.channel[i]];
  return expanded;
}

std::pair<double, double> Color::extremesOfBands() const {
  const auto [least, most] = std::ranges::minmax(bands_.values());
  return {least, most};
}

void Color::addBands(const Color& other, double sign) {
  if (!bands_) {
    if (!other.bands_) return;
    bands_ = bandsIn(other.bands_.sampling());
  }
  const SpectralSampling& sampling = bands_.sampling();
  const std::span<double> values = bands_.values();
  if (other.bands_) {
    const double* more = std::as_const(other.bands_).values().data();
    for (size_t i = 0; i < values.size(); ++i) values[i] += sign * more[i];
  } else {
    for (size_t i = 0; i < values.size(); ++i) values[i] += sign * other[sampling.channel[i]];
  }
}

void Color::multiplyBands(const Color& other) {
  if (!bands_) bands_ = bandsIn(other.bands_.sampling());
  setProduct(*this, other);
}

void Color::setProduct(const Color& a, const Color& b) {
  const Color& first = a.bands_ ? a : b;
  const Color& second = a.bands_ ? b : a;
  const SpectralSampling& sampling = first.bands_.sampling();
  if (!bands_) bands_ = Bands(sampling);
  const double* const from = std::as_const(first.bands_).values().data();
  const std::span<double> values = bands_.values();
  if (second.bands_) {
    const double* const factor = std::as_const(second.bands_).values().data();
    for (size_t i = 0; i < values.size(); ++i) values[i] = from[i] * factor[i];
  } else {
    for (size_t i = 0; i < values.size(); ++i) values[i] = from[i] * second[sampling.channel[i]];
  }
}

void Color::divideBands(const Color& other) {
  if (!bands_) bands_ = bandsIn(other.bands_.sampling());
  const Bands divisor = other.bandsIn(bands_.sampling());
  const std::span<double> values = bands_.values();
  for (size_t i = 0; i < values.size(); ++i) values[i] /= divisor.values()[i];
}

void Color::scaleBands(double factor) {
  for (double& value : bands_.values()) value *= factor;
}

void Color::setScaled(const Color& a, double factor) {
  bands_ = a.bands_;
  scaleBands(factor);
}

bool Color::sameBands(const Color& a, const Color& b) {
  const SpectralSampling& sampling = (a.bands_ ? a : b).bands_.sampling();
  const Bands first = a.bandsIn(sampling), second = b.bandsIn(sampling);
  return std::ranges::equal(first.values(), second.values());
}

}  // namespace rsphere
