#pragma once
#include <memory>
#include <string>

#include "contrib/bin_function.h"
#include "sphere/direction_bins.h"

namespace rsphere {

// The bins that an expression of the direction (Dx, Dy, Dz, in the world) numbers, as rcontrib's -b does.
// count: an expression of their number. Throws rad::Error if a definition or an expression is wrong, if bin
// uses anything else of a ray, or if the number is not a constant from 1 to 100,000.
std::shared_ptr<const DirectionBins> directionBins(const std::string& bin, const std::string& count,
                                                   const BinDefinitions& definitions);

}  // namespace rsphere
