// A falsecolor plan of the illuminance on a floor, a desk or a wall of a scene, and its average and
// uniformity. Without arguments it prints its options.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "area.h"
#include "base/version.h"
#include "drawing.h"
#include "isolines.h"
#include "layout.h"
#include "markup.h"
#include "rad_parser/open_file.h"
#include "rad_parser/printable.h"
#include "rad_parser/scene_file.h"
#include "rad_parser/text_source.h"
#include "rtrace.h"

namespace grid {
namespace {

constexpr const char* kUsage =
    R"(usage: rsphere-plan -s NAME [options] scene... [-- options of rtrace]

  -s NAME   the polygon to measure, or the modifier of polygons; repeat it for several in one plane
  -h H      height above the polygon, along its normal (0)
  -d D      largest spacing of the grid (EN 12464-1's: .2 * 5^log10(longer side), in metres)
  -m M      width of a band along the edges that is left out (0; EN 12464-1 allows .5 m along walls)
  -u        of these polygons, only those that face up: the tops of boxes
  -r        measure the back of the polygon
  -z        leave out points of 0 lx, which are inside of furniture
  -f F      maintenance factor, by which all illuminances are multiplied (1)
  -D E      daylight factors, in percent of this horizontal illuminance outdoors, which sky.rad states
  -o FILE   draw the plan, as SVG
  -l A,B,.. illuminances of the isolines (round numbers)
  -w        write the illuminances into the plan
  -c NAME   draw the outlines of these polygons, too; may be repeated
  -t TITLE  title of the plan
  -x FILE   write a table: x y z and illuminance of each point
  -p        print the sensors, as rtrace reads them, and stop
  -a        print all polygons, one a line, and stop: name, modifier, x y z of each corner; behind tabs
  -i FILE   read the illuminances from a file, in the order of -p, instead of running rtrace
  -q UNIT   of what -i reads, if it is no illuminance: -q % for shares of time; without -i, -q W/m2 for
            irradiance by luminaires whose files are radiant
  -version  of rsphere

Scene files are scene text or one octree. rtrace is run with)";

constexpr const char* kRadiant = "W/m2";  // the unit of irradiance

// Diffuse light between surfaces, interpolated, for an rtrace without -Sa.
const std::vector<std::string> kOfOthers{"-ab", "8",   "-aa",  ".1",  "-ad", "1024", "-as", "512", "-ar",
                                         "64",  "-lw", "1e-4", "-dj", "1",   "-dt",  "0",   "-st", "1"};

std::vector<std::string> defaults() {
  return isOtherRtrace() ? kOfOthers : std::vector<std::string>{"-Sa", ".01"};
}

struct Settings {
  std::vector<std::string> surfaces, context, files, rtrace = defaults();
  double height = 0, spacing = 0, margin = 0, maintenance = 1;
  double outdoors = 0;  // lx; 0: no daylight factors
  bool upOnly = false, reversed = false, skipDark = false, values = false, onlyPoints = false;
  bool allPolygons = false;
  std::string picture, title, table, readings, unit = "lx";
  std::vector<double> levels;
};

double number(const std::string& option, const std::string& word, double least) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end || !std::isfinite(value) || value < least)
    throw rad::Error(fmt::format("{} needs a number{}, not \"{}\"", option,
                                 std::isfinite(least) ? (least > 0 ? " above 0" : " of at least 0") : "",
                                 word));
  return value;
}

std::vector<double> levelsOf(const std::string& list) {
  std::vector<double> levels;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    levels.push_back(number("-l", list.substr(begin, end - begin), 0));
    if (levels.size() > 1 && levels.back() <= levels[levels.size() - 2])
      throw rad::Error("the numbers of -l must ascend");
    begin = end + 1;
  }
  return levels;
}

void warn(std::string_view text) { fmt::print(stderr, "rsphere-plan: warning - {}\n", text); }

// Options that are given, and their last arguments. They change nothing without others: these are refused.
using Given = std::map<std::string, std::string>;

void refuseUnused(const Given& given, const Settings& s) {
  const auto refuse = [&](bool unused, const std::vector<std::string>& options, const char* why) {
    for (const std::string& option : options)
      if (unused && given.count(option)) throw rad::Error(fmt::format("{} {}", option, why));
  };
  refuse(s.picture.empty(), {"-l", "-w", "-c", "-t"}, "is for the plan of -o");
  refuse(s.onlyPoints, {"-o", "-x", "-i", "-z", "-f", "-D", "-q"}, "excludes -p, which prints sensors alone");
  refuse(!s.readings.empty(), {"--"}, "and what follows is for rtrace, whose place -i takes");
}

Settings settingsOf(const std::vector<std::string>& words) {
  Settings s;
  Given given;
  size_t i = 0;
  const auto argument = [&]() -> const std::string& {
    if (i + 1 >= words.size()) throw rad::Error(fmt::format("{} needs an argument; see -help", words[i]));
    const std::string& option = words[i++];
    const auto before = given.find(option);
    if (before != given.end() && !before->second.empty() && before->second != words[i] && option != "-s" &&
        option != "-c")
      warn(fmt::format("{} is given twice; the last, {}, holds", option, words[i]));
    return given[option] = words[i];
  };
  for (; i < words.size(); ++i) {
    const std::string& word = words[i];
    given.emplace(word, "");
    if (word == "--") {
      s.rtrace.insert(s.rtrace.end(), words.begin() + static_cast<std::ptrdiff_t>(i) + 1, words.end());
      break;
    }
    if (word == "-s")
      s.surfaces.push_back(argument());
    else if (word == "-c")
      s.context.push_back(argument());
    else if (word == "-h")
      s.height = number(word, argument(), -HUGE_VAL);
    else if (word == "-d")
      s.spacing = number(word, argument(), 1e-9);
    else if (word == "-m")
      s.margin = number(word, argument(), 0);
    else if (word == "-f")
      s.maintenance = number(word, argument(), 1e-9);
    else if (word == "-D")
      s.outdoors = number(word, argument(), 1e-9);
    else if (word == "-l")
      s.levels = levelsOf(argument());
    else if (word == "-o")
      s.picture = argument();
    else if (word == "-t")
      s.title = argument();
    else if (word == "-x")
      s.table = argument();
    else if (word == "-i")
      s.readings = argument();
    else if (word == "-q")
      s.unit = argument();
    else if (word == "-u")
      s.upOnly = true;
    else if (word == "-r")
      s.reversed = true;
    else if (word == "-z")
      s.skipDark = true;
    else if (word == "-w")
      s.values = true;
    else if (word == "-p")
      s.onlyPoints = true;
    else if (word == "-a")
      s.allPolygons = true;
    else if (word.size() > 1 && word[0] == '-')
      throw rad::Error(fmt::format("unknown option \"{}\"; options of rtrace come behind --", word));
    else
      s.files.push_back(word);
  }
  if (s.surfaces.empty() && !s.allPolygons) throw rad::Error("no polygon is named; -s NAME names one");
  if (s.files.empty()) throw rad::Error("no scene file is named");
  refuseUnused(given, s);
  // rtrace, which reads the files again, would find a pipe empty.
  for (const std::string& file : s.files)
    if (std::filesystem::is_fifo(file))
      throw rad::Error(
          fmt::format("{}: is a pipe, and files are read twice: write it to a file first", file));
  if (s.outdoors > 0 && s.unit != "lx") throw rad::Error("-D and -q exclude each other");
  if (s.unit != "lx" && s.unit != kRadiant && s.readings.empty())
    throw rad::Error(fmt::format("-q is for what -i reads; without -i, {} is the only other unit", kRadiant));
  rsphere::requireSvgName("-o", s.picture, "the plan");
  // A forgotten argument makes the next word the file: -x sky.rad room.rad.
  if (s.table.ends_with(".rad") || s.table.ends_with(".oct") ||
      std::ranges::find(s.files, s.table) != s.files.end())
    throw rad::Error(
        fmt::format("-x \"{}\": the table would replace a scene; give it another name", s.table));
  rsphere::requireWritable(s.picture);
  rsphere::requireWritable(s.table);
  if (s.outdoors > 0) s.unit = "%";
  return s;
}

std::vector<double> readIlluminances(const std::string& path, size_t count) {
  const rad::OpenFile file(path);
  if (file.descriptor() < 0)
    throw rad::Error(fmt::format("cannot read \"{}\": {}", path, std::strerror(errno)), rad::Status::system);
  rad::DescriptionBuilder places;
  rad::TextSource text(file.descriptor(), places.addFile(path), places);
  text.skipByteOrderMark();
  std::vector<double> values;
  for (double value = 0; text.real(value);) values.push_back(value);
  if (const std::string_view word = text.lastWord(); !word.empty())
    throw places.error(
        text.place(),
        fmt::format("expected a number, got \"{}\"; blanks separate numbers, and decimals need a point",
                    rad::printable(word, 40)));
  if (values.size() != count)
    throw rad::Error(fmt::format("\"{}\" must have {} numbers, one for each point; it has {}", path, count,
                                 values.size()));
  return values;
}

std::string facing(const Plane& plane) {
  if (plane.horizontal()) return plane.normal.z > 0 ? "up" : "down";
  const V3d& n = plane.normal;
  return fmt::format("along the polygon's normal ({:.3g} {:.3g} {:.3g})", n.x, n.y, n.z);
}

std::string whereAbove(double height) {
  if (height == 0) return "on the polygon";
  return fmt::format("{:.4g} {} the polygon", std::abs(height), height > 0 ? "above" : "behind");
}

std::vector<std::string> remarksOf(const Settings& s, const Plane& plane, const Grid& grid, size_t dark,
                                   const Summary& summary) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("Grid: {} x {}, {} points, spacing {:.3g} x {:.3g}; sensors {}, facing {}",
                              grid.columns, grid.rows, grid.points.size(), grid.across.length(),
                              grid.upwards.length(), whereAbove(s.height), facing(plane)));
  if (dark > 0)
    lines.push_back(
        fmt::format("Left out: {} of 0 lx", dark == 1 ? "1 point" : fmt::format("{} points", dark)));
  if (s.unit != "lx") {
    lines.push_back(fmt::format("Mean {0} {3}, smallest {1} {3}, largest {2} {3}", luxText(summary.average),
                                luxText(summary.smallest), luxText(summary.largest), s.unit));
    return lines;
  }
  const std::string average =
      s.maintenance == 1
          ? "average illuminance (no maintenance factor)"
          : fmt::format("average maintained illuminance (maintenance factor {:.3g})", s.maintenance);
  lines.push_back(fmt::format("E_m = {} lx, {}", luxText(summary.average), average));
  lines.push_back(
      fmt::format("E_min = {} lx, E_max = {} lx", luxText(summary.smallest), luxText(summary.largest)));
  lines.push_back(fmt::format("U_o = E_min/E_m = {:.2f}, U_d = E_min/E_max = {:.2f}",
                              summary.overallUniformity(), summary.diversity()));
  return lines;
}

// The largest relative standard error of a lit point; empty: no errors are known.
std::string errorText(const std::vector<V3d>& sensors, const std::vector<double>& values,
                      const std::vector<double>& errors) {
  double largest = -1;
  V3d where(0, 0, 0);
  for (size_t i = 0; i < errors.size(); ++i) {
    if (!(values[i] > 0) || errors[i] / values[i] <= largest) continue;
    largest = errors[i] / values[i];
    where = sensors[i];
  }
  if (largest < 0) return "";
  return fmt::format("Standard error of a point: at most {:.2g}% (at {:.3g} {:.3g} {:.3g})", 100 * largest,
                     where.x, where.y, where.z);
}

// "Illuminance 0.8 above floor (lx)"
std::string titleOf(const Settings& s) {
  const std::string where =
      s.height == 0 ? "on" : fmt::format("{:.4g} {}", std::abs(s.height), s.height > 0 ? "above" : "behind");
  if (s.unit == kRadiant && s.readings.empty())
    return fmt::format("Irradiance {} {} ({})", where, fmt::join(s.surfaces, ", "), s.unit);
  if (s.unit != "lx")
    return fmt::format("{}{} {} ({})", s.outdoors > 0 ? "Daylight factor " : "", where,
                       fmt::join(s.surfaces, ", "), s.unit);
  return fmt::format("{} {} {} (lx)", s.maintenance == 1 ? "Illuminance" : "Maintained illuminance", where,
                     fmt::join(s.surfaces, ", "));
}

void printPolygons(const rad::Description& scene) {
  for (const PolygonCorners& polygon : allPolygons(scene)) {
    fmt::print("{}\t{}\t", polygon.name, polygon.modifier);
    for (const V3d& p : polygon.corners) fmt::print("{:.9g} {:.9g} {:.9g} ", p.x, p.y, p.z);
    fmt::print("\n");
  }
}

// Warnings about the scene, which are written when this object ends, also by an error.
struct SceneWarnings {
  ~SceneWarnings() {
    for (const std::string& text : texts) warn(text);
  }
  std::vector<std::string> texts;
};

void run(const Settings& s) {
  SceneWarnings warnings;
  const auto keep = [&](std::string_view text) { warnings.texts.emplace_back(text); };
  const rad::Description scene = rad::readScene(s.files, {.warn = keep});
  if (s.allPolygons) return printPolygons(scene);
  const Area area = findArea(scene, s.surfaces, s.reversed, s.upOnly);
  const Plane& plane = area.plane();
  Grid grid = layGrid(area, s.spacing, s.margin);
  std::vector<V3d> sensors;
  for (const V2d& p : grid.points) sensors.push_back(plane.at(p, s.height));
  if (s.onlyPoints) {
    for (const V3d& p : sensors)
      fmt::print("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z, plane.normal.x, plane.normal.y,
                 plane.normal.z);
    return;
  }
  if (plane.normal.z < 0 && plane.horizontal() && !s.reversed)
    warn(fmt::format("the front of \"{}\" faces down, and so do the sensors; -r measures its back",
                     s.surfaces[0]));

  if (s.readings.empty() && !isOtherRtrace())
    warnings.texts.clear();  // rsphere reads the scene and warns, too
  auto [values, errors] =
      s.readings.empty() ? traceIlluminances(sensors, plane.normal, s.rtrace, s.files, s.unit == kRadiant)
                         : Illuminances{readIlluminances(s.readings, sensors.size()), {}};
  const std::string largestError = errorText(sensors, values, errors);
  for (double& value : values) value *= s.maintenance * (s.outdoors > 0 ? 100 / s.outdoors : 1);
  std::vector<bool> lit;
  for (const double value : values) lit.push_back(value > 0);
  auto dark = static_cast<size_t>(std::count(lit.begin(), lit.end(), false));
  if (s.skipDark && dark > 0) {
    if (dark == lit.size()) throw rad::Error("all points have 0 lx; is there a light source in the scene?");
    grid = withOnly(grid, lit);
    size_t kept = 0;
    for (size_t i = 0; i < values.size(); ++i)
      if (lit[i]) {
        values[kept] = values[i];
        sensors[kept++] = sensors[i];
      }
    values.resize(kept);
    sensors.resize(kept);
  } else if (dark > 0 && (s.unit == "lx" || s.outdoors > 0)) {
    warn(dark == lit.size()
             ? fmt::format("0 lx at all {} points; is there a light source, and is -h in the units of the "
                           "scene?",
                           dark)
             : fmt::format("0 lx at {} of {} points; if these are inside of furniture, -z leaves them out",
                           dark, lit.size()));
  }
  if (!s.skipDark) dark = 0;

  const Summary summary(values);
  Drawing drawing{s.title.empty() ? titleOf(s) : s.title,
                  remarksOf(s, plane, grid, dark, summary),
                  s.levels.empty() ? roundLevels(values) : s.levels,
                  findOutlines(scene, s.context, plane),
                  s.values,
                  s.unit};
  for (const std::string& line : drawing.remarks) fmt::print("{}\n", line);
  if (!largestError.empty()) fmt::print("{}\n", largestError);
  if (!s.table.empty()) {
    std::string table;
    for (size_t i = 0; i < sensors.size(); ++i)
      table += fmt::format("{:.6g}\t{:.6g}\t{:.6g}\t{:.5g}\n", sensors[i].x, sensors[i].y, sensors[i].z,
                           values[i]);
    rsphere::writeTextFile(s.table, table);
  }
  if (!s.picture.empty()) rsphere::writeTextFile(s.picture, planAsSvg(area, grid, values, drawing));
}

// Throws std::system_error if the standard output is closed: the next file opened would take its place.
void requireOutput() {
  if (fcntl(STDOUT_FILENO, F_GETFD) < 0) throw std::system_error(errno, std::generic_category());
}

// As fmt::print() does for what does not fit into the stream's buffer.
void flushOutput() {
  if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category());
}

}  // namespace
}  // namespace grid

int main(int argc, char** argv) {
  const std::vector<std::string> words{argv + 1, argv + argc};
  try {
    grid::requireOutput();
    if (words.empty() || words[0] == "-help" || words[0] == "--help")
      fmt::print("{}\n{}, and then those behind --.\n", grid::kUsage, fmt::join(grid::defaults(), " "));
    else if (words[0] == "-version" || words[0] == "--version")
      fmt::print("rsphere {}\n", rsphere::kVersion);
    else
      grid::run(grid::settingsOf(words));
    grid::flushOutput();
  } catch (const rad::Error& error) {
    fmt::print(stderr, "rsphere-plan: fatal - {}\n", error.what());
    return static_cast<int>(error.status());
  } catch (const std::system_error& error) {
    fmt::print(stderr, "rsphere-plan: system - write error: {}\n", error.code().message());
    return static_cast<int>(rad::Status::system);
  }
}
