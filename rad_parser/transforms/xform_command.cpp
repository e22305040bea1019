#include "rad_parser/transforms/xform_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "rad_parser/number.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

XformFault fault(std::string_view text) { return XformFault(fmt::format("xform: {}", text)); }

// The words of one line of an argument file. As in xform, quotes and backslashes are special only at the
// beginning of a word.
std::vector<std::string> argumentWords(std::string_view line) {
  if (line.starts_with('!')) line.remove_prefix(1);
  if (line.starts_with("xform ")) line.remove_prefix(6);
  std::vector<std::string> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    if (line.starts_with("\\\n")) {
      line.remove_prefix(2);
      continue;
    }
    if (line.empty()) return words;
    size_t begin = 0, end, next;
    if (line[0] == '"' || line[0] == '\'') {
      begin = 1;
      end = std::min(line.find(line[0], 1), line.size());
      next = std::min(end + 1, line.size());
    } else {
      begin = line[0] == '\\' && line.size() > 1;
      next = end = std::min(line.find_first_of(kBlanks, begin), line.size());
    }
    words.emplace_back(line.substr(begin, end - begin));
    line.remove_prefix(next);
  }
}

// The words of all lines of an argument file except comments and empty lines.
std::vector<std::vector<std::string>> readArgumentFile(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> lines;
  std::string line, part;
  while (std::getline(file, part)) {
    if (part.ends_with('\r')) part.pop_back();
    line += part;
    if (line.ends_with('\\')) {
      line += '\n';
      continue;
    }
    if (!line.empty() && line[0] != '#') lines.push_back(argumentWords(line));
    line.clear();
  }
  if (!line.empty() && line[0] != '#') lines.push_back(argumentWords(line));
  if (!file.eof())
    throw XformFault(
        fmt::format("xform: cannot read argument file \"{}\": {}", printable(name), std::strerror(errno)),
        Status::system);
  if (lines.empty()) throw fault(fmt::format("empty argument file \"{}\"", printable(name)));
  return lines;
}

// The count after words[at], which is -a. As in xform, only the integer at the beginning of the word counts:
// "3.0", the result of a division in a script, is 3. Empty if it is missing or not positive.
std::optional<int64_t> countAfter(std::span<const std::string> words, size_t at) {
  if (at + 1 >= words.size()) return {};
  std::string_view word = words[at + 1];
  word.remove_prefix(std::min(word.find_first_not_of(kBlanks), word.size()));
  const auto count =
      parseInteger(word.substr(0, word.find_first_not_of("0123456789", word.starts_with('+'))));
  return count && *count > 0 ? count : std::nullopt;
}

class Passes {
 public:
  Passes(const std::string& directory, const FileAccess& access,
         const std::function<void(const XformPass&)>& pass)
      : directory_(directory), access_(access), pass_(pass) {}

  void run(const std::vector<std::string>& words, int nested) {
    if (nested > kDeepest) throw fault("argument files include each other without end");
    for (size_t i = 1; i < words.size(); ++i)
      if (words[i] == "-f") return fromFile(words, i, nested);
    for (size_t i = 1; i < words.size(); ++i)
      if (words[i] == "-a") return array(words, i, nested);
    if (++done_ > kMostPasses) throw tooMany();
    single(words);
  }

 private:
  static constexpr int kDeepest = 32;  // nesting of argument files and arrays

  void fromFile(const std::vector<std::string>& words, size_t at, int nested) {
    if (at + 1 == words.size() || (words[at + 1].starts_with('-') && words[at + 1] != "-"))
      throw fault("missing file for -f");
    if (words[at + 1] == "-") throw fault("-f - would read standard input, which a scene must not");
    int k = 0;
    const std::string path = joinPath(directory_, words[at + 1]);
    if (!access_.allows(path))
      throw XformFault(fmt::format("xform: cannot read argument file \"{}\"{}", printable(words[at + 1]),
                                   access_.remark()),
                       Status::system);
    for (const auto& line : readArgumentFile(path, words[at + 1])) {
      std::vector<std::string> longer(words.begin(), words.begin() + at);
      longer.insert(longer.end(), line.begin(), line.end());
      longer.insert(longer.end(), words.begin() + at + 2, words.end());
      bool named = false;
      for (size_t i = 1; i + 1 < longer.size() && !named; ++i)
        if (longer[i] == "-n") {
          longer[i + 1] += fmt::format(".{}", k);
          named = true;
        }
      if (!named) longer.insert(longer.begin() + 1, {"-n", fmt::format("i{}", k)});
      run(longer, nested + 1);
      ++k;
    }
  }

  void array(const std::vector<std::string>& words, size_t at, int nested) {
    const auto count = countAfter(words, at);
    if (!count) throw fault("missing count for -a");
    copiesOfArrays(words);
    // If a command has several names (-n), each is replaced by the last one with the element's number.
    std::optional<std::string> name;
    for (size_t i = 1; i + 1 < words.size(); ++i)
      if (words[i] == "-n") name = words[i + 1];
    for (int64_t k = 0; k < *count; ++k) {
      std::vector<std::string> element = words;
      element[at] = "-i";
      element[at + 1] = fmt::format("{}", k);
      for (size_t i = 1; name && i + 1 < words.size(); ++i)
        if (words[i] == "-n") element[i + 1] = fmt::format("{}.{}", *name, k);
      if (!name) element.insert(element.begin() + 1, {"-n", fmt::format("a{}", k)});
      run(element, nested + 1);
    }
  }

  void single(const std::vector<std::string>& words) {
    XformPass pass;
    Transform& t = pass.transform;
    size_t i = 1;
    for (; i < words.size(); ++i) {
      const std::string& option = words[i];
      const bool hasValue = i + 1 < words.size();
      if (option == "-m" && hasValue) {
        if (!t.modifier) t.modifier = words[i + 1];
        ++i;
      } else if (option == "-n" && hasValue) {
        if (!t.prefix.empty()) t.prefix += '.';
        t.prefix += words[++i];
      } else if (option == "-c" || option == "-e") {
        pass.changesDirectory = option == "-e";
      } else if (option == "-I") {
        t.inverted = !t.inverted;
      } else {
        break;
      }
    }
    const std::vector<std::string_view> rest(words.begin() + i, words.end());
    size_t used = 0;
    t.similarity = readTransform(rest, used);
    t.reversed = (t.similarity.scale < 0) != t.inverted;
    if (used > 0 && rest[0] != "-i")
      t.arguments = {"-i", "1"};  // terminates an -i among the primitive's own arguments
    t.arguments.insert(t.arguments.end(), rest.begin(), rest.begin() + used);
    if (used < rest.size() && rest[used].starts_with('-'))
      throw fault(fmt::format("bad option or argument at \"{}\"", printable(rest[used])));
    if (used == rest.size())
      throw fault("no file named: it would read standard input, which a scene must not");
    pass.files.assign(rest.begin() + used, rest.end());
    pass_(pass);
  }

  const std::string& directory_;
  const FileAccess& access_;
  const std::function<void(const XformPass&)>& pass_;
  int64_t done_ = 0;
};

}  // namespace

std::optional<std::vector<std::string>> plainWords(std::string_view command) {
  std::vector<std::string> words;
  std::string word;
  bool inWord = false;
  for (size_t i = 0; i <= command.size(); ++i) {
    const char c = i < command.size() ? command[i] : ' ';
    if (c == '\\' && i + 1 < command.size() && command[i + 1] == '\n') {
      ++i;
    } else if (c == ' ' || c == '\t' || c == '\n' || (c == '#' && !inWord)) {
      // In a shell, a line end that is not escaped would begin another command, but command lines do not
      // contain any.
      if (inWord) words.push_back(word);
      word.clear();
      inWord = false;
      if (c == '#') break;
    } else if (c == '"' || c == '\'') {
      const size_t close = command.find(c, i + 1);
      if (close == command.npos) return {};
      const std::string_view quoted = command.substr(i + 1, close - i - 1);
      if (c == '"' && quoted.find_first_of("$`\\") != quoted.npos) return {};
      word += quoted;
      inWord = true;
      i = close;
    } else if (std::strchr("|&;<>()$`\\*?[]{}!", c)) {
      return {};
    } else {
      word += c;
      inWord = true;
    }
  }
  return words;
}

XformFault tooMany() {
  return fault(fmt::format(
      "more than {} copies: make an octree (oconv -f) of a part, and copy instances of it", kMostPasses));
}

int64_t copiesOfArrays(std::span<const std::string> words, int64_t outside) {
  int64_t copies = 1;
  for (size_t i = 1; i + 1 < words.size(); ++i) {
    const auto count = words[i] == "-a" ? countAfter(words, i) : std::nullopt;
    if (!count) continue;
    if (*count > kMostPasses / copies / outside) throw tooMany();
    copies *= *count;
  }
  return copies;
}

void forEachPass(std::span<const std::string> words, const std::string& directory, const FileAccess& access,
                 const std::function<void(const XformPass&)>& pass) {
  Passes(directory, access, pass).run({words.begin(), words.end()}, 0);
}

}  // namespace rad
