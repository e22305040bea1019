#pragma once
// Light of a source in a rough highlight can be estimated in two ways: by shadow rays, which choose a
// direction within the source, and by samples of the lobe, which choose one within the highlight. Near a
// large source shadow rays have large variance: few of them lie in the highlight, and each of those few
// brings many times the mean. The light is therefore divided between both (multiple importance sampling,
// balance heuristic: Veach and Guibas 1995). The shares are functions of the direction alone, and sum to 1
// for each, so that no light is counted twice or lost.
#include "transport/prepared_scene.h"
#include "transport/ray.h"

namespace rsphere {

// Whether the light of a source in highlights is divided: real sources of constant radiance without a reach
// or a spot. Not illums, through which samples of a lobe pass.
bool sharesHighlights(const PreparedScene& prepared, LightId source);

// The share (0 to 1) of a highlight's light from a direction that samples of the lobe estimate. distance
// (world units), cosine: of the hit on the source in this direction. density: of the lobe's samples in it,
// per sr. 0 where the lobe is so much wider than the source that shadow rays do better.
double shareOfLobe(const LightSource& source, double distance, double cosine, double density);

// The radiance of the source that is the first hit of a lobe's sample, before it is multiplied by the share;
// black if the sample hit no source, or one whose light is not divided. sample: the end of the sample's ray
// after tracing; the value of the ray itself excludes the source.
Radiance sourceSeenBy(const PreparedScene& prepared, const RayEnd& sample);

}  // namespace rsphere
