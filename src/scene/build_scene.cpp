#include "scene/build_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/overloaded.h"
#include "scene/arguments.h"
#include "scene/contributors.h"
#include "scene/modifier_builder.h"
#include "scene/shape_arguments.h"

namespace rsphere {
namespace {

// Throws rad::Error with the file and line of an instance if an octree contains itself, or if octrees and
// meshes are nested deeper than PlacementPath::kDeepest.
class Nesting {
 public:
  explicit Nesting(const Scene& scene) : scene_(scene), heights_(scene.groups.size(), kUnknown) {}

  // The number of levels of octrees and meshes below this group, which is at `depth`.
  int height(uint32_t group, int depth) {
    constexpr int kOpen = -1;
    int& known = heights_[group];
    if (known != kUnknown) return known;
    known = kOpen;
    int highest = 0;
    const SurfaceGroup& g = scene_.groups[group];
    for (const SurfaceId s : g.surfaces) {
      const Surface& surface = scene_.surfaces[s];
      const int under = match(
          surface.shape,
          [&](const Instance& instance) {
            if (heights_[instance.group] == kOpen) fail(surface, "an octree contains itself");
            return depth < kMostLevels ? 1 + height(instance.group, depth + 1) : kMostLevels + 1;
          },
          [](const MeshInstance&) { return 1; },
          [](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) { return 0; });
      if (depth + under > kMostLevels)
        fail(surface, fmt::format("octrees are nested more than {} deep", kMostLevels));
      highest = std::max(highest, under);
    }
    return heights_[group] = highest;
  }

 private:
  static constexpr int kUnknown = -2;
  static constexpr int kMostLevels = PlacementPath::kDeepest;

  [[noreturn]] void fail(const Surface& surface, std::string_view what) const {
    PrimitiveArguments(scene_.description, scene_.surfaces.primitiveOf(surface.id)).fail(what);
  }

  const Scene& scene_;
  std::vector<int> heights_;  // by group
};

using rad::Place;
using rad::Primitive;
using rad::Type;

// The bounds of the surfaces of a scene's groups, without distant ones.
class BoundsOf {
 public:
  explicit BoundsOf(const Scene& scene)
      : scene_(scene), groups_(scene.groups.size()), meshes_(scene.meshes.size()) {}

  const Box3d& group(uint32_t index) {
    std::optional<Box3d>& box = groups_[index];
    if (box) return *box;
    box.emplace();
    for (const SurfaceId s : scene_.groups[index].surfaces)
      match(
          scene_.surfaces.shapeOf(scene_.surfaces.face(s)),
          [&](const Polygon& p) {
            for (const V3d& v : std::span(scene_.vertices).subspan(p.firstVertex, p.vertices))
              box->extendBy(v);
          },
          [&](const Instance& i) { box->extendBy(placed(scene_.placements[i.placement], group(i.group))); },
          [&](const MeshInstance& m) { box->extendBy(placed(scene_.placements[m.placement], mesh(m.mesh))); },
          [&](const OneOf<Sphere, Cone, Ring> auto& form) { box->extendBy(bounds(form)); },
          [](const OneOf<Distant, MeshFaces> auto&) {});
    return *box;
  }

 private:
  const Box3d& mesh(uint32_t index) {
    std::optional<Box3d>& box = meshes_[index];
    if (box) return *box;
    box.emplace();
    const rad::Mesh& data = scene_.meshes[index].data;
    for (const rad::Mesh::Triangle& t : data.triangles)
      for (const uint32_t vertex : t.vertices) box->extendBy(data.position(vertex));
    return *box;
  }

  const Scene& scene_;
  std::vector<std::optional<Box3d>> groups_, meshes_;  // computed so far
};

// Reads the files that a scene names, and converts their surfaces and its own.
class Builder {
 public:
  Builder(rad::Description description, const rad::ReadOptions& options)
      : options_(options), warn_(options.warn), modifiers_(scene_, warn_) {
    scene_.description = std::move(description);
    scene_.files = options.files;
  }

  Scene build() {
    addGroup(0);
    // Octrees that instances name may name further octrees. The meshes named by all of these follow.
    for (size_t i = 0; i < octrees_.size(); ++i) {
      const Place from = primitive(octrees_[i].namedBy).place;
      addGroup(adopt(read(octrees_[i].namedBy, [&] { return rad::readOctree(octrees_[i].file, options_); }),
                     from));
    }
    if (scene_.groups.size() > 1) Nesting(scene_).height(0, 0);
    for (size_t i = 0; i < meshes_.size(); ++i) addMesh(meshes_[i]);
    for (Finish& finish : scene_.surfaces.finishes()) finish.clip = modifiers_.clipOf(finish.described);
    scene_.vertices = std::move(scene_.description.vertices);
    scene_.samePlace = samePlaceIn(BoundsOf(scene_).group(0));
    scene_.description.primitives.shrink();
    if (scene_.surfaces.size() > Scene::kFewSurfaces) scene_.names = {};
    return std::move(scene_);
  }

 private:
  // A file that primitives name, and the first of these primitives.
  struct NamedFile {
    std::string file;
    PrimitiveId namedBy;
  };

  Primitive primitive(PrimitiveId i) const { return scene_.description.primitives[i]; }

  // ---- octrees and meshes

  // Calls a function that reads the file named by primitive i. If it fails, the error also names that
  // primitive.
  template <class Read>
  std::invoke_result_t<Read> read(PrimitiveId i, const Read& reader) const {
    try {
      return reader();
    } catch (const rad::Error& error) {
      throw rad::Error(fmt::format("{} (from {})", error.what(), placeOf(scene_.description, i)),
                       error.status());
    }
  }

  // Appends the description of another file to the scene's. Primitives from here on belong to that file.
  // Returns the index of the first of them.
  uint32_t adopt(rad::Description&& description, Place from) {
    firstPrimitive_ = static_cast<uint32_t>(scene_.description.primitives.size());
    rad::append(scene_.description, std::move(description), from);
    modifiers_.beginFile(firstPrimitive_);
    return firstPrimitive_;
  }

  // Adds a group: all surfaces among the primitives starting with this one.
  void addGroup(uint32_t firstPrimitive) {
    const rad::PrimitiveList& primitives = scene_.description.primitives;
    const size_t firstSurface = scene_.surfaces.size();
    size_t surfaces = 0;
    for (size_t i = firstPrimitive; i < primitives.size(); ++i)
      surfaces += primitives.isSurface(PrimitiveId(i));
    scene_.surfaces.reserve(surfaces);
    const auto end = primitives.end();
    for (auto p = primitives.from(firstPrimitive); p != end; ++p)
      if (rad::isSurface(p->type)) addSurface(p.id(), *p);
    scene_.groups.push_back({{firstSurface, scene_.surfaces.size() - firstSurface}});
  }

  // The index of a file in `files`, in the order of first use. numbers: by name and the file that names it,
  // because many instances may name the same file.
  uint32_t numberOf(const std::string& name, PrimitiveId i, std::vector<NamedFile>& files,
                    std::map<std::pair<uint32_t, std::string>, uint32_t>& numbers) const {
    const rad::Place place = primitive(i).place;
    const auto [at, isNew] = numbers.try_emplace({place.file, name});
    if (isNew) {
      const std::string file = rad::nameOfFile(scene_.description, place, name, options_.files);
      const auto known = std::ranges::find_if(files, [&](const auto& f) { return f.file == file; });
      at->second = static_cast<uint32_t>(known - files.begin());
      if (known == files.end()) files.push_back({file, i});
    }
    return at->second;
  }

  // An instance of an octree or of a mesh.
  Shape makeInstance(PrimitiveId i, const PrimitiveArguments& a) {
    const PlacedFile placed = readPlacedFile(a);
    const auto placement = static_cast<uint32_t>(scene_.placements.size());
    scene_.placements.push_back(placed.placement);
    if (a.type() == Type::mesh)
      return MeshInstance{placement, numberOf(placed.file, i, meshes_, meshNumbers_)};
    return Instance{placement, 1 + numberOf(placed.file, i, octrees_, octreeNumbers_)};
  }

  // Reads a mesh. Each material that it uses becomes the modifier of a MeshFaces surface.
  void addMesh(const NamedFile& named) {
    rad::Mesh data = read(named.namedBy, [&] { return rad::readMesh(named.file, warn_, options_.files); });
    std::vector<bool> used(data.materials.primitives.size());
    for (const rad::Mesh::Triangle& t : data.triangles)
      if (t.material != rad::Mesh::kNoMaterial) used[static_cast<size_t>(t.material)] = true;
    const std::optional<rad::Cube> cube = data.materials.cube;
    const uint32_t first = adopt(std::move(data.materials), primitive(named.namedBy).place);
    data.materials.cube = cube;
    std::vector<SurfaceId> facesOf(used.size());
    for (size_t m = 0; m < used.size(); ++m)
      if (used[m]) facesOf[m] = addFaces(PrimitiveId(first + m));
    scene_.meshes.push_back({std::move(data), std::move(facesOf)});
  }

  SurfaceId addFaces(PrimitiveId described) {
    rad::Description& d = scene_.description;
    rad::Primitive p;
    p.type = Type::mesh;
    p.modifier = described;
    p.place = primitive(described).place;
    p.name = "M-Tri";  // in the output of rtrace -os
    d.primitives.push_back(p);
    addSurface(d.primitives.last(), p, MeshFaces{});
    return scene_.surfaces.last();
  }

  // ---- surfaces

  void addSurface(PrimitiveId i, const Primitive& p) {
    // An octree cannot contain distant light sources.
    if (inOctree() && p.type == Type::source) return;
    if (const auto shape = makeShape(i, p)) addSurface(i, p, *shape);
  }

  void addSurface(PrimitiveId i, const Primitive& p, const Shape& shape) {
    const uint32_t finish = finishOf(p.modifier);
    // Light sources in octrees are visible, but are not sampled as light sources.
    if (!inOctree()) checkLight(p, shape, scene_.surfaces.finishes()[finish].material);
    scene_.surfaces.push_back(shape, finish, i);
    if (scene_.surfaces.size() <= Scene::kFewSurfaces) scene_.names.push_back(p.name);
  }

  // The index of the finish with this modifier.
  uint32_t finishOf(PrimitiveId described) {
    std::vector<Finish>& finishes = scene_.surfaces.finishes();
    const auto [at, isNew] = finishOf_.try_emplace(described, static_cast<uint32_t>(finishes.size()));
    if (isNew) {
      Finish finish;
      finish.described = described;
      finish.modifier = modifiers_.modifier(described);
      finish.material = scene_.firstMaterial(finish.modifier);
      if (described != rad::kVoid) finish.name = primitive(described).name;
      finish.smoothed = finish.name == "Phong";
      finishes.push_back(std::move(finish));
    }
    return at->second;
  }

  // Rejects shapes that cannot be sampled as light sources, because rays cannot be aimed at their centre. As
  // in rtrace, meshes and instances are accepted without being sampled.
  void checkLight(const Primitive& p, const Shape& shape, ModifierId materialId) const {
    const Material* material = scene_.materialAt(materialId);
    if (!material || !isSampled(*material)) return;
    const PrimitiveArguments own(scene_.description, p);
    const std::span<const V3d> vertices = scene_.description.vertices;
    match(
        shape,
        [&](const Polygon& polygon) {
          if (areaOf(polygon, vertices) == 0) own.fail("zero source area");
          if (!inside(polygon, vertices, centerOf(polygon, vertices))) own.fail("cannot hit source center");
        },
        [&](const Ring& ring) {
          if (ring.inner > 0) own.fail("cannot hit source center");
        },
        [&](const Sphere& sphere) {
          if (sphere.inward) own.fail("a bubble cannot be a light source");
        },
        [&](const Cone& cone) {
          if (cone.inward || cone.radius0 != cone.radius1)
            own.fail("a cone, cup or tube cannot be a light source");
          if (cone.radius0 > .2 * cone.length) own.warn(warn_, "source aspect too small");
        },
        [](const Distant&) {},
        [&](const NestedShape auto&) {
          own.warn(warn_, "a surface of this type is no light source: it is seen, but lights nothing");
        });
  }

  std::optional<Shape> makeShape(PrimitiveId i, const Primitive& p) {
    const PrimitiveArguments a(scene_.description, p);
    switch (a.type()) {
      case Type::polygon: return readPolygon(a, warn_, scene_.description.vertices);
      case Type::sphere:
      case Type::bubble: return readSphere(a, warn_);
      case Type::cone:
      case Type::cup:
      case Type::cylinder:
      case Type::tube: return readCone(a, warn_);
      case Type::ring: return readRing(a, warn_);
      case Type::source: return readSource(a);
      case Type::instance:
      case Type::mesh: return makeInstance(i, a);
      default: a.fail("this type is not supported yet");
    }
  }

  bool inOctree() const { return firstPrimitive_ > 0; }

  const rad::ReadOptions& options_;
  const rad::Warn& warn_;
  Scene scene_;
  ModifierBuilder modifiers_;
  uint32_t firstPrimitive_ = 0;  // of the file that is being converted
  std::vector<NamedFile> octrees_, meshes_;
  std::map<std::pair<uint32_t, std::string>, uint32_t> octreeNumbers_, meshNumbers_;
  std::unordered_map<PrimitiveId, uint32_t> finishOf_;
};

}  // namespace

Scene buildScene(rad::Description description, const rad::ReadOptions& options,
                 std::span<const std::string> goals) {
  Scene scene = Builder(std::move(description), options).build();
  setGoals(scene, goals);
  return scene;
}

}  // namespace rsphere
