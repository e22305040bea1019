#include "shade/surface_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "rad_parser/file_path.h"
#include "rad_parser/open_file.h"
#include "rad_parser/printable.h"
#include "rad_parser/scene_file.h"

namespace rsphere {
namespace {

using rad::Type;
namespace calc = rad::calc;

constexpr uint64_t bits(calc::Input first, int count) { return ((uint64_t{1} << count) - 1) << first; }

void put(double* to, const V3d& v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

// The text of a file without the byte order mark of UTF-8. Throws rad::Error if the file cannot be read, or
// is in UTF-16 and no XML.
std::string readText(const std::string& path) {
  std::string text = rad::OpenFile(path).contents(path);
  if (text.starts_with(rad::kByteOrderMark)) text.erase(0, rad::kByteOrderMark.size());
  if (rad::isUtf16(text) && text.find('<') > 3) throw rad::Error(fmt::format("{}: {}", path, rad::kUtf16));
  return text;
}

bool isFolder(const std::string& path, const rad::FileAccess& access) {
  std::error_code none;
  return access.allows(path) && std::filesystem::is_directory(path, none);
}

std::string folderProblem(std::string_view name, std::string_view kind) {
  return fmt::format("\"{}\" is a folder, expected a {} file", rad::printableName(name), kind);
}

// Coordinates that are NaN are an error. Infinite ones are allowed: data are 0 there.
void checkCoordinates(std::span<const double> coordinates, calc::State& state) {
  if (std::ranges::any_of(coordinates, [](double c) { return std::isnan(c); }))
    state.faults |= calc::kDomainError;
}

// Number i of `count` wavelengths that are evenly spaced from first to last. REQUIRES count above 1.
double between(double first, double last, size_t i, size_t count) {
  return first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1);
}

// A spectrum from values at the middles of its bins, which run from first to last. REQUIRES at least two
// values.
Spectrum betweenMiddles(std::span<const double> values, double first, double last) {
  const double half = (last - first) / static_cast<double>(values.size() - 1) / 2;
  return {values, first - half, last + half};
}

// The color of a spectrum in descending order of wavelength. As in RADIANCE 6.1, three values are red, green
// and blue.
Color threeChannels(const Spectrum& spectrum) {
  const auto& v = spectrum.values;
  if (v.size() == 3) return Color(v[0], v[1], v[2]);
  return Color(standardRgb(tristimulusInRadiance(spectrum)));
}

// The wavelengths (nm) along an axis of data if they are unevenly spaced; otherwise empty.
std::vector<double> unevenWavelengths(const rad::DataFile& data, size_t axis) {
  const auto divisions = data.unevenDivisions(axis);
  return {divisions.begin(), divisions.end()};
}

}  // namespace

// Reads and compiles a single modifier.
class SurfaceFunctions::Maker {
 public:
  Maker(const SurfaceFunctions& functions, ModifierId modifier)
      : functions_(functions),
        scene_(functions.scene_),
        modifier_(scene_.modifiers[modifier]),
        arguments_(scene_.description, modifier_.decoded) {}

  std::unique_ptr<Function> make() {
    std::visit([&](const auto& read) { makeFrom(read); }, *modifier_.arguments);
    return std::move(made_);
  }

 private:
  [[noreturn]] void fail(std::string_view what, rad::Status status = rad::Status::input) const {
    arguments_.fail(what, status);
  }

  // rest: the arguments that should include this number of coordinates.
  [[noreturn]] void tooFewCoordinates(std::span<const std::string_view> rest, size_t coordinates,
                                      std::string_view exception) const {
    const size_t given = arguments_.strings();
    fail(fmt::format("expected at least {} string arguments, with a coordinate for each dimension{}, got {}",
                     given - rest.size() + coordinates, exception, given));
  }

  // The path of a file that this modifier names.
  std::string find(std::string_view name, std::string_view kind) const {
    const auto path = rad::findNamedFile(scene_.description, place(), name, scene_.files);
    if (isFolder(path.value_or(std::string(name)), scene_.files))
      fail(folderProblem(name, kind), rad::Status::system);
    if (!path)
      fail(fmt::format("cannot find {} file \"{}\"{}", kind, rad::printableName(name),
                       scene_.files.remark(name, true)),
           rad::Status::system);
    return *path;
  }

  // What a file of this kind contains: make(its path), unless another modifier has had it made.
  template <class T, class Read>
  std::shared_ptr<const T> shared(Cache<T>& cache, std::string_view name, std::string_view kind,
                                  const Read& make) const {
    const std::string path = find(name, kind);
    std::shared_ptr<const T>& thing = cache[path];
    if (!thing) thing = placed([&] { return std::make_shared<const T>(make(path)); });
    return thing;
  }

  // Errors of read() begin with the path of the file; this adds the place of the primitive.
  template <class Read>
  auto placed(const Read& read) const {
    try {
      return read();
    } catch (const rad::Error& error) {
      fail(error.what(), error.status());
    }
  }

  std::shared_ptr<const rad::DataFile> table(std::string_view name) const {
    return shared(functions_.data_, name, "data",
                  [](const std::string& path) { return rad::DataFile::parse(readText(path), path); });
  }

  template <class T>
  std::shared_ptr<const T> picture(Cache<T>& cache, std::string_view name) const {
    return shared(cache, name, "picture", [](const std::string& path) { return T::read(path); });
  }

  rad::Place place() const { return scene_.description.primitives[modifier_.primitive].place; }

  // The request refers to the name of the function file, which is looked up once: a modifier has one.
  calc::Request request(std::string_view file) const {
    if (functionFile_.empty())
      functionFile_ = file == "." ? "." : rad::nameOfFile(scene_.description, place(), file, scene_.files);
    calc::Request r;
    r.place = scene_.place(modifier_.primitive);
    r.file = functionFile_;
    r.available = available_;
    r.reals = arguments_.reals();
    return r;
  }

  void use(const ProgramPointer& program) const { made_->needs |= program->inputs(); }

  ProgramPointer compiled(std::string_view file, std::span<const std::string_view> expressions) const {
    const std::vector<std::string> texts(expressions.begin(), expressions.end());
    calc::Request r = request(file);
    r.expressions = texts;
    auto program = functions_.library_.compile(r);
    use(program);
    return program;
  }

  // The functions that correct the values of data or of a picture. passed: number of values passed to each.
  std::vector<Correction> corrections(std::string_view file, const Words& names,
                                      const std::vector<int>& passed) const {
    std::vector<Correction> all;
    for (size_t i = 0; i < names.size(); ++i) {
      all.push_back({functions_.library_.compileCall(request(file), names[i], passed[i]), passed[i] > 1});
      use(all.back().program);
    }
    return all;
  }

  // The second and third function of a color receive only the value of their own channel if they take fewer
  // than three arguments, otherwise all three values.
  std::vector<int> colorsPassed(std::string_view file, const Words& names) const {
    std::vector<int> passed{3};
    for (size_t i = 1; i < names.size(); ++i)
      passed.push_back(functions_.library_.functionArity(request(file), names[i]) < 3 ? 1 : 3);
    return passed;
  }

  void makeFrom(const FunctionArguments& read) const {
    Values values{compiled(read.file.name, read.expressions)};
    finish(std::move(values), read.expressions.size(), read.file.transform);
  }

  void makeFrom(const DataArguments& read) const {
    if (arguments_.type() == Type::specdata) return spectralData(read);
    const std::vector<int> passed = arguments_.type() == Type::colordata
                                        ? colorsPassed(read.file, read.corrections)
                                    : arguments_.type() == Type::texdata ? std::vector{3, 3, 3}
                                                                         : std::vector{1};
    Data d;
    for (const std::string_view name : read.tables) d.tables.push_back(table(name));
    const size_t dimensions = d.tables[0]->dimensions();
    for (const auto& t : d.tables)
      if (t->dimensions() != dimensions) fail("the data files differ in their number of dimensions");
    if (read.rest.size() < dimensions) tooFewCoordinates(read.rest, dimensions, "");
    const auto rest = std::span(read.rest);
    d.coordinates = compiled(read.file, rest.first(dimensions));
    d.corrections = corrections(read.file, read.corrections, passed);
    finish(std::move(d), read.corrections.size(), transformAmong(rest.subspan(dimensions)));
  }

  void makeFrom(const PictureArguments& read) const {
    if (arguments_.type() == Type::specpict) return spectralImage(read);
    const std::vector<int> passed = arguments_.type() == Type::colorpict
                                        ? colorsPassed(read.file.name, read.corrections)
                                        : std::vector{3};
    Image i;
    i.coordinates = compiled(read.file.name, read.coordinates);
    i.corrections = corrections(read.file.name, read.corrections, passed);
    i.picture = picture(functions_.pictures_, read.picture);
    finish(std::move(i), read.corrections.size(), read.file.transform);
  }

  // ---- spectra

  void constant(Color color) const { finish(ConstantSpectrum{std::move(color)}, 0, {}); }
  void constant(std::span<const double> values, double first, double last) const {
    constant(functions_.colorOf(betweenMiddles(values, first, last)));
  }

  void makeFrom(const SpectrumArguments& read) const { constant(read.values, read.first, read.last); }

  void makeFrom(const SpectrumFileArguments& read) const {
    const auto data = table(read.data);
    if (data->dimensions() != 1)
      fail(fmt::format("expected data of 1 dimension, the wavelength, got {}", data->dimensions()));
    const rad::DataFile::Divisions d = data->divisions(0);
    const std::vector<double> wavelengths = unevenWavelengths(*data, 0);
    std::vector<double> values(d.count);
    for (size_t i = 0; i < values.size(); ++i) {
      const double wavelength = d.even ? between(d.first, d.last, i, d.count) : wavelengths[i];
      values[i] = data->value({&wavelength, 1});
    }
    if (d.even) return constant(values, d.first, d.last);
    constant(functions_.colorOf(SpectralCurve{wavelengths, values}));
  }

  void makeFrom(const SpectralFunctionArguments& read) const {
    SpectralFunction s;
    s.program = functions_.library_.compileCall(request(read.file.name), read.function, 1);
    use(s.program);
    const SpectralSampling* sampling = functions_.sampling_;
    const WavelengthLimits& limits = functions_.limits_;
    s.longest = std::min(read.longest, limits.longest);
    s.shortest = std::max(read.shortest, limits.shortest);
    const double range = s.longest - s.shortest;
    if (range > 0) {
      // As in RADIANCE, a band has at most four bins, because more would not be resolved.
      const double band = sampling ? sampling->width() : (limits.longest - limits.shortest) / 3;
      s.step = std::max(range / kMostBands, band / 4);
      s.bins = std::max(size_t{1}, static_cast<size_t>(range / s.step + .1));
    }
    finish(std::move(s), 0, read.file.transform);
  }

  void spectralData(const DataArguments& read) const {
    SpectralData s;
    s.table = table(read.tables[0]);
    if (s.table->dimensions() < 2)
      fail("expected data of at least 2 dimensions, the last of them the wavelength");
    const size_t coordinates = s.table->dimensions() - 1;
    const rad::DataFile::Divisions d = s.table->divisions(coordinates);
    s.count = d.count;
    s.firstWavelength = d.first;
    s.lastWavelength = d.last;
    s.unevenWavelengths = unevenWavelengths(*s.table, coordinates);
    if (read.rest.size() < coordinates) tooFewCoordinates(read.rest, coordinates, " but the wavelength");
    const auto rest = std::span(read.rest);
    corrected(std::move(s), read.file, rest.first(coordinates), read.corrections[0],
              transformAmong(rest.subspan(coordinates)));
  }

  void spectralImage(const PictureArguments& read) const {
    SpectralData s;
    s.picture = picture(functions_.spectralPictures_, read.picture);
    s.count = s.picture->components();
    const double half = (s.picture->last() - s.picture->first()) / static_cast<double>(s.count) / 2;
    s.firstWavelength = s.picture->first() + half;
    s.lastWavelength = s.picture->last() - half;
    corrected(std::move(s), read.file.name, read.coordinates, read.corrections[0], read.file.transform);
  }

  void corrected(SpectralData s, std::string_view file, std::span<const std::string_view> coordinates,
                 std::string_view correction, const Words& transform) const {
    s.coordinates = compiled(file, coordinates);
    s.correction = functions_.library_.compileCall(request(file), correction, 2);
    use(s.correction);
    finish(std::move(s), 0, transform);
  }

  // ---- text

  void makeFrom(const TextArguments& read) const {
    const size_t channels = read.foreground.size();
    made_->results = std::max<size_t>(channels, 1);
    const V3d &r = read.right, &d = read.down, n = d.cross(r);
    const double n2 = n.length2();
    // The motion vectors are parallel or too short. RADIANCE compares the length of n x d with 1e-12.
    if (!(n2 * d.length2() > 1e-24)) fail("illegal motion vector");

    const auto font = shared(functions_.fonts_, read.font, "font", [](const std::string& path) {
      return rad::FontFile::parse(readText(path), path);
    });
    std::vector<std::string> lines;
    if (!read.words.empty()) {
      lines.push_back(fmt::format("{}", fmt::join(read.words, " ")));
    } else {
      const std::string text = placed([path = find(read.file, "text")] { return readText(path); });
      for (const std::string_view line : rad::split(text, "\n")) lines.emplace_back(line);
    }
    std::array<double, 3> foreground{1, 0, 0}, background{0, 0, 0};
    std::copy(read.foreground.begin(), read.foreground.end(), foreground.begin());
    std::copy(read.background.begin(), read.background.end(), background.begin());
    made_->what.emplace<Text>(Text{font, rad::TextLayout(*font, lines, read.spacing), read.anchor,
                                   n.cross(d) / n2, r.cross(n) / n2, foreground, background});
  }

  // ---- materials

  void makeFrom(const OneOf<AnisotropicArguments, AshikhminArguments> auto& read) const {
    Scatterer s;
    s.orientation = compiled(read.orientation.file.name, read.orientation.direction);
    finish(std::move(s), read.orientation.file);
  }

  // A call of a function by name. Its last four arguments are the direction to a source and the solid angle
  // of the source; `before` is the number of arguments before these.
  ProgramPointer called(std::string_view file, std::string_view function, int before) const {
    auto program = functions_.library_.compileCall(request(file), function, before + 4);
    use(program);
    return program;
  }

  void makeFrom(const FunctionScattererArguments& read) {
    available_ = calc::kMaterialInputs;
    Scatterer s;
    s.distribution[0] = called(read.file.name, read.distribution, 0);
    finish(std::move(s), read.file);
  }

  void makeFrom(const DataScattererArguments& read) {
    available_ = calc::kMaterialInputs;
    Scatterer s;
    s.table = table(read.table);
    for (size_t i = 0; i < s.table->dimensions(); ++i) {
      if (i >= read.rest.size()) tooFewCoordinates(read.rest, s.table->dimensions(), "");
      s.coordinates.push_back(called(read.file.name, read.rest[i], 0));
    }
    s.distribution[0] = called(read.file.name, read.correction, 1);
    finish(std::move(s), read.file);
  }

  void makeFrom(const BrtdArguments& read) {
    available_ = calc::kMaterialInputs;
    Scatterer s;
    s.reflection = compiled(read.file.name, read.reflection);
    s.transmission = compiled(read.file.name, read.transmission);
    const Words& names = read.distribution;
    s.gray = names[0] == names[1] && names[1] == names[2];
    for (size_t i = 0; i < (s.gray ? 1 : 3); ++i)
      if (names[i] != "0") s.distribution[i] = called(read.file.name, names[i], 0);
    finish(std::move(s), read.file);
  }

  void makeFrom(const WgmdArguments& read) {
    available_ = (uint64_t{1} << calc::CrP) - 1;
    const FunctionFile& file = read.orientation.file;
    Scatterer s;
    s.reflection = compiled(file.name, read.reflected.shape);
    s.transmission = compiled(file.name, read.transmitted.shape);
    s.orientation = compiled(file.name, read.orientation.direction);
    finish(std::move(s), file);
  }

  void makeFrom(const BsdfArguments& read) const {
    Scatterer s;
    s.bsdf = shared(functions_.bsdfs_, read.data, "BSDF", [&](const std::string& path) {
      return BsdfData(rad::BsdfFile::parse(readText(path), path, functions_.warn_), path, functions_.warn_);
    });
    s.orientation = compiled(read.up.file.name, read.up.direction);
    if (read.thickness) s.thickness = compiled(read.up.file.name, std::span(&*read.thickness, 1));
    finish(std::move(s), read.up.file);
  }

  void makeFrom(const PrismArguments& read) {
    available_ = calc::kPrismInputs;
    Redirector r;
    for (size_t i = 0; i < read.images.size(); ++i) r.programs[i] = compiled(read.file.name, read.images[i]);
    finish(std::move(r), 1, read.file.transform);
  }

  void finish(Scatterer s, const FunctionFile& file) const { finish(std::move(s), 3, file.transform); }
  // what: one of Function::what. transform: the words of a transform; may be empty.
  template <class What>
  void finish(What what, size_t results, const Words& transform) const {
    made_->results = results;
    made_->what = std::move(what);
    if (transform.empty()) return;
    made_->moved = true;
    made_->placement = readPlacement(arguments_, transform);
  }

  const SurfaceFunctions& functions_;
  const Scene& scene_;
  const Modifier& modifier_;
  PrimitiveArguments arguments_;
  mutable std::string functionFile_;
  uint64_t available_ = calc::kPointInputs;
  std::unique_ptr<Function> made_ = std::make_unique<Function>();
};

std::optional<calc::SourceText> loadFunctionFile(std::string_view name, const rad::FileAccess& access) {
  const auto path = rad::findFile(name, rad::libraryPath(), {}, access);
  if (isFolder(path.value_or(std::string(name)), access))
    throw rad::Error(folderProblem(name, "function"), rad::Status::system);
  if (!path) {
    if (const auto text = calc::builtInFile(name))
      return calc::SourceText{std::string(name), std::string(*text)};
    return std::nullopt;
  }
  return calc::SourceText{*path, readText(*path)};
}

SurfaceFunctions::SurfaceFunctions(const Scene& scene, const SpectralSampling* sampling, rad::Warn warn,
                                   std::span<const SharedDefinitions> definitions,
                                   const WavelengthLimits& limits)
    : scene_(scene),
      sampling_(sampling),
      limits_(sampling ? WavelengthLimits{sampling->shortest, sampling->longest} : limits),
      warn_(std::move(warn)),
      ready_(scene.modifiers.size()),
      library_(
          calc::sceneInterface(scene.files),
          [&files = scene.files](std::string_view name) { return loadFunctionFile(name, files); }, warn_) {
  for (const SharedDefinitions& shared : definitions)
    if (shared.isFile)
      library_.include(shared.text);
    else
      library_.define(shared.text, fmt::format("-e '{}'", shared.text));
}

const SurfaceFunctions::Function& SurfaceFunctions::prepare(ModifierId modifier) const {
  const std::lock_guard lock(mutex_);
  auto& slot = ready_[modifier.index()];
  if (const Function* f = slot.load(std::memory_order_relaxed)) return *f;
  functions_.push_back(Maker(*this, modifier).make());
  slot.store(functions_.back().get(), std::memory_order_release);
  return *functions_.back();
}

std::span<const double> SurfaceFunctions::realsOf(ModifierId modifier) const {
  return scene_.description.reals(scene_.modifiers[modifier].decoded);
}

const Placement* SurfaceFunctions::placementOf(const Function& f, const FunctionPoint& at,
                                               FunctionScratch& scratch) const {
  if (at.path.count == 0) return f.moved ? &f.placement : nullptr;
  if (at.path.count == 1 && !f.moved) return &scene_.placements[at.path.placements[0]];
  scratch.placement = within(scene_.placementOf(at.path), f.placement);
  return &scratch.placement;
}

void SurfaceFunctions::setInputs(const Function& f, const FunctionPoint& at, FunctionScratch& scratch) const {
  using namespace rad::calc;
  auto& in = scratch.inputs;
  const uint64_t needs = f.needs;
  const Placement* placement = placementOf(f, at, scratch);
  const double scale = placement ? placement->toInner.scale : 1;
  const auto direction = [&](const V3d& v) { return placement ? placement->directionToInner(v) : v; };
  scratch.state.faults = 0;
  if (needs & bits(Dx, 3)) put(&in[Dx], direction(at.direction));
  if (needs & bits(Nx, 3)) put(&in[Nx], direction(at.normal));
  if (needs & bits(Px, 3)) put(&in[Px], placement ? placement->toInner.point(at.point) : at.point);
  in[T] = at.distance * scale;
  in[Rdot] = std::clamp(at.cosine, -1., 1.);
  in[Ts] = at.shadowDistance * scale;
  in[Lu] = at.u;
  in[Lv] = at.v;
  in[S] = scale;
  if (needs & bits(Tx, 12)) {
    const Imath::M44d own = placement ? placement->toInner.matrix : Imath::M44d();
    put(&in[Tx], V3d(own[3][0], own[3][1], own[3][2]));
    for (int i = 0; i < 3; ++i)
      put(&in[static_cast<size_t>(Ix + 3 * i)], V3d(own[i][0], own[i][1], own[i][2]) / scale);
  }
  if (needs & bits(NxP, 3)) put(&in[NxP], direction(at.perturbedNormal));
  in[RdotP] = at.perturbedCosine;
  if (needs & bits(CrP, 3)) put(&in[CrP], at.color.rgb());
  if (needs & bits(DxA, 3)) put(&in[DxA], direction(at.toTarget));
}

void SurfaceFunctions::warn(ModifierId modifier, std::string_view problem) const {
  if (!warn_ || ready(modifier).warned.exchange(true)) return;
  const std::lock_guard lock(mutex_);
  warn_(fmt::format("{}: {}", scene_.place(scene_.modifiers[modifier].primitive), problem));
}

bool SurfaceFunctions::computed(ModifierId modifier, const FunctionScratch& scratch,
                                std::span<const double> values) const {
  const auto isFinite = [](double value) { return std::isfinite(value); };
  if (scratch.state.faults == 0 && std::ranges::all_of(values, isFinite)) return true;
  if (!ready(modifier).warned)
    warn(modifier,
         fmt::format("compute error: {}: ignored at such points; the function can exclude them with if()",
                     calc::faultName(scratch.state.faults)));
  return false;
}

bool SurfaceFunctions::evaluate(ModifierId modifier, const Function& f, const FunctionPoint& at,
                                FunctionScratch& scratch, std::array<double, 3>& out) const {
  if (const auto* text = std::get_if<Text>(&f.what)) {
    const Placement* placement = placementOf(f, at, scratch);
    const V3d v = (placement ? placement->toInner.point(at.point) : at.point) - text->anchor;
    out = text->layout.covers(v.dot(text->right), v.dot(text->down)) ? text->foreground : text->background;
    return true;
  }
  setInputs(f, at, scratch);
  calc::Point point{scratch.inputs, realsOf(modifier), {}};
  calc::State& state = scratch.state;
  const auto correct = [&](const std::vector<Correction>& corrections, const double* values) {
    for (size_t i = 0; i < corrections.size(); ++i) {
      point.arguments =
          corrections[i].ofAll ? std::span<const double>(values, 3) : std::span<const double>(values + i, 1);
      out[i] = corrections[i].program->evaluate(point, state);
    }
  };
  if (const auto* values = std::get_if<Values>(&f.what)) {
    values->program->evaluate(point, state, out);
  } else if (const auto* data = std::get_if<Data>(&f.what)) {
    std::array<double, rad::DataFile::kMaxDimensions> coordinates{};
    const std::span<double> place(coordinates.data(), data->coordinates->outputs());
    data->coordinates->evaluate(point, state, place);
    checkCoordinates(place, state);
    std::array<double, 3> found{};
    for (size_t i = 0; i < data->tables.size() && state.faults == 0; ++i)
      found[i] = i > 0 && data->tables[i] == data->tables[0] ? found[0] : data->tables[i]->value(place);
    if (state.faults == 0) correct(data->corrections, found.data());
  } else if (const auto* image = std::get_if<Image>(&f.what)) {
    std::array<double, 2> xy{};
    image->coordinates->evaluate(point, state, xy);
    checkCoordinates(xy, state);
    if (state.faults == 0) {
      const Color color = image->picture->value(xy[0], xy[1]);
      const std::array<double, 3> found{color.x, color.y, color.z};
      correct(image->corrections, found.data());
    }
  }
  return computed(modifier, scratch, std::span(out).first(f.results));
}

Color SurfaceFunctions::pattern(ModifierId modifier, const FunctionPoint& at,
                                FunctionScratch& scratch) const {
  const Function& f = ready(modifier);
  if (f.results == 0) [[unlikely]]
    return spectralPattern(modifier, f, at, scratch);
  std::array<double, 3> v;
  if (!evaluate(modifier, f, at, scratch, v)) return Color(1, 1, 1);
  return f.results == 1 ? Color(v[0], v[0], v[0]) : Color(v[0], v[1], v[2]);
}

Color SurfaceFunctions::patterns(ModifierId first, const FunctionPoint& at, FunctionScratch& scratch) const {
  Color product(1, 1, 1);
  for (ModifierId i = first; i != kNone; i = scene_.modifiers[i].next) product *= pattern(i, at, scratch);
  return product;
}

bool SurfaceFunctions::dependsOnPlaceAlone(ModifierId pattern) const {
  using namespace rad::calc;
  return (ready(pattern).needs & (bits(Dx, 3) | bits(T, 1) | bits(Rdot, 1) | bits(Ts, 1))) == 0;
}

bool SurfaceFunctions::dependsOnDistance(ModifierId pattern) const {
  using namespace rad::calc;
  return (ready(pattern).needs & (bits(T, 1) | bits(Ts, 1))) != 0;
}

Color SurfaceFunctions::spectralPattern(ModifierId modifier, const Function& f, const FunctionPoint& at,
                                        FunctionScratch& scratch) const {
  if (const auto* constant = std::get_if<ConstantSpectrum>(&f.what)) return constant->color;
  setInputs(f, at, scratch);
  calc::Point point{scratch.inputs, realsOf(modifier), {}};
  if (const auto* function = std::get_if<SpectralFunction>(&f.what)) {
    if (function->bins == 0) {
      warn(modifier, "its wavelengths are outside the limits of the spectrum (-cw): it is ignored");
      return Color(1, 1, 1);
    }
    evaluateSpectrum(*function, point, scratch);
    if (!computed(modifier, scratch, scratch.spectrum)) return Color(1, 1, 1);
    return colorOf({scratch.spectrum, function->shortest, function->longest});
  }
  const auto& data = std::get<SpectralData>(f.what);
  evaluateSpectrum(data, point, scratch);
  if (!computed(modifier, scratch, scratch.spectrum)) return Color(1, 1, 1);
  if (!data.unevenWavelengths.empty())
    return colorOf(SpectralCurve{data.unevenWavelengths, scratch.spectrum});
  return colorOf(betweenMiddles(scratch.spectrum, data.firstWavelength, data.lastWavelength));
}

// RADIANCE draws a random wavelength in each bin. The mean of two fixed wavelengths equals the mean of these
// draws up to third order in the wavelength.
void SurfaceFunctions::evaluateSpectrum(const SpectralFunction& f, calc::Point& point,
                                        FunctionScratch& scratch) const {
  scratch.spectrum.resize(f.bins);
  for (size_t i = 0; i < f.bins && scratch.state.faults == 0; ++i) {
    double sum = 0;
    for (const double part : {.25, .75}) {
      const double wavelength = f.longest - (static_cast<double>(i) + part) * f.step;
      point.arguments = {&wavelength, 1};
      sum += f.program->evaluate(point, scratch.state);
    }
    scratch.spectrum[f.bins - 1 - i] = sum / 2;
  }
}

void SurfaceFunctions::evaluateSpectrum(const SpectralData& data, calc::Point& point,
                                        FunctionScratch& scratch) const {
  calc::State& state = scratch.state;
  std::array<double, rad::DataFile::kMaxDimensions> place{};
  const size_t coordinates = data.coordinates->outputs();
  data.coordinates->evaluate(point, state, std::span(place).first(coordinates));
  checkCoordinates(std::span(place).first(coordinates), state);
  if (state.faults > 0) return;
  scratch.spectrum.resize(data.count);
  if (data.picture) data.picture->value(place[0], place[1], scratch.spectrum);
  for (size_t i = 0; i < data.count && state.faults == 0; ++i) {
    double& value = scratch.spectrum[i];
    const double wavelength = data.unevenWavelengths.empty()
                                  ? between(data.firstWavelength, data.lastWavelength, i, data.count)
                                  : data.unevenWavelengths[i];
    if (data.table) {
      place[coordinates] = wavelength;
      value = data.table->value(std::span(place).first(coordinates + 1));
    }
    const std::array arguments{value, wavelength};
    point.arguments = arguments;
    value = data.correction->evaluate(point, state);
  }
}

Color SurfaceFunctions::colorOf(const Spectrum& spectrum) const {
  if (sampling_) return Color(bandsOf(spectrum, *sampling_));
  // In a run of three channels, RADIANCE first resamples spectra that are in ascending order of wavelength or
  // have many values, at about their own resolution. If that is coarse, colors shift by up to a fifth. This
  // is done here as well, because scenes were made with these colors.
  const size_t count = spectrum.values.size();
  if (spectrum.first > spectrum.last && count <= kMostBands) return threeChannels(spectrum);
  const double range = std::abs(spectrum.last - spectrum.first);
  const double bands = static_cast<double>(count) * (limits_.longest - limits_.shortest) / range + .99;
  const int resampled = static_cast<int>(std::clamp(bands, 3., double{kMostBands}));
  return threeChannels(
      spectrumOf(bandsOf(spectrum, spectralSampling(resampled, limits_.shortest, limits_.longest))));
}

// RADIANCE samples data of unevenly spaced wavelengths at even steps, which misses spectral lines. Here the
// means over bands are exact.
Color SurfaceFunctions::colorOf(const SpectralCurve& curve) const {
  if (sampling_) return Color(bandsOf(curve, *sampling_));
  return threeChannels(
      spectrumOf(bandsOf(curve, spectralSampling(kMostBands, limits_.shortest, limits_.longest))));
}

V3d SurfaceFunctions::texture(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const {
  const Function& f = ready(modifier);
  std::array<double, 3> v;
  if (!evaluate(modifier, f, at, scratch, v)) return V3d(0, 0, 0);
  const V3d own(v[0], v[1], v[2]);
  const Placement* placement = placementOf(f, at, scratch);
  return placement ? placement->directionToOuter(own) : own;
}

double SurfaceFunctions::mixture(ModifierId modifier, const FunctionPoint& at,
                                 FunctionScratch& scratch) const {
  std::array<double, 3> v;
  if (!evaluate(modifier, ready(modifier), at, scratch, v)) return -1;
  return std::clamp(v[0], 0., 1.);
}

std::array<double, 3> SurfaceFunctions::three(ModifierId modifier, ProgramPointer Scatterer::*program,
                                              const FunctionPoint& at, FunctionScratch& scratch) const {
  const Function& f = ready(modifier);
  setInputs(f, at, scratch);
  std::array<double, 3> v{};
  (std::get<Scatterer>(f.what).*program)->evaluate({scratch.inputs, realsOf(modifier), {}}, scratch.state, v);
  return computed(modifier, scratch, v) ? v : std::array<double, 3>{};
}

V3d SurfaceFunctions::orientation(ModifierId modifier, const FunctionPoint& at,
                                  FunctionScratch& scratch) const {
  const auto v = three(modifier, &Scatterer::orientation, at, scratch);
  const Function& f = ready(modifier);
  const V3d own(v[0], v[1], v[2]);
  // As in rtrace, an instance transforms the point and the normal that functions use, but not the direction
  // that they return.
  return f.moved ? f.placement.toOuter.vector(own) : own;
}

double SurfaceFunctions::thickness(ModifierId modifier, const FunctionPoint& at,
                                   FunctionScratch& scratch) const {
  const Function& f = ready(modifier);
  setInputs(f, at, scratch);
  const double own =
      std::get<Scatterer>(f.what).thickness->evaluate({scratch.inputs, realsOf(modifier), {}}, scratch.state);
  if (!computed(modifier, scratch, {&own, 1})) return 0;
  const Placement* placement = placementOf(f, at, scratch);
  return placement ? own * std::abs(placement->toOuter.scale) : own;
}

V3d SurfaceFunctions::up(ModifierId modifier, const FunctionPoint& at, FunctionScratch& scratch) const {
  const auto v = three(modifier, &Scatterer::orientation, at, scratch);
  const Placement* placement = placementOf(ready(modifier), at, scratch);
  const V3d own(v[0], v[1], v[2]);
  return placement ? placement->directionToOuter(own) : own;
}

const BsdfData& SurfaceFunctions::bsdf(ModifierId modifier) const {
  return *std::get<Scatterer>(ready(modifier).what).bsdf;
}

std::array<double, 3> SurfaceFunctions::reflection(ModifierId modifier, const FunctionPoint& at,
                                                   FunctionScratch& scratch) const {
  return three(modifier, &Scatterer::reflection, at, scratch);
}

std::array<double, 3> SurfaceFunctions::transmission(ModifierId modifier, const FunctionPoint& at,
                                                     FunctionScratch& scratch) const {
  return three(modifier, &Scatterer::transmission, at, scratch);
}

Color SurfaceFunctions::distribution(ModifierId modifier, const FunctionPoint& at, const V3d& toSource,
                                     double solidAngle, FunctionScratch& scratch) const {
  const Function& f = ready(modifier);
  const Scatterer& s = std::get<Scatterer>(f.what);
  setInputs(f, at, scratch);
  calc::State& state = scratch.state;
  const Placement* placement = placementOf(f, at, scratch);
  const V3d own = placement ? placement->directionToInner(toSource) : toSource;
  std::array<double, 5> arguments{0, own.x, own.y, own.z, solidAngle};
  const std::span<const double> ofSource = std::span(arguments).subspan(1);
  calc::Point point{scratch.inputs, realsOf(modifier), ofSource};
  if (s.table) {
    std::array<double, rad::DataFile::kMaxDimensions> place{};
    for (size_t i = 0; i < s.coordinates.size(); ++i) place[i] = s.coordinates[i]->evaluate(point, state);
    checkCoordinates(std::span(place).first(s.coordinates.size()), state);
    if (state.faults == 0) arguments[0] = s.table->value({place.data(), s.coordinates.size()});
    point.arguments = arguments;
  }
  Color value(0, 0, 0);
  for (int i = 0; i < (s.gray ? 1 : 3) && state.faults == 0; ++i)
    if (s.distribution[static_cast<size_t>(i)])
      value[i] = s.distribution[static_cast<size_t>(i)]->evaluate(point, state);
  if (!computed(modifier, scratch, std::array{value.x, value.y, value.z})) return Color(0, 0, 0);
  return s.gray ? Color(value.x, value.x, value.x) : value;
}

SurfaceFunctions::Redirection SurfaceFunctions::redirection(ModifierId modifier, int image,
                                                            const FunctionPoint& at,
                                                            FunctionScratch& scratch) const {
  const Function& f = ready(modifier);
  setInputs(f, at, scratch);
  std::array<double, 4> v{};
  std::get<Redirector>(f.what).programs[static_cast<size_t>(image)]->evaluate(
      {scratch.inputs, realsOf(modifier), {}}, scratch.state, v);
  const V3d own(v[1], v[2], v[3]);
  const Placement* placement = placementOf(f, at, scratch);
  const V3d direction = placement ? placement->directionToOuter(own) : own;
  const double length = direction.length();
  if (!(length > 0)) ++scratch.state.faults;
  if (!computed(modifier, scratch, v)) return {};
  return {v[0], direction / length};
}

}  // namespace rsphere
