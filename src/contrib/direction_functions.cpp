#include "contrib/direction_functions.h"

#include <fmt/format.h>

#include <cmath>

namespace rsphere {
namespace {

constexpr double kMostBins = 100000;  // the limit of -Sz

}  // namespace

std::shared_ptr<const DirectionBins> directionBins(const std::string& bin, const std::string& count,
                                                   const BinDefinitions& definitions) {
  BinFunctions functions;
  const BinFunction number = functions.compile("-Szn", count, definitions, BinInputs::direction);
  const double bins = number.isConstant() ? std::floor(number.constant() + .5) : 0;
  if (!(bins >= 1 && bins <= kMostBins))
    throw rad::Error(
        fmt::format("-Szn '{}': the number of bins must be a constant from 1 to {:.0f}", count, kMostBins));
  const BinFunction of = functions.compile("-Szb", bin, definitions, BinInputs::direction);
  BinScratch scratch;
  const auto binOf = [&](const V3d& direction) {
    const std::optional<double> found = of.at(direction, scratch);
    return found && *found >= 0 && *found < bins ? static_cast<size_t>(*found) : static_cast<size_t>(bins);
  };
  return std::make_shared<const DirectionBins>(static_cast<size_t>(bins), binOf);
}

}  // namespace rsphere
