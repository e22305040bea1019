#include "light/relays.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/overloaded.h"
#include "light/relay_tree.h"
#include "shade/scattering.h"

namespace rsphere {
namespace {

constexpr double kTiny = 1e-6;  // world units, cosines: RADIANCE's own figure for "in the plane"
// Bounds of relays are enlarged by this share of their distance, so that rounding loses no relay in them.
constexpr double kRounding = 1e-9;

// An affine map that leaves the points of a relay's plane fixed: p goes to p + height(p) * shift. It
// preserves volume if shift . normal is 0 (a shear) or -2 (a shear combined with a reflection).
struct Projection {
  V3d normal;
  double offset;
  V3d shift;
  bool isMirror;

  double height(const V3d& p) const { return p.dot(normal) - offset; }
  V3d point(const V3d& p) const { return p + height(p) * shift; }
  V3d vector(const V3d& v) const { return v + v.dot(normal) * shift; }
};

struct Ball {
  V3d center{0, 0, 0};
  double radius = 0;
};

struct Relay {
  SurfaceId surface;
  ModifierId modifier;  // of the material
  V3d normal;
  double offset = 0;         // normal . p for the points p of the plane
  Ball ball;                 // around it
  std::vector<V3d> corners;  // of the polygon, or of the square around the ring
};

// The modifier of the mirror or prism that makes the surface a relay, which may be the alternative material
// of an illum; kNone if the surface is no relay.
ModifierId relayMaterial(const Scene& scene, const Surface& surface) {
  ModifierId modifier = surface.material;
  const Material* material = scene.materialAt(modifier);
  if (const auto* illum = material ? std::get_if<Illum>(material) : nullptr;
      illum && illum->alternate.kind == Alternate::Kind::modifier) {
    modifier = illum->alternate.modifier;
    material = scene.materialAt(modifier);
  }
  return material && imagesMadeBy(*material) > 0 ? modifier : kNone;
}

// The largest distance of the source's points from its center, measured along a unit vector.
double extent(const LightSource& source, const V3d& along) {
  const double u = source.u.dot(along), v = source.v.dot(along);
  switch (source.map) {
    case LightSource::Map::parallelogram:
      return std::abs(u) + std::abs(v);
    case LightSource::Map::disk:
      return std::hypot(u, v);
    case LightSource::Map::fan: {
      double most = 0;
      for (const V3d& p : source.fanVertices) most = std::max(most, (p - source.center).dot(along));
      return most;
    }
    case LightSource::Map::cone:
      return source.cosHalfAngle > 0 ? source.sinHalfAngle : 1;
    default:
      return source.radius;
  }
}

class Images {
 public:
  Images(const Scene& scene, const SurfaceFunctions& functions, const rad::Warn& warn,
         ById<LightId, LightSource>& sources)
      : scene_(scene), functions_(functions), sources_(sources) {
    for (const SurfaceId i : scene.outermostIds()) addRelay(i, warn);
    std::vector<RelayTree::Bounds> bounds;
    for (const Relay& relay : relays_) {
      RelayTree::Bounds& b = bounds.emplace_back();
      for (const V3d& corner : relay.corners) b.corners.extendBy(corner);
      b.centers.extendBy(relay.ball.center);
      b.radius = relay.ball.radius;
    }
    tree_ = RelayTree(bounds);
  }

  // Adds the images of one source, and recursively their images, in sequences of up to `relays` relays.
  void addImages(LightId source, int relays) {
    if (relays <= 0) return;
    std::vector<uint32_t> reached;
    tree_.find([&](const RelayTree::Bounds& bounds) { return mayLight(source, bounds); }, reached);
    for (const uint32_t r : reached) {
      // A relay makes no image of its own images, nor of light that its own surface emits.
      if (relays_[r].surface == sources_[source].surface) continue;
      if (!lights(source, relays_[r])) continue;
      for (int image = 0; image < imagesBy(relays_[r]); ++image) {
        const auto projection = project(sources_[source], relays_[r], image);
        if (!projection) continue;
        relayOf_.resize(sources_.size());
        relayOf_.push_back(r);
        sources_.push_back(imageOf(sources_[source], relays_[r], *projection));
        sources_.back().relayed = source;
        sources_.back().image = image;
        addImages(sources_.last(), relays - 1);
      }
    }
  }

 private:
  void addRelay(SurfaceId index, const rad::Warn& warn) {
    const Surface& surface = scene_.surfaces[index];
    Relay relay;
    relay.surface = index;
    relay.modifier = relayMaterial(scene_, surface);
    if (relay.modifier == kNone) return;
    const V3d* normal = planeNormal(surface.shape);
    if (!normal) {
      if (warn)
        warn(scene_.place(surface) + ": only plane surfaces make virtual sources; this one makes none");
      return;
    }
    relay.normal = *normal;
    relay.offset = planeOffset(surface.shape);
    visit(Overloaded{
              [&](const Polygon& polygon) {
                const auto vertices =
                    std::span(scene_.vertices).subspan(polygon.firstVertex, polygon.vertices);
                relay.corners.assign(vertices.begin(), vertices.end());
                relay.ball.center = centerOf(polygon, scene_.vertices);
                for (const V3d& v : vertices)
                  relay.ball.radius = std::max(relay.ball.radius, (v - relay.ball.center).length());
              },
              [&](const Ring& ring) {
                relay.ball.center = ring.center;
                relay.ball.radius = ring.outer;
                V3d x, y;
                frame(relay.normal, x, y);
                for (const double a : {-relay.ball.radius, relay.ball.radius})
                  for (const double b : {-relay.ball.radius, relay.ball.radius})
                    relay.corners.push_back(relay.ball.center + a * x + b * y);
              },
              [](const OneOf<Sphere, Cone, Distant> auto&) {},  // not plane
              [](const NestedShape auto&) {},
          },
          surface.shape);
    relays_.push_back(relay);
  }

  // The maximum of value(p) over the corners of a relay.
  template <class Value>
  double mostOver(const Relay& relay, const Value& value) const {
    double most = -kFarAway;
    for (const V3d& v : relay.corners) most = std::max(most, value(v));
    return most;
  }

  int imagesBy(const Relay& relay) const { return imagesMadeBy(*scene_.materialAt(relay.modifier)); }

  std::optional<Projection> project(const LightSource& source, const Relay& relay, int image) {
    if (std::holds_alternative<Prism>(*scene_.materialAt(relay.modifier)))
      return projectByPrism(source, relay, image);
    const double before =
        source.center.dot(relay.normal) - (source.distant ? 0 : relay.offset) + extent(source, relay.normal);
    if (before <= kTiny) return std::nullopt;  // behind the mirror
    return Projection{relay.normal, relay.offset, -2. * relay.normal, true};
  }

  // The map to the image in a prism: a shear, combined with a reflection if the light leaves on the side that
  // it came from. The ray from the source's center through the relay's center, after the prism has turned it,
  // then appears to come from the center of the image.
  std::optional<Projection> projectByPrism(const LightSource& source, const Relay& relay, int image) {
    FunctionPoint at;
    at.point = relay.ball.center + (relay.offset - relay.ball.center.dot(relay.normal)) * relay.normal;
    const V3d way = source.distant ? -source.center : at.point - source.center;
    at.distance = at.shadowDistance = way.length();
    if (!(at.distance > 0)) return std::nullopt;
    at.direction = way / at.distance;
    at.normal = relay.normal;
    at.cosine = -at.direction.dot(relay.normal);
    ShapeHit hit;
    const V3d before = at.point - at.direction;
    if (std::abs(at.cosine) <= kTiny ||
        !intersect(scene_.surfaces[relay.surface].shape, scene_.vertices, before, at.direction, 2, hit))
      return std::nullopt;
    const auto [share, direction] = functions_.redirection(relay.modifier, image, at, scratch_);
    const double in = -at.cosine, out = direction.dot(relay.normal);
    if (share <= kTiny || std::abs(out) <= kTiny) return std::nullopt;
    return Projection{relay.normal, relay.offset, (std::abs(in / out) * direction - at.direction) / in,
                      false};
  }

  // The side of its last relay on which the light of a virtual source leaves: the points with
  // away . p > offset.
  struct Side {
    V3d away;
    double offset;
  };
  static Side sideLit(const LightSource& source, const Relay& last) {
    // It is opposite to the image.
    double side = source.center.dot(last.normal);
    if (!source.distant) side -= last.offset;
    return side > 0 ? Side{-last.normal, -last.offset} : Side{last.normal, last.offset};
  }

  // Whether light of a source can reach the relay at all.
  bool lights(LightId index, const Relay& relay) const {
    const LightSource& source = sources_[index];
    if (source.isVirtual()) {
      const Relay& last = relays_[relayOf_[index]];
      const auto [away, offset] = sideLit(source, last);
      if (mostOver(relay, [&](const V3d& p) { return p.dot(away) - offset; }) <= kTiny) return false;
      if (!meetsBeam(source, last, relay.ball)) return false;
    }
    if (source.distant) return true;
    // As in RADIANCE, the reach is compared with the distance to the relay's center.
    if (source.reach > 0 && (relay.ball.center - source.center).length() > source.reach) return false;
    if (source.spot &&
        !meetsCone(source, source.spot->aim, 1 - source.spot->solidAngle / (2 * kPi), relay.ball))
      return false;
    if (!source.isPlane()) return true;
    return mostOver(relay, [&](const V3d& p) { return (p - source.center).dot(source.normal); }) > kTiny;
  }

  // False only if lights() is false of every relay within the bounds.
  bool mayLight(LightId index, const RelayTree::Bounds& bounds) const {
    const LightSource& source = sources_[index];
    if (!source.isVirtual()) return true;
    const Relay& last = relays_[relayOf_[index]];
    const auto [away, offset] = sideLit(source, last);
    const V3d middle = bounds.corners.center(), half = bounds.corners.size() / 2;
    const V3d span(std::abs(away.x), std::abs(away.y), std::abs(away.z));
    const double rounding = kRounding * (middle.length() + half.length() + std::abs(offset));
    if (middle.dot(away) + half.dot(span) - offset + rounding <= kTiny) return false;
    Ball ball{bounds.centers.center(), bounds.centers.size().length() / 2 + bounds.radius};
    ball.radius += kRounding * (ball.center.length() + ball.radius + last.ball.center.length() +
                                (source.distant ? 0 : source.center.length()));
    return meetsBeam(source, last, ball);
  }

  static bool meetsBeam(const LightSource& source, const Relay& last, const Ball& ball) {
    if (source.distant) {
      const V3d between = ball.center - last.ball.center;
      // A source as wide as 120 degrees is taken to light every relay. That costs tests, but no light.
      if (source.cosHalfAngle <= .5) return true;
      const double distance = between.length() + last.ball.radius + ball.radius;
      const double spread = distance * source.sinHalfAngle / source.cosHalfAngle;
      const V3d aside = between - between.dot(source.center) * source.center;
      return aside.length() <= last.ball.radius + ball.radius + spread;
    }
    return meetsCone(source, source.beam, source.cosBeam, ball);
  }

  // Whether the ball can be hit by rays in a cone around the axis. The cone starts at the source's center;
  // for rays from the rest of the source, the ball is enlarged by the source's radius.
  static bool meetsCone(const LightSource& source, const V3d& axis, double cosHalf, const Ball& ball) {
    const V3d towards = ball.center - source.center;
    const double distance = towards.length(), radius = ball.radius + source.radius;
    if (cosHalf <= 0 || distance <= radius) return true;
    const double angle = std::acos(std::clamp(towards.dot(axis) / distance, -1., 1.));
    return angle <= std::acos(cosHalf) + std::asin(radius / distance) + kTiny;
  }

  static LightSource imageOf(const LightSource& source, const Relay& relay, const Projection& projection) {
    LightSource image = source;
    image.hitsWhereAimed = false;
    image.surface = relay.surface;
    image.u = projection.vector(source.u);
    image.v = projection.vector(source.v);
    for (V3d& p : image.fanVertices) p = projection.point(p);
    if (source.isPlane()) image.normal = projection.vector(source.normal).normalized();
    if (image.spot) {
      image.spot->aim = projection.vector(image.spot->aim).normalized();
      // A shear does not map a cone to a cone, so the image has no limit. The spot's cone is tested when the
      // ray reaches the real source.
      if (!projection.isMirror) image.spot->solidAngle = 4 * kPi;
    }
    if (source.distant) {
      image.center = projection.vector(source.center).normalized();
      return image;
    }
    image.center = projection.point(source.center);
    const V3d towards = relay.ball.center - image.center;
    const double distance = towards.length();
    // As seen from the image's center, every point on a ray from the image through the relay lies within this
    // angle of the relay's center, however far the ray goes on.
    const double sine = (relay.ball.radius + source.radius) / distance;
    image.cosBeam = -1;
    if (distance > 0 && sine < 1) {
      image.beam = towards / distance;
      image.cosBeam = std::sqrt(1 - sine * sine);
    }
    return image;
  }

  const Scene& scene_;
  const SurfaceFunctions& functions_;
  FunctionScratch scratch_;
  ById<LightId, LightSource>& sources_;
  std::vector<Relay> relays_;
  RelayTree tree_{{}};
  ById<LightId, size_t> relayOf_;  // for a virtual one, the index in relays_ of its last relay
};

}  // namespace

void addVirtualSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                       const rad::Warn& warn, ById<LightId, LightSource>& sources) {
  if (relays <= 0 || sources.empty()) return;
  Images images(scene, functions, warn, sources);
  for (const LightId real : sources.ids()) images.addImages(real, relays);
}

}  // namespace rsphere
