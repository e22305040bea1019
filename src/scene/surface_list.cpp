#include "scene/surface_list.h"

#include <algorithm>

namespace rsphere {

PrimitiveId SurfaceList::primitiveOf(SurfaceId id) const {
  const auto after = std::ranges::upper_bound(runs_, id, std::less(), &Run::surface);
  const Run& run = *std::prev(after);
  return PrimitiveId(run.primitive.index() + id.index() - run.surface.index());
}

void SurfaceList::push_back(const Shape& shape, uint32_t finish, PrimitiveId primitive) {
  Face face;
  if (const auto* polygon = std::get_if<Polygon>(&shape); polygon && polygon->hasArea) {
    static_cast<Polygon&>(face) = *polygon;
  } else {
    face.firstVertex = static_cast<uint32_t>(others_.size());
    others_.push_back(shape);
  }
  face.finish = finish;
  faces_.push_back(face);
  const SurfaceId id = last();
  if (runs_.empty() ||
      runs_.back().primitive.index() + id.index() - runs_.back().surface.index() != primitive.index())
    runs_.push_back({id, primitive});
}

void SurfaceList::reserve(size_t more) {
  const size_t size = faces_.size() + more;
  if (size > faces_.capacity()) faces_.reserve(std::max(size, 2 * faces_.capacity()));
}

}  // namespace rsphere
