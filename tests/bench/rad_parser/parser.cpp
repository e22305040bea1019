// The time to read scene text of a million quadrangles with different names (258 MB). In the
// same run it is compared with
// - a tokenizer that splits the text at white space, passes numbers to strtod and keeps only these: the cost
//   of reading without looking up names, checking modifiers and keeping places;
// - getbbox, if it is on PATH: RADIANCE's reader, in a process of its own, which discards each
//   primitive after reading it.
// The file is in the page cache, as after another program has written it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <vector>

#include "rad_parser/scene_file.h"

namespace {

constexpr int kPolygons = 1'000'000;

std::string millionPolygons() {
  std::string text = "void plastic wall\n0\n0\n5 .5 .5 .5 0 0\n";
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-100, 100);
  for (int i = 0; i < kPolygons; ++i) {
    fmt::format_to(std::back_inserter(text), "\nwall polygon p.{}\n0\n0\n12\n", i);
    const double x = place(random), y = place(random), z = place(random);
    for (const auto& [dx, dy] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}})
      fmt::format_to(std::back_inserter(text), "{:18.12g} {:18.12g} {:18.12g}\n", x + dx, y + dy, z);
  }
  return text;
}

// A file with the text, which is removed at the end of the program.
struct TextFile {
  std::string text = millionPolygons();
  std::string path =
      fmt::format("{}/bench_parser_{}.rad", std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "/tmp", getpid());
  TextFile() { std::ofstream(path) << text; }
  ~TextFile() { std::remove(path.c_str()); }
};

const TextFile& scene() {
  static const TextFile file;
  return file;
}

void count(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * kPolygons);
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(scene().text.size()));
}

void readFile(benchmark::State& state) {
  const std::string names[] = {scene().path};
  for (auto _ : state) {
    const rad::Description d = rad::readScene(names);
    if (d.primitives.size() != kPolygons + 1) state.SkipWithError("primitives are missing");
    benchmark::DoNotOptimize(d.vertices.data());
  }
  count(state);
}

void readTransformed(benchmark::State& state) {
  const std::string names[] = {"!xform -rz 30 -t 1 2 3 " + scene().path};
  for (auto _ : state) {
    const rad::Description d = rad::readScene(names);
    benchmark::DoNotOptimize(d.vertices.data());
  }
  count(state);
}

void strtodTokens(benchmark::State& state) {
  for (auto _ : state) {
    std::ifstream file(scene().path);
    std::stringstream whole;
    whole << file.rdbuf();
    const std::string text = std::move(whole).str();
    std::vector<double> numbers;
    size_t words = 0;
    for (const char* p = text.c_str(); *p;) {
      p += std::strspn(p, " \t\r\n");
      char* end;
      const double value = std::strtod(p, &end);
      if (end != p) {
        numbers.push_back(value);
      } else {
        end += std::strcspn(p, " \t\r\n");
        ++words;
      }
      p = end;
    }
    benchmark::DoNotOptimize(numbers.data());
    benchmark::DoNotOptimize(words);
  }
  count(state);
}

void originalGetbbox(benchmark::State& state) {
  const std::string command = "getbbox -h " + scene().path + " > /dev/null";
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) state.SkipWithError("getbbox failed");
  count(state);
}

}  // namespace

int main(int argc, char** argv) {
  const auto bench = [](const char* name, void (*run)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  bench("readScene", readFile);
  bench("readScene, one xform", readTransformed);
  bench("strtod tokens", strtodTokens);
  if (std::system("command -v getbbox > /dev/null") == 0)
    bench("original getbbox", originalGetbbox);
  else
    fmt::print(stderr, "getbbox is not on PATH: the original is left out\n");
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
