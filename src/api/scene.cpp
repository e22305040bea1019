#include "rsphere/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>

#include "answer/answer_glare.h"
#include "answer/answer_points.h"
#include "answer/answer_rays.h"
#include "answer/answer_writer.h"
#include "answer/column_names.h"
#include "answer/load_scene.h"
#include "api/command_line.h"
#include "api/ray_contributions.h"
#include "base/color.h"
#include "base/stop_check.h"
#include "cli/options.h"
#include "process/threads.h"
#include "rad_parser/printable.h"
#include "scene/contributors.h"
#include "scene/scene.h"
#include "scene/sensors.h"
#include "transport/transport.h"

namespace rsphere::v1 {
namespace {

constexpr auto kAskToStop = std::chrono::milliseconds(100);
// Claims of records for each thread. With this number, all threads end nearly together.
constexpr size_t kClaims = 64;
constexpr size_t kLargestClaim = 256;

static_assert(kBrightnessWeights == std::array{kRedWeight, kGreenWeight, kBlueWeight});
static_assert(sizeof(Point) == 3 * sizeof(double) && sizeof(Ray) == 6 * sizeof(double));

// Thrown by a thread that notices that the call must end.
struct Stopped {};

// Collects the warnings of all threads, until the calling thread passes them on.
class Warnings {
 public:
  rad::Warn collector() {
    return [this](std::string_view text) {
      const std::lock_guard lock(mutex_);
      texts_.push_back(rad::messageLine(text));
    };
  }
  void passOn(const Warn& warn) {
    std::vector<std::string> texts;
    {
      const std::lock_guard lock(mutex_);
      texts.swap(texts_);
    }
    if (warn)
      for (const std::string& text : texts) warn(text);
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> texts_;
};

// The scene, prepared for a set of options. Warnings may be added later, while it is in use.
struct PreparedScene {
  PreparedScene(std::shared_ptr<const rsphere::Scene> of, const rsphere::Options& options)
      : scene(std::move(of)),
        transport(*scene, options.ray, options.irradiance, options.sphere.basicRadiance,
                  warnings.collector()) {}
  const std::shared_ptr<const rsphere::Scene> scene;
  Warnings warnings;
  Transport transport;
};

// Calls work(prepared, warn) and converts internal exceptions to public ones. In either case passes on the
// warnings, also those of the scene that `work` has set.
template <typename SomeOptions, typename Work>
auto passingWarnings(const SomeOptions& options, const Work& work) {
  Warnings warnings;
  std::shared_ptr<PreparedScene> prepared;
  const auto passWarnings = [&] {
    if (prepared) prepared->warnings.passOn(options.warn);
    warnings.passOn(options.warn);
  };
  const auto fault = [&](const std::string& text, Error::Cause cause) {
    passWarnings();
    return Error(text, cause);
  };
  try {
    auto result = work(prepared, warnings.collector());
    passWarnings();
    return result;
  } catch (const rad::Error& error) {
    throw fault(error.what(),
                error.status() == rad::Status::input ? Error::Cause::input : Error::Cause::system);
  } catch (const Stopped&) {
    throw fault("stopped", Error::Cause::stopped);
  }
}

rsphere::Options optionsFor(const rsphere::Scene& scene, rsphere::Options options) {
  options.contributors = scene.contributors;
  return options;
}

// The numbers of records.
template <typename Record>
std::span<const double> numbersOf(std::span<const Record> records) {
  return {reinterpret_cast<const double*>(records.data()), records.size_bytes() / sizeof(double)};
}

// The goals of importance(); empty for other calls.
struct Goals {
  std::span<const std::string> modifiers;
  std::span<const double> sensors;  // x y z dx dy dz of each

  bool empty() const { return modifiers.empty() && sensors.empty(); }
};

// Makes the call compute the importance of goals.
void addGoals(CommandOptions& given, const Goals& goals) {
  given.options.separate = true;
  given.options.goals.assign(goals.modifiers.begin(), goals.modifiers.end());
  given.options.sensors = sensorsOf(goals.sensors, "sensors");
  if (!goals.sensors.empty() && given.options.sphere.weights != Weights::silhouettes)
    throw rad::Error("sensors need -Sw c, which aims at them");
  for (std::string* const key : {&given.key, &given.sceneKey}) {
    key->append("-Sp").push_back('\0');
    for (const std::string& goal : goals.modifiers) key->append("-Sg").append(goal).push_back('\0');
    if (goals.sensors.empty()) continue;
    key->append("-SG").append(reinterpret_cast<const char*>(goals.sensors.data()),
                              goals.sensors.size_bytes());
    key->push_back('\0');
  }
}

// The letters of a glare source, in the order in which takeSources() reads them.
constexpr const char* kSourceLetters = "dlLwWps";

// Answers the records of a call. It serves one call at a time.
struct Answerer {
  Answerer(std::shared_ptr<PreparedScene> prepared, const rsphere::Options& given)
      : options(optionsFor(*prepared->scene, given)),
        scene(std::move(prepared)),
        writer(options),
        warn(scene->warnings.collector()),
        sourceOptions(options) {
    sourceOptions.outputs = kSourceLetters;
    sourceOptions.sphere.everyDirection = true;
    const Transport& transport = scene->transport;
    answer = !options.sphereMode           ? answerRays(transport, options, writer, warn, *summary)
             : options.sphere.glare.wanted ? answerGlare(transport, options, writer, warn, *summary,
                                                         &sourceWriter.emplace(sourceOptions))
                                           : answerPoints(transport, options, writer, warn, *summary);
  }
  // For contributions to rays.
  Answerer(std::shared_ptr<PreparedScene> prepared, const rsphere::Options& given,
           std::vector<TrackedModifier> modifiers, const ContributionOptions& how)
      : options(given), scene(std::move(prepared)), writer(options), warn(scene->warnings.collector()) {
    contributions.emplace(scene->transport, options, std::move(modifiers),
                          how.coefficients ? Contributed::coefficients : Contributed::values, how.samples,
                          warn);
    const AnswerRecord answerRay = [this](const Record& record, unsigned worker, std::string& bytes) {
      contributions->answer(record, worker, bytes, *summary);
    };
    answer = withSensors(answerRay, options, scene->transport.prepared(), *summary);
  }
  const rsphere::Options options;
  const std::shared_ptr<PreparedScene> scene;
  const AnswerWriter writer;
  const rad::Warn warn;
  std::optional<RunSummary> summary{std::in_place};  // of the call
  std::optional<RayContributions> contributions;
  std::atomic<bool> stop = false;
  rsphere::Options sourceOptions;  // of the list of an eye's glare sources
  std::optional<AnswerWriter> sourceWriter;
  AnswerRecord answer;
};

// Receives the answer to a record, as bytes in the command's format.
using Keep = std::function<void(size_t record, const std::string& bytes)>;

// One call: its records, and the threads that answer them.
class Call {
 public:
  Call(Answerer& answerer, std::span<const double> numbers, const Keep& keep)
      : answerer_(answerer),
        numbers_(numbers),
        keep_(keep),
        perRecord_(static_cast<size_t>(answerer.options.numbersPerRecord())),
        records_(numbers.size() / perRecord_) {}

  void run(const std::function<bool()>& stop, const rad::Warn& warn) {
    answerer_.stop = false;
    const unsigned threads = threadCount(answerer_.options.threads);
    claim_ = std::clamp<size_t>(records_ / (kClaims * threads), 1, kLargestClaim);
    const size_t claims = (records_ + claim_ - 1) / claim_;
    std::condition_variable changed;
    unsigned ended = 0;
    std::exception_ptr ofStop;
    const auto watch = [&](unsigned started) {
      std::unique_lock lock(mutex_);
      while (!changed.wait_for(lock, kAskToStop, [&] { return ended == started; })) {
        lock.unlock();
        try {
          if (!answerer_.stop) answerer_.stop = stop();
        } catch (...) {
          ofStop = std::current_exception();
          answerer_.stop = true;
        }
        lock.lock();
      }
    };
    const auto answerSome = [&](unsigned worker) {
      work(worker);
      const std::lock_guard lock(mutex_);
      ++ended;
      changed.notify_one();
    };
    runOnThreads(static_cast<unsigned>(std::min<size_t>(threads, claims)), answerSome, {},
                 stop ? watch : std::function<void(unsigned)>());
    if (ofStop) std::rethrow_exception(ofStop);
    if (fault_) std::rethrow_exception(fault_);
    for (const std::string& text :
         answerer_.summary->warnings(answerer_.options, answerer_.scene->transport.prepared()))
      warn(text);
  }

 private:
  void work(unsigned worker) {
    const StopCheck stopCheck([this] {
      if (answerer_.stop) throw Stopped();
    });
    std::string bytes;
    for (size_t first = next_.fetch_add(claim_); first < records_; first = next_.fetch_add(claim_))
      for (size_t i = first; i < std::min(first + claim_, records_); ++i) {
        // Records before a faulty one are still answered, so that the reported error is always the first,
        // regardless of threads.
        if (i > faultAt_) return;
        try {
          StopCheck::here();
          answer(i, worker, bytes);
        } catch (...) {
          fail(i);
        }
      }
  }

  void answer(size_t index, unsigned worker, std::string& bytes) {
    for (const double number : numbers_.subspan(index * perRecord_, perRecord_))
      if (!std::isfinite(number))
        throw rad::Error(fmt::format("{}[{}]: {} is not a finite number",
                                     answerer_.options.sphere.glare.wanted ? "eyes"
                                     : answerer_.options.sphereMode        ? "points"
                                                                           : "rays",
                                     index, number));
    bytes.clear();
    answerer_.answer(record(index), worker, bytes);
    keep_(index, bytes);
  }

  Record record(size_t index) const {
    static constexpr std::array<double, 6> kNone{};
    const auto numbers = [this](size_t i) { return numbers_.subspan(i * perRecord_, perRecord_); };
    Record record;
    record.index = index;
    record.numbers = numbers(index);
    record.bogus = !answerer_.options.sphereMode && hasNoDirection(record.numbers);
    if (!record.bogus) return record;
    while (index > 0 && hasNoDirection(numbers(index))) --index;
    record.numbers = hasNoDirection(numbers(index)) ? std::span<const double>(kNone) : numbers(index);
    return record;
  }

  // Stores the current exception, unless an earlier record has one.
  void fail(size_t index) {
    const std::lock_guard lock(mutex_);
    if (index > faultAt_) return;
    faultAt_ = index;
    fault_ = std::current_exception();
  }

  Answerer& answerer_;
  const std::span<const double> numbers_;
  const Keep& keep_;
  const size_t perRecord_, records_;
  size_t claim_ = 1;
  std::atomic<size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr fault_;
  std::atomic<size_t> faultAt_ = std::numeric_limits<size_t>::max();
};

// A letter of -o, and where its answers are stored.
struct Column {
  char letter;
  Quantity* quantity = nullptr;
  std::vector<std::string>* names = nullptr;
  char of = 0;  // for a standard error at a point, the letter of its quantity
};

std::vector<Column> columnsOf(RayAnswers& a) {
  return {{'v', &a.value},
          {'e', &a.standardError},
          {'o', &a.origin},
          {'d', &a.direction},
          {'p', &a.point},
          {'n', &a.normal},
          {'N', &a.unperturbedNormal},
          {'L', &a.firstLength},
          {'l', &a.effectiveLength},
          {'c', &a.localCoordinates},
          {'w', &a.weight},
          {'W', &a.coefficient},
          {'V', &a.contribution},
          {'r', &a.mirroredValue},
          {'R', &a.mirroredLength},
          {'x', &a.unmirroredValue},
          {'X', &a.unmirroredLength},
          {'s', nullptr, &a.surface},
          {'m', nullptr, &a.modifier},
          {'M', nullptr, &a.material}};
}

std::vector<Column> columnsOf(PointAnswers& a) {
  std::vector<Column> columns{
      {'k', &a.directions}, {'Z', &a.zonesStandardError, nullptr, 'z'}, {'o', &a.point}};
  // A quantity and its standard error, the letter e after it.
  const auto add = [&](char letter, Quantity& value, Quantity& error) {
    columns.push_back({letter, &value});
    columns.push_back({'e', &error, nullptr, letter});
  };
  add('v', a.mean, a.meanStandardError);
  add('E', a.scalarIrradiance, a.scalarIrradianceStandardError);
  add('C', a.cylindricalIrradiance, a.cylindricalIrradianceStandardError);
  add('S', a.semicylindricalIrradiance, a.semicylindricalIrradianceStandardError);
  add('h', a.hemisphericalIrradiance, a.hemisphericalIrradianceStandardError);
  add('H', a.faceIrradiance, a.faceIrradianceStandardError);
  add('u', a.lightVector, a.lightVectorStandardError);
  add('z', a.zones, a.zonesStandardError);
  return columns;
}

std::vector<Column> columnsOf(GlareAnswers& a) {
  return {{'u', &a.unifiedGlareRating},       {'U', &a.ugrStandardError}, {'v', &a.illuminance},
          {'V', &a.illuminanceStandardError}, {'b', &a.background},       {'B', &a.backgroundStandardError},
          {'g', &a.daylightGlareProbability}, {'G', &a.dgpStandardError}, {'t', &a.threshold}};
}

// The columns for the letters, in order, with memory for the answers.
std::vector<Column> prepareColumns(const std::vector<Column>& all, const rsphere::Options& options,
                                   size_t records) {
  std::vector<Column> columns;
  const bool points = options.sphereMode && !options.sphere.glare.wanted;
  const auto quantities =
      points ? pointQuantities(options.outputs) : std::vector<const PointQuantity*>(options.outputs.size());
  const auto names = columnNames(options);
  for (size_t i = 0; i < options.outputs.size(); ++i) {
    const char letter = options.outputs[i];
    const auto known = std::ranges::find_if(all, [&](const Column& c) {
      return c.letter == letter && (!quantities[i] || c.of == quantities[i]->of);
    });
    if (known == all.end()) {
      columns.push_back({letter});  // a tilde
      continue;
    }
    columns.push_back(*known);
    if (known->names) {
      known->names->resize(records);
      continue;
    }
    known->quantity->columns = names[i].size();
    known->quantity->numbers.resize(records * known->quantity->columns);
  }
  return columns;
}

// Splits a record written by AnswerWriter as float64: numbers are copied, names end with a TAB. Returns the
// end of the record.
const char* takeApart(const std::string& bytes, const std::vector<Column>& columns, size_t record) {
  const char* at = bytes.data();
  for (const Column& column : columns) {
    if (Quantity* const q = column.quantity) {
      std::memcpy(q->numbers.data() + record * q->columns, at, q->columns * sizeof(double));
      at += q->columns * sizeof(double);
      continue;
    }
    const char* const end = std::find(at, bytes.data() + bytes.size(), '\t');
    if (column.names) (*column.names)[record].assign(at, end);
    at = end + 1;
  }
  return at;
}

// The glare sources that follow the record of an eye, from `at` to `end`.
std::vector<GlareSource> takeSources(const char* at, const char* end) {
  std::vector<GlareSource> sources;
  while (at < end) {
    std::array<double, 8> n;
    std::memcpy(n.data(), at, sizeof n);
    at += sizeof n;
    const char* const nameEnd = std::find(at, end, '\t');
    sources.push_back({{n[0], n[1], n[2]}, n[3], n[4], n[5], n[6], n[7], std::string(at, nameEnd)});
    at = nameEnd + 1;
  }
  return sources;
}

}  // namespace

struct Scene::Implementation {
  Implementation(rsphere::Scene&& read, std::vector<std::string> goals)
      : scene_(std::make_shared<const rsphere::Scene>(std::move(read))), goals_(std::move(goals)) {}

  // An answerer for these options: the idle one or a new one. A new one uses the prepared scene of another
  // answerer if it can (CommandOptions::sceneKey).
  std::unique_ptr<Answerer> take(const CommandOptions& given) {
    {
      const std::lock_guard lock(mutex_);
      Idle& idle = given.options.sphereMode ? points_ : rays_;
      if (idle.answerer && idle.key == given.key) return std::move(idle.answerer);
      // Frees the memory for the last options before that for new ones is allocated.
      if (!preparedFor(given.sceneKey)) idle.answerer.reset();
    }
    return std::make_unique<Answerer>(prepare(given), given.options);
  }

  void giveBack(const std::string& key, std::unique_ptr<Answerer> answerer) {
    if (!answerer->options.ray.ambientFile.empty())
      return;  // -af: other processes may read the file between calls
    const std::lock_guard lock(mutex_);
    Idle& idle = answerer->options.sphereMode ? points_ : rays_;
    idle = {key, std::move(answerer)};
  }

  template <typename Answers>
  Answers answer(std::span<const double> numbers, const Options& options, Records records,
                 const Goals& goals = {});

  Contributions contributions(std::span<const double> numbers, const std::vector<std::string>& of,
                              const ContributionOptions& options) {
    return passingWarnings(options, [&](std::shared_ptr<PreparedScene>& prepared, const rad::Warn& warn) {
      if (options.samples < 1)
        throw rad::Error(fmt::format("{} samples: expected at least 1", options.samples));
      std::vector<TrackedModifier> modifiers = trackedModifiers(of, options.bins);
      const CommandOptions given = commandOptions(options, Records::contributions);
      for (const std::string& remark : given.options.messages.remarks) warn(remark);
      prepared = prepare(given);
      {
        const std::lock_guard lock(mutex_);
        ofContributions_ = prepared;
      }
      Contributions result;
      result.modifiers = of;
      result.bins = modifiers.front().bins;
      Answerer answerer(prepared, given.options, std::move(modifiers), options);
      const size_t columns = answerer.contributions->numbers();
      result.size = numbers.size() / static_cast<size_t>(given.options.numbersPerRecord());
      std::vector<Column> all{{'v', &result.value}};
      if (answerer.contributions->hasErrors()) all.push_back({'e', &result.standardError});
      for (Column& column : all) {
        column.quantity->columns = columns;
        column.quantity->numbers.resize(result.size * columns);
      }
      const auto keep = [&](size_t record, const std::string& bytes) { takeApart(bytes, all, record); };
      Call(answerer, numbers, keep).run(options.stop, warn);
      return result;
    });
  }

 private:
  // REQUIRES: the mutex is locked.
  std::shared_ptr<PreparedScene> preparedFor(const std::string& sceneKey) const {
    for (const auto& [key, prepared] : prepared_)
      if (key == sceneKey)
        if (auto shared = prepared.lock()) return shared;
    return nullptr;
  }

  std::shared_ptr<PreparedScene> prepare(const CommandOptions& given) {
    {
      const std::lock_guard lock(mutex_);
      if (auto shared = preparedFor(given.sceneKey)) return shared;
    }
    auto shared = std::make_shared<PreparedScene>(sceneFor(given.options), given.options);
    const std::lock_guard lock(mutex_);
    std::erase_if(prepared_, [](const auto& entry) { return entry.second.expired(); });
    prepared_.emplace_back(given.sceneKey, shared);
    return shared;
  }

  // The scene as it was read, or a copy with other goals or contributors.
  std::shared_ptr<const rsphere::Scene> sceneFor(const rsphere::Options& options) const {
    if (!options.separate) return scene_;
    auto copy = std::make_shared<rsphere::Scene>(*scene_);
    const bool own = !options.goals.empty() || !options.sensors.empty();
    if (own) setGoals(*copy, options.goals);
    addSensors(*copy, options.sensors);
    separateContributors(*copy, own ? options.goals : goals_);
    return copy;
  }

  const std::shared_ptr<const rsphere::Scene> scene_;
  const std::vector<std::string> goals_;

  // Prepared scenes by CommandOptions::sceneKey, as long as they are in use. At most one idle answerer for
  // rays and one for points is kept, for the last options.
  struct Idle {
    std::string key;
    std::unique_ptr<Answerer> answerer;
  };
  std::mutex mutex_;
  std::vector<std::pair<std::string, std::weak_ptr<PreparedScene>>> prepared_;
  Idle rays_, points_;
  std::shared_ptr<PreparedScene> ofContributions_;  // of the last call
};

template <typename Answers>
Answers Scene::Implementation::answer(std::span<const double> numbers, const Options& options,
                                      Records records, const Goals& goals) {
  return passingWarnings(options, [&](std::shared_ptr<PreparedScene>& prepared, const rad::Warn& warn) {
    CommandOptions given = commandOptions(options, records);
    if (!goals.empty()) addGoals(given, goals);
    const rsphere::Options& parsed = given.options;
    for (const std::string& remark : parsed.messages.remarks) warn(remark);
    std::unique_ptr<Answerer> answerer = take(given);
    prepared = answerer->scene;
    given.options.contributors = prepared->scene->contributors;
    Answers answers;
    if constexpr (requires { answers.contributors; }) {
      answers.contributors = given.options.contributors;
      const SphereOptions& sphere = given.options.sphere;
      answers.zoneCount = static_cast<size_t>(sphere.zones);
      for (size_t i = 0; i < answers.zoneCount; ++i)
        answers.zoneSolidAngles.push_back(sphere.bins ? sphere.bins->solidAngle(i)
                                                      : 4 * std::numbers::pi / sphere.zones);
    }
    answers.size = numbers.size() / static_cast<size_t>(parsed.numbersPerRecord());
    const std::vector<Column> columns = prepareColumns(columnsOf(answers), parsed, answers.size);
    if constexpr (requires { answers.sources; }) answers.sources.resize(answers.size);
    const auto keep = [&](size_t record, const std::string& bytes) {
      [[maybe_unused]] const char* const at = takeApart(bytes, columns, record);
      if constexpr (requires { answers.sources; })
        answers.sources[record] = takeSources(at, bytes.data() + bytes.size());
    };

    answerer->summary.emplace();
    Call(*answerer, numbers, keep).run(options.stop, warn);
    giveBack(given.key, std::move(answerer));
    return answers;
  });
}

Scene::Scene(const std::vector<std::string>& files, const SceneOptions& options) {
  implementation_ = passingWarnings(options, [&](std::shared_ptr<PreparedScene>&, const rad::Warn& warn) {
    if (files.empty())
      throw rad::Error("a scene needs at least one file: an octree, scene text or '!command'");
    for (const std::string& file : files)
      if (file.find('\0') != std::string::npos)
        throw rad::Error(fmt::format("the file name \"{}\" contains a NUL byte", rad::printable(file)));
    AnswerOptions read;
    read.scene = files;
    read.commands = options.commands;
    read.goals = options.goals;
    return std::make_unique<Implementation>(loadScene(read, warn), options.goals);
  });
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

RayAnswers Scene::trace(std::span<const Ray> rays, const Options& options) const {
  return implementation_->answer<RayAnswers>(numbersOf(rays), options, Records::rays);
}

PointAnswers Scene::sphere(std::span<const Point> points, const Options& options) const {
  return implementation_->answer<PointAnswers>(numbersOf(points), options, Records::points);
}

PointAnswers Scene::importance(std::span<const Point> points, const std::vector<std::string>& goals,
                               const Options& options) const {
  if (goals.empty()) throw Error("importance() needs the modifier of at least one goal", Error::Cause::input);
  return implementation_->answer<PointAnswers>(numbersOf(points), options, Records::points, {goals, {}});
}

PointAnswers Scene::importanceOfSensors(std::span<const Point> points, std::span<const Sensor> sensors,
                                        const Options& options) const {
  if (sensors.empty()) throw Error("importanceOfSensors() needs at least one sensor", Error::Cause::input);
  return implementation_->answer<PointAnswers>(numbersOf(points), options, Records::points,
                                               {{}, numbersOf(sensors)});
}

GlareAnswers Scene::glare(std::span<const Ray> eyes, const Options& options) const {
  return implementation_->answer<GlareAnswers>(numbersOf(eyes), options, Records::glare);
}

Contributions Scene::contributions(std::span<const Ray> rays, const std::vector<std::string>& of,
                                   const ContributionOptions& options) const {
  return implementation_->contributions(numbersOf(rays), of, options);
}

std::vector<std::array<double, 3>> zoneMiddles(size_t count) {
  const EqualZones zones(count);
  std::vector<std::array<double, 3>> middles;
  for (size_t i = 0; i < count; ++i) {
    const V3d middle = zones.middle(i);
    middles.push_back({middle.x, middle.y, middle.z});
  }
  return middles;
}

}  // namespace rsphere::v1
