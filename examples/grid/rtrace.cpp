#include "rtrace.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "base/color.h"
#include "rad_parser/error.h"

namespace grid {
namespace {

constexpr double kLumensPerWatt = 179;  // RADIANCE's, of white light

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

rad::Error systemError(const std::string& what) {
  return rad::Error(fmt::format("{}: {}", what, std::strerror(errno)), rad::Status::system);
}

// rsphere, which is called by the name of this program below, or another rtrace.
std::string program() {
  if (isOtherRtrace()) return std::getenv("RTRACE");
  std::error_code none;
  const auto beside = std::filesystem::read_symlink("/proc/self/exe", none).parent_path() / "rsphere";
  return std::filesystem::exists(beside, none) ? beside.string() : "rtrace";
}

}  // namespace

bool isOtherRtrace() {
  const char* const named = std::getenv("RTRACE");
  return named && *named;
}

Illuminances traceIlluminances(std::span<const Imath::V3d> points, const Imath::V3d& normal,
                               const std::vector<std::string>& options, const std::vector<std::string>& files,
                               bool radiant) {
  const File sensors(std::tmpfile(), std::fclose);
  if (!sensors) throw systemError("cannot make a temporary file");
  for (const Imath::V3d& p : points)
    fmt::print(sensors.get(), "{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z, normal.x,
               normal.y, normal.z);
  std::rewind(sensors.get());  // it also writes what is left in the buffer

  // The user's options come before those that the answer relies on.
  const std::string file = program();
  const bool own = !isOtherRtrace();
  std::vector<std::string> words{own ? "rsphere-plan" : file};  // the name that its messages begin with
  if (own) words.emplace_back("-S-");
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), {"-h-", "-I+", "-fa"});
  const bool inColors = radiant || !own;  // only luminance and colors have standard errors
  if (inColors)
    words.insert(words.end(), {"-ov"});
  else
    words.insert(words.end(), {"-pY", "-ove"});
  words.insert(words.end(), files.begin(), files.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int pipe[2];
  if (::pipe(pipe)) throw systemError("cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) throw systemError("cannot start rtrace");
  if (child == 0) {
    dup2(fileno(sensors.get()), 0);
    dup2(pipe[1], 1);
    close(pipe[0]);
    close(pipe[1]);
    execvp(file.c_str(), arguments.data());
    _exit(127);
  }
  close(pipe[1]);
  Illuminances found;
  {
    const File answers(fdopen(pipe[0], "r"), std::fclose);
    rsphere::Color c;
    if (inColors)
      while (answers && std::fscanf(answers.get(), "%lf %lf %lf", &c.x, &c.y, &c.z) == 3)
        found.values.push_back(radiant ? (c.x + c.y + c.z) / 3 : kLumensPerWatt * rsphere::brightness(c));
    else
      while (answers && std::fscanf(answers.get(), "%lf %lf", &c.x, &c.y) == 2) {
        found.values.push_back(c.x);
        found.errors.push_back(c.y);
      }
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    throw rad::Error(fmt::format("cannot run \"{}\"; $RTRACE can name another rtrace", file),
                     rad::Status::system);
  if (own && WIFEXITED(status) && WEXITSTATUS(status) != 0) std::exit(WEXITSTATUS(status));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw rad::Error(fmt::format("\"{}\" failed; its message is above", file));
  if (found.values.size() != points.size())
    throw rad::Error(
        fmt::format("\"{}\" answered {} of {} points", file, found.values.size(), points.size()));
  return found;
}

}  // namespace grid
