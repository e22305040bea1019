#include "companions/compare/original.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "base/spectral_sampling.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

[[noreturn]] void fault(const std::string& text) { throw rad::Error(text, rad::Status::system); }

// The paths of all programs of this name, in the order of PATH. A name that contains a slash is already a
// path.
std::vector<std::string> programsNamed(const std::string& name) {
  if (name.find('/') != std::string::npos) return {name};
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path);
  std::vector<std::string> found;
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = (folder.empty() ? "." : folder) + "/" + name;
    std::error_code error;
    if (access(file.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(file, error))
      found.push_back(std::move(file));
  }
  return found;
}

// The text of -version; empty if the program is rsphere.
std::string originalVersion(const std::string& path) {
  const MemoryFile in, out;
  const ChildResult result = runChild({path, "-version"}, in, out);
  const std::string version = firstLine(out.contents());
  if (result.status == 127 && result.errors.empty()) fault(fmt::format("cannot run {}", path));
  if (result.status != 0)
    fault(fmt::format("{} -version ends with status {}: {}", path, result.status, firstLine(result.errors)));
  return version.find("rsphere ") != std::string::npos ? "" : version;
}

}  // namespace

OriginalProgram findOriginal() {
  constexpr std::string_view kHelp =
      "put the folder of RADIANCE's programs on PATH, or set RTRACE=/path/to/rtrace";
  const char* chosen = std::getenv("RTRACE");
  const bool asked = chosen != nullptr && *chosen != '\0';
  const std::string name = asked ? chosen : "rtrace";
  std::string ours;
  for (const std::string& path : programsNamed(name)) {
    if (access(path.c_str(), X_OK) != 0)
      fault(fmt::format("$RTRACE: cannot run \"{}\": {}", path, std::strerror(errno)));
    if (std::string version = originalVersion(path); !version.empty()) return {path, std::move(version)};
    if (ours.empty()) ours = path;
  }
  if (!ours.empty()) fault(fmt::format("no original rtrace: {} is rsphere; {}", ours, kHelp));
  fault(fmt::format("no original rtrace: {}; {}",
                    asked ? fmt::format("$RTRACE names \"{}\", which is not on PATH", name)
                          : std::string("there is none on PATH"),
                    kHelp));
}

std::vector<std::string> originalOptions(const Options& options, std::span<const UsedOption> used) {
  std::vector<std::string> words;
  if (options.sphereMode) {
    const std::string ofRays = '\n' + defaultsText(modeDefaults(false));
    std::istringstream ofPoints(defaultsText(modeDefaults(true)));
    for (std::string given; std::getline(ofPoints, given);) {
      if (ofRays.find(fmt::format("\n{}\n", given)) != std::string::npos || given.starts_with("-S")) continue;
      std::istringstream line(given.substr(0, given.find('#')));
      for (std::string word; line >> word;) words.push_back(word);
    }
  }
  for (const UsedOption& option : used) {
    const OptionEntry& entry = *option.entry;
    const auto isOneOf = [&](std::initializer_list<std::string_view> names) {
      return std::ranges::find(names, entry.name) != names.end();
    };
    bool pass = false;
    switch (entry.group) {
      case Group::records: pass = isOneOf({"-I", "-i", "-ld"}); break;
      case Group::direct:
      case Group::specular:
      case Group::indirect:
      case Group::limits:
      case Group::medium: pass = true; break;
      case Group::program:
        pass = isOneOf({"-u", "-bv", "-f"}) ||
               (entry.name == "-e" && option.words[1].find_first_of("=:") != std::string::npos);
        break;
      case Group::sphere:
      case Group::color:
      case Group::trees:
      case Group::companion: break;
    }
    if (pass) words.insert(words.end(), option.words.begin(), option.words.end());
  }
  if (const SpectralSampling* const s = options.ray.sampling) {
    const std::string bands = std::to_string(s->count());
    words.insert(words.end(), {"-cs", bands, "-cw", fmt::format("{}", s->shortest),
                               fmt::format("{}", s->longest), "-co+"});
  }
  return words;
}

Original::Original(OriginalProgram program, const std::vector<std::string>& scene, bool isOctree,
                   std::vector<std::string> options)
    : program_(std::move(program)), options_(std::move(options)) {
  if (isOctree) {
    octreeName_ = scene[0];
    return;
  }
  const std::string folder = program_.path.substr(0, program_.path.rfind('/') + 1);
  std::string oconv = folder + "oconv";
  if (access(oconv.c_str(), X_OK) != 0) {
    const auto found = programsNamed("oconv");
    if (found.empty())
      fault(fmt::format("no oconv beside {} or on PATH: give an octree as the scene", program_.path));
    oconv = found[0];
  }
  std::vector<std::string> words{oconv};
  words.insert(words.end(), scene.begin(), scene.end());
  const MemoryFile in;
  const ChildResult result = runChild(words, in, octree_);
  if (result.status != 0)
    fault(fmt::format("{} ends with status {}: {}", oconv, result.status, firstLine(result.errors)));
  octreeSeconds_ = result.seconds;
  octreeName_ = octree_.path();
}

std::string Original::run(std::span<const double> rays, std::vector<std::string> more) {
  std::vector<std::string> words{program_.path};
  words.insert(words.end(), options_.begin(), options_.end());
  words.insert(words.end(), {"-h-", "-w-"});
  words.insert(words.end(), more.begin(), more.end());
  words.push_back(octreeName_);
  const MemoryFile in({reinterpret_cast<const char*>(rays.data()), rays.size_bytes()}), out;
  const ChildResult result = runChild(words, in, out);
  if (result.status != 0)
    fault(fmt::format("{} ends with status {}: {}", program_.path, result.status, firstLine(result.errors)));
  seconds_ += result.seconds;
  return out.contents();
}

std::vector<double> Original::answers(std::span<const double> rays, const std::string& letters,
                                      size_t perRay) {
  const std::string bytes = run(rays, {"-fdd", "-o" + letters});
  const size_t wanted = rays.size() / 6 * perRay;
  if (bytes.size() != wanted * sizeof(double))
    fault(
        fmt::format("{} answered {} numbers, not {}", program_.path, bytes.size() / sizeof(double), wanted));
  std::vector<double> numbers(wanted);
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

std::vector<std::string> Original::surfaces(std::span<const double> rays) {
  const double before = seconds_;
  std::istringstream lines(run(rays, {"-fda", "-os"}));
  seconds_ = before;
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) names.push_back(line.substr(0, line.find('\t')));
  names.resize(rays.size() / 6, "?");
  return names;
}

}  // namespace rsphere
