#include "cli/word_file.h"

#include <fmt/format.h>

#include "rad_parser/file_path.h"
#include "rad_parser/open_file.h"
#include "rad_parser/text_source.h"

namespace rsphere {
namespace {

constexpr size_t kMostWords = 1000000;

// source: the descriptor or the text.
template <typename Source>
std::vector<std::string> readWords(const Source& source, const std::string& name, size_t most) {
  rad::DescriptionBuilder places;
  rad::TextSource text(source, places.addFile(name), places);
  text.skipByteOrderMark();
  std::vector<std::string> words;
  for (std::string_view word; text.word(word);) {
    if (words.size() == most) throw places.error(text.place(), fmt::format("more than {} words", most));
    words.emplace_back(word);
  }
  return words;
}

}  // namespace

std::vector<std::string> wordsOf(const rad::OpenFile& file, const std::string& name, size_t most) {
  return readWords(file.descriptor(), name, most);
}

std::vector<std::string> wordsOf(std::string_view text, const std::string& name, size_t most) {
  return readWords(text, name, most);
}

std::vector<std::string> wordsOfFile(std::string_view what, const std::string& name) {
  const std::string path = rad::findFile(name, rad::libraryPath()).value_or(name);
  const rad::OpenFile file(path);
  if (file.descriptor() < 0) throw rad::systemError(fmt::format("cannot open {} \"{}\"", what, name));
  return wordsOf(file, path, kMostWords);
}

}  // namespace rsphere
