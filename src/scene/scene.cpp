#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <unordered_map>

#include "base/constants.h"

namespace rsphere {
namespace {

using rad::Place;
using rad::Primitive;
using rad::printable;
using rad::Type;

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }
double coneSolidAngle(double fullAngleDegrees) {
  // 4 pi sin^2(a/4) equals 2 pi (1 - cos(a/2)), but does not suffer from cancellation for small cones.
  const double s = std::sin(radians(fullAngleDegrees) / 4);
  return 4 * std::numbers::pi * s * s;
}

class Builder {
 public:
  Builder(rad::Description description, const rad::ReadOptions& options)
      : options_(options), warn_(options.warn) {
    scene_.description = std::move(description);
    scene_.files = options.files;
  }

  Scene build() {
    addGroup(0);
    // Octrees that instances name, including those named by other octrees; then the meshes of them all.
    for (size_t i = 0; i < octrees_.size(); ++i) {
      const Place from = primitive(octrees_[i].namedBy).place;
      addGroup(adopt(read(octrees_[i].namedBy, [&] { return rad::readOctree(octrees_[i].file, options_); }),
                     from));
    }
    checkNesting();
    for (size_t i = 0; i < meshes_.size(); ++i) addMesh(meshes_[i]);
    for (Surface& surface : scene_.surfaces) {
      const auto clip = clipOf_.find(primitive(surface.primitive).modifier);
      if (clip != clipOf_.end()) surface.clip = clip->second;
    }
    dropSurfaceNumbers();
    return std::move(scene_);
  }

 private:
  static constexpr ModifierId kUnknown{-2};  // not converted yet
  static constexpr int kUnmeasured = -2;
  static constexpr int kDeepest = 64;

  // A file that primitives name, and the first primitive that names it.
  struct NamedFile {
    std::string file;
    PrimitiveId namedBy;
  };

  const Primitive& primitive(PrimitiveId i) const { return scene_.description.primitives[i]; }
  std::span<const double> reals(PrimitiveId i) const { return scene_.description.reals(primitive(i)); }

  [[noreturn]] void fail(PrimitiveId i, std::string_view what) const {
    throw rad::Error(fmt::format("{}: {}", scene_.place(i), what));
  }
  void warn(PrimitiveId i, std::string_view what) const {
    if (warn_) warn_(fmt::format("{}: {}", scene_.place(i), what));
  }

  void needReals(PrimitiveId i, size_t count) const {
    if (reals(i).size() != count)
      fail(i, fmt::format("expected {} real arguments, got {}", count, reals(i).size()));
  }
  void needStrings(PrimitiveId i, size_t most) const {
    if (primitive(i).strings > most)
      fail(i, fmt::format("expected at most {} string arguments, got {}", most, primitive(i).strings));
  }
  V3d vector(PrimitiveId i, size_t at) const {
    const auto r = reals(i);
    return V3d(r[at], r[at + 1], r[at + 2]);
  }
  Rgb color(PrimitiveId i, size_t at) const {
    const auto r = reals(i);
    return Rgb(r[at], r[at + 1], r[at + 2]);
  }

  // ---- modifiers

  // Index in the description of the latest definition of a modifier before primitive i; rad::kVoid
  // if there is none.
  PrimitiveId definedBefore(PrimitiveId i, std::string_view name) {
    if (!index_) index_.emplace(scene_.description, firstPrimitive_);
    return index_->before(name, i);
  }

  // The modifier that a string argument of primitive i names: its latest definition before i; kNone for void.
  ModifierId named(PrimitiveId i, size_t argument) {
    const std::string_view name = scene_.description.string(primitive(i), argument);
    if (name == "void") return kNone;
    const PrimitiveId described = definedBefore(i, name);
    if (described == rad::kVoid) fail(i, fmt::format("undefined modifier \"{}\"", printable(name)));
    // A ray that hits nested modifiers recurses as deeply, and splits into up to 2^depth evaluations.
    if (depth_ == kDeepest) fail(i, fmt::format("modifiers name each other more than {} deep", kDeepest));
    ++depth_;
    const ModifierId converted = modifier(described);
    --depth_;
    return converted;
  }

  Antimatter antimatter(PrimitiveId i) {
    needAtLeast(i, 1);
    Antimatter made;
    for (uint32_t k = 0; k < primitive(i).strings; ++k) {
      const std::string_view name = scene_.description.string(primitive(i), k);
      if (name == "void") continue;
      const PrimitiveId described = definedBefore(i, name);
      if (described == rad::kVoid) {
        warn(i, fmt::format("unknown modifier \"{}\"", printable(name)));
        continue;
      }
      const auto [clip, added] = clipOf_.try_emplace(described, uint64_t{1} << (clipOf_.size() % 64));
      if (added && clipOf_.size() > 64) fail(i, "more than 64 modifiers are clipped by antimatter");
      made.clips |= clip->second;
      if (k == 0) made.cut = {Alternate::Kind::modifier, named(i, 0)};
    }
    return made;
  }

  Mist mist(PrimitiveId i) {
    const auto r = reals(i);
    if (r.size() > 7) fail(i, fmt::format("expected at most 7 real arguments, got {}", r.size()));
    if (primitive(i).strings > 32)
      fail(i, fmt::format("expected at most 32 light sources, got {}", primitive(i).strings));
    Mist made;
    if (r.size() > 2) made.extinction = color(i, 0);
    made.hasAlbedo = r.size() > 5;
    if (made.hasAlbedo) made.albedo = color(i, 3);
    made.hasEccentricity = r.size() > 6;
    if (made.hasEccentricity) made.eccentricity = r[6];
    for (uint32_t k = 0; k < primitive(i).strings; ++k)
      made.sources.emplace_back(scene_.description.string(primitive(i), k));
    made.number = mists_++;
    return made;
  }

  // The alternate material that mirror and illum name.
  Alternate alternate(PrimitiveId i) {
    if (primitive(i).strings == 0) return {};
    if (scene_.description.string(primitive(i), 0) == "void") return {Alternate::Kind::pass, kNone};
    return {Alternate::Kind::modifier, named(i, 0)};
  }

  void needAtLeast(PrimitiveId i, size_t strings, size_t realArguments = 0) const {
    if (primitive(i).strings < strings)
      fail(i, fmt::format("expected at least {} string arguments, got {}", strings, primitive(i).strings));
    if (reals(i).size() < realArguments)
      fail(i, fmt::format("expected at least {} real arguments, got {}", realArguments, reals(i).size()));
  }

  // A string argument's value if it is a number, otherwise this bound.
  double numberOr(PrimitiveId i, size_t argument, double otherwise) const {
    const std::string_view word = scene_.description.string(primitive(i), argument);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? value : otherwise;
  }

  // The modifier that WGMDfunc names for a component. A component that reflects or transmits
  // nothing needs none.
  std::optional<ModifierId> componentModifier(PrimitiveId i, size_t argument, bool used) {
    if (!used || scene_.description.string(primitive(i), argument) == "inherit") return std::nullopt;
    return named(i, argument);
  }
  WgmdFunction::Lobe lobe(PrimitiveId i, size_t argument) {
    const double share = numberOr(i, argument + 1, 1);
    return {share, numberOr(i, argument + 2, 0), numberOr(i, argument + 3, 0),
            componentModifier(i, argument, share > kNegligible)};
  }

  Content mixture(PrimitiveId i) {
    const ModifierId foreground = named(i, 0);
    return Mixture{foreground, named(i, 1)};
  }

  Content content(PrimitiveId i) {
    switch (primitive(i).type) {
      case Type::brightfunc:
        needAtLeast(i, 2);
        return Pattern{};
      case Type::colorfunc:
      case Type::brightdata:
        needAtLeast(i, 4);
        return Pattern{};
      case Type::colordata:
        needAtLeast(i, 8);
        return Pattern{};
      case Type::colorpict:
        needAtLeast(i, 7);
        return Pattern{};
      case Type::brighttext:
        needAtLeast(i, 2, 11);
        return Pattern{};
      case Type::colortext:
        needAtLeast(i, 2, 15);
        return Pattern{};
      case Type::texfunc:
        needAtLeast(i, 4);
        return Texture{};
      case Type::texdata:
        needAtLeast(i, 8);
        return Texture{};
      case Type::mixfunc:
        needAtLeast(i, 4);
        return mixture(i);
      case Type::mixdata:
        needAtLeast(i, 6);
        return mixture(i);
      case Type::mixpict:
        needAtLeast(i, 7);
        return mixture(i);
      case Type::mixtext:
        needAtLeast(i, 4, 9);
        return mixture(i);
      default:
        return material(i);
    }
  }

  Material material(PrimitiveId i) {
    switch (primitive(i).type) {
      case Type::plastic:
      case Type::metal:
        needReals(i, 5);
        return Opaque{color(i, 0), reals(i)[3], reals(i)[4], primitive(i).type == Type::metal};
      case Type::trans:
        needReals(i, 7);
        return Trans{color(i, 0), reals(i)[3], reals(i)[4], reals(i)[5], reals(i)[6]};
      case Type::plastic2:
      case Type::metal2:
        needReals(i, 6);
        return anisotropic(i);
      case Type::trans2:
        needReals(i, 8);
        return anisotropic(i);
      case Type::ashik2:
        needReals(i, 8);
        needAtLeast(i, 4);
        if (!(reals(i)[6] > -1 && reals(i)[7] > -1)) fail(i, "specular powers must be above -1");
        return Ashikhmin{color(i, 0), color(i, 3), reals(i)[6], reals(i)[7]};
      case Type::plasfunc:
      case Type::metfunc:
        needAtLeast(i, 2, 4);
        return FunctionScatterer{color(i, 0), reals(i)[3], primitive(i).type == Type::metfunc};
      case Type::plasdata:
      case Type::metdata:
        needAtLeast(i, 4, 4);
        return FunctionScatterer{color(i, 0), reals(i)[3], primitive(i).type == Type::metdata};
      case Type::transfunc:
      case Type::transdata:
        needAtLeast(i, primitive(i).type == Type::transfunc ? 2 : 4, 6);
        return FunctionScatterer{color(i, 0), reals(i)[3], false, reals(i)[4], reals(i)[5]};
      case Type::brtdfunc: {
        needAtLeast(i, 10, 9);
        const auto word = [&](size_t k) { return scene_.description.string(primitive(i), k); };
        const auto most = [&](size_t k) {
          return std::max({numberOr(i, k, 1), numberOr(i, k + 1, 1), numberOr(i, k + 2, 1)});
        };
        return BrtdFunction{color(i, 0),
                            color(i, 3),
                            color(i, 6),
                            word(3) != "0" || word(4) != "0" || word(5) != "0",
                            word(6) != "0" || word(7) != "0" || word(8) != "0",
                            most(0),
                            most(3)};
      }
      case Type::wgmdfunc: {
        needAtLeast(i, 13, 9);
        const bool diffusesThrough = maxChannel(color(i, 6)) > kNegligible;
        return WgmdFunction{color(i, 0),
                            color(i, 3),
                            color(i, 6),
                            lobe(i, 0),
                            lobe(i, 4),
                            componentModifier(i, 8, diffusesThrough),
                            scene_.description.string(primitive(i), 5) != "0"};
      }
      case Type::bsdf:
        needAtLeast(i, 6);
        return bsdf(i);
      case Type::absdf:
        needAtLeast(i, 5);
        return bsdf(i);
      case Type::dielectric:
        needReals(i, 5);
        if (!(reals(i)[3] > 0)) fail(i, "refractive index must be above 0");
        return Dielectric{color(i, 0), reals(i)[3], reals(i)[4]};
      case Type::interface:
        needReals(i, 8);
        if (!(reals(i)[3] > 0 && reals(i)[7] > 0)) fail(i, "refractive index must be above 0");
        return Interface{color(i, 0), reals(i)[3], color(i, 4), reals(i)[7]};
      case Type::glass:
        if (reals(i).size() != 3 && reals(i).size() != 4)
          fail(i, fmt::format("expected 3 or 4 real arguments, got {}", reals(i).size()));
        if (reals(i).size() == 4 && !(reals(i)[3] >= 1)) fail(i, "refractive index must be at least 1");
        return Glass{color(i, 0), reals(i).size() == 4 ? reals(i)[3] : Glass{}.refraction};
      case Type::mirror:
        needReals(i, 3);
        needStrings(i, 1);
        return Mirror{color(i, 0), alternate(i)};
      case Type::prism1:
        needAtLeast(i, 5);
        return Prism{1};
      case Type::prism2:
        needAtLeast(i, 9);
        return Prism{2};
      case Type::antimatter:
        return antimatter(i);
      case Type::mist:
        return mist(i);
      case Type::light:
        needReals(i, 3);
        return Light{color(i, 0)};
      case Type::illum:
        needReals(i, 3);
        needStrings(i, 1);
        return Illum{color(i, 0), alternate(i)};
      case Type::glow:
        needReals(i, 4);
        return Glow{color(i, 0), reals(i)[3]};
      case Type::spotlight: {
        needReals(i, 7);
        if (!(reals(i)[3] > 0)) fail(i, "zero angle");
        const V3d aim = vector(i, 4);
        const double length = aim.length();
        if (!(length > 0)) fail(i, "zero focus vector");
        return Spotlight{color(i, 0), coneSolidAngle(reals(i)[3]), aim / length, length};
      }
      default:
        fail(i, "this type is not supported yet");
    }
  }

  Material bsdf(PrimitiveId i) const {
    const size_t count = reals(i).size();
    if (count > 9 || count % 3) fail(i, fmt::format("expected 0, 3, 6 or 9 real arguments, got {}", count));
    BsdfMaterial m;
    m.aperture = primitive(i).type == Type::absdf;
    m.proxy = !m.aperture && scene_.description.string(primitive(i), 0) != "0";
    if (count >= 3) m.diffuseFront = color(i, 0);
    if (count >= 6) m.diffuseBack = color(i, 3);
    if (count >= 9) m.diffuseTransmitted = color(i, 6);
    return m;
  }

  Material anisotropic(PrimitiveId i) const {
    needAtLeast(i, 4);
    const auto r = reals(i);
    if (!(r[4] > kNegligible && r[5] > kNegligible)) fail(i, "roughness too small");
    Anisotropic m{color(i, 0), r[3], r[4], r[5], primitive(i).type == Type::metal2};
    m.trans = primitive(i).type == Type::trans2;
    if (m.trans) {
      m.transmissivity = r[6];
      m.transmittedSpecular = r[7];
    }
    return m;
  }

  // Converts the modifier at this index of the description and the chain of those that modify
  // it, each only once.
  ModifierId modifier(PrimitiveId described) {
    if (described == rad::kVoid) return kNone;
    // Follows the chain from described to void without recursion, because a file may nest as
    // deeply as it likes.
    std::vector<PrimitiveId> chain;
    PrimitiveId next = described;
    while (next != rad::kVoid && modifierOf_[next] == kUnknown) {
      chain.push_back(next);
      next = primitive(next).modifier;
    }
    ModifierId converted = next == rad::kVoid ? kNone : modifierOf_[next];
    while (!chain.empty()) {
      const PrimitiveId i = chain.back();
      chain.pop_back();
      PrimitiveId target = i;
      while (target != rad::kVoid && primitive(target).type == Type::alias)
        target = primitive(target).aliased != rad::kVoid ? primitive(target).aliased
                 : target == i                           ? rad::kVoid
                                                         : primitive(target).modifier;
      if (target != rad::kVoid) {  // an alias without a target is its modifier
        Content made = content(target);
        tellIndex(made, ModifierId(scene_.modifiers.size()));
        scene_.modifiers.push_back({std::move(made), converted, target});
        converted = scene_.modifiers.last();
      }
      modifierOf_[i] = converted;
    }
    return converted;
  }

  static void tellIndex(Content& content, ModifierId index) {
    if (auto* material = std::get_if<Material>(&content))
      std::visit(
          [index](auto& kind) {
            if constexpr (requires { kind.functions; }) kind.functions = index;
          },
          *material);
  }
  // ---- octrees and meshes

  // Calls a reader of primitive i's file. Its errors get the primitive that named the file appended.
  template <class Read>
  std::invoke_result_t<Read> read(PrimitiveId i, const Read& reader) const {
    try {
      return reader();
    } catch (const rad::Error& error) {
      throw rad::Error(fmt::format("{} (from {})", error.what(), scene_.place(i)), error.status());
    }
  }

  // Appends another file's description; returns the index of its first primitive.
  uint32_t adopt(rad::Description&& description, Place from) {
    const auto first = static_cast<uint32_t>(scene_.description.primitives.size());
    rad::append(scene_.description, std::move(description), from);
    index_.reset();
    return first;
  }

  // Reserves memory for all surfaces from this primitive on. Growing the lists by doubling would touch
  // twice the memory.
  void reserve(uint32_t firstPrimitive) {
    size_t surfaces = 0, coordinates = 0;
    for (const Primitive& p : std::span(scene_.description.primitives).subspan(firstPrimitive)) {
      surfaces += rad::isSurface(p.type);
      if (p.type == Type::polygon) coordinates += p.reals;
    }
    const auto makeRoom = [](auto& list, size_t more) {
      if (list.size() + more > list.capacity())
        list.reserve(std::max(list.size() + more, 2 * list.capacity()));
    };
    makeRoom(scene_.surfaces, surfaces);
    makeRoom(scene_.vertices, coordinates / 3);
  }

  // Removes the numeric arguments of surfaces, which take a fifth of a large scene. Shapes have been made
  // from them, and only those of modifiers are needed again.
  void dropSurfaceNumbers() {
    rad::Description& d = scene_.description;
    std::vector<double> kept;
    for (Primitive& p : d.primitives) {
      if (rad::isSurface(p.type)) p.reals = 0;
      const auto reals = d.reals(p);
      p.firstReal = kept.size();
      kept.insert(kept.end(), reals.begin(), reals.end());
    }
    d.realArgs = std::move(kept);
  }

  // Adds a group: the surfaces among the primitives from this one on.
  void addGroup(uint32_t firstPrimitive) {
    firstPrimitive_ = firstPrimitive;
    const auto& primitives = scene_.description.primitives;
    modifierOf_.resize(primitives.size(), kUnknown);
    const size_t firstSurface = scene_.surfaces.size();
    reserve(firstPrimitive);
    for (const PrimitiveId i : IdRange<PrimitiveId>(firstPrimitive, primitives.size() - firstPrimitive))
      if (rad::isSurface(primitives[i].type)) addSurface(i);
    scene_.groups.push_back({{firstSurface, scene_.surfaces.size() - firstSurface}});
  }

  // The index of a file among those of its kind, in the order in which they are first named.
  static uint32_t numberOf(const std::string& file, PrimitiveId i, std::vector<NamedFile>& files,
                           std::unordered_map<std::string, uint32_t>& numbers) {
    const auto [at, isNew] = numbers.try_emplace(file, static_cast<uint32_t>(files.size()));
    if (isNew) files.push_back({file, i});
    return at->second;
  }

  // The arguments of instance and mesh: a file name and a transform.
  std::string fileArgument(PrimitiveId i) const {
    if (primitive(i).strings == 0) fail(i, "expected a file name");
    return std::string(scene_.description.string(primitive(i), 0));
  }
  uint32_t placement(PrimitiveId i) {
    std::vector<std::string_view> words;
    for (uint32_t k = 1; k < primitive(i).strings; ++k)
      words.push_back(scene_.description.string(primitive(i), k));
    size_t used = 0;
    Placement p;
    p.toOuter = rad::readTransform(words, used);
    if (used != words.size()) fail(i, "bad transform");
    p.toInner = p.toOuter.inverse();
    for (rad::Similarity* s : {&p.toOuter, &p.toInner}) {
      s->scale = std::abs(s->scale);
      bool finite = std::isnormal(s->scale);
      for (const auto& row : s->matrix.x)
        for (double x : row) finite = finite && std::isfinite(x);
      if (!finite) fail(i, "a transform beyond the range of numbers");
    }
    scene_.placements.push_back(p);
    return static_cast<uint32_t>(scene_.placements.size()) - 1;
  }

  Instance makeInstance(PrimitiveId i) {
    const std::string file = fileArgument(i);
    return {placement(i), 1 + numberOf(file, i, octrees_, octreeNumbers_)};
  }

  MeshInstance makeMeshInstance(PrimitiveId i) {
    const std::string file = fileArgument(i);
    return {placement(i), numberOf(file, i, meshes_, meshNumbers_)};
  }

  // Reads a mesh. Each material that it uses becomes the modifier of a MeshFaces surface.
  void addMesh(const NamedFile& named) {
    rad::Mesh data = read(named.namedBy, [&] { return rad::readMesh(named.file, warn_, options_.files); });
    std::vector<bool> used(data.materials.primitives.size());
    for (const rad::Mesh::Triangle& t : data.triangles)
      if (t.material != rad::Mesh::kNoMaterial) used[static_cast<size_t>(t.material)] = true;
    const std::optional<rad::Cube> cube = data.materials.cube;
    firstPrimitive_ = adopt(std::move(data.materials), primitive(named.namedBy).place);
    data.materials.cube = cube;
    modifierOf_.resize(scene_.description.primitives.size(), kUnknown);
    std::vector<SurfaceId> facesOf(used.size());
    for (size_t m = 0; m < used.size(); ++m)
      if (used[m]) facesOf[m] = addFaces(PrimitiveId(firstPrimitive_ + m));
    scene_.meshes.push_back({std::move(data), std::move(facesOf)});
  }

  SurfaceId addFaces(PrimitiveId described) {
    rad::Description& d = scene_.description;
    if (facesName_ == kNoWord) {
      facesName_ = static_cast<uint32_t>(d.words.size());
      d.words.emplace_back("M-Tri");  // their name in the output of rtrace -os
    }
    rad::Primitive p;
    p.type = Type::mesh;
    p.modifier = described;
    p.place = primitive(described).place;
    p.name = facesName_;
    d.primitives.push_back(p);
    modifierOf_.push_back(kUnknown);
    addSurface(d.primitives.last(), MeshFaces{});
    return scene_.surfaces.last();
  }

  // Checks that octrees do not contain themselves, and that no ray can be nested too deeply.
  void checkNesting() {
    heights_.assign(scene_.groups.size(), kUnmeasured);
    if (!octrees_.empty()) height(0, 0);
  }
  // The number of levels of octrees and meshes below this group, which is itself at `depth`.
  int height(uint32_t group, int depth) {
    constexpr int kOpen = -1;
    int& known = heights_[group];
    if (known != kUnmeasured) return known;
    known = kOpen;
    int highest = 0;
    const SurfaceGroup& g = scene_.groups[group];
    for (const SurfaceId s : g.surfaces) {
      const Surface& surface = scene_.surfaces[s];
      int under = 0;
      if (const auto* instance = std::get_if<Instance>(&surface.shape)) {
        if (heights_[instance->group] == kOpen) fail(surface.primitive, "an octree within itself");
        under = depth < kMostLevels ? 1 + height(instance->group, depth + 1) : kMostLevels + 1;
      } else if (std::holds_alternative<MeshInstance>(surface.shape)) {
        under = 1;
      }
      if (depth + under > kMostLevels)
        fail(surface.primitive, fmt::format("octrees within each other more than {} deep", kMostLevels));
      highest = std::max(highest, under);
    }
    return heights_[group] = highest;
  }
  static constexpr int kMostLevels = PlacementPath::kDeepest;

  // ---- surfaces

  void addSurface(PrimitiveId i) {
    // An octree cannot contain distant light sources.
    if (firstPrimitive_ > 0 && primitive(i).type == Type::source) return;
    std::optional<Shape> shape = makeShape(i);
    if (shape) addSurface(i, std::move(*shape));
  }

  void addSurface(PrimitiveId i, Shape shape) {
    Surface surface{std::move(shape), i, modifier(primitive(i).modifier), kNone};
    surface.material = scene_.firstMaterial(surface.modifier);
    surface.smoothed = scene_.modifierName(surface) == "Phong";
    // Light sources in octrees are visible, but are not sampled as light sources.
    if (firstPrimitive_ == 0) checkLight(i, surface);
    scene_.surfaces.push_back(std::move(surface));
  }

  // Rejects shapes that cannot be sampled as light sources, because rays cannot be aimed at their centre.
  void checkLight(PrimitiveId i, const Surface& surface) const {
    const Material* material = scene_.materialOf(surface);
    if (!material) return;
    const std::optional<Rgb> radiance = sourceRadiance(*material);
    if (!radiance || maxChannel(*radiance) <= 0) return;
    if (const auto* glow = std::get_if<Glow>(material); glow && glow->reach <= 0) return;
    if (const auto* polygon = std::get_if<Polygon>(&surface.shape)) {
      if (polygon->area == 0) fail(i, "zero source area");
      V3d center(0, 0, 0);
      const auto vertices = std::span(scene_.vertices).subspan(polygon->firstVertex, polygon->vertices);
      for (const V3d& v : vertices) center += v / static_cast<double>(vertices.size());
      if (!inside(*polygon, scene_.vertices, center)) fail(i, "cannot hit source center");
    } else if (const auto* ring = std::get_if<Ring>(&surface.shape)) {
      if (ring->inner > 0) fail(i, "cannot hit source center");
    } else if (const auto* sphere = std::get_if<Sphere>(&surface.shape)) {
      if (sphere->inward) fail(i, "a bubble cannot be a light source");
    } else if (const auto* cone = std::get_if<Cone>(&surface.shape)) {
      if (cone->inward || cone->radius0 != cone->radius1)
        fail(i, "only a cylinder of this kind can be a light source");
      if (cone->radius0 > .2 * cone->length) warn(i, "source aspect too small");
    } else if (!std::holds_alternative<Distant>(surface.shape)) {
      fail(i, "a light source's material on a surface that cannot be one");
    }
  }

  std::optional<Shape> makeShape(PrimitiveId i) {
    switch (primitive(i).type) {
      case Type::polygon:
        return makePolygonShape(i);
      case Type::sphere:
      case Type::bubble:
        return makeSphere(i);
      case Type::cone:
      case Type::cup:
        return makeCone(i);
      case Type::cylinder:
      case Type::tube:
        return makeCylinder(i);
      case Type::ring:
        return makeRing(i);
      case Type::source:
        return makeDistant(i);
      case Type::instance:
        return makeInstance(i);
      case Type::mesh:
        return makeMeshInstance(i);
      default:
        fail(i, "this type is not supported yet");
    }
  }

  std::optional<Shape> makePolygonShape(PrimitiveId i) {
    const auto r = reals(i);
    if (r.size() < 9 || r.size() % 3)
      fail(i, fmt::format("expected 9 or more coordinates by threes, got {}", r.size()));
    size_t count = r.size() / 3;
    if (count > 3 && (vector(i, 0) - vector(i, r.size() - 3)).length() <= kSamePlace) --count;
    const auto first = static_cast<uint32_t>(scene_.vertices.size());
    for (size_t k = 0; k < count; ++k) scene_.vertices.push_back(vector(i, 3 * k));
    const Polygon polygon = makePolygon(scene_.vertices, first, static_cast<uint32_t>(count));
    if (polygon.area == 0) {
      warn(i, "zero area");
      scene_.vertices.resize(first);
      return std::nullopt;
    }
    const double size = std::sqrt(polygon.area);
    // A thousandth of the size is visibly bent; the rounding of single-precision files stays far below.
    if (polygon.thickness > 1e-3 * size) warn(i, "non-planar vertex");
    return polygon;
  }

  std::optional<Shape> makeSphere(PrimitiveId i) {
    needReals(i, 4);
    Sphere sphere{vector(i, 0), reals(i)[3], primitive(i).type == Type::bubble};
    if (sphere.radius < 0) {
      warn(i, "negative radius");
      sphere.radius = -sphere.radius;
      sphere.inward = !sphere.inward;
    }
    if (!(sphere.radius > 0)) fail(i, "zero radius");
    return sphere;
  }

  std::optional<Shape> makeCylinder(PrimitiveId i) {
    needReals(i, 7);
    Cone cone{vector(i, 0), vector(i, 3) - vector(i, 0),    0, reals(i)[6],
              reals(i)[6],  primitive(i).type == Type::tube};
    if (cone.radius0 < 0) {
      warn(i, "negative radius");
      cone.radius0 = cone.radius1 = -cone.radius0;
      cone.inward = !cone.inward;
    }
    return finishCone(i, cone);
  }

  std::optional<Shape> makeCone(PrimitiveId i) {
    needReals(i, 8);
    Cone cone{vector(i, 0), vector(i, 3) - vector(i, 0),   0, reals(i)[6],
              reals(i)[7],  primitive(i).type == Type::cup};
    if (cone.radius0 < 0 || cone.radius1 < 0) {
      if (cone.radius0 > 0 || cone.radius1 > 0) return illegalRadii(i);
      warn(i, "negative radii");
      cone.radius0 = -cone.radius0;
      cone.radius1 = -cone.radius1;
      cone.inward = !cone.inward;
    }
    return finishCone(i, cone);
  }

  std::optional<Shape> illegalRadii(PrimitiveId i) const {
    warn(i, "illegal radii");
    return std::nullopt;
  }

  std::optional<Shape> finishCone(PrimitiveId i, Cone cone) const {
    if (!(cone.radius0 > 0 || cone.radius1 > 0)) return illegalRadii(i);
    cone.length = cone.axis.length();
    if (!(cone.length > 0)) {
      warn(i, "unknown orientation");
      return std::nullopt;
    }
    cone.axis /= cone.length;
    return cone;
  }

  std::optional<Shape> makeRing(PrimitiveId i) {
    needReals(i, 8);
    const auto r = reals(i);
    const double length = vector(i, 3).length();
    if (r[6] < 0 || r[7] < 0 || r[6] == r[7]) return illegalRadii(i);
    if (!(length > 0)) {
      warn(i, "unknown orientation");
      return std::nullopt;
    }
    return Ring{vector(i, 0), vector(i, 3) / length, std::min(r[6], r[7]), std::max(r[6], r[7])};
  }

  std::optional<Shape> makeDistant(PrimitiveId i) {
    needReals(i, 4);
    const V3d direction = vector(i, 0);
    const double length = direction.length();
    if (!(length > 0)) fail(i, "zero direction");
    if (!(reals(i)[3] > 0)) fail(i, "zero size");
    const double half = std::min(radians(reals(i)[3]) / 2, std::numbers::pi);
    return Distant{direction / length, half, std::cos(half),
                   coneSolidAngle(2 * half * 180 / std::numbers::pi)};
  }

  static constexpr uint32_t kNoWord = std::numeric_limits<uint32_t>::max();

  const rad::ReadOptions& options_;
  const rad::Warn& warn_;
  Scene scene_;
  uint32_t firstPrimitive_ = 0;  // of the file that is being converted
  std::vector<NamedFile> octrees_, meshes_;
  std::unordered_map<std::string, uint32_t> octreeNumbers_, meshNumbers_;
  std::vector<int> heights_;  // by group
  uint32_t facesName_ = kNoWord;
  std::optional<rad::ModifierIndex> index_;           // made when a string argument first names a modifier
  int depth_ = 0;                                     // of nested conversions by such names
  std::unordered_map<PrimitiveId, uint64_t> clipOf_;  // Surface::clip of a modifier
  uint32_t mists_ = 0;
  ById<PrimitiveId, ModifierId> modifierOf_;  // kUnknown: not converted yet
};

}  // namespace

ModifierId Scene::firstMaterial(ModifierId modifier) const {
  for (; modifier != kNone; modifier = modifiers[modifier].next) {
    const Modifier& m = modifiers[modifier];
    if (std::holds_alternative<Material>(m.content)) return modifier;
    if (m.next == kNone && std::holds_alternative<Mixture>(m.content)) return modifier;
  }
  return kNone;
}

Placement Scene::placementOf(const PlacementPath& path) const {
  if (path.count == 0) return {};
  Placement all = placements[path.placements[0]];
  for (uint8_t i = 1; i < path.count; ++i) all = within(all, placements[path.placements[i]]);
  return all;
}

std::string_view Scene::modifierName(const Surface& s) const {
  const PrimitiveId m = description.primitives[s.primitive].modifier;
  return m == rad::kVoid ? "void" : description.name(description.primitives[m]);
}

std::string_view Scene::materialName(const Surface& s) const {
  return s.material == kNone ? "void"
                             : description.name(description.primitives[modifiers[s.material].primitive]);
}

std::string Scene::place(PrimitiveId i) const {
  const Primitive& p = description.primitives[i];
  return fmt::format("{}: {} \"{}\"", description.at(p.place), rad::typeName(p.type), description.name(p));
}

bool isTransparent(const Material& material) {
  if (std::holds_alternative<Mist>(material)) return true;
  if (const auto* m = std::get_if<Anisotropic>(&material)) return m->trans;
  if (const auto* m = std::get_if<BrtdFunction>(&material)) return m->transmits;
  if (const auto* m = std::get_if<WgmdFunction>(&material)) return m->transmits;
  if (const auto* m = std::get_if<BsdfMaterial>(&material)) return m->aperture || m->proxy;
  return std::holds_alternative<Trans>(material) || std::holds_alternative<Dielectric>(material) ||
         std::holds_alternative<Interface>(material) || std::holds_alternative<Glass>(material);
}

std::optional<Rgb> sourceRadiance(const Material& material) {
  if (const auto* m = std::get_if<Light>(&material)) return m->radiance;
  if (const auto* m = std::get_if<Illum>(&material)) return m->radiance;
  if (const auto* m = std::get_if<Glow>(&material)) return m->radiance;
  if (const auto* m = std::get_if<Spotlight>(&material)) return m->radiance;
  return std::nullopt;
}

Rgb sourceRadiance(const Scene& scene, const Surface& surface) {
  if (surface.goal) return Rgb(1, 1, 1);
  const Material* material = scene.materialOf(surface);
  return material ? sourceRadiance(*material).value_or(Rgb(0, 0, 0)) : Rgb(0, 0, 0);
}

bool isLightSource(const Material& material) { return sourceRadiance(material).has_value(); }

Scene buildScene(rad::Description description, const rad::ReadOptions& options,
                 std::span<const std::string> goals) {
  Scene scene = Builder(std::move(description), options).build();
  for (const std::string& goal : goals) {
    bool found = false;
    for (Surface& surface : scene.surfaces)
      if (scene.modifierName(surface) == goal && !std::holds_alternative<Distant>(surface.shape))
        found = surface.goal = true;
    if (!found) throw rad::Error(fmt::format("no surface has the goal's modifier \"{}\"", goal));
  }
  scene.importance = !goals.empty();
  return scene;
}

}  // namespace rsphere
