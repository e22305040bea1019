#include "companions/trade/ladder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "rad_parser/error.h"

namespace rsphere {
namespace {

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream in(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// -Sx is twice -Sn, like its default.
std::string directions(char weights, int base) {
  return fmt::format("-Sw {} -Sn {} -Sx {}", weights, base, 2 * base);
}

std::vector<std::string> linesOfRays() {
  std::vector<std::string> lines;
  for (const int rays : {256, 1024, 4096}) {
    lines.push_back(fmt::format("-aa 0 -ad {} -as 0 -dj 1 -dt 0 -ds .05 -st 0 -lw 1e-4", rays));
    lines.push_back(fmt::format("-aa .1 -ad {} -as {} -dj 1 -dt 0 -ds .05 -st 0 -lw 1e-4", rays, rays / 2));
  }
  for (const double accuracy : {.02, .01, .005}) lines.push_back(fmt::format("-Sa {}", accuracy));
  return lines;
}

std::vector<std::string> usualLines(const TradeOptions& options) {
  if (!options.sphereMode) return linesOfRays();
  std::vector<std::string> lines;
  for (const int base : {128, 256, 512, 1024, 2048, 4096}) lines.push_back(directions('c', base));
  for (const int base : {512, 2048, 8192}) lines.push_back(directions('h', base));
  for (const int base : {512, 2048}) lines.push_back(directions('v', base));
  for (const int base : {512, 2048}) lines.push_back(directions('c', base) + " -Sk 0");
  lines.push_back(directions('c', 512) + " -Sk 4");
  if (options.ray.ambientBounces > 0 && options.ray.ambientDivisions > 0) {
    for (const int base : {512, 2048, 4096}) lines.push_back(directions('c', base) + " -ad 1");
    for (const int base : {128, 512}) lines.push_back(directions('c', base) + " -ad 16");
  }
  for (const int base : {256, 1024, 4096})
    lines.push_back(directions('c', base) + (options.ray.ambientBounces > 0 ? " -ad 1 -Ss 1" : " -Ss 1"));
  if (options.ray.ambientBounces > 0)
    for (const int base : {512, 2048, 8192}) lines.push_back(directions('c', base) + " -ad 1 -Ss 2 -lw .5");
  for (const double accuracy : {.02, .005})
    lines.push_back(fmt::format("-Sw c -Sn 256 -Sx 65536 -Sa {}", accuracy));
  return lines;
}

std::vector<std::string> linesOf(const std::string& name) {
  std::ifstream file(name);
  if (!file)
    throw rad::Error(fmt::format("cannot open \"{}\": {}", name, std::strerror(errno)), rad::Status::system);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace

std::vector<std::vector<std::string>> ladder(const TradeOptions& options) {
  std::vector<std::vector<std::string>> settings;
  for (const std::string& line : options.ladder.empty() ? usualLines(options) : linesOf(options.ladder))
    if (auto words = wordsOf(line); !words.empty()) settings.push_back(std::move(words));
  if (settings.empty()) throw rad::Error(fmt::format("{}: no settings", options.ladder));
  if (options.bounces)
    for (int bounces = 0; bounces < options.ray.ambientBounces; ++bounces)
      settings.push_back(
          wordsOf(fmt::format("{} -ab {}", options.sphereMode ? directions('c', 1024) : "-Sa .01", bounces)));
  return settings;
}

std::vector<std::string> referenceWords(bool sphereMode) {
  return wordsOf(sphereMode ? "-Sw c -Sn 4096 -Sx 8192 -Sk 1"
                            : "-aa 0 -ad 4096 -as 0 -lw 1e-6 -dj 1 -dt 0 -ds .05 -st 0");
}

}  // namespace rsphere
