#include "field/stored_sites.h"

#include <array>
#include <cstring>
#include <utility>

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

StoredSites::~StoredSites() { write(true); }

const GatheredLight* StoredSites::find(const CellKey& key) const {
  const auto known = known_.find(key);
  return known == known_.end() ? nullptr : &known->second;
}

void StoredSites::add(const CellKey& key, const GatheredLight& light) {
  if (!file_) return;
  std::unique_lock lock(adding_);
  fresh_.push_back(recordOf(key, light));
  const bool due = ++added_ % kBetweenWrites == 0;
  lock.unlock();
  if (due) write(false);
}

// Appends the new sites to the file. wait: whether to wait for other processes that are writing to it.
void StoredSites::write(bool wait) {
  if (!file_) return;
  const std::unique_lock alone(writing_, std::try_to_lock);
  if (!alone.owns_lock()) return;
  std::unique_lock lock(adding_);
  const std::vector<AmbientFile::Record> records = std::exchange(fresh_, {});
  lock.unlock();
  if (file_->add(records, wait)) return;
  lock.lock();
  fresh_.insert(fresh_.end(), records.begin(), records.end());
}

}  // namespace rsphere
