#pragma once
#include <Imath/ImathVec.h>

#include <utility>

namespace rsphere {

using Imath::V3d;

// Two unit vectors x and y that form a right-handed orthonormal frame with the unit vector z (Duff et al.
// 2017, JCGT 6/1), multiplied by a length.
std::pair<V3d, V3d> frame(const V3d& z, double length = 1);

}  // namespace rsphere
