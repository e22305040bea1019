#pragma once
// An irradiance cache (-aa above 0) whose answers do not depend on the order of the queries.
//
// Light is gathered at the sites of cells (surface_cells.h), which the scene and the options determine. The
// irradiance of a place is interpolated bilinearly between the four sites around it. A site that does not see
// the place is left out, so that no light leaks through walls. The initial cell spacing is proportional to
// the harmonic mean distance of the surroundings (-aa); cells are subdivided where the irradiance of their
// sites differs, down to the finest spacing. That is the size of the room around, times -aa, divided by -ar,
// and never more than a part of the height of a gap that the place lies in.
//
// A site is gathered when it is first needed, with random numbers seeded by its cell. An answer therefore
// depends only on the place, not on earlier queries or on the thread.
//
// Threads: any number may query at once, and none waits. If two threads need the same site at the same time,
// both may gather it; the values are identical, and the first is kept.
//
// Memory: if it is bounded (-Sm), the next thread that finds the memory full replaces it by an empty one. The
// old memory is freed when the last thread has left it. Sites that are needed again are computed again, to
// the same bits. A thread leaves at the end of each primary ray or earlier.
#include <memory>

#include "field/ambient_file.h"
#include "field/field_options.h"
#include "field/field_rays.h"
#include "field/surface_cells.h"
#include "scene/scene.h"

namespace rsphere {

struct FieldMemory;

// A thread's hold on the memory that it reads: the memory is not freed before all readers have let go.
using FieldReader = std::shared_ptr<FieldMemory>;

class IrradianceField {
 public:
  // Keeps a reference to the scene. bounds: of all that can be hit.
  IrradianceField(const Scene& scene, const Box3d& bounds, const FieldOptions& options);
  ~IrradianceField();  // writes new sites to the file

  // Reads the sites of earlier runs from the file. New sites are appended from time to time and at the end.
  // REQUIRES that find() has not been called.
  void keepIn(std::unique_ptr<AmbientFile> file);

  // The interpolated light at a place: its mean, and how it depends on the normal. False if no site can be
  // used, as in crevices, on the insides of curved surfaces and on meshes; the caller then gathers directly.
  // reader: the thread's own. The rays must not call find() of the same field.
  bool find(const SurfacePlace& place, FieldReader& reader, FieldRays& rays, GatheredLight& light);

  // Lets go of the memory; it is freed if it has been replaced and this was its last reader.
  void leave(FieldReader& reader) const;

  // The number of sites made; sites that were discarded and made again are counted each time.
  size_t sitesMade() const;

  // Bytes held by all memories that are not freed yet. They exceed the bound by at most what the queries
  // under way need.
  size_t bytes() const;

 private:
  class Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace rsphere
