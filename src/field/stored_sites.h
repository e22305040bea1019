#pragma once
// The sites of an irradiance cache that are stored in an ambient file (-af): sites from earlier runs, and new
// sites that have not been written yet.
//
// Threads: any number may call find() and add() at the same time. None waits for the file.
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "field/ambient_file.h"
#include "field/hemisphere.h"
#include "field/surface_cells.h"

namespace rsphere {

class StoredSites {
 public:
  StoredSites() = default;
  explicit StoredSites(std::unique_ptr<AmbientFile> file);
  ~StoredSites();  // writes the new sites

  // The light of a site from an earlier run; null if there is none.
  const GatheredLight* find(const CellKey& key) const;

  // Stores a new site. Sites are written in groups of 256, so that a killed process loses few of them.
  void add(const CellKey& key, const GatheredLight& light);

 private:
  struct KeyHash {
    size_t operator()(const CellKey& key) const { return key.hash(); }
  };

  void write(bool wait);

  std::unique_ptr<AmbientFile> file_;
  std::unordered_map<CellKey, GatheredLight, KeyHash> known_;
  std::mutex writing_;                      // only locked by try_lock, so that no thread waits
  std::mutex adding_;                       // guards the members that follow
  std::vector<AmbientFile::Record> fresh_;  // not in the file yet
  size_t added_ = 0;
};

}  // namespace rsphere
