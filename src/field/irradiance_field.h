#pragma once
// An irradiance cache (-aa above 0) whose answers do not depend on the order of the queries.
//
// Light is gathered at the sites of cells (surface_cells.h), which depend only on the scene and the options.
// The irradiance at a place is interpolated bilinearly between the four sites around it. Sites that do not
// see the place are left out, so that no light leaks through walls. The initial cell spacing is proportional
// to the harmonic mean distance of the surroundings (-aa). Cells are subdivided where the irradiance at their
// sites differs, down to the finest spacing: -aa times the size of the surrounding room, divided by -ar. In a
// narrow gap the spacing is at most a fraction of the gap's height.
//
// A site is gathered when it is first needed, with random numbers seeded by its cell. Therefore an answer
// depends only on the place, not on earlier queries or on the thread.
//
// Threads: any number may query at the same time, and none waits. If two threads need the same site at the
// same time, both may gather it; the values are identical, and the first is kept.
//
// Memory: if a limit is set (-Sm), the first thread that finds the memory full replaces it by an empty one.
// The old memory is freed when the last thread has stopped reading it. Sites that are needed again are
// computed again, with bit-identical results. A thread stops reading at the end of each primary ray at the
// latest.
#include <memory>

#include "field/ambient_file.h"
#include "field/field_options.h"
#include "field/field_rays.h"
#include "field/surface_cells.h"
#include "scene/scene.h"

namespace rsphere {

struct FieldMemory;

// Keeps the memory that a thread reads from being freed.
using FieldReader = std::shared_ptr<FieldMemory>;

class IrradianceField {
 public:
  // Keeps a reference to the scene. bounds: of everything that rays can hit.
  IrradianceField(const Scene& scene, const Box3d& bounds, const FieldOptions& options);
  ~IrradianceField();  // writes new sites to the file

  // Reads the sites of earlier runs from the file. New sites are appended from time to time, and at the end.
  // REQUIRES that find() has not been called.
  void keepIn(std::unique_ptr<AmbientFile> file);

  // Interpolates the light at a place: its mean, and its dependence on the normal. False if no site can be
  // used, as in crevices, on the insides of curved surfaces and on meshes; the caller then gathers directly.
  // reader: owned by the calling thread. `rays` must not call find() of the same field.
  bool find(const SurfacePlace& place, FieldReader& reader, FieldRays& rays, GatheredLight& light);

  // Stops reading the memory. It is freed if it has been replaced and has no other readers.
  void leave(FieldReader& reader) const;

  // The number of sites made, including those that were discarded and made again.
  size_t sitesMade() const;

  // Bytes of all memories that have not been freed. They exceed the limit by at most the amount that current
  // queries need.
  size_t bytes() const;

 private:
  class Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace rsphere
