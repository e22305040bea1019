#pragma once
#include <memory>
#include <string>

#include "contrib/bin_function.h"
#include "sphere/direction_bins.h"

namespace rsphere {

// Bins that are numbered by an expression of the direction (Dx, Dy, Dz, in the world), as with rcontrib's -b.
// count: an expression for their number. Throws rad::Error if a definition or an expression is invalid, if
// `bin` uses other properties of a ray, or if `count` is not a constant from 1 to 100,000.
std::shared_ptr<const DirectionBins> directionBins(const std::string& bin, const std::string& count,
                                                   const BinDefinitions& definitions);

}  // namespace rsphere
