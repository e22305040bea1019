#include "rad_parser/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "rad_parser/printable.h"

namespace rad {
namespace {

std::string inLowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

size_t mostChanges(size_t letters) {
  if (letters < 3 || letters > NearestName::kLongest) return 0;
  return letters < 6 ? 1 : 2;
}

}  // namespace

size_t editDistance(std::string_view a, std::string_view b) {
  // Rows of the table of distances between the beginnings of a and b: the one for i + 1 letters of a, and the
  // two before it.
  std::vector<size_t> row(b.size() + 1), before(row), twoBefore(row);
  for (size_t k = 0; k <= b.size(); ++k) row[k] = k;
  for (size_t i = 0; i < a.size(); ++i) {
    twoBefore.swap(before);
    before.swap(row);
    row[0] = i + 1;
    for (size_t k = 0; k < b.size(); ++k) {
      row[k + 1] = std::min({before[k] + (a[i] != b[k]), row[k] + 1, before[k + 1] + 1});
      if (i > 0 && k > 0 && a[i] == b[k - 1] && a[i - 1] == b[k])
        row[k + 1] = std::min(row[k + 1], twoBefore[k - 1] + 1);
    }
  }
  return row.back();
}

NearestName::NearestName(std::string_view wanted)
    : wanted_(wanted), lowercase_(inLowerCase(wanted)), most_(mostChanges(wanted.size())) {}

void NearestName::consider(std::string_view name) {
  const size_t longer = std::max(name.size(), wanted_.size()),
               shorter = std::min(name.size(), wanted_.size());
  if (most_ == 0 || longer - shorter > most_ || name == wanted_ || name == nearest_) return;
  const size_t changes = editDistance(lowercase_, inLowerCase(name));
  if (changes > most_) return;
  const size_t cost = 2 * changes + (changes == 0);
  if (cost > cost_) return;
  tied_ = cost == cost_;
  cost_ = cost;
  nearest_ = name;
}

std::string NearestName::hint() const {
  return name().empty() ? "" : fmt::format("; the nearest is \"{}\"", printable(name()));
}

}  // namespace rad
