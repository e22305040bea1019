#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <numbers>

#include "answer/answer_points.h"
#include "answer/answer_rays.h"
#include "answer/answer_writer.h"
#include "answer/load_scene.h"
#include "cli/program.h"
#include "companions/compare/compare_options.h"
#include "companions/compare/compare_page.h"
#include "companions/compare/comparison.h"
#include "companions/compare/original.h"
#include "companions/compare/report.h"
#include "companions/measure/records_file.h"
#include "companions/measure/work.h"
#include "companions/report/markup.h"
#include "companions/report/page.h"
#include "rad_parser/printable.h"
#include "rays/ray_report.h"
#include "records/record_writer.h"
#include "sphere/directions.h"

namespace rsphere {
namespace {

// The seed of a repeat. The first repeat uses the seed that rsphere itself would use.
uint64_t seedOfRepeat(uint64_t seed, size_t repeat) { return repeat == 0 ? seed : mixBits(seed + repeat); }

// Removes rays whose direction is zero: they make rtrace flush its output, and have no answer to compare.
std::vector<double> withoutBogus(const std::vector<double>& rays) {
  std::vector<double> kept;
  for (size_t i = 0; i < rays.size(); i += 6)
    if (V3d(rays[i + 3], rays[i + 4], rays[i + 5]).length2() != 0)
      kept.insert(kept.end(), rays.begin() + static_cast<ptrdiff_t>(i),
                  rays.begin() + static_cast<ptrdiff_t>(i) + 6);
  return kept;
}

Answers answerRays(const Transport& transport, const CompareOptions& options, std::span<const double> rays) {
  Answers answers{rays.size() / 6, static_cast<size_t>(options.repeats), {}, options.ray.sampling};
  answers.values.resize(answers.records * answers.repeats);
  std::vector<PathTracer> tracers = rayTracers(transport, options);
  forEachIndex(answers.records, options.threads, nullptr, [&](size_t i, unsigned worker) {
    const std::span<const double> numbers = rays.subspan(6 * i, 6);
    const InputRay in = inputRay(numbers.data(), options.irradiance, transport.prepared().scene().samePlace);
    const double farthest = options.limitDistance ? in.length : 0;
    for (size_t r = 0; r < answers.repeats; ++r)
      answers.values[r * answers.records + i] =
          tracers[worker]
              .trace(in.origin, in.direction, farthest, seedOfRepeat(seedOfRay(numbers, i, options), r))
              .value.color;
  });
  return answers;
}

Answers answerPoints(const Transport& transport, const CompareOptions& options,
                     std::span<const double> points) {
  Answers answers{points.size() / 3, static_cast<size_t>(options.repeats), {}, options.ray.sampling};
  answers.values.resize(answers.records * answers.repeats);
  for (size_t r = 0; r < answers.repeats; ++r) {
    AnswerOptions rotated = options;
    rotated.sphere.rotation += r;
    PointWorkers workers(transport, rotated, false);
    forEachIndex(answers.records, options.threads, nullptr, [&](size_t i, unsigned worker) {
      const V3d point(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      answers.values[r * answers.records + i] = workers.answer(point, worker).mean.color;
    });
  }
  return answers;
}

// The colors in the original's output, with three numbers or one for each band.
std::vector<Color> colorsOf(std::span<const double> numbers, const SpectralSampling* sampling) {
  std::vector<Color> colors;
  for (; !numbers.empty(); numbers = numbers.subspan(sampling ? sampling->count() : 3)) {
    if (!sampling) {
      colors.emplace_back(numbers[0], numbers[1], numbers[2]);
      continue;
    }
    Bands bands(*sampling);
    std::copy_n(numbers.begin(), sampling->count(), bands.values().begin());
    colors.emplace_back(std::move(bands));
  }
  return colors;
}

std::vector<Color> originalColors(Original& original, std::span<const double> rays,
                                  const SpectralSampling* sampling) {
  return colorsOf(original.answers(rays, "v", sampling ? sampling->count() : 3), sampling);
}

// Runs the original once for all repeats: within a run, equal records get different random numbers.
Answers originalRays(Original& original, const CompareOptions& options, std::span<const double> rays) {
  const auto repeats = static_cast<size_t>(options.repeats);
  std::vector<double> all;
  for (size_t r = 0; r < repeats; ++r) all.insert(all.end(), rays.begin(), rays.end());
  const SpectralSampling* const sampling = options.ray.sampling;
  return {rays.size() / 6, repeats, originalColors(original, all, sampling), sampling};
}

// The mean irradiance of planes of all orientations is F/4, which is pi times the mean radiance F/4pi.
Answers originalPoints(Original& original, const CompareOptions& options, std::span<const double> points) {
  const auto repeats = static_cast<size_t>(options.repeats),
             count = static_cast<size_t>(options.orientations);
  std::vector<double> rays;
  for (size_t r = 0; r < repeats; ++r) {
    const auto facing = rotatedDirections(baseDirections(count), options.sphere.rotation + r + 1);
    for (size_t i = 0; i < points.size(); i += 3)
      for (const V3d& d : facing)
        rays.insert(rays.end(), {points[i], points[i + 1], points[i + 2], d.x, d.y, d.z});
  }
  Answers answers{points.size() / 3, repeats, {}, options.ray.sampling};
  const std::vector<Color> irradiances = originalColors(original, rays, answers.sampling);
  for (size_t i = 0; i < irradiances.size(); i += count) {
    Color sum(0, 0, 0);
    for (size_t k = i; k < i + count; ++k) sum += irradiances[k];
    answers.values.push_back(sum / (std::numbers::pi * static_cast<double>(count)));
  }
  return answers;
}

// The original's options for the irradiance of planes. Gathering at the plane itself is a bounce in addition
// to those of -ab. Each plane needs only a few rays, because there are many planes.
std::vector<std::string> pointOptions(const Options& options, std::span<const UsedOption> used) {
  std::vector<std::string> words = originalOptions(options, used);
  const std::vector<std::string> more{
      "-I+", "-ab", std::to_string(options.ray.ambientBounces + 1), "-ad", "16", "-as", "0"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void refuseWhatPointsHave(const CompareOptions& options) {
  if (!options.goals.empty() || options.sphere.basicRadiance)
    throw rad::Error("-Sg and -Sb: the original does not compute importance");
  if (options.sphere.glare.wanted) throw rad::Error("-Su: rtrace does not compute glare");
  if (!options.ray.sourcesVisible)
    throw rad::Error("-dv-: the original's irradiance includes the light of sources; compare rays");
}

std::string worstText(const CompareOptions& options, const Comparison& comparison, const Answers& ours,
                      const Answers& original, std::span<const double> numbers, const Transport& transport,
                      Original& program) {
  const auto per = static_cast<size_t>(options.numbersPerRecord());
  const auto count = std::min(static_cast<size_t>(options.worst), comparison.worst.size());
  if (count == 0) return "";
  const bool hits = !options.sphereMode && options.irradiance != IrradianceAt::point;
  std::vector<double> rays;
  for (size_t k = 0; k < count; ++k) {
    const auto record = numbers.subspan(per * comparison.worst[k], per);
    rays.insert(rays.end(), record.begin(), record.end());
  }
  const auto names = hits ? program.surfaces(rays) : std::vector<std::string>(count);
  PathTracer tracer = transport.pathTracer();
  std::string text = "Worst records (brightness, means of the repeats)\n";
  for (size_t k = 0; k < count; ++k) {
    const size_t i = comparison.worst[k];
    text += fmt::format("{:>8}: {:.4e}, original {:.4e}, {:+.2f}% +- {:.2f}%  at", i + 1,
                        brightnessOf(ours, i), brightnessOf(original, i),
                        100 * comparison.records[i].difference, 100 * comparison.records[i].error);
    for (size_t c = 0; c < per; ++c) text += fmt::format(" {:g}", rays[per * k + c]);
    if (hits) {
      const InputRay in =
          inputRay(&rays[per * k], options.irradiance, transport.prepared().scene().samePlace);
      const TracedRay hit = tracer.cast(in.origin, in.direction, options.limitDistance ? in.length : 0);
      const std::string name = answerOf(transport.prepared().scene(), hit).surface.text();
      text += name == names[k] ? fmt::format("  hits {}", names[k])
                               : fmt::format("  hits {}, original {}", name, names[k]);
    }
    text += '\n';
  }
  return text;
}

// Whether -x and -y describe a picture of all records.
bool formPicture(const CompareOptions& options, size_t records) {
  return options.width > 0 && options.height > 0 &&
         static_cast<size_t>(options.width * options.height) == records;
}

// The command line of this program.
std::string givenLine(const CompareOptions& options, const std::string& recordsName) {
  std::vector<std::string> words{"rsphere-compare"};
  words.insert(words.end(), options.words.begin(), options.words.end());
  words.insert(words.end(), options.scene.begin(), options.scene.end());
  words.push_back(recordsName);
  return shellLine(words);
}

// The numbers of the records to compare. Throws rad::Error if there are none, or if their number does not fit
// the picture of -Cp.
std::vector<double> recordsToCompare(const CompareOptions& options, const std::string& name) {
  std::vector<double> numbers = readRecords(name, options);
  if (!options.sphereMode) numbers = withoutBogus(numbers);
  const size_t records = numbers.size() / static_cast<size_t>(options.numbersPerRecord());
  if (records == 0) throw rad::Error(fmt::format("{}: no record has a direction", name));
  if (!options.differences.empty() && !formPicture(options, records))
    throw rad::Error(fmt::format("-Cp: {} records do not fill a picture of -x {} times -y {}", records,
                                 options.width, options.height));
  return numbers;
}

CompareStatus statusOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
    case Verdict::small: return CompareStatus::same;
    case Verdict::undecided: return CompareStatus::undecided;
    case Verdict::differs: break;
  }
  return CompareStatus::differs;
}

// Answers records with rsphere and with the original, and prints a comparison on standard output. The last
// word of options.scene is the file of records. REQUIRES: options come from parseCompanion(), and `used` is
// its result. Throws rad::Error.
CompareStatus runCompare(CompareOptions options, std::span<const UsedOption> used, const Messages& messages) {
  if (options.scene.size() < 2)
    throw rad::Error("missing argument: a scene and a file of records are needed; see -help");
  const bool points = options.sphereMode;
  if (options.separate) throw rad::Error("-Sp: sums are compared, not the parts of contributors");
  if (points) refuseWhatPointsHave(options);
  const OriginalProgram program = findOriginal();
  CompareSubject subject;
  const rad::Warn warn = [&](std::string_view text) {
    messages.warning(text);
    if (options.messages.warnings) subject.warnings.push_back(rad::messageLine(text));
  };
  if (options.messages.warnings) subject.warnings = options.messages.remarks;
  const std::string recordsName = options.scene.back();
  options.scene.pop_back();
  const std::vector<double> numbers = recordsToCompare(options, recordsName);
  if (options.ray.ambientBounces > 0 && options.ray.ambientAccuracy > 0)
    warn(
        "the original keeps indirect light in a cache, whose error shows as bias, and repeats use it again: "
        "use -aa 0 to compare without it");

  const double start = processSeconds();
  const Scene scene = loadScene(options, warn);
  const bool isOctree = scene.description.cube.has_value();
  const Transport transport(scene, options.ray, options.irradiance, options.sphere.basicRadiance, warn);
  if (isDark(transport.prepared())) warn("no light sources found");
  const Answers ours =
      points ? answerPoints(transport, options, numbers) : answerRays(transport, options, numbers);
  const double ourSeconds = processSeconds() - start;

  Original original(program, options.scene, isOctree,
                    points ? pointOptions(options, used) : originalOptions(options, used));
  const Answers theirs =
      points ? originalPoints(original, options, numbers) : originalRays(original, options, numbers);
  const Comparison comparison = compare(ours, theirs, options.tolerance, options.shareBeyond, !points);

  RecordWriter out(1);
  out.write(fmt::format("{} {}, {} repeats, beside {} ({})\n", ours.records, points ? "points" : "rays",
                        options.repeats, program.path, program.version));
  out.write(warningsText(subject.warnings));
  out.write(figuresText(comparison, options.tolerance));
  out.write(histogramText(comparison.records, options.tolerance));
  subject.worst = worstText(options, comparison, ours, theirs, numbers, transport, original);
  out.write(subject.worst);
  subject.times =
      fmt::format("CPU time of all repeats, loading included: rsphere {:.2f} s, the original {:.2f} s",
                  ourSeconds, original.seconds());
  subject.times += isOctree ? "\n" : fmt::format(", oconv {:.2f} s\n", original.octreeSeconds());
  if (points)
    subject.times += equalErrorText(comparison, options.orientations, ourSeconds, original.seconds());
  out.write(subject.times);
  out.flush();
  if (!options.differences.empty())
    writeDifferences(options.differences, options.width, options.height, comparison.records,
                     options.tolerance);
  if (!options.page.empty()) {
    subject.scene = fmt::format("{}", fmt::join(options.scene, " "));
    subject.recordsFile = recordsName;
    subject.given = givenLine(options, recordsName);
    subject.original = program.path;
    subject.originalVersion = program.version;
    subject.points = points;
    subject.irradiance = !points && options.irradiance != IrradianceAt::none;
    subject.tolerance = options.tolerance;
    if (formPicture(options, ours.records)) {
      subject.width = options.width;
      subject.height = options.height;
    }
    writeTextFile(options.page, comparePage(ours, theirs, comparison, subject, std::time(nullptr)));
  }
  return statusOf(comparison.verdict);
}

}  // namespace
}  // namespace rsphere

int main(int argc, char** argv) {
  using namespace rsphere;
  CompareOptions options;
  return runCompanion(compareCompanion(), argc, argv, options,
                      [&](std::span<const UsedOption> used, const Messages& messages, StopSignals&) {
                        return static_cast<int>(runCompare(options, used, messages));
                      });
}
