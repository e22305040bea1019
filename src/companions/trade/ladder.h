#pragma once
#include <string>
#include <vector>

#include "companions/trade/trade_options.h"

namespace rsphere {

// The settings to be measured, each a list of rsphere's options: those in the file of -Tl, or else a default
// selection; with -Tb, also settings with fewer bounces. Throws rad::Error if the file cannot be read
// (Status::system) or contains no setting.
std::vector<std::vector<std::string>> ladder(const TradeOptions& options);

// The options of the reference, with which the answers of all settings are compared.
std::vector<std::string> referenceWords(bool sphereMode);

}  // namespace rsphere
