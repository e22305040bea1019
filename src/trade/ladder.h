#pragma once
#include <string>
#include <vector>

#include "trade/trade_options.h"

namespace rsphere {

// The settings to measure, each a list of rsphere's options: those of -Tl, or the usual ones from cheap to
// dear. Throws rad::Error where the file cannot be read (Status::system) or has no setting.
std::vector<std::vector<std::string>> ladder(const TradeOptions& options);

// That of the reference.
std::vector<std::string> referenceWords();

}  // namespace rsphere
