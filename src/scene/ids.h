#pragma once
#include "rad_parser/description.h"

namespace rsphere {

using rad::ById;
using rad::IdRange;
using rad::PrimitiveId;

inline constexpr rad::None kNone;

using SurfaceId = rad::Id<struct SurfaceTag>;    // index in Scene::surfaces
using ModifierId = rad::Id<struct ModifierTag>;  // index in Scene::modifiers
using LightId = rad::Id<struct LightTag>;        // index in LightSources::all()

}  // namespace rsphere
