#include "field/stored_sites.h"

#include <array>
#include <cstring>
#include <vector>

namespace rsphere {
namespace {

constexpr size_t kBetweenWrites = 256;  // the number of sites that a killed process may lose

// Calls each(number) for all numbers that describe a light, in the order of the file.
template <class Light, class Each>
void forNumbers(Light& light, Each each) {
  const auto three = [&](auto& v) {
    for (int c = 0; c < 3; ++c) each(v[c]);
  };
  three(light.mean);
  three(light.tilted.all);
  for (int k = 0; k < 3; ++k) {
    three(light.perLength[k]);
    three(light.tilted.first[k]);
    three(light.tilted.squares[k]);
    three(light.tilted.products[k]);
  }
  each(light.noise);
  each(light.noisePerLength);
  each(light.reach);
}

// A record consists of the key and the numbers of the light, in the byte order of the machine.
AmbientFile::Record recordOf(const CellKey& key, const GatheredLight& light) {
  std::array<float, 45> numbers;
  size_t n = 0;
  forNumbers(light, [&](const float& x) { numbers[n++] = x; });
  AmbientFile::Record record;
  static_assert(sizeof(SurfaceId) == sizeof(int32_t) && std::is_trivially_copyable_v<CellKey> &&
                sizeof key + sizeof numbers == sizeof record);
  std::memcpy(record.data(), &key, sizeof key);
  std::memcpy(record.data() + sizeof key, &numbers, sizeof numbers);
  return record;
}

void fromRecord(const AmbientFile::Record& record, CellKey& key, GatheredLight& light) {
  std::array<float, 45> numbers;
  std::memcpy(&key, record.data(), sizeof key);
  std::memcpy(&numbers, record.data() + sizeof key, sizeof numbers);
  size_t n = 0;
  forNumbers(light, [&](float& x) { x = numbers[n++]; });
}

}  // namespace

StoredSites::StoredSites(std::unique_ptr<AmbientFile> file) : file_(std::move(file)) {
  if (!file_) return;
  for (const AmbientFile::Record& record : file_->take()) {
    CellKey key;
    GatheredLight light;
    fromRecord(record, key, light);
    known_.emplace(key, light);
  }
}

StoredSites::~StoredSites() {
  write(true);
  for (Fresh* site = fresh_.load(std::memory_order_relaxed); site;) {
    Fresh* const next = site->next;
    delete site;
    site = next;
  }
}

const GatheredLight* StoredSites::find(const CellKey& key) const {
  const auto known = known_.find(key);
  return known == known_.end() ? nullptr : &known->second;
}

void StoredSites::add(const CellKey& key, const GatheredLight& light) {
  if (!file_) return;
  auto* const site = new Fresh{recordOf(key, light), nullptr};
  push(site, site);
  if ((added_.fetch_add(1, std::memory_order_relaxed) + 1) % kBetweenWrites == 0) write(false);
}

void StoredSites::push(Fresh* first, Fresh* last) {
  last->next = fresh_.load(std::memory_order_relaxed);
  while (!fresh_.compare_exchange_weak(last->next, first, std::memory_order_release,
                                       std::memory_order_relaxed)) {
  }
}

// Appends the new sites to the file. wait: whether to wait for other processes that are writing to it.
void StoredSites::write(bool wait) {
  if (!file_) return;
  const std::unique_lock lock(writing_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  Fresh* first = fresh_.exchange(nullptr, std::memory_order_acquire);
  if (!first) return;
  std::vector<AmbientFile::Record> records;
  Fresh* last = first;
  for (Fresh* site = first; site; site = site->next) {
    records.push_back(site->record);
    last = site;
  }
  if (!file_->add(records, wait)) return push(first, last);
  while (first) {
    Fresh* const next = first->next;
    delete first;
    first = next;
  }
}

}  // namespace rsphere
