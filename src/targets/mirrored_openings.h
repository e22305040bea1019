#pragma once
// The images of openings, which show daylight, in flat mirrors. An image is far brighter than the rest of the
// mirror, and may be small in it, so that it is a separate target.
#include <vector>

#include "openings/opening_images.h"
#include "rays/prepared_scene.h"
#include "targets/glints.h"

namespace rsphere {

// The images visible from a point (world). Omits images whose solid angle (sr) times squared brightness is
// below `least`, and images that are hidden according to up to ten shadow rays. The result depends only on
// the arguments.
std::vector<Glint> mirroredOpenings(const PreparedScene& prepared, const OpeningImages& images,
                                    const V3d& point, double least);

}  // namespace rsphere
