#pragma once
// Indirect light by interpolation (-aa above 0), as a field that is computed where it is asked for.
//
// Light is gathered at the sites of cells (surface_cells.h), which the scene and the options fix. Four sites
// around a place serve it, as far as each of them sees it: no light is taken from beyond a wall. Cells are as
// wide as the distances to what surrounds them allow (-aa), and are divided where the light of their sites
// differs, down to the finest spacing that -aa and -ar ask for.
//
// A site is gathered when it is first needed, with random numbers that its own cell seeds. So an answer
// depends on the place and the direction that are asked for, not on what was asked before, or by whom.
//
// Threads: any number may ask at once, and nobody waits. Two that need the same site at the same time may
// both gather; the values are the same, and the first is kept.
//
// Memory: where it has a bound (-Sm), a memory that is full is given up for a new one by whoever comes to it
// next, and freed when the last thread has left it; what is asked for again is computed again, to the same
// bits. A thread leaves where a primary ray ends, or earlier.
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "cli/options.h"
#include "scene/scene.h"
#include "transport/ambient_file.h"
#include "transport/hemisphere.h"
#include "transport/insert_once.h"
#include "transport/surface_cells.h"

namespace rsphere {

struct FieldMemory;

// What a thread has to do with a field: the memory that it asks in, which stays while it does.
using FieldReader = std::shared_ptr<FieldMemory>;

// How sites are looked at. Every answer depends on nothing but the arguments.
class SiteLooker {
 public:
  virtual GatheredLight gather(const GatherSite& site, uint64_t seed) = 0;
  // The harmonic mean of the distances to what is seen from a site, in few directions (world units).
  virtual double reach(const GatherSite& site) = 0;
  // Whether nothing is between two points.
  virtual bool sees(const V3d& from, const V3d& to) = 0;
  // Whether an object smaller than the side lies beside the site (small_objects.h).
  virtual bool isBesideSmall(const GatherSite& site, double side) = 0;

 protected:
  ~SiteLooker() = default;
};

class IrradianceField {
 public:
  // Keeps a reference to the scene. bounds: of all that can be hit.
  IrradianceField(const Scene& scene, const Box3d& bounds, const RayOptions& options);
  ~IrradianceField();  // what is new goes to the file

  // Takes from the file what was gathered in earlier runs, and adds to it what is new, now and then and at
  // the end. Before the first find().
  void keepIn(std::unique_ptr<AmbientFile> file);

  // The light at a place: its mean, and how it depends on the normal. False where no site serves the place,
  // which then has to be gathered for itself: crevices, insides of what is curved, and meshes. reader: the
  // thread's own. The looker must not come back here.
  bool find(const SurfacePlace& place, FieldReader& reader, SiteLooker& looker, GatheredLight& light);

  // The least distance between sites (world units) that options ask for: what is nearer is not resolved.
  double finestSpacing() const { return finest_; }

  // The thread has nothing more to ask for now; what it alone keeps is freed.
  void leave(FieldReader& reader) const;

  // Sites that were made, those again that had been given up.
  size_t sitesMade() const { return made_.load(std::memory_order_relaxed); }

  // What all memories hold that are not freed yet (bytes): beyond the bound by what single questions need.
  size_t bytes() const { return use_->bytes.load(std::memory_order_relaxed); }

 private:
  friend struct FieldMemory;
  struct Site;
  struct Use {
    std::atomic<size_t> bytes{0};     // that memories hold
    std::atomic<size_t> reserved{0};  // that they may
  };
  struct KeyHash {
    size_t operator()(const CellKey& key) const { return key.hash(); }
  };
  struct Asked;
  struct Around;

  void enter(FieldReader& memory);
  Site& siteOf(const SurfaceChart& chart, const CellKey& key, const Asked& asked);
  const GatheredLight& lightOf(Site& site, const Asked& asked);
  bool look(const SurfaceChart& chart, const SurfacePlace& place, int level, const Asked& asked,
            Around& around);
  void addFresh(Site* first, Site* last);
  void save(bool wait);
  static AmbientFile::Record recordOf(const CellKey& key, const GatheredLight& light);
  static void fromRecord(const AmbientFile::Record& record, CellKey& key, GatheredLight& light);

  const Scene& scene_;
  CellGrid grid_;
  double accuracy_;
  double finest_;
  size_t bound_;  // of what all memories hold (bytes)
  std::shared_ptr<Use> use_ = std::make_shared<Use>();
  // The memory that questions begin in.
  std::atomic<const FieldMemory*> newest_{nullptr};
  std::shared_ptr<FieldMemory> kept_;
  std::mutex replacing_;  // for as long as a pointer is copied
  std::atomic<size_t> made_{0};
  std::unordered_map<CellKey, GatheredLight, KeyHash> known_;  // of earlier runs
  std::unique_ptr<AmbientFile> file_;
  std::mutex writing_;                 // nobody waits for it
  std::atomic<Site*> fresh_{nullptr};  // not in the file yet; a list through Site::nextFresh
  std::atomic<size_t> gathered_{0};
};

}  // namespace rsphere
