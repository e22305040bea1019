#include "records/record_text.h"

#include <array>
#include <charconv>

#include "image/rgbe.h"

namespace rsphere {

void RecordText::number(double x) {
  switch (format_) {
    case NumberFormat::ascii:
      appendScientific(bytes_, x);
      bytes_ += '\t';
      break;
    case NumberFormat::float32: {
      const auto single = static_cast<float>(x);
      bytes_.append(reinterpret_cast<const char*>(&single), sizeof single);
      break;
    }
    case NumberFormat::float64:
    case NumberFormat::rgbe:  // cannot occur: parseOptions() allows a single color only
      bytes_.append(reinterpret_cast<const char*>(&x), sizeof x);
      break;
  }
}

void RecordText::integer(uint64_t n) {
  if (format_ != NumberFormat::ascii) return number(static_cast<double>(n));
  char digits[24];
  bytes_.append(digits, std::to_chars(digits, digits + sizeof digits, n).ptr);
  bytes_ += '\t';
}

void RecordText::vector(const V3d& v) {
  number(v.x);
  number(v.y);
  number(v.z);
}

void RecordText::color(const Color& c) {
  if (format_ != NumberFormat::rgbe) return vector(c.rgb());
  const std::array<uint8_t, 4> pixel = rgbePixel(c);
  bytes_.append(reinterpret_cast<const char*>(pixel.data()), pixel.size());
}

void RecordText::spectrum(std::span<const double> bands) {
  if (format_ == NumberFormat::rgbe) return appendSpectralPixel(bands, bytes_);
  for (const double value : bands) number(value);
}

void RecordText::name(std::string_view n) {
  bytes_ += n;
  bytes_ += '\t';
}

void RecordText::end() {
  if (format_ == NumberFormat::ascii) bytes_ += '\n';
}

}  // namespace rsphere
