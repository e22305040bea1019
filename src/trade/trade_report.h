#pragma once
#include <span>
#include <string>

#include "trade/curve.h"

namespace rsphere {

// A line for each setting; what the marks mean; for text, CSV and SVG.
std::string tradeTable(std::span<const Figures> all);
std::string tradeCsv(std::span<const Figures> all, const Reference& reference);

// Rms error against seconds a point, both logarithmic: a mark for each setting, in the colour of its weights,
// and a line through those that nothing beats. Settings without error or time are left out.
std::string tradePlot(std::span<const Figures> all, const std::string& title);

}  // namespace rsphere
