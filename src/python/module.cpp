// The compiled part of the Python package rsphere: converts from and to NumPy arrays on the public library.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <charconv>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/help.h"
#include "python/options.h"
#include "rsphere/scene.h"

namespace py = pybind11;

namespace rsphere::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// The text of an error or a warning, adapted to Python: it refers to Python's help instead of the command's,
// and to options instead of a command line; it counts records from 0, as arrays do.
std::string forPython(std::string text) {
  constexpr std::string_view kCommand = "command line error at ";
  if (text.starts_with(kCommand)) text.replace(0, kCommand.size(), "option ");
  constexpr std::string_view kHelp = "see -help";
  if (std::string_view(text).ends_with(kHelp))
    text.replace(text.size() - kHelp.size(), kHelp.size(), "see help(rsphere.Scene)");
  constexpr std::string_view kRecord = "record ";
  for (size_t at = text.find(kRecord); at != std::string::npos; at = text.find(kRecord, at + 1)) {
    size_t number = 0;
    const char* const digits = text.data() + at + kRecord.size();
    const auto [end, error] = std::from_chars(digits, text.data() + text.size(), number);
    if (error == std::errc() && number > 0)
      text.replace(at, size_t(end - text.data()) - at, "index " + std::to_string(number - 1));
  }
  return text;
}

// Whether a signal has arrived that raises an exception in Python, such as KeyboardInterrupt.
bool interrupted() {
  const py::gil_scoped_acquire lock;
  return PyErr_CheckSignals() != 0;
}

// Calls `work` without the interpreter lock. Warnings become Python warnings. Ctrl-C ends the work.
template <typename SomeOptions, typename Work>
auto withoutLock(SomeOptions& options, const Work& work) {
  if constexpr (requires { options.stop; }) options.stop = interrupted;
  std::vector<std::string> warnings;
  options.warn = [&](std::string_view text) { warnings.push_back(forPython(std::string(text))); };
  const auto issue = [&] {
    for (const std::string& text : warnings)
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  };
  try {
    auto result = [&] {
      const py::gil_scoped_release released;
      return work();
    }();
    if (PyErr_Occurred()) throw py::error_already_set();  // interrupted when the work was all but done
    issue();
    return result;
  } catch (const Error& error) {
    if (error.cause() == Error::Cause::stopped && PyErr_Occurred()) throw py::error_already_set();
    issue();
    throw;
  }
}

// The array of a quantity, whose memory it takes over. It has a row for each record, divided by each of
// `parts` that is not 0 (contributors, faces); rows of a single number become that number. None if the
// quantity was not requested.
py::object arrayOf(Quantity&& quantity, size_t records, std::initializer_list<size_t> parts = {}) {
  if (quantity.columns == 0) return py::none();
  std::vector<size_t> shape{records};
  size_t columns = quantity.columns;
  for (const size_t part : parts) {
    if (part == 0) continue;
    shape.push_back(part);
    columns /= part;
  }
  if (columns > 1) shape.push_back(columns);
  auto* const numbers = new std::vector<double>(std::move(quantity.numbers));
  const py::capsule owner(numbers, [](void* p) { delete static_cast<std::vector<double>*>(p); });
  return py::array_t<double>(shape, numbers->data(), owner);
}

py::object arrayOf(const std::vector<std::string>& names) {
  if (names.empty()) return py::none();
  return py::module_::import("numpy").attr("array")(names);
}

// The numbers of an array or of lists. Raises TypeError or ValueError if they are not plain real numbers,
// because imaginary parts and masks would be lost.
Numbers numbersOf(const py::object& array, const std::string& name) {
  const py::module_ numpy = py::module_::import("numpy");
  if (py::isinstance(array, numpy.attr("ma").attr("MaskedArray")))
    throw py::type_error(name + " must not be a masked array: choose the rows, and pass array.data");
  if (numpy.attr("iscomplexobj")(array).cast<bool>())
    throw py::type_error(name + " must be real numbers, not complex");
  if (const auto kind = numpy.attr("asarray")(array).attr("dtype").attr("kind").cast<std::string>();
      kind == "b" || kind == "M" || kind == "m")
    throw py::type_error(name + " must be numbers, not truth values or dates");
  return array.cast<Numbers>();
}

// A required argument. Raises TypeError if it is missing. needs: what the method needs, and an example.
const py::object& required(const py::object& argument, const char* needs) {
  if (argument.is_none()) throw py::type_error(needs);
  return argument;
}

// Whether __init__() of a Scene has been called. It has not after Scene.__new__(Scene).
bool isMade(const py::object& self) {
  return reinterpret_cast<py::detail::instance*>(self.ptr())->get_value_and_holder().holder_constructed();
}

// The scene of a method. Objects of other classes have none.
const Scene& sceneOf(const py::object& self) {
  if (!py::isinstance<Scene>(self)) throw py::type_error("this method belongs to a Scene");
  if (!isMade(self)) throw py::type_error("the Scene has no files: it must be made by Scene(files)");
  return self.cast<const Scene&>();
}

// The records of an array as structs of doubles.
template <typename Record>
std::span<const Record> recordsOf(const Numbers& array, const char* name) {
  constexpr py::ssize_t kColumns = sizeof(Record) / sizeof(double);
  if (array.ndim() != 2 || array.shape(1) != kColumns)
    throw py::value_error(std::string(name) + " must be an array of shape (n, " + std::to_string(kColumns) +
                          ")");
  return {reinterpret_cast<const Record*>(array.data()), static_cast<size_t>(array.shape(0))};
}

py::object answersObject(const py::dict& arrays) {
  return py::module_::import("rsphere.answers").attr("Answers")(**arrays);
}

py::object trace(const py::object& self, const py::object& given, const py::kwargs& keywords) {
  const Scene& scene = sceneOf(self);
  const Numbers array = numbersOf(required(given, "trace() needs rays: an array of shape (n, 6)"), "rays");
  const std::span<const Ray> rays = recordsOf<Ray>(array, "rays");
  Options options = optionsOf(keywords);
  RayAnswers a = withoutLock(options, [&] { return scene.trace(rays, options); });
  py::dict arrays;
  arrays["value"] = arrayOf(std::move(a.value), a.size);
  arrays["standard_error"] = arrayOf(std::move(a.standardError), a.size);
  arrays["origin"] = arrayOf(std::move(a.origin), a.size);
  arrays["direction"] = arrayOf(std::move(a.direction), a.size);
  arrays["point"] = arrayOf(std::move(a.point), a.size);
  arrays["normal"] = arrayOf(std::move(a.normal), a.size);
  arrays["unperturbed_normal"] = arrayOf(std::move(a.unperturbedNormal), a.size);
  arrays["first_length"] = arrayOf(std::move(a.firstLength), a.size);
  arrays["effective_length"] = arrayOf(std::move(a.effectiveLength), a.size);
  arrays["local_coordinates"] = arrayOf(std::move(a.localCoordinates), a.size);
  arrays["weight"] = arrayOf(std::move(a.weight), a.size);
  arrays["coefficient"] = arrayOf(std::move(a.coefficient), a.size);
  arrays["contribution"] = arrayOf(std::move(a.contribution), a.size);
  arrays["mirrored_value"] = arrayOf(std::move(a.mirroredValue), a.size);
  arrays["mirrored_length"] = arrayOf(std::move(a.mirroredLength), a.size);
  arrays["unmirrored_value"] = arrayOf(std::move(a.unmirroredValue), a.size);
  arrays["unmirrored_length"] = arrayOf(std::move(a.unmirroredLength), a.size);
  arrays["surface"] = arrayOf(a.surface);
  arrays["modifier"] = arrayOf(a.modifier);
  arrays["material"] = arrayOf(a.material);
  return answersObject(arrays);
}

py::object arraysOf(PointAnswers&& a) {
  const size_t parts = a.contributors.size();
  py::dict arrays;
  arrays["contributors"] = parts > 0 ? py::object(py::cast(a.contributors)) : py::none();
  // A quantity and its standard error, with as many colors for each contributor; 0: one.
  const auto add = [&](const std::string& name, Quantity& value, Quantity& error, size_t colors = 0) {
    arrays[name.c_str()] = arrayOf(std::move(value), a.size, {parts, colors});
    arrays[(name + "_standard_error").c_str()] = arrayOf(std::move(error), a.size, {parts, colors});
  };
  add("mean", a.mean, a.meanStandardError);
  add("scalar_irradiance", a.scalarIrradiance, a.scalarIrradianceStandardError);
  add("cylindrical_irradiance", a.cylindricalIrradiance, a.cylindricalIrradianceStandardError);
  add("semicylindrical_irradiance", a.semicylindricalIrradiance, a.semicylindricalIrradianceStandardError);
  add("hemispherical_irradiance", a.hemisphericalIrradiance, a.hemisphericalIrradianceStandardError);
  add("face_irradiance", a.faceIrradiance, a.faceIrradianceStandardError, 6);
  add("light_vector", a.lightVector, a.lightVectorStandardError);
  add("bins", a.zones, a.zonesStandardError, a.zoneCount);
  arrays["bins_solid_angle"] =
      a.zoneCount > 0 ? py::object(py::array_t<double>(py::ssize_t(a.zoneCount), a.zoneSolidAngles.data()))
                      : py::none();
  arrays["directions"] = arrayOf(std::move(a.directions), a.size);
  arrays["point"] = arrayOf(std::move(a.point), a.size);
  if (!arrays["directions"].is_none()) arrays["directions"] = arrays["directions"].attr("astype")("int64");
  return answersObject(arrays);
}

py::object sphere(const py::object& self, const py::object& given, const py::kwargs& keywords) {
  const Scene& scene = sceneOf(self);
  const Numbers array =
      numbersOf(required(given, "sphere() needs points: an array of shape (n, 3)"), "points");
  const std::span<const Point> points = recordsOf<Point>(array, "points");
  Options options = optionsOf(keywords);
  return arraysOf(withoutLock(options, [&] { return scene.sphere(points, options); }));
}

// Whether all items are names of modifiers. Raises TypeError for a single name, because its letters would be
// taken for names.
bool areNames(const py::object& given, const std::string& argument) {
  if (py::isinstance<py::str>(given))
    throw py::type_error(argument + " must be a list: [" + py::repr(given).cast<std::string>() + "]");
  if (!py::isinstance<py::sequence>(given)) return false;
  for (const py::handle& item : given)
    if (!py::isinstance<py::str>(item)) return false;
  return true;
}

py::object importance(const py::object& self, const py::object& given, const py::object& goals,
                      const py::kwargs& keywords) {
  const Scene& scene = sceneOf(self);
  const Numbers array =
      numbersOf(required(given, "importance() needs points: an array of shape (n, 3)"), "points");
  required(goals, "importance() needs goals: a list of modifiers, or sensors as an array of shape (n, 6)");
  const std::span<const Point> points = recordsOf<Point>(array, "points");
  Options options = optionsOf(keywords);
  if (areNames(goals, "goals")) {
    const auto names = goals.cast<std::vector<std::string>>();
    return arraysOf(withoutLock(options, [&] { return scene.importance(points, names, options); }));
  }
  const Numbers numbers = numbersOf(goals, "goals");
  const std::span<const Sensor> sensors = recordsOf<Sensor>(numbers, "goals that are sensors");
  return arraysOf(withoutLock(options, [&] { return scene.importanceOfSensors(points, sensors, options); }));
}

// Eyes and gazes from arrays; a single gaze applies to all eyes.
std::vector<Ray> eyesOf(const Numbers& eyes, const Numbers& gazes) {
  const std::span<const Point> places = recordsOf<Point>(eyes, "eyes");
  const bool one = gazes.ndim() == 1 && gazes.shape(0) == 3;
  if (!one && (gazes.ndim() != 2 || gazes.shape(1) != 3 || gazes.shape(0) != eyes.shape(0)))
    throw py::value_error("gazes must be an array of shape (n, 3) as eyes, or one gaze of three numbers");
  std::vector<Ray> rays;
  for (size_t i = 0; i < places.size(); ++i) {
    const double* const gaze = gazes.data() + (one ? 0 : 3 * i);
    rays.push_back({places[i], {gaze[0], gaze[1], gaze[2]}});
  }
  return rays;
}

py::object sourcesOf(const std::vector<GlareSource>& sources) {
  Quantity directions{3, {}};
  py::dict arrays;
  std::vector<std::string> surfaces;
  const auto add = [&](const char* name, double GlareSource::*member) {
    Quantity quantity{1, {}};
    for (const GlareSource& source : sources) quantity.numbers.push_back(source.*member);
    arrays[name] = arrayOf(std::move(quantity), sources.size());
  };
  for (const GlareSource& source : sources) {
    directions.numbers.insert(directions.numbers.end(), source.direction.begin(), source.direction.end());
    surfaces.push_back(source.surface);
  }
  arrays["direction"] = arrayOf(std::move(directions), sources.size());
  add("luminance", &GlareSource::luminance);
  add("luminance_standard_error", &GlareSource::luminanceStandardError);
  add("solid_angle", &GlareSource::solidAngle);
  add("solid_angle_standard_error", &GlareSource::solidAngleStandardError);
  add("position_index", &GlareSource::positionIndex);
  arrays["surface"] = py::cast(surfaces);
  return answersObject(arrays);
}

py::object glare(const py::object& self, const py::object& eyes, const py::object& gazes,
                 const py::kwargs& keywords) {
  const Scene& scene = sceneOf(self);
  required(eyes, "glare() needs eyes: an array of shape (n, 3)");
  required(
      gazes,
      "glare() needs gazes: the directions in which the eyes look, an array of shape (n, 3), or one gaze "
      "of three numbers for all");
  const std::vector<Ray> rays = eyesOf(numbersOf(eyes, "eyes"), numbersOf(gazes, "gazes"));
  Options options = optionsOf(keywords);
  GlareAnswers a = withoutLock(options, [&] { return scene.glare(rays, options); });
  py::dict arrays;
  arrays["ugr"] = arrayOf(std::move(a.unifiedGlareRating), a.size);
  arrays["ugr_standard_error"] = arrayOf(std::move(a.ugrStandardError), a.size);
  arrays["illuminance"] = arrayOf(std::move(a.illuminance), a.size);
  arrays["illuminance_standard_error"] = arrayOf(std::move(a.illuminanceStandardError), a.size);
  arrays["background"] = arrayOf(std::move(a.background), a.size);
  arrays["background_standard_error"] = arrayOf(std::move(a.backgroundStandardError), a.size);
  arrays["dgp"] = arrayOf(std::move(a.daylightGlareProbability), a.size);
  arrays["dgp_standard_error"] = arrayOf(std::move(a.dgpStandardError), a.size);
  arrays["threshold"] = arrayOf(std::move(a.threshold), a.size);
  py::list sources;
  for (const std::vector<GlareSource>& ofEye : a.sources) sources.append(sourcesOf(ofEye));
  arrays["sources"] = sources;
  return answersObject(arrays);
}

py::object contributions(const py::object& self, const py::object& given, const py::object& of,
                         const py::object& bins, const py::object& samples, const py::object& coefficients,
                         const py::kwargs& keywords) {
  const Scene& scene = sceneOf(self);
  const Numbers array =
      numbersOf(required(given, "contributions() needs rays: an array of shape (n, 6)"), "rays");
  required(of, "contributions() needs of: the modifiers that contribute, a list such as [\"sky\", \"lamp\"]");
  if (!areNames(of, "of")) throw py::type_error("of must be a list of modifiers: [\"sky\", \"lamp\"]");
  if (keywords.contains("values"))
    throw py::type_error("contributions() gives values unless coefficients=True; there is no 'values'");
  const auto modifiers = of.cast<std::vector<std::string>>();
  const std::span<const Ray> rays = recordsOf<Ray>(array, "rays");
  ContributionOptions options;
  static_cast<Options&>(options) = optionsOf(keywords);
  options.bins = binsOf(bins);
  options.samples = wholeNumberOf(samples, "samples");
  options.coefficients = truthOf(coefficients, "coefficients");
  Contributions a = withoutLock(options, [&] { return scene.contributions(rays, modifiers, options); });
  py::dict arrays;
  arrays["modifiers"] = py::cast(a.modifiers);
  arrays["value"] = arrayOf(std::move(a.value), a.size, {modifiers.size(), a.bins});
  arrays["standard_error"] = arrayOf(std::move(a.standardError), a.size, {modifiers.size(), a.bins});
  return answersObject(arrays);
}

// The middle directions of zones.
py::object zoneMiddlesOf(const py::object& given) {
  const int whole = wholeNumberOf(given, "count");
  if (whole < 1) throw py::value_error("count must be at least 1, not " + std::to_string(whole));
  const auto count = static_cast<size_t>(whole);
  Quantity directions{3, {}};
  for (const std::array<double, 3>& middle : zoneMiddles(count))
    directions.numbers.insert(directions.numbers.end(), middle.begin(), middle.end());
  return arrayOf(std::move(directions), count);
}

std::unique_ptr<Scene> readScene(const py::object& files, const py::args& more, const py::object& commands,
                                 const py::object& goals) {
  if (!more.empty())
    throw py::type_error("Scene() takes several files as one list: Scene([\"sky.rad\", \"room.rad\"])");
  required(files, "Scene() needs files: one octree, scene files, or '!command'; one path or a list");
  if (!areNames(goals, "goals")) throw py::type_error("goals must be a list of modifiers: [\"desk\"]");
  SceneOptions options;
  options.commands = truthOf(commands, "commands");
  options.goals = goals.cast<std::vector<std::string>>();
  const std::vector<std::string> paths = pathsOf(files);
  return withoutLock(options, [&] { return std::make_unique<Scene>(paths, options); });
}

// Replaces __init__() by one that raises TypeError if it is called again: pybind11 ignores such a call, and
// the object would keep its first scene.
void refuseSecondInit(py::class_<Scene>& scene) {
  const py::object init = scene.attr("__init__");
  const auto once = [init](const py::object& self, const py::args& arguments, const py::kwargs& keywords) {
    if (py::isinstance<Scene>(self) && isMade(self))
      throw py::type_error("this Scene has its files already: other files make another Scene(files)");
    init(self, *arguments, **keywords);
  };
  const auto text = init.attr("__doc__").cast<std::string>();
  scene.attr("__init__") = py::cpp_function(once, py::name("init"), py::is_method(scene), text.c_str());
}

py::object photometricOf(const py::object& given) {
  const Numbers color = numbersOf(required(given,
                                           "photometric() needs color: an array of shape (..., 3); "
                                           "quantities that were not requested are None"),
                                  "color");
  const py::module_ numpy = py::module_::import("numpy");
  if (color.ndim() < 1 || color.shape(color.ndim() - 1) != 3)
    throw py::value_error("color must be an array of shape (..., 3), not " +
                          std::string(py::str(color.attr("shape"))));
  return numpy.attr("dot")(color, numpy.attr("array")(kBrightnessWeights)) * py::float_(kLumensPerWatt);
}

// Creates the exception rsphere.Error, with the members of the library's Error.
void addError(py::module_& m) {
  static PyObject* type = nullptr;  // lives as long as the interpreter
  type = PyErr_NewExceptionWithDoc(
      "rsphere.Error",
      "A fault in the scene, the options or the records. Its text begins with the place: room.rad:12: ...\n\n"
      "file, line: that place; line is None for a file that cannot be opened, and both if the fault has no "
      "place.\n"
      "cause: 'input', or 'system' if a file cannot be opened or memory or threads are short.",
      PyExc_Exception, nullptr);
  m.attr("Error") = py::handle(type);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      const py::object instance = py::handle(type)(forPython(error.what()));
      instance.attr("file") = error.file().empty() ? py::object(py::none()) : py::str(error.file());
      instance.attr("line") = error.line() == 0 ? py::object(py::none()) : py::int_(error.line());
      instance.attr("cause") = error.cause() == Error::Cause::input ? "input" : "system";
      PyErr_SetObject(type, instance.ptr());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_rsphere, m) {
  m.attr("__name__") = "rsphere";  // where users find what is defined below
  py::options texts;
  texts.disable_function_signatures();  // the texts have them, with the types that are meant
  m.attr("__version__") = version();
  addError(m);
  const auto withOptions = [](const char* text) { return std::string(text) + kOptions; };
  py::class_<Scene> scene(m, "Scene", kScene);
  scene
      .def(py::init(&readScene), py::arg("files") = py::none(), py::arg("commands") = true,
           py::arg("goals") = std::vector<std::string>(), kInit)
      .def("trace", &trace, py::arg("rays") = py::none(), withOptions(kTrace).c_str())
      .def("sphere", &sphere, py::arg("points") = py::none(), withOptions(kSphere).c_str())
      .def("importance", &importance, py::arg("points") = py::none(), py::arg("goals") = py::none(),
           withOptions(kImportance).c_str())
      .def("glare", &glare, py::arg("eyes") = py::none(), py::arg("gazes") = py::none(),
           withOptions(kGlare).c_str())
      .def("contributions", &contributions, py::arg("rays") = py::none(), py::arg("of") = py::none(),
           py::kw_only(), py::arg("bins") = py::none(), py::arg("samples") = 8,
           py::arg("coefficients") = false, withOptions(kContributions).c_str());
  refuseSecondInit(scene);
  m.def("zone_middles", &zoneMiddlesOf, py::arg("count"),
        "zone_middles(count: int) -> array (count, 3)\n\n"
        "The directions (count, 3) in the middle of zones of equal solid angle, 4 pi / count sr each.");
  m.def("photometric", &photometricOf, py::arg("color"),
        "photometric(color: array (..., 3)) -> array (...)\n\n"
        "Turns colors (..., 3) of radiance (W/sr/m2) into luminance (cd/m2), and of irradiance (W/m2) into "
        "illuminance (lx).");
  m.attr("LUMENS_PER_WATT") = kLumensPerWatt;
  m.attr("__name__") = "rsphere._rsphere";
}

}  // namespace rsphere::python
