#include "base/color.h"

#include <array>
#include <cassert>

#include "base/spectral_sampling.h"

namespace rsphere {
namespace {

// Capacities of blocks: one for the part of one contributor, so that a block fits into one cache line, and
// one for all bands of a spectrum. Larger blocks have room for all values of their scheme.
constexpr size_t kOnePart = 3, kUsualRoom = kMostBands;
constexpr size_t kLargeRoom = 2;
// Unused blocks of one capacity that a thread keeps. A path needs some hundreds at once. Blocks beyond these
// come from other threads, whose colors this one destroys: kept, they would never be used.
constexpr size_t kMostSpares = 4096;
size_t classOf(size_t room) { return room <= kOnePart ? 0 : room <= kUsualRoom ? 1 : kLargeRoom; }

}  // namespace

// The header of a block. It is followed by the values from index `first` to before `end`; all others are 0.
// room: number of values for which memory is allocated.
struct Bands::Block {
  union {
    const BandScheme* scheme;
    Block* next;  // while the block is unused
  };
  uint32_t room, first, end, unused;

  double* values() { return reinterpret_cast<double*>(this + 1); }
  const double* values() const { return reinterpret_cast<const double*>(this + 1); }
  size_t filled() const { return end - first; }
  bool isWhole() const { return first == 0 && end == scheme->count(); }
};

// Unused blocks of a thread, with a list for each capacity. They are kept because a path allocates and frees
// dozens of blocks at each surface. Blocks that outlive the objects of the thread, such as colors of static
// objects, are returned to the heap.
struct Bands::Spares {
  static thread_local std::array<Block*, kLargeRoom + 1> first;
  static thread_local std::array<size_t, kLargeRoom + 1> count;
  static thread_local bool closed;

  struct Closer {
    bool open = true;
    ~Closer() {
      closed = true;
      for (Block*& block : first)
        while (block) ::operator delete(std::exchange(block, block->next));
    }
  };
  static Block* take(const BandScheme& scheme, size_t room) {
    const size_t kind = classOf(room);
    Block*& spare = first[kind];
    for (; spare && spare->room < room; --count[kind]) ::operator delete(std::exchange(spare, spare->next));
    Block* block = spare;
    if (block) {
      spare = block->next;
      --count[kind];
    } else {
      static thread_local Closer closer;
      closer.open = true;  // this access constructs the thread's object, so that it is destroyed when the
                           // thread ends
      if (kind < kLargeRoom) room = kind == 0 ? kOnePart : kUsualRoom;
      block = static_cast<Block*>(::operator new(sizeof(Block) + room * sizeof(double)));
      block->room = static_cast<uint32_t>(room);
    }
    block->scheme = &scheme;
    block->first = block->end = 0;
    return block;
  }
  static void give(Block* block) {
    const size_t kind = classOf(block->room);
    if (closed || count[kind] == kMostSpares) return ::operator delete(block);
    block->next = std::exchange(first[kind], block);
    ++count[kind];
  }
};
thread_local std::array<Bands::Block*, kLargeRoom + 1> Bands::Spares::first{};
thread_local std::array<size_t, kLargeRoom + 1> Bands::Spares::count{};
thread_local bool Bands::Spares::closed = false;

Bands::Bands(const BandScheme& scheme)
    : block_(Spares::take(scheme, scheme.ofContributors ? 0 : scheme.count())) {
  if (!scheme.ofContributors) cover(0, scheme.count());
}

// Extends the stored values so that they include those from `begin` to before `end`; new ones are 0. Returns
// the address of the value at `begin`.
double* Bands::cover(size_t begin, size_t end) {
  Block& old = *block_;
  if (old.first <= begin && end <= old.end) return old.values() + (begin - old.first);
  const size_t first = old.filled() > 0 ? std::min<size_t>(begin, old.first) : begin;
  const size_t last = old.filled() > 0 ? std::max<size_t>(end, old.end) : end;
  Block* const block = last - first > old.room ? Spares::take(*old.scheme, old.scheme->count()) : &old;
  const size_t before = old.filled() > 0 ? old.first - first : 0, kept = old.filled();
  if (before > 0 || block != &old)
    std::copy_backward(old.values(), old.values() + kept, block->values() + before + kept);
  std::fill_n(block->values(), before, 0.);
  std::fill(block->values() + before + kept, block->values() + (last - first), 0.);
  block->first = static_cast<uint32_t>(first);
  block->end = static_cast<uint32_t>(last);
  if (block != &old) {
    Spares::give(&old);
    block_ = block;
  }
  return block->values() + (begin - first);
}

// Provides memory for the same range of values as another block has; the values are not set.
double* Bands::cover(const Block& like) {
  if (block_ == &like) return block_->values();
  if (block_ && block_->room < like.filled()) release();
  if (!block_)
    block_ = Spares::take(*like.scheme, like.filled() > kUsualRoom ? like.scheme->count() : like.filled());
  block_->scheme = like.scheme;
  block_->first = like.first;
  block_->end = like.end;
  return block_->values();
}

void Bands::assign(const Bands& other) {
  if (this == &other) return;
  if (!other.block_) return release();
  double* const to = cover(*other.block_);
  std::copy_n(std::as_const(*other.block_).values(), other.block_->filled(), to);
}

void Bands::release() {
  if (block_) Spares::give(std::exchange(block_, nullptr));
}

void Bands::addScaled(const Block& other, double factor) {
  if (other.filled() == 0) return;
  Block& own = *block_;
  double* const to = own.first <= other.first && other.end <= own.end
                         ? own.values() + (other.first - own.first)
                         : cover(other.first, other.end);
  const double* const from = other.values();
  for (size_t i = 0; i < other.filled(); ++i) to[i] += factor * from[i];
}

const BandScheme& Bands::scheme() const { return *block_->scheme; }

const SpectralSampling& Bands::sampling() const {
  assert(!scheme().ofContributors);
  return static_cast<const SpectralSampling&>(scheme());
}

std::span<double> Bands::values() { return {cover(0, scheme().count()), scheme().count()}; }

std::span<const double> Bands::values() const {
  assert(block_->isWhole());
  return {block_->values(), block_->filled()};
}

Color::Color(Bands bands) : bands_(std::move(bands)) {
  std::array<double, 3> sum{}, count{};
  const std::span<const double> values = std::as_const(bands_).values();
  for (size_t i = 0; i < values.size(); ++i) {
    sum[bands_.scheme().channel[i]] += values[i];
    ++count[bands_.scheme().channel[i]];
  }
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<size_t>(c);
    (*this)[c] = count[i] > 0 ? sum[i] / count[i] : 0;
  }
}

Bands Color::bandsIn(const BandScheme& scheme) const {
  assert(!bands_ || &bands_.scheme() == &scheme);
  Bands all = bands_ ? bands_ : termsIn(scheme);
  all.values();  // also stores values that are 0
  return all;
}

// The bands of a factor: for a color without bands, those of its channels.
Bands Color::factorsIn(const BandScheme& scheme) const {
  if (bands_) return bandsIn(scheme);
  Bands expanded(scheme);
  const std::span<double> values = expanded.values();
  for (size_t i = 0; i < values.size(); ++i) values[i] = (*this)[scheme.channel[i]];
  return expanded;
}

Color Color::ofContributor(const V3d& rgb, size_t contributor, const BandScheme& parts) {
  Bands bands(parts);
  double* const part = bands.cover(3 * contributor, 3 * contributor + 3);
  for (int c = 0; c < 3; ++c) part[c] = rgb[c];
  return Color(rgb, std::move(bands));
}

Color Color::part(size_t contributor) const {
  if (!bands_ || !bands_.scheme().ofContributors) return Color(0);
  const Bands::Block& block = *bands_.block_;
  const auto valueOf = [&](size_t i) {
    return i >= block.first && i < block.end ? block.values()[i - block.first] : 0;
  };
  return {valueOf(3 * contributor), valueOf(3 * contributor + 1), valueOf(3 * contributor + 2)};
}

std::pair<double, double> Color::extremesOfBands() const {
  if (bands_.scheme().ofContributors) return {std::min({x, y, z}), std::max({x, y, z})};
  const auto [least, most] = std::ranges::minmax(bands_.values());
  return {least, most};
}

void Color::addBands(const Color& other, double factor) {
  if (other.bands_) {
    if (!bands_) bands_ = termsIn(other.bands_.scheme());
    return bands_.addScaled(*other.bands_.block_, factor);
  }
  if (!bands_ || bands_.scheme().ofContributors) return;
  const BandScheme& scheme = bands_.scheme();
  const std::span<double> values = bands_.values();
  for (size_t i = 0; i < values.size(); ++i) values[i] += factor * other[scheme.channel[i]];
}

// Sets the bands to a + factor * b, at least one of which has bands.
void Color::setSum(const Color& a, const Color& b, double factor) {
  Color sum(a);
  sum.addBands(b, factor);
  bands_ = std::move(sum.bands_);
}

// The bands of a term of a sum, for a color without bands.
Bands Color::termsIn(const BandScheme& scheme) const {
  return scheme.ofContributors ? Bands(scheme) : factorsIn(scheme);
}

void Color::multiplyBands(const Color& other) { setProduct(*this, other); }

void Color::setProduct(const Color& a, const Color& b) {
  const Color& first = a.bands_ ? a : b;
  const Color& second = a.bands_ ? b : a;
  if (second.bands_) return setProductOfBands(*first.bands_.block_, *second.bands_.block_);
  const Bands::Block& from = *first.bands_.block_;
  const double* const values = from.values();
  double* const to = bands_.cover(from);
  if (from.scheme->ofContributors) {
    // The stored range contains whole parts, so that it begins with red.
    for (size_t i = 0; i < from.filled(); i += 3) {
      to[i] = values[i] * second.x;
      to[i + 1] = values[i + 1] * second.y;
      to[i + 2] = values[i + 2] * second.z;
    }
    return;
  }
  const uint8_t* const channel = from.scheme->channel.data();
  for (size_t i = 0; i < from.filled(); ++i) to[i] = values[i] * second[channel[i]];
}

// Only values stored in both blocks can differ from 0.
void Color::setProductOfBands(const Bands::Block& a, const Bands::Block& b) {
  Bands product(*a.scheme);
  const size_t first = std::max(a.first, b.first), end = std::min(a.end, b.end);
  if (first < end) {
    double* const to = product.cover(first, end);
    const double *const one = a.values() + (first - a.first), *const other = b.values() + (first - b.first);
    for (size_t i = 0; i < end - first; ++i) to[i] = one[i] * other[i];
  }
  bands_ = std::move(product);
}

void Color::divideBands(const Color& other) {
  if (!bands_) bands_ = factorsIn(other.bands_.scheme());
  const Bands divisor = other.factorsIn(bands_.scheme());
  const std::span<double> values = bands_.values();
  for (size_t i = 0; i < values.size(); ++i) values[i] /= divisor.values()[i];
}

void Color::scaleBands(double factor) {
  double* const values = bands_.block_->values();
  for (size_t i = 0; i < bands_.block_->filled(); ++i) values[i] *= factor;
}

void Color::setScaled(const Color& a, double factor) {
  const Bands::Block& from = *a.bands_.block_;
  const double* const values = from.values();
  double* const to = bands_.cover(from);
  for (size_t i = 0; i < from.filled(); ++i) to[i] = values[i] * factor;
}

bool Color::sameBands(const Color& a, const Color& b) {
  const BandScheme& scheme = (a.bands_ ? a : b).bands_.scheme();
  const Bands first = a.bandsIn(scheme), second = b.bandsIn(scheme);
  return std::ranges::equal(first.values(), second.values());
}

}  // namespace rsphere
