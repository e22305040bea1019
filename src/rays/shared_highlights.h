#pragma once
// The light of a source in a rough highlight can be estimated in two ways: by shadow rays, which sample a
// direction within the source, and by samples of the lobe. Near a large source, shadow rays have a large
// variance, because the few that fall in the highlight contribute many times the mean. Both are therefore
// combined (multiple importance sampling, balance heuristic: Veach and Guibas 1995). Their weights depend
// only on the direction, and sum to 1, so that no light is counted twice or lost.
#include "rays/prepared_scene.h"
#include "rays/ray.h"

namespace rsphere {

// Whether the light of a source in highlights is estimated in both ways: true for real sources of constant
// radiance without a reach or a spotlight's cone. False for illums, which samples of a lobe pass through.
bool sharesHighlights(const PreparedScene& prepared, LightId source);

// The weight (0 to 1) of samples of the lobe in the estimate of a highlight's light from a direction.
// distance (world units), cosine: of the hit on the source in this direction. density: of the lobe's samples
// in this direction, per sr. The weight is 0 if the lobe is so much wider than the source that shadow rays
// are better.
double shareOfLobe(const LightSource& source, double distance, double cosine, double density);

// The radiance of the source that a lobe's sample hits first, without its weight. Black if the sample hit no
// source, or one that only shadow rays estimate. sample: the end of the sample's ray after tracing; the value
// of the ray excludes the source.
Radiance sourceSeenBy(const PreparedScene& prepared, const RayEnd& sample);

}  // namespace rsphere
