#include "answer/header.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "answer/column_names.h"
#include "base/version.h"
#include "rad_parser/printable.h"
#include "records/output_colors.h"
#include "sphere/direction_bins.h"

namespace rsphere {
namespace {

// A word as in rtrace's headers: in quotes if it is empty, or contains blanks or a quote.
std::string quoted(const std::string& word) {
  char quote = 0;
  for (size_t i = 1; i + 1 < word.size(); ++i) {
    if (word[i] == '"') quote = '\'';
    if (word[i] == '\'') quote = '"';
  }
  const bool blanks = std::ranges::any_of(word, rad::isBlank);
  if (quote == 0 && (word.empty() || blanks)) quote = '"';
  return quote == 0 ? word : quote + word + quote;
}

// Solid angle of each bin (sr), eight on a line.
std::string solidAngleLines(const DirectionBins& bins) {
  std::string lines;
  for (size_t i = 0; i < bins.count(); ++i) {
    if (i % 8 == 0) lines += "SOLIDANGLES=";
    lines += fmt::format(" {:.6g}", bins.solidAngle(i));
    if (i % 8 == 7 || i + 1 == bins.count()) lines += '\n';
  }
  return lines;
}

}  // namespace

std::string_view formatName(NumberFormat format, const ColorOptions& color) {
  switch (format) {
    case NumberFormat::ascii: return "ascii";
    case NumberFormat::float32: return "float";
    case NumberFormat::float64: return "double";
    case NumberFormat::rgbe: return OutputColors(color).pixelFormat();
  }
  return "unknown";
}

std::string versionLine() { return fmt::format("rsphere {}", kVersion); }

std::string versionAnswer(std::string_view program) {
  if (program != "rtrace" && program != "rcontrib") return versionLine();
  return fmt::format("matches {0}: this is {1}, compatible with {2} of RADIANCE {0}", kRadianceVersion,
                     versionLine(), program);
}

std::string commandLine(const AnswerOptions& options, bool withScene) {
  std::string line = quoted(options.program);
  for (const std::string& word : options.words) line += ' ' + quoted(word);
  if (withScene)
    for (const std::string& word : options.scene) line += ' ' + quoted(word);
  return line;
}

std::string provenance(const AnswerOptions& options, std::span<const std::string> sceneHeader) {
  std::string text;
  if (sceneHeader.empty()) text += "#?RADIANCE\n";
  for (const std::string& line : sceneHeader) text += line + '\n';
  text += commandLine(options, sceneHeader.empty()) + '\n';
  return text + fmt::format("SOFTWARE= {}\n", versionLine());
}

std::string resolutionLine(const AnswerOptions& options) {
  return fmt::format("-Y {:8} +X {:8}\n", options.height, options.width);
}

void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now, const RecordLayout& layout) {
  std::string text;
  if (options.header) {
    text += provenance(options, sceneHeader);
    std::tm date{};
    if (localtime_r(&now, &date) != nullptr) text += fmt::format("CAPDATE= {:%Y:%m:%d %H:%M:%S}\n", date);
    if (gmtime_r(&now, &date) != nullptr) text += fmt::format("GMT= {:%Y:%m:%d %H:%M:%S}\n", date);
    if (layout.components > 0) text += fmt::format("NCOMP={}\n", layout.components);
    text += OutputColors(options.color).headerLines();
    if (options.sphere.accuracy > 0) text += fmt::format("ACCURACY= {:g}\n", options.sphere.accuracy);
    text += layout.lines;
    size_t alignment = 1;
    if (options.out == NumberFormat::float32) alignment = sizeof(float);
    if (options.out == NumberFormat::float64) alignment = sizeof(double);
    if (alignment > 1) text += fmt::format("BigEndian={}\n", std::endian::native == std::endian::big ? 1 : 0);
    text += fmt::format("FORMAT={}", formatName(options.out, options.color));
    constexpr size_t kLineEnds = 2;  // of this line and of the following empty line
    if (const auto start = writer.position(); start && alignment > 1)
      while ((static_cast<size_t>(*start) + text.size() + kLineEnds) % alignment != 0) text += ' ';
    text += "\n\n";
  }
  if (layout.resolution && options.width > 0 && options.height > 0) text += resolutionLine(options);
  writer.write(text);
}

void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now) {
  const bool counts = options.treeOutputs.empty() && !options.outputs.empty();
  RecordLayout layout{counts ? componentCount(options) : 0};
  if (!options.contributors.empty()) {
    layout.lines = "CONTRIBUTORS=";
    for (const std::string& name : options.contributors) layout.lines += ' ' + quoted(name);
    layout.lines += '\n';
  }
  std::vector<std::string> columns;
  if (options.namesColumns && counts)
    for (const auto& ofLetter : columnNames(options))
      columns.insert(columns.end(), ofLetter.begin(), ofLetter.end());
  if (!columns.empty()) layout.lines += fmt::format("COLUMNS= {}\n", fmt::join(columns, " "));
  if (options.sphereMode && options.sphere.bins) {
    layout.lines += solidAngleLines(*options.sphere.bins);
  } else if (options.sphereMode && options.sphere.zones > 0) {
    layout.lines += "ZONES=";
    for (const size_t zones : EqualZones(static_cast<size_t>(options.sphere.zones)).rows())
      layout.lines += fmt::format(" {}", zones);
    layout.lines += '\n';
  }
  writeHeader(writer, options, sceneHeader, now, layout);
}

}  // namespace rsphere
