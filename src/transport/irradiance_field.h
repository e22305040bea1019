#pragma once
// Indirect light by interpolation (-aa above 0), as a field that is computed where it is asked for.
//
// Every plane that is asked about has a square lattice, fixed by the scene and the options alone, and so have
// spheres and cones from outside. A square whose corners tell that the light between them is smooth answers
// with what lies between its corners; others are divided in four, down to the finest spacing that -aa and -ar
// allow. What a corner has is gathered when it is first needed, with random numbers that its own place seeds.
// So an answer depends on the place and the direction that are asked for, not on what was asked before, or by
// whom.
//
// A corner need not lie on a surface: the light that its plane gets is smooth in free space. It only serves
// places that nothing hides from it. Short rays along its plane tell whether something stands around it;
// where something does, a ray from the corner to the place decides.
//
// Threads: any number may ask at once, and nobody waits. Two that need the same corner at the same time may
// both gather; the values are the same, and the first is kept.
//
// Memory: what is known of first and of second surfaces is kept apart, in a memory each. Where it has a bound
// (-Sm), a memory that is full is given up for a new one by whoever comes to it next, and freed when the last
// thread has left it; what is asked for again is computed again, to the same bits. A thread leaves where a
// primary ray ends, or earlier.
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "cli/options.h"
#include "scene/scene.h"
#include "transport/ambient_file.h"
#include "transport/hemisphere.h"
#include "transport/insert_once.h"

namespace rsphere {

// What is asked: the indirect light that arrives at a point of a surface, or of an imagined one.
struct FieldPlace {
  V3d point{0, 0, 0};
  V3d normal{0, 0, 1};      // unit, on the side that the light arrives at
  int32_t surface = kNone;  // the surface that it lies on; kNone: a plane that is only imagined
  double scale = 0;         // of what holds the surface; 0: the world itself does
};

// Whether light is asked for where a path meets its first diffuse surface, or the one after: that has a
// bounce less to go, and only averages of it are seen.
enum class LightOf : uint8_t { first, second };

struct FieldMemory;

// What a thread has to do with a field: the memories that it asks in, by LightOf, which stay while it does.
using FieldReader = std::array<std::shared_ptr<FieldMemory>, 2>;

// How sites are looked at. Every answer depends on nothing but the arguments.
class SiteLooker {
 public:
  static constexpr int kAzimuths = 24;
  // For each azimuth around a site, at equal angles from its frame's x towards its y: one over the distance
  // along its plane at which something stands there, 0 where nothing does.
  using Surroundings = std::array<float, kAzimuths>;

  // share: of the rays that the options ask for. Of all light, or of what arrives after a diffuse surface.
  virtual GatheredLight gather(const GatherSite& site, LightOf of, double share, uint64_t seed) = 0;
  virtual Surroundings survey(const GatherSite& site, double farthest) = 0;
  // The harmonic mean of the distances to what is seen from a site, by projected solid angle and in few
  // directions; what is nearer than `nearest` counts as being there (world units).
  virtual double reach(const GatherSite& site, double nearest) = 0;
  // Whether nothing is between two points.
  virtual bool sees(const V3d& from, const V3d& to) = 0;

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

  // The light at a place: its mean, and its change when the normal tilts. False where nothing in the field
  // serves the place, which then has to be gathered for itself: surfaces that are much smaller than the
  // finest spacing, insides of curved ones, and meshes.
  // reader: the thread's own. The looker must not come back here, but may ask findSecond() for it, and that
  // one's looker neither.
  bool find(const FieldPlace& place, FieldReader& reader, SiteLooker& looker, GatheredLight& light);

  // The mean light at a place of a second diffuse surface, where few rays tell it, the same all over a room:
  // in the widest squares and those next to them. False where these do not tell.
  bool findSecond(const FieldPlace& place, FieldReader& reader, SiteLooker& looker, V3f& mean);

  // The least distance between corners (world units): what is nearer than that is not resolved.
  double finestSpacing() const { return spacing_.back(); }

  // The thread has nothing more to ask for now; what it alone keeps is freed.
  void leave(FieldReader& reader) const;

  // Sites that were looked at, those again that had been given up.
  size_t sitesMade() const { return made_.load(std::memory_order_relaxed); }

  // What all memories hold that are not freed yet (bytes): beyond the bound by what single questions need.
  size_t bytes() const { return use_->bytes.load(std::memory_order_relaxed); }

 private:
  friend struct FieldMemory;
  struct Key {
    std::array<int32_t, 3> normal{};  // of the plane; or a surface, a part of it, and kCurved
    int32_t i = 0, j = 0;
    int32_t level = 0;
    int64_t offset = 0;
    bool operator==(const Key&) const = default;
    uint64_t hash() const;
  };
  struct KeyHash {
    size_t operator()(const Key& key) const { return key.hash(); }
  };
  struct Chart;
  struct Value;
  struct Site;
  struct Cell;
  struct Square;
  struct Corners;
  struct Asked;
  struct Use {
    std::atomic<size_t> bytes{0};     // that memories hold
    std::atomic<size_t> reserved{0};  // that they may
  };
  // Of one kind of light: the memory that questions begin in.
  struct Newest {
    std::atomic<const FieldMemory*> memory{nullptr};
    std::shared_ptr<FieldMemory> kept;
    std::mutex replacing;  // for as long as a pointer is copied
  };

  void enter(LightOf of, std::shared_ptr<FieldMemory>& memory);

  bool chartOf(const FieldPlace& place, Chart& chart) const;
  void setPlane(const FieldPlace& place, Chart& chart) const;
  GatherSite siteAt(const Chart& chart, double u, double v) const;
  Site& site(const Key& key, const GatherSite& at, const Asked& asked);
  Site& corner(const Chart& chart, int64_t i, int64_t j, const Asked& asked);
  const GatheredLight& lightOf(Site& site, const Asked& asked);
  double shareOfRays(const Key& key, LightOf of) const;
  void addFresh(Value* first, Value* last);
  void save(bool wait);
  static AmbientFile::Record recordOf(const Key& key, const GatheredLight& light);
  static void fromRecord(const AmbientFile::Record& record, Key& key, GatheredLight& light);
  bool serves(const Site& site, const FieldPlace& place, SiteLooker& looker) const;
  std::unique_ptr<Cell> makeCell(const Chart& chart, int64_t i, int64_t j, int64_t size, const Asked& asked);
  bool begin(const Chart& chart, int level, const Asked& asked, Square& square);
  void descend(const Chart& chart, const Asked& asked, Square& square);
  void lookUp(const Cell& cell, const Asked& asked, Corners& corners);
  bool nearby(const Square& square, const V3d& point, double tolerance, const Asked& asked,
              GatheredLight& light);
  bool single(const FieldPlace& place, const Chart& chart, double tolerance, const Asked& asked,
              GatheredLight& light);

  const Scene& scene_;
  double accuracy_;
  double shiftError_, fewerRays_, secondRays_;
  double size_ = 1;              // the longest side of the bounds
  double planeStep_ = 0;         // offsets that differ by less are one plane's
  V3d origin_{0, 0, 0};          // of the lattices
  std::vector<double> spacing_;  // by level, each half of the one before
  int secondLevel_ = 0;          // of the widest squares at second surfaces; below 0: wider than spacing_[0]
  struct Extent {
    V3f center{0, 0, 0};
    float size = 0;  // across
  };
  std::vector<Extent> extents_;  // of flat surfaces, in the coordinates of what holds them
  size_t bound_;                 // of what all memories hold (bytes)
  std::shared_ptr<Use> use_ = std::make_shared<Use>();
  std::array<Newest, 2> newest_;  // by LightOf
  std::atomic<size_t> made_{0};
  std::unordered_map<Key, GatheredLight, KeyHash> known_;  // of earlier runs
  std::unique_ptr<AmbientFile> file_;
  std::mutex writing_;                  // nobody waits for it
  std::atomic<Value*> fresh_{nullptr};  // not in the file yet; a list through Value::nextFresh
  std::atomic<size_t> gathered_{0};
};

}  // namespace rsphere
