#pragma once
#include <Imath/ImathVec.h>

namespace rsphere {

using Imath::V3d;

// Two unit vectors x and y that form a right-handed orthonormal frame with the unit vector z (Duff et al.
// 2017, JCGT 6/1).
void frame(const V3d& z, V3d& x, V3d& y);

}  // namespace rsphere
