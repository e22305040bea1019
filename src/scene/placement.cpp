#include "scene/placement.h"

namespace rsphere {

Placement within(const Placement& outer, const Placement& inner) {
  return {inner.toOuter * outer.toOuter, outer.toInner * inner.toInner};
}

Box3d placed(const Placement& placement, const Box3d& box) {
  Box3d result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.extendBy(
        placement.toOuter.point(V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                    corner & 4 ? box.max.z : box.min.z)));
  return result;
}

}  // namespace rsphere
