// Reads records as from standard input. The first byte selects their form: text, floats or doubles; three or
// six numbers; line ends that end a record or do not. Neither the records nor the error messages may depend
// on how many records are requested at a time.
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "memory_file.h"
#include "rad_parser/error.h"
#include "records/record_reader.h"

namespace {

using Outcome = std::pair<std::vector<double>, std::string>;

Outcome readAll(const uint8_t* data, size_t size, rsphere::NumberFormat format, int perRecord,
                rsphere::LineEnds lineEnds, size_t most) {
  const MemoryFile file(data, size);
  rsphere::RecordReader reader(file.descriptor(), format, perRecord, lineEnds);
  Outcome outcome;
  try {
    for (;;) {
      const size_t before = outcome.first.size(), count = reader.read(outcome.first, most);
      if (count > most || outcome.first.size() != before + count * static_cast<size_t>(perRecord))
        std::abort();
      if (count == 0) break;
    }
    static_cast<void>(reader.firstLine());
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
  const auto lineEnds = static_cast<rsphere::LineEnds>(data[0] / 6 % 2);
  const Outcome one = readAll(data + 1, size - 1, format, perRecord, lineEnds, 1);
  if (one != readAll(data + 1, size - 1, format, perRecord, lineEnds, 256)) std::abort();
  return 0;
}
