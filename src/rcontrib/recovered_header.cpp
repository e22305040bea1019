#include "rcontrib/recovered_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "cli/word_file.h"
#include "rad_parser/printable.h"

namespace rsphere {
namespace {

[[noreturn]] void refuse(const std::string& file, std::string_view why) {
  throw rad::Error(fmt::format("cannot recover {}: {}", rad::printableName(file), why));
}

// The lines of a text, without blanks at their ends: FORMAT= has some, which align the records.
std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  for (const std::string_view line : rad::split(text, "\n"))
    lines.emplace_back(line.substr(0, line.find_last_not_of(' ') + 1));
  return lines;
}

// The words of the last command line of rcontrib in a header; none if there is no such line. A word in quotes
// may contain line ends.
std::vector<std::string> commandIn(const std::vector<std::string>& header) {
  constexpr std::string_view kProgram = "rcontrib";
  std::vector<std::string> words;
  for (size_t first = 0; first < header.size(); ++first) {
    const std::string& line = header[first];
    if (!line.substr(0, line.find(' ')).ends_with(kProgram)) continue;
    std::string command;
    for (size_t i = first; i < header.size(); ++i) {
      command += header[i] + '\n';
      try {
        words = wordsOf(command, "header", std::numeric_limits<size_t>::max());
        break;
      } catch (const rad::Error&) {  // a quote is not closed in this line
      }
    }
  }
  return words;
}

// The option, without its remark, in the first of the lines that is not among the others; empty if all are.
std::string_view firstMissing(const std::vector<std::string>& lines, const std::vector<std::string>& others) {
  for (const std::string& line : lines)
    if (std::ranges::find(others, line) == others.end())
      return std::string_view(line).substr(0, line.find_last_not_of(" \t", line.find('#') - 1) + 1);
  return "";
}

// Compares a command in a header with this run.
void requireSameCommand(const std::string& file, std::vector<std::string> words,
                        const ContributionOptions& options) {
  if (words.empty()) refuse(file, "its header has no command line of rcontrib");
  // The command line lacks the scene if that is an octree; without one it could not be parsed.
  words.emplace_back("octree");
  ContributionOptions other;
  try {
    parseCompanion(words, contributionCompanion(), other);
    other.recovers = false;
    finish(other);
  } catch (const rad::Error& error) {
    refuse(file, fmt::format("the command line in its header: {}", error.what()));
  }
  other.scene.pop_back();
  // Options that do not change records. -x and -y determine lines of the header, which are compared as well.
  other.threads = options.threads;
  other.messages = options.messages;
  other.progressSeconds = options.progressSeconds;
  other.width = options.width;
  other.height = options.height;
  other.overwrites = options.overwrites;
  other.recovers = options.recovers;
  ContributionOptions own = options;
  const auto before = linesOf(companionDefaults(contributionCompanion(), other)),
             now = linesOf(companionDefaults(contributionCompanion(), own));
  const std::string_view was = firstMissing(before, now), is = firstMissing(now, before);
  if (!was.empty() || !is.empty())
    refuse(file, fmt::format("it was made with {}, not with {}", was.empty() ? "the default" : was,
                             is.empty() ? "the default" : is));
  if (other.tracked != options.tracked)
    refuse(file, "it was made for other modifiers, bins or outputs (-m -M -b -bn -p -e -f -o -oe)");
  if (!other.scene.empty() && other.scene != options.scene) refuse(file, "it was made with another scene");
}

}  // namespace

size_t recordsBeginIn(const std::string& file, std::string_view bytes, const ContributionOptions& options,
                      const RecordLayout& layout) {
  size_t begin = 0;
  if (options.header) {
    const size_t end = bytes.find("\n\n");
    const auto header = linesOf(bytes.substr(0, end == bytes.npos ? 0 : end));
    const auto has = [&](const std::string& line) { return std::ranges::find(header, line) != header.end(); };
    for (const std::string& line :
         linesOf(fmt::format("{}FORMAT={}", layout.lines, formatName(options.out, options.color))))
      if (!has(line)) refuse(file, fmt::format("its header lacks {}", line));
    const std::string otherOrder =
        fmt::format("BigEndian={}", std::endian::native == std::endian::big ? 0 : 1);
    if (has(otherOrder)) refuse(file, fmt::format("its header has {}", otherOrder));
    requireSameCommand(file, commandIn(header), options);
    begin = end + 2;
  }
  if (layout.resolution) {
    const std::string line = resolutionLine(options);
    if (!bytes.substr(begin).starts_with(line))
      refuse(file, fmt::format("it lacks the resolution {}", line.substr(0, line.size() - 1)));
    begin += line.size();
  }
  return begin;
}

}  // namespace rsphere
