// Records as they come on standard input. The first byte of a file says which: text, floats or doubles, of
// three or six numbers. What is read, and what is said of a fault, must not depend on how many records are
// asked for at once.
#include "cli/records.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "memory_file.h"

namespace {

using Outcome = std::pair<std::vector<double>, std::string>;

Outcome readAll(const uint8_t* data, size_t size, rsphere::NumberFormat format, int perRecord, size_t most) {
  const MemoryFile file(data, size);
  rsphere::RecordReader reader(file.descriptor(), format, perRecord);
  Outcome outcome;
  try {
    for (;;) {
      const size_t before = outcome.first.size(), count = reader.read(outcome.first, most);
      if (count > most || outcome.first.size() != before + count * static_cast<size_t>(perRecord))
        std::abort();
      if (count == 0) break;
    }
    static_cast<void>(reader.numbersOnFirstLine());
    if (!(reader.shareRead() >= 0 && reader.shareRead() <= 1)) std::abort();
  } catch (const rad::Error& error) {
    outcome.second = error.what();
  }
  for (const double x : outcome.first)
    if (!std::isfinite(x)) std::abort();
  return outcome;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  using rsphere::NumberFormat;
  constexpr NumberFormat kFormats[] = {NumberFormat::ascii, NumberFormat::float32, NumberFormat::float64};
  const NumberFormat format = kFormats[data[0] / 2 % 3];
  const int perRecord = data[0] % 2 == 0 ? 3 : 6;
  const Outcome one = readAll(data + 1, size - 1, format, perRecord, 1);
  if (one != readAll(data + 1, size - 1, format, perRecord, 256)) std::abort();
  return 0;
}
