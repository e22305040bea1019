#pragma once
#include <span>
#include <string>

#include "trade/curve.h"

namespace rsphere {

// Tables with a line for each setting: as text, with the meaning of its marks, and as comma-separated values.
std::string tradeTable(std::span<const Figures> all);
std::string tradeCsv(std::span<const Figures> all, const Reference& reference);

// An SVG plot of rms error against seconds for a point, with logarithmic axes. Each setting is a mark in the
// colour of its weights; a line joins the best settings. Settings without error or time are omitted.
std::string tradePlot(std::span<const Figures> all, const std::string& title);

}  // namespace rsphere
