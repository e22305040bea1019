// Rays through rsphere and through the rtrace of the machine, in turn: CPU time of both, the ratio, and how
// far their answers are apart.
//
//   bench_rtrace [-r RUNS] [NAME]...              the scenes of this folder and of examples, or those of a
//   name bench_rtrace [-r RUNS] SCENE RAYS [OPTION]... an octree, rays as rtrace reads them, options for both
//
// $RTRACE, or else the first rtrace on PATH that is not ours, and the oconv beside it. Where there is none,
// ours alone is timed. One thread each; start-up counts. A ratio is that of medians, with the least and the
// greatest of pairs.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::string scene;       // a shell command that writes it as text
  double low[3], high[3];  // rays begin between, in every direction
  std::vector<std::string> options;
};

const std::vector<std::string> kDirect = {"-ab", "0"};
const std::vector<std::string> kIndirect = {"-ab", "3", "-ad", "1", "-as", "0", "-aa", "0"};

std::vector<Case> cases() {
  const std::string functions = "cat " RSPHERE_SCENES "/functions.rad";
  const std::string openplan = RSPHERE_EXAMPLES "/openplan/generate 50";
  const auto room = [](std::string name, std::string scene, double x, double y,
                       std::vector<std::string> options) {
    return Case{std::move(name), std::move(scene), {.3, .3, .3}, {x, y, 2.7}, std::move(options)};
  };
  return {room("functions", functions, 5.7, 3.7, {"-ab", "0", "-av", "1", "1", "1"}),
          room("functions", functions, 5.7, 3.7, kIndirect), room("openplan", openplan, 19.7, 13.7, kDirect),
          room("openplan", openplan, 19.7, 13.7, kIndirect)};
}

[[noreturn]] void fail(const std::string& why) {
  std::cerr << "bench_rtrace: " << why << '\n';
  std::exit(1);
}

fs::path ourFolder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

// Empty where there is none.
std::string findRtrace() {
  if (const char* named = std::getenv("RTRACE")) return named;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder) / "rtrace";
    std::error_code none;
    if (access(candidate.c_str(), X_OK) == 0 && fs::canonical(candidate, none).filename() != "rsphere")
      return candidate;
  }
  return "";
}

// CPU seconds of the program, user and system.
double run(const std::vector<std::string>& words, const std::string& input, const std::string& output) {
  const pid_t child = fork();
  if (child == 0) {
    const int in = open(input.c_str(), O_RDONLY),
              out = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (in < 0 || out < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0) _exit(127);
    std::vector<char*> arguments;
    for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) < 0 || status != 0) fail(words[0] + " failed");
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::vector<double> numbersOf(const std::string& file) {
  std::ifstream in(file);
  return {std::istream_iterator<double>(in), std::istream_iterator<double>()};
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

struct Programs {
  std::string ours = ourFolder() / "rsphere";
  std::string theirs = findRtrace();
  size_t runs = 5;
};

void compare(const Programs& programs, const std::string& name, const std::string& scene,
             const std::string& rays, const std::vector<std::string>& options, const std::string& folder) {
  const auto command = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-h", "-n", "1"});
    words.insert(words.end(), options.begin(), options.end());
    words.push_back(scene);
    return words;
  };
  std::vector<double> ours, theirs, ratios;
  for (size_t i = 0; i < programs.runs; ++i) {
    ours.push_back(run(command({programs.ours, "-S-"}), rays, folder + "/ours"));
    if (programs.theirs.empty()) continue;
    theirs.push_back(run(command({programs.theirs}), rays, folder + "/theirs"));
    ratios.push_back(theirs.back() / ours.back());
  }
  std::string words;
  for (const std::string& o : options) words += o + ' ';
  fmt::print("{:10} {:32} ours {:6.3f} s", name, words, median(ours));
  if (!theirs.empty()) {
    const std::vector<double> a = numbersOf(folder + "/ours"), b = numbersOf(folder + "/theirs");
    if (a.size() != b.size() || a.empty()) fail("answers differ in number");
    double sumA = 0, sumB = 0;
    size_t near = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      sumA += a[i];
      sumB += b[i];
      near += std::abs(a[i] - b[i]) <= .01 * std::max(std::abs(a[i]), std::abs(b[i]));
    }
    fmt::print(
        "  rtrace {:6.3f} s  {:4.1f} times ({:.1f} to {:.1f});  means differ by {:+.2f}%, {:.1f}% of numbers "
        "by less than 1%",
        median(theirs), median(theirs) / median(ours), *std::min_element(ratios.begin(), ratios.end()),
        *std::max_element(ratios.begin(), ratios.end()), 100 * (sumA / sumB - 1),
        100. * static_cast<double>(near) / static_cast<double>(a.size()));
  }
  fmt::print("\n");
}

void writeRays(const Case& c, const std::string& file) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit;
  std::ofstream out(file);
  for (int i = 0; i < 200000; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      out << c.low[axis] + unit(random) * (c.high[axis] - c.low[axis]) << ' ';
    const double z = 2 * unit(random) - 1, angle = 2 * M_PI * unit(random), s = std::sqrt(1 - z * z);
    out << s * std::cos(angle) << ' ' << s * std::sin(angle) << ' ' << z << '\n';
  }
  if (!out) fail("cannot write " + file);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  Programs programs;
  if (words.size() >= 2 && words[0] == "-r") {
    programs.runs = std::max(1ul, std::stoul(words[1]));
    words.erase(words.begin(), words.begin() + 2);
  }
  if (programs.theirs.empty()) std::cerr << "bench_rtrace: no rtrace on PATH, nor $RTRACE: ours alone\n";
  std::string folder = fs::temp_directory_path() / "bench_rtraceXXXXXX";
  if (!mkdtemp(folder.data())) fail("cannot make a folder for what is written");
  if (words.size() >= 2 && fs::exists(words[0])) {
    compare(programs, words[0], words[0], words[1], {words.begin() + 2, words.end()}, folder);
  } else {
    // Function files are found beside their scene.
    const char* raypath = std::getenv("RAYPATH");
    setenv("RAYPATH", (std::string(RSPHERE_SCENES) + (raypath ? ":" + std::string(raypath) : "")).c_str(), 1);
    for (const Case& c : cases()) {
      if (!words.empty() && std::find(words.begin(), words.end(), c.name) == words.end()) continue;
      writeRays(c, folder + "/rays");
      std::string scene = folder + "/scene.rad";
      if (std::system(fmt::format("{} > '{}'", c.scene, scene).c_str()) != 0) fail("cannot make " + c.name);
      if (!programs.theirs.empty()) {
        const fs::path oconv = fs::path(programs.theirs).parent_path() / "oconv";
        run({oconv.has_parent_path() ? oconv.string() : "oconv", "-f", scene}, "/dev/null",
            folder + "/scene.oct");
        scene = folder + "/scene.oct";
      }
      compare(programs, c.name, scene, folder + "/rays", c.options, folder);
    }
  }
  fs::remove_all(folder);
}
