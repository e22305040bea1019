#pragma once
// Contributions of tracked modifiers to rays: what each surface with such a modifier sends along each path,
// or the coefficient of the path to it, added up by bins.
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contrib/bin_function.h"
#include "contrib/contribution_list.h"
#include "sphere/equal_zones.h"
#include "transport/path_tracer.h"
#include "transport/prepared_scene.h"

namespace rsphere {

struct TrackedModifier {
  std::string name;
  uint32_t bins = 1;
  std::optional<BinFunction> bin;  // empty: all of its contributions are in bin 0
  // Instead of a function: the bins are the zones that the directions of rays lie in which meet it.
  std::shared_ptr<const EqualZones> zones{};
};

// The quantity that is summed over all rays that meet a tracked modifier.
enum class Contributed : uint8_t {
  coefficients,  // the share of its radiance in that of the primary ray
  values         // this share times its radiance
};

// Constant once constructed; any number of threads may use it at once.
class Tracked {
 public:
  // Keeps a reference to the scene. warn: gets one line for each modifier with a bin that does not exist;
  // from any thread.
  Tracked(const PreparedScene& prepared, std::vector<TrackedModifier> modifiers, Contributed what,
          rad::Warn warn = {});

  const std::vector<TrackedModifier>& modifiers() const { return modifiers_; }
  // A record has a column for each bin of each modifier: modifiers in their order, then bins.
  uint32_t columns() const { return columns_; }
  uint32_t firstColumn(size_t modifier) const { return firstColumn_[modifier]; }
  // The numbers of a column: 3, or one for each band of a spectral run.
  int components() const;

  // Adds what a ray of a path contributes: nothing if its surface is not tracked, if it is a shadow ray that
  // did not reach its source, or if it hit a light source whose light shadow rays bring. Called for each ray
  // that an observer is shown with ShownShadows::thatArrive.
  void add(const RayEnd& end, const RayResult& result, BinScratch& scratch, ContributionList& to) const;

 private:
  std::optional<uint32_t> columnOf(size_t modifier, const RayEnd& end, BinScratch& scratch) const;
  bool counts(const RayEnd& end, const RayResult& result) const;

  const PreparedScene& prepared_;
  std::vector<TrackedModifier> modifiers_;
  const Contributed what_;
  rad::Warn warn_;
  std::vector<uint32_t> firstColumn_;
  uint32_t columns_ = 0;
  static constexpr uint32_t kNotTracked = ~uint32_t{0};
  std::vector<uint32_t> modifierOf_;  // by number of a finish; kNotTracked
  mutable std::vector<std::atomic<bool>> warned_;
};

// Traces rays and adds up what contributes to them. Each thread needs its own.
class ContributionTracer {
 public:
  // Keeps references. REQUIRES: nothing is interpolated (-aa 0), all shadows are tested (-dt 0, -Ss 0), and
  // the tracer is one of ray mode. Then the values of all that emits, the ambient value being 0, sum to the
  // radiance along the ray.
  ContributionTracer(PathTracer tracer, const Tracked& tracked)
      : tracer_(std::move(tracer)), tracked_(tracked), list_(tracked.components()) {}

  // The contributions to a primary ray, valid until the next call. As PathTracer::trace().
  const ContributionList& trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed);

  int components() const { return tracked_.components(); }

  // The radiance along that ray.
  const Radiance& radiance() const { return radiance_; }

 private:
  PathTracer tracer_;
  const Tracked& tracked_;
  BinScratch scratch_;
  ContributionList list_;
  Radiance radiance_;
};

}  // namespace rsphere
