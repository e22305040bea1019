#include "silhouettes/special_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/overloaded.h"
#include "silhouettes/tuning.h"

namespace rsphere {
namespace {

struct Irregularity {
  static double lobe(double share, double roughness) {
    const double wide = roughness / tuning::SpecialObjects::kSharpRoughness;
    return share / (1 + wide * wide);
  }
  static double lobe(double share, double roughnessAlong, double roughnessAcross) {
    const double along = roughnessAlong / tuning::SpecialObjects::kSharpRoughness,
                 across = roughnessAcross / tuning::SpecialObjects::kSharpRoughness;
    return share / std::sqrt((1 + along * along) * (1 + across * across));
  }
  static double lobe(const WgmdFunction::Lobe& m) {
    return lobe(std::min(m.share, 1.), m.roughnessAlong, m.roughnessAcross);
  }
  // The roughness of the Gaussian in slope whose peak has the curvature of a power of the cosine.
  static double roughnessOf(double power) { return std::sqrt(2 / (power + 1)); }
  double operator()(const Opaque& m) const { return lobe(m.specularity, m.roughness); }
  double operator()(const Trans& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                m.roughness);
  }
  double operator()(const Anisotropic& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                m.roughnessAlong, m.roughnessAcross);
  }
  double operator()(const Ashikhmin& m) const {
    return lobe(maxChannel(m.specular), roughnessOf(m.powerAlong), roughnessOf(m.powerAcross));
  }
  double operator()(const FunctionScatterer& m) const {
    return lobe(std::max(m.specularity, (1 - m.specularity) * m.transmissivity * m.transmittedSpecular),
                tuning::SpecialObjects::kSharpRoughness);
  }
  double operator()(const BrtdFunction& m) const {
    const double sharp = std::clamp(std::max(m.mostReflected, m.mostTransmitted), 0., 1.);
    return m.directional ? std::max(sharp, lobe(1, tuning::SpecialObjects::kSharpRoughness)) : sharp;
  }
  double operator()(const WgmdFunction& m) const { return std::max(lobe(m.reflected), lobe(m.transmitted)); }
  double operator()(const BsdfMaterial& m) const { return m.aperture ? 1 : 0; }
  double operator()(const Glass& m) const { return m.refraction == 1 ? 0 : tuning::SpecialObjects::kPane; }
  double operator()(const OneOf<Dielectric, Interface, Mirror, Prism> auto&) const { return 1; }
  double operator()(const OneOf<Antimatter, Mist, Light, Illum, Glow, Spotlight> auto&) const { return 0; }
};

// The most irregular material of a surface, including the alternatives of mixtures.
struct Shown {
  const Modifier* modifier = nullptr;
  double irregularity = 0;
};
Shown mostIrregular(const Scene& scene, ModifierId modifier);

// The visible material of an illum: its alternate material; if there is none, the illum shows what is behind
// it, like a pane.
Shown seenOf(const Scene& scene, const Modifier& illum, const Alternate& alternate) {
  if (alternate.kind == Alternate::Kind::modifier) return mostIrregular(scene, alternate.modifier);
  return {&illum, tuning::SpecialObjects::kPane};
}

Shown mostIrregular(const Scene& scene, ModifierId modifier) {
  Shown most;
  for (; modifier != kNone; modifier = scene.modifiers[modifier].next) {
    const Modifier& m = scene.modifiers[modifier];
    const Shown here = match(
        m.content,
        [&](const Material& material) {
          const auto* illum = std::get_if<Illum>(&material);
          return illum ? seenOf(scene, m, illum->alternate) : Shown{&m, irregularity(material)};
        },
        [&](const Mixture& mixture) {
          const Shown foreground = mostIrregular(scene, mixture.foreground);
          const Shown background = mostIrregular(scene, mixture.background);
          return background.irregularity > foreground.irregularity ? background : foreground;
        },
        [](const OneOf<Pattern, Texture> auto&) { return Shown{}; });
    if (here.irregularity > most.irregularity) most = here;
    if (std::holds_alternative<Material>(m.content)) break;
  }
  return most;
}

std::string why(const Material& material, double irregularity) {
  const auto reason = [&](const std::string& given) {
    return fmt::format("{}: irregularity {:.3g} of at least {:g}", given, irregularity,
                       tuning::SpecialObjects::kSpecialIrregularity);
  };
  const auto transmitted = [](const auto& m) { return m.transmissivity * m.transmittedSpecular; };
  return match(
      material,
      [&](const Opaque& m) {
        return reason(fmt::format("specularity {:g}, roughness {:g}", m.specularity, m.roughness));
      },
      [&](const Trans& m) {
        return reason(fmt::format("specularity {:g}, transmitted {:g}, roughness {:g}", m.specularity,
                                  transmitted(m), m.roughness));
      },
      [&](const Anisotropic& m) {
        return reason(fmt::format("specularity {:g}, transmitted {:g}, roughness {:g} and {:g}",
                                  m.specularity, transmitted(m), m.roughnessAlong, m.roughnessAcross));
      },
      [&](const Ashikhmin& m) {
        return reason(fmt::format("specularity {:g}, powers {:g} and {:g}", maxChannel(m.specular),
                                  m.powerAlong, m.powerAcross));
      },
      [&](const FunctionScatterer& m) {
        return reason(
            fmt::format("specularity {:g}, transmitted {:g}, by functions", m.specularity, transmitted(m)));
      },
      [&](const OneOf<BrtdFunction, WgmdFunction> auto&) { return reason("by functions"); },
      [](const OneOf<BsdfMaterial, Dielectric, Interface, Glass, Mirror, Prism, Antimatter, Mist, Light,
                     Illum, Glow, Spotlight> auto&) -> std::string { return "irregular by type"; });
}

class Finder {
 public:
  Finder(const Scene& scene, double factor) : scene_(scene), factor_(factor), balls_(scene) {}

  std::vector<SpecialObject> find() {
    size_t placedObjects = 0;
    for (const Surface& s : scene_.outermost()) placedObjects += contentsOf(s).objects;
    const bool each = placedObjects <= tuning::SpecialObjects::kMostPlacedObjects;
    for (const SurfaceId i : scene_.outermostIds()) {
      if (each || contentsOf(scene_.surfaces[i]).objects == 0)
        add(i, nullptr);
      else
        addAround(i);
    }
    return std::move(objects_);
  }

 private:
  // Summary of the special surfaces in an instance or mesh without a modifier.
  struct Contents {
    size_t objects = 0;
    SurfaceId mostIrregular;
    double irregularity = 0;
  };

  double irregularityOf(SurfaceId surface) const {
    return mostIrregular(scene_, scene_.surfaces[surface].modifier).irregularity;
  }

  void count(Contents& contents, SurfaceId surface, size_t objects, double irregularity) const {
    if (irregularity < tuning::SpecialObjects::kSpecialIrregularity) return;
    contents.objects += objects;
    if (irregularity > contents.irregularity) {
      contents.mostIrregular = surface;
      contents.irregularity = irregularity;
    }
  }

  Contents contentsOf(const Surface& s) {
    if (scene_.hasOwnModifier(s)) return {};
    return match(
        s.shape, [&](const Instance& instance) { return contentsOfGroup(instance.group); },
        [&](const MeshInstance& mesh) { return contentsOfMesh(scene_.meshes[mesh.mesh]); },
        [](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) { return Contents{}; });
  }

  Contents contentsOfMesh(const Mesh& mesh) const {
    Contents contents;
    for (const SurfaceId faces : mesh.facesOf)
      if (faces != kNone) count(contents, faces, 1, irregularityOf(faces));
    return contents;
  }

  Contents contentsOfGroup(uint32_t index) {
    const auto known = groups_.find(index);
    if (known != groups_.end()) return known->second;
    Contents contents;
    for (const SurfaceId i : scene_.groups[index].surfaces) {
      const Contents inner = contentsOf(scene_.surfaces[i]);
      if (inner.objects > 0)
        count(contents, inner.mostIrregular, inner.objects, inner.irregularity);
      else
        count(contents, i, 1, irregularityOf(i));
    }
    return groups_[index] = contents;
  }

  void addObject(SurfaceId surface, double irregularity, std::optional<PlacedShape> placedShape,
                 bool several = false) {
    if (irregularity >= tuning::SpecialObjects::kSpecialIrregularity)
      objects_.push_back({surface, irregularity,
                          irregularity * tuning::SpecialObjects::kDirectionsPerSr * factor_,
                          std::move(placedShape), several});
  }
  void addBall(SurfaceId surface, double irregularity, const Sphere& ball, const Placement& placement,
               bool several = false) {
    if (ball.radius > 0) addObject(surface, irregularity, PlacedShape{placed(ball, placement), {}}, several);
  }

  Sphere ballOf(const Instance& instance) { return balls_.ofGroup(instance.group); }
  Sphere ballOf(const MeshInstance& mesh) { return balls_.ofMesh(mesh.mesh); }

  // Adds the surface, or the surfaces that it contains, if they are special; each becomes one object. at: the
  // placement of the group that the surface belongs to; null: world coordinates.
  void add(SurfaceId index, const Placement* at) {
    const Surface& s = scene_.surfaces[index];
    match(
        s.shape, [&](const OneOf<Instance, MeshInstance> auto& nested) { addNested(index, nested, at); },
        [](const Distant&) {},
        [&](const OneOf<Polygon, Sphere, Cone, Ring, MeshFaces> auto&) {
          const double value = irregularityOf(index);
          if (value < tuning::SpecialObjects::kSpecialIrregularity) return;
          addObject(index, value, at ? std::optional(placed(s.shape, scene_.vertices, *at)) : std::nullopt);
        });
  }

  void addNested(SurfaceId index, const auto& nested, const Placement* at) {
    const Surface& s = scene_.surfaces[index];
    const Placement& own = scene_.placements[nested.placement];
    const Placement all = at ? within(*at, own) : own;
    if (scene_.hasOwnModifier(s)) {
      if (irregularityOf(index) >= tuning::SpecialObjects::kSpecialIrregularity)
        addBall(index, irregularityOf(index), ballOf(nested), all);
    } else if (contentsOf(s).objects > 0) {
      addContents(nested, all);
    }
  }

  void addContents(const Instance& instance, const Placement& placement) {
    for (const SurfaceId i : scene_.groups[instance.group].surfaces) add(i, &placement);
  }

  void addContents(const MeshInstance& mesh, const Placement& placement) {
    const std::vector<SurfaceId>& facesOf = scene_.meshes[mesh.mesh].facesOf;
    for (size_t m = 0; m < facesOf.size(); ++m)
      if (facesOf[m] != kNone)
        addBall(facesOf[m], irregularityOf(facesOf[m]), balls_.ofFaces(mesh.mesh, m), placement);
  }

  // Adds an outermost instance or mesh as one object.
  void addAround(SurfaceId index) {
    const Surface& s = scene_.surfaces[index];
    const Contents contents = contentsOf(s);
    match(
        s.shape,
        [&](const OneOf<Instance, MeshInstance> auto& nested) {
          addBall(contents.mostIrregular, contents.irregularity, ballOf(nested),
                  scene_.placements[nested.placement], true);
        },
        [](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) {});  // no contents
  }

  const Scene& scene_;
  double factor_;
  BoundingBalls balls_;
  std::map<uint32_t, Contents> groups_;
  std::vector<SpecialObject> objects_;
};

}  // namespace

double irregularity(const Material& material) { return std::visit(Irregularity{}, material); }

std::vector<SpecialObject> findSpecialObjects(const Scene& scene, double factor) {
  return Finder(scene, factor).find();
}

ShapeRef shapeOf(const Scene& scene, const SpecialObject& object) {
  return object.placed ? ShapeRef(object.placed->shape) : scene.surfaces[object.surface].shape;
}

std::span<const V3d> verticesOf(const Scene& scene, const SpecialObject& object) {
  return object.placed ? object.placed->vertices : scene.vertices;
}

bool shows(const Scene& scene, const SpecialObject& object, SurfaceId surface) {
  if (surface == kNone) return false;
  if (!object.several) return surface == object.surface;
  const ModifierId modifier = scene.surfaces[surface].modifier;
  return mostIrregular(scene, modifier).irregularity >= tuning::SpecialObjects::kSpecialIrregularity;
}

Silhouette silhouetteOf(const Scene& scene, const SpecialObject& object, const V3d& point) {
  return silhouetteOf(shapeOf(scene, object), verticesOf(scene, object), point);
}

SurfacePoint samplePoint(const Scene& scene, const SpecialObject& object, Random& random) {
  return samplePoint(shapeOf(scene, object), verticesOf(scene, object), random);
}

std::string specialObjectsText(const Scene& scene, const std::vector<SpecialObject>& objects) {
  std::string text;
  for (const SpecialObject& o : objects) {
    const Surface& s = scene.surfaces[o.surface];
    const Modifier& m = *mostIrregular(scene, s.modifier).modifier;
    const rad::Primitive& p = m.decoded;
    fmt::format_to(std::back_inserter(text), "{}\t{} \"{}\"\t{:.6g} per sr\t{}\n", scene.place(s),
                   rad::typeName(p.type), p.name, o.density,
                   why(std::get<Material>(m.content), o.irregularity));
  }
  return text;
}

}  // namespace rsphere
