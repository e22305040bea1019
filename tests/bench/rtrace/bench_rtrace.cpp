// Rays through rsphere and through the rtrace of the machine, in turn: CPU time of both, the ratio, how far
// each is from a converged answer that is kept in references, memory, and the time to the first ray.
//
//   bench_rtrace [-r RUNS] [-w] [NAME]...      the scenes of this folder and of examples, or those of a name
//   bench_rtrace [-r RUNS] [-w] [-e REFERENCE] SCENE RAYS [OPTION]...
//                                              an octree, rays as rtrace reads them, options for both
//
// -w computes references and writes them instead. $RTRACE, or else the first rtrace on PATH that is not ours,
// and the oconv beside it. Where there is none, ours alone is timed. One thread each; start-up counts. A
// ratio is that of medians, with the least and the greatest of pairs.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Scene {
  std::string name;
  std::string text;        // a shell command that writes it
  double low[3], high[3];  // rays begin between, in every direction
};

// What every scene is timed with, and what its references are called by.
struct Setting {
  const char* name;
  Words options;
};
const Setting kSettings[] = {{"direct", {"-ab", "0"}},
                             {"indirect", {"-ab", "3", "-ad", "1", "-as", "0", "-aa", "0"}}};

std::vector<Scene> scenes() {
  const std::string folder = RSPHERE_SCENES "/", openplan = RSPHERE_EXAMPLES "/openplan/generate";
  const auto room = [](std::string name, std::string text, double x, double y) {
    return Scene{std::move(name), std::move(text), {.3, .3, .3}, {x, y, 2.7}};
  };
  return {room("functions", "cat " + folder + "functions.rad", 5.7, 3.7),
          room("openplan", openplan + " 50", 19.7, 13.7),
          room("goal", folder + "goal " + openplan, 19.7, 13.7),
          room("vases14k", folder + "vases " + openplan + " 14000", 19.7, 13.7),
          room("vases100k", folder + "vases " + openplan + " 100000", 19.7, 13.7),
          room("sunlit", "cat " + folder + "sunlit.rad", 5.4, 3.7),
          room("lamps", "cat " + folder + "lamps.rad", 5.7, 3.7)};
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

struct Cost {
  double seconds = 0;    // CPU time, user and system
  double megabytes = 0;  // the most that was in memory
};

Cost run(const Words& words, const std::string& input, const std::string& output) {
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
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024};
}

std::vector<double> numbersOf(const std::string& file) {
  std::ifstream in(file);
  while (in.peek() == '#') in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  return {std::istream_iterator<double>(in), std::istream_iterator<double>()};
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

double medianSeconds(const std::vector<Cost>& costs) {
  std::vector<double> seconds;
  for (const Cost& c : costs) seconds.push_back(c.seconds);
  return median(seconds);
}

// RADIANCE's brightness of each three numbers, red, green and blue.
std::vector<double> brightnessOf(const std::vector<double>& rgb) {
  std::vector<double> result;
  for (size_t i = 0; i + 2 < rgb.size(); i += 3)
    result.push_back(.265 * rgb[i] + .670 * rgb[i + 1] + .065 * rgb[i + 2]);
  return result;
}

struct Programs {
  std::string ours = ourFolder() / "rsphere";
  std::string theirs = findRtrace();
  std::string oconv = (fs::path(theirs).parent_path() / "oconv").string();
  size_t runs = 5;

  Words ourCommand(const Words& options, const std::string& scene) const {
    return command({ours, "-S-"}, options, scene);
  }
  Words theirCommand(const Words& options, const std::string& scene) const {
    return command({theirs}, options, scene);
  }

 private:
  static Words command(Words words, const Words& options, const std::string& scene) {
    words.insert(words.end(), {"-h", "-n", "1"});
    words.insert(words.end(), options.begin(), options.end());
    words.push_back(scene);
    return words;
  }
};

// What one comparison is about.
struct Job {
  std::string name;
  std::string octree, text;  // text: empty where there is only the octree
  std::string rays;
  Words options;
  std::string reference;  // a file; empty, or not there: none
};

constexpr size_t kReferenceRays = 500;

void copyLines(const std::string& from, const std::string& to, size_t lines) {
  std::ifstream in(from);
  std::ofstream out(to);
  std::string line;
  for (size_t i = 0; i < lines && std::getline(in, line); ++i) out << line << '\n';
}

// The mean brightness of 64 runs of our own with every source split finely and tested, 64 paths a ray: 4096
// paths, and as many samples of each highlight and of each source's parts. The file's head says so.
void writeReference(const Programs& programs, const Job& job, const std::string& folder) {
  constexpr int kRuns = 64;
  const std::string rays = folder + "/first";
  copyLines(job.rays, rays, kReferenceRays);
  Words options = job.options;
  const Words fine = {"-dt", "0",   "-dc",  "1",   "-dj", "1",   "-ds",
                      ".05", "-lw", "1e-5", "-ad", "64",  "-ss", "64"};
  options.insert(options.end(), fine.begin(), fine.end());
  std::vector<double> sum;
  for (int i = 0; i < kRuns; ++i) {
    Words seeded = options;
    seeded.insert(seeded.end(), {"-Sr", std::to_string(i + 1)});
    run(programs.ourCommand(seeded, job.octree), rays, folder + "/ours");
    const std::vector<double> values = brightnessOf(numbersOf(folder + "/ours"));
    sum.resize(values.size());
    for (size_t k = 0; k < values.size(); ++k) sum[k] += values[k] / kRuns;
  }
  std::ofstream out(job.reference);
  out << fmt::format("# Brightness along the first {} rays, the mean of -Sr 1 to {}: rsphere -S- {}\n",
                     sum.size(), kRuns, fmt::join(options, " "));
  for (const double v : sum) out << fmt::format("{:.4g}\n", v);
  if (!out) fail("cannot write " + job.reference);
}

// "rms error and error of the mean", in percent of the reference's mean; of rays as far as there is a
// reference.
std::string errorOf(const std::string& answers, const std::vector<double>& reference) {
  const std::vector<double> values = brightnessOf(numbersOf(answers));
  if (values.size() < reference.size()) fail("fewer answers than the reference has");
  double squares = 0, difference = 0, sum = 0;
  for (size_t i = 0; i < reference.size(); ++i) {
    squares += std::pow(values[i] - reference[i], 2);
    difference += values[i] - reference[i];
    sum += reference[i];
  }
  const double count = static_cast<double>(reference.size()), mean = sum / count;
  return fmt::format("{:.2f}% {:+.2f}%", 100 * std::sqrt(squares / count) / mean,
                     100 * difference / count / mean);
}

// Milliseconds of CPU time until one ray is answered: the octree's, and the text's with all that has to be
// done to it.
void printFirstRay(const Programs& programs, const Job& job, const std::string& folder) {
  const std::string ray = folder + "/first", answer = folder + "/answer";
  copyLines(job.rays, ray, 1);
  const auto measure = [&](const auto& once) {
    std::vector<double> seconds;
    for (size_t i = 0; i < std::max<size_t>(programs.runs, 9); ++i) seconds.push_back(once());
    return 1e3 * median(seconds);
  };
  const auto print = [&](const char* what, double ours, double theirs) {
    fmt::print("{:13} first ray, {}: ours {:.1f} ms, rtrace {:.1f} ms, {:.1f} times\n", "", what, ours,
               theirs, theirs / ours);
  };
  const auto ours = [&](const std::string& scene) {
    return measure([&] { return run(programs.ourCommand(job.options, scene), ray, answer).seconds; });
  };
  const auto theirs = [&] {
    return run(programs.theirCommand(job.options, job.octree), ray, answer).seconds;
  };
  if (programs.theirs.empty()) return;
  print("octree", ours(job.octree), measure(theirs));
  if (!job.text.empty())
    print("text", ours(job.text), measure([&] {
            return run({programs.oconv, job.text}, "/dev/null", folder + "/again.oct").seconds + theirs();
          }));
}

void compare(const Programs& programs, const Job& job, const std::string& folder) {
  const std::string ourAnswers = folder + "/ours", theirAnswers = folder + "/theirs";
  std::vector<Cost> ours, theirs;
  std::vector<double> ratios;
  for (size_t i = 0; i < programs.runs; ++i) {
    ours.push_back(run(programs.ourCommand(job.options, job.octree), job.rays, ourAnswers));
    if (programs.theirs.empty()) continue;
    theirs.push_back(run(programs.theirCommand(job.options, job.octree), job.rays, theirAnswers));
    ratios.push_back(theirs.back().seconds / ours.back().seconds);
  }
  const std::vector<double> reference = numbersOf(job.reference);
  fmt::print("{:10} {}\n{:13} ours {:.3f} s", job.name, fmt::join(job.options, " "), "", medianSeconds(ours));
  if (!theirs.empty())
    fmt::print(", rtrace {:.3f} s: {:.1f} times ({:.1f} to {:.1f})", medianSeconds(theirs),
               medianSeconds(theirs) / medianSeconds(ours), *std::min_element(ratios.begin(), ratios.end()),
               *std::max_element(ratios.begin(), ratios.end()));
  fmt::print("\n");
  if (!reference.empty()) {
    fmt::print("{:13} error, rms and of the mean: ours {}", "", errorOf(ourAnswers, reference));
    if (!theirs.empty()) fmt::print(", rtrace {}", errorOf(theirAnswers, reference));
    fmt::print("\n");
  }
  if (theirs.empty()) return;
  const std::vector<double> a = numbersOf(ourAnswers), b = numbersOf(theirAnswers);
  if (a.size() != b.size() || a.empty()) fail("answers differ in number");
  double sumA = 0, sumB = 0;
  size_t near = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sumA += a[i];
    sumB += b[i];
    near += std::abs(a[i] - b[i]) <= .01 * std::max(std::abs(a[i]), std::abs(b[i]));
  }
  fmt::print("{:13} means differ by {:+.2f}%, {:.1f}% of numbers by less than 1%\n", "",
             100 * (sumA / sumB - 1), 100. * static_cast<double>(near) / static_cast<double>(a.size()));
  fmt::print("{:13} memory: ours {:.1f} MB, rtrace {:.1f} MB\n", "", ours[0].megabytes, theirs[0].megabytes);
}

void writeRays(const Scene& scene, const std::string& file) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit;
  std::ofstream out(file);
  for (int i = 0; i < 200000; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      out << scene.low[axis] + unit(random) * (scene.high[axis] - scene.low[axis]) << ' ';
    const double z = 2 * unit(random) - 1, angle = 2 * M_PI * unit(random), s = std::sqrt(1 - z * z);
    out << s * std::cos(angle) << ' ' << s * std::sin(angle) << ' ' << z << '\n';
  }
  if (!out) fail("cannot write " + file);
}

void work(const Programs& programs, const Job& job, bool writing, bool first, const std::string& folder) {
  if (writing) return writeReference(programs, job, folder);
  compare(programs, job, folder);
  if (first) printFirstRay(programs, job, folder);
  std::cout.flush();
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Words words(argv + 1, argv + argc);
  Programs programs;
  bool writing = false;
  std::string reference;
  const auto take = [&] {
    if (words.empty()) fail("an option without its value");
    const std::string word = words.front();
    words.erase(words.begin());
    return word;
  };
  while (!words.empty() && words[0].size() == 2 && words[0][0] == '-') {
    const char option = take()[1];
    if (option == 'w')
      writing = true;
    else if (option == 'r')
      programs.runs = std::max(1ul, std::stoul(take()));
    else if (option == 'e')
      reference = take();
    else
      fail(fmt::format("-{}: -r, -w and -e there are", option));
  }
  if (programs.theirs.empty()) std::cerr << "bench_rtrace: no rtrace on PATH, nor $RTRACE: ours alone\n";
  std::string folder = fs::temp_directory_path() / "bench_rtraceXXXXXX";
  if (!mkdtemp(folder.data())) fail("cannot make a folder for what is written");
  if (words.size() >= 2 && fs::exists(words[0])) {
    const Job job{words[0], words[0], "", words[1], {words.begin() + 2, words.end()}, reference};
    work(programs, job, writing, true, folder);
  } else {
    // Function files are found beside their scene.
    const char* raypath = std::getenv("RAYPATH");
    setenv("RAYPATH", (std::string(RSPHERE_SCENES) + (raypath ? ":" + std::string(raypath) : "")).c_str(), 1);
    for (const Scene& scene : scenes()) {
      if (!words.empty() && std::find(words.begin(), words.end(), scene.name) == words.end()) continue;
      Job job{scene.name, "", folder + "/scene.rad", folder + "/rays", {}, ""};
      writeRays(scene, job.rays);
      if (std::system(fmt::format("{} > '{}'", scene.text, job.text).c_str()) != 0)
        fail("cannot make " + scene.name);
      job.octree = job.text;
      if (!programs.theirs.empty()) {
        job.octree = folder + "/scene.oct";
        run({programs.oconv, "-f", job.text}, "/dev/null", job.octree);
      }
      for (const Setting& setting : kSettings) {
        job.options = setting.options;
        job.reference = fmt::format("{}/{}-{}.txt", RSPHERE_REFERENCES, scene.name, setting.name);
        work(programs, job, writing, &setting == kSettings, folder);
      }
    }
  }
  fs::remove_all(folder);
}
