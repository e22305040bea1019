#pragma once
// The sites of an irradiance cache that an ambient file keeps (-af): those of earlier runs, and new ones that
// wait to be written.
//
// Threads: any number may ask and add at once, and none waits.
#include <atomic>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "field/ambient_file.h"
#include "field/hemisphere.h"
#include "field/surface_cells.h"

namespace rsphere {

class StoredSites {
 public:
  StoredSites() = default;
  explicit StoredSites(std::unique_ptr<AmbientFile> file);
  StoredSites(const StoredSites&) = delete;
  StoredSites& operator=(const StoredSites&) = delete;
  ~StoredSites();  // writes the new sites

  // The light of a site of an earlier run; null where there is none.
  const GatheredLight* find(const CellKey& key) const;

  // Keeps a new site. Every 256 of them are written, so that a process that is killed loses no more.
  void add(const CellKey& key, const GatheredLight& light);

 private:
  struct Fresh {
    AmbientFile::Record record;
    Fresh* next;
  };
  struct KeyHash {
    size_t operator()(const CellKey& key) const { return key.hash(); }
  };

  void push(Fresh* first, Fresh* last);
  void write(bool wait);

  std::unique_ptr<AmbientFile> file_;
  std::unordered_map<CellKey, GatheredLight, KeyHash> known_;
  std::mutex writing_;                  // only tried: no thread waits for it
  std::atomic<Fresh*> fresh_{nullptr};  // not in the file yet
  std::atomic<size_t> added_{0};
};

}  // namespace rsphere
