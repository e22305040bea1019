#pragma once
// The variance of the light of sources that are integrated separately. Parameters: points/error_estimate.h.
#include <span>

#include "points/error_estimate.h"
#include "silhouettes/seen_sources.h"

namespace rsphere {

// The variance of the samples of one image of a light source, in the order of its grid. It is computed from
// differences between adjacent cells, because occluded cells lie together.
Variance partsVariance(std::span<const SeenSources::Sample> samples, const SpectralSampling* sampling,
                       KernelVariances* to = nullptr);

// The variance due to sampling a random subset of the images, if there are more images than samples. It is
// computed from differences between images that are sampled in succession. samples: of all images.
Variance choiceVariance(std::span<const SeenSources::Sample> samples, const SpectralSampling* sampling,
                        KernelVariances* to = nullptr);

}  // namespace rsphere
