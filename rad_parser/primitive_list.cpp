#include "rad_parser/primitive_list.h"

#include <algorithm>

namespace rad {
namespace {

// A primitive is written as
//   head                its type, and whether the byte `more` follows
//   more                which of the values marked with * follow
//   modifier, line      differences from those of the preceding primitive
//   * file
//   * aliased
//   * strings           number of strings
//   * first arguments   if they do not follow the arguments of the preceding primitive
//   reals               number of reals
// Its name is stored in another list, as
//   lengths             of the part in common with the preceding name, and of the rest
//   the rest
// Numbers have 7 bits a byte, lowest first; the highest bit is set if more bytes follow. Differences have
// their sign in the lowest bit.
constexpr uint8_t kMore = 0x40, kTypeBits = 0x3f;
static_assert(kTypes <= kTypeBits + 1);
constexpr uint8_t kFile = 1, kAliased = 2, kStrings = 4, kArguments = 8;
// Two lengths below 16 share one byte. If one is longer, or both are 15, this byte precedes them.
constexpr uint8_t kLongName = 0xff;

void write(std::vector<uint8_t>& bytes, uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes.push_back(static_cast<uint8_t>(number | 0x80));
  bytes.push_back(static_cast<uint8_t>(number));
}

void writeDifference(std::vector<uint8_t>& bytes, int64_t to, int64_t from) {
  const int64_t d = to - from;
  write(bytes, static_cast<uint64_t>(d) << 1 ^ static_cast<uint64_t>(d >> 63));
}

void writeName(std::vector<uint8_t>& bytes, std::string_view name, std::string_view before) {
  const auto same = static_cast<size_t>(
      std::mismatch(name.begin(), name.end(), before.begin(), before.end()).first - name.begin());
  const std::string_view rest = name.substr(same);
  if (same < 16 && rest.size() < 16 && (same < 15 || rest.size() < 15)) {
    bytes.push_back(static_cast<uint8_t>(same << 4 | rest.size()));
  } else {
    bytes.push_back(kLongName);
    write(bytes, same);
    write(bytes, rest.size());
  }
  bytes.insert(bytes.end(), rest.begin(), rest.end());
}

uint64_t readNumber(const std::vector<uint8_t>& bytes, uint64_t& at) {
  uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    const uint8_t byte = bytes[at++];
    value |= static_cast<uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
}

int64_t readDifference(const std::vector<uint8_t>& bytes, uint64_t& at) {
  const uint64_t n = readNumber(bytes, at);
  return static_cast<int64_t>(n >> 1) ^ -static_cast<int64_t>(n & 1);
}

// name: on entry, the preceding name.
void readName(const std::vector<uint8_t>& bytes, uint64_t& at, std::string& name) {
  const uint8_t lengths = bytes[at++];
  const uint64_t same = lengths == kLongName ? readNumber(bytes, at) : lengths >> 4;
  const uint64_t rest = lengths == kLongName ? readNumber(bytes, at) : lengths & 15;
  name.resize(same);
  name.append(reinterpret_cast<const char*>(bytes.data()) + at, rest);
  at += rest;
}

}  // namespace

void PrimitiveList::State::advance(const Primitive& p) {
  modifier = p.modifier;
  place = p.place;
  nextString = p.firstString + p.strings;
  if (p.type == Type::polygon)
    nextVertex = p.firstReal + (uint64_t{p.reals} + 2) / 3;
  else
    nextReal = p.firstReal + p.reals;
}

void PrimitiveList::push_back(const Primitive& p) {
  if (size() % kBlock == 0) {
    state_.byte = bytes_.size();
    state_.nameByte = names_.size();
    blocks_.push_back(state_);
    lastName_.clear();
  }
  uint8_t more = 0;
  if (p.place.file != state_.place.file) more |= kFile;
  if (p.aliased != kVoid) more |= kAliased;
  if (p.strings != 0) more |= kStrings;
  if (p.firstString != state_.nextString ||
      p.firstReal != (p.type == Type::polygon ? state_.nextVertex : state_.nextReal))
    more |= kArguments;
  bytes_.push_back(static_cast<uint8_t>(static_cast<uint8_t>(p.type) | (more ? kMore : 0)));
  if (more) bytes_.push_back(more);
  writeDifference(bytes_, p.modifier.number(), state_.modifier.number());
  writeDifference(bytes_, p.place.line, state_.place.line);
  if (more & kFile) write(bytes_, p.place.file);
  if (more & kAliased) write(bytes_, p.aliased.index());
  if (more & kStrings) write(bytes_, p.strings);
  if (more & kArguments) {
    write(bytes_, p.firstString);
    write(bytes_, p.firstReal);
  }
  write(bytes_, p.reals);
  writeName(names_, p.name, lastName_);
  lastName_ = p.name;
  isSurface_.push_back(rad::isSurface(p.type));
  state_.advance(p);
}

void PrimitiveList::shrink() {
  bytes_.shrink_to_fit();
  names_.shrink_to_fit();
  blocks_.shrink_to_fit();
  isSurface_.shrink_to_fit();
}

Primitive PrimitiveList::at(size_t index) const { return *from(index); }

std::string PrimitiveList::name(PrimitiveId id) const {
  std::string name;
  uint64_t byte = blocks_[id.index() / kBlock].nameByte;
  for (size_t i = 0; i <= id.index() % kBlock; ++i) readName(names_, byte, name);
  return name;
}

PrimitiveList::Iterator PrimitiveList::from(size_t index) const {
  Iterator at(*this, std::min(index - index % kBlock, size()));
  while (at.index_ < index) ++at;
  return at;
}

PrimitiveList::Iterator::Iterator(const PrimitiveList& list, size_t index) : list_(&list), index_(index) {
  decode();
}

// Decodes the primitive at index_, which either begins a block or follows the last decoded primitive.
void PrimitiveList::Iterator::decode() {
  if (index_ >= list_->size()) return;
  Primitive& p = primitive_;
  if (index_ % kBlock == 0) {
    state_ = list_->blocks_[index_ / kBlock];
    p.name.clear();
  }
  const std::vector<uint8_t>& bytes = list_->bytes_;
  uint64_t at = state_.byte;
  const auto number = [&] { return readNumber(bytes, at); };
  const auto difference = [&] { return readDifference(bytes, at); };
  const uint8_t head = bytes[at++];
  const uint8_t more = head & kMore ? bytes[at++] : 0;
  p.type = static_cast<Type>(head & kTypeBits);
  p.modifier = PrimitiveId(state_.modifier.number() + difference());
  p.place.line = static_cast<uint32_t>(state_.place.line + difference());
  p.place.file = more & kFile ? static_cast<uint32_t>(number()) : state_.place.file;
  p.aliased = more & kAliased ? PrimitiveId(number()) : PrimitiveId();
  p.strings = more & kStrings ? static_cast<uint32_t>(number()) : 0;
  p.firstString = state_.nextString;
  p.firstReal = p.type == Type::polygon ? state_.nextVertex : state_.nextReal;
  if (more & kArguments) {
    p.firstString = static_cast<uint32_t>(number());
    p.firstReal = number();
  }
  p.reals = static_cast<uint32_t>(number());
  state_.byte = at;
  readName(list_->names_, state_.nameByte, p.name);
  state_.advance(p);
}

}  // namespace rad
