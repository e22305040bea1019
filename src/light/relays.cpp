#include "light/relays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "base/constants.h"
#include "base/frame.h"
#include "base/overloaded.h"
#include "light/penumbra.h"
#include "light/tuning.h"
#include "scene/box_tree.h"

namespace rsphere {
namespace {

constexpr double kTiny = 1e-6;  // of cosines and shares: RADIANCE's own figure; Scene::samePlace for lengths
// Bounds of relays are enlarged by this fraction of their distance so that rounding cannot exclude a relay.
constexpr double kRelayRounding = 1e-9;
// For light that has passed more relays than this, only its source and this number of the last relays bound
// it, because storing all n relays of each image in a chain of n would take memory of order n^2. The bounds
// become wider, which affects memory and time but no answer. The images of two facing mirrors with -dr 2000
// take 3 MB.
constexpr size_t kMostRelays = 8;
// A polygon with more corners bounds light by the rectangle around it: the planes between two outlines are as
// many as the products of their corners (addPenumbra()).
constexpr size_t kMostCorners = 64;

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

struct Relay {
  SurfaceId surface;
  ModifierId modifier;  // of the material
  V3d normal;
  double offset = 0;         // normal . p for the points p of the plane
  Ball ball;                 // around it
  std::vector<V3d> corners;  // of the polygon, or of a square around the ring
  std::vector<V3d> hull;     // their convex hull contains all points where rays can hit it: hullOf()
};

// One element of the path that the light of an image has taken: the source (unless it is distant) or a relay.
// The path is unfolded to a straight line as it appears from behind the last relay: the source and the
// earlier relays are moved to where the later relays show their images.
struct Passage {
  Ball ball;  // around it
  Beam beam;  // contains all points behind the last relay that light from the ball reaches; apex: its center
  std::vector<V3d> hull;  // its convex hull contains the lit part of this element
  bool isFlat = false;    // the hull is a polygon
};
struct Way {
  std::vector<Passage> passages;
  std::vector<HalfSpace> lit;  // each contains all points behind the last relay that the light reaches
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

// The corners of a box, in an order in which edges join successive corners.
std::vector<V3d> cornersOf(const Box3d& box) {
  std::vector<V3d> corners;
  for (const unsigned k : {0, 1, 3, 2, 6, 7, 5, 4})
    corners.emplace_back((k & 1 ? box.max : box.min).x, (k & 2 ? box.max : box.min).y,
                         (k & 4 ? box.max : box.min).z);
  return corners;
}

// The corners of the square around a ring.
std::vector<V3d> cornersOf(const Ring& ring) {
  const auto [x, y] = frame(ring.normal, ring.outer);
  return {ring.center - x - y, ring.center - x + y, ring.center + x + y, ring.center + x - y};
}

// Points whose convex hull contains all points where rays can hit a shape. Rays hit a polygon in its mean
// plane, so its vertices are first moved into that plane along the coordinate axis Polygon::axis.
std::vector<V3d> hullOf(ShapeRef shape, std::span<const V3d> vertices) {
  return match(
      shape,
      [&](const Polygon& polygon) {
        const auto own = vertices.subspan(polygon.firstVertex, polygon.vertices);
        std::vector<V3d> corners(own.begin(), own.end());
        if (polygon.hasArea)
          for (V3d& p : corners)
            p[polygon.axis] -= (p.dot(polygon.normal) - polygon.offset) / polygon.normal[polygon.axis];
        if (corners.size() <= kMostCorners) return corners;
        const auto [x, y] = frame(polygon.normal);
        Box3d box;
        for (const V3d& p : corners) box.extendBy(V3d(p.dot(x), p.dot(y), polygon.offset));
        corners = cornersOf(box);
        corners.resize(4);  // of the rectangle around the polygon
        for (V3d& p : corners) p = p.x * x + p.y * y + p.z * polygon.normal;
        return corners;
      },
      [](const Ring& ring) { return cornersOf(ring); },
      [](const OneOf<Sphere, Cone> auto& solid) { return cornersOf(bounds(solid)); },
      [](const Distant&) { return std::vector<V3d>(); },
      [](const NestedShape auto&) { return std::vector<V3d>(); });
}

// The largest distance of the source's points from its center, measured along a unit vector.
double extent(const LightSource& source, const V3d& along) {
  const auto ofPlane = [&](const PlaneLight& plane) {
    const double u = plane.u.dot(along), v = plane.v.dot(along);
    return match(
        plane.map, [&](const PlaneLight::Parallelogram&) { return std::abs(u) + std::abs(v); },
        [&](const PlaneLight::Square&) { return source.radius; },
        [&](const PlaneLight::Disk&) { return std::hypot(u, v); },
        [&](const PlaneLight::Triangles& triangles) {
          double most = 0;
          for (const V3d& p : triangles.vertices) most = std::max(most, (p - source.center).dot(along));
          return most;
        });
  };
  return match(
      source.shape, ofPlane, [&](const OneOf<BallLight, TubeLight> auto&) { return source.radius; },
      [&](const DistantLight&) { return source.outermost; });
}

static_assert(kLightForms == 8, "Which of its members does a mirror move?");
LightShape imageOf(LightShape shape, const Projection& projection) {
  match(
      shape,
      [&](PlaneLight& plane) {
        plane.normal = projection.vector(plane.normal).normalized();
        plane.u = projection.vector(plane.u);
        plane.v = projection.vector(plane.v);
        if (auto* triangles = std::get_if<PlaneLight::Triangles>(&plane.map))
          for (V3d& p : triangles->vertices) p = projection.point(p);
        measure(plane);
      },
      [&](TubeLight& tube) { tube.half = projection.vector(tube.half); },
      [](const OneOf<BallLight, DistantLight> auto&) {});
  return shape;
}

class Images {
 public:
  Images(const Scene& scene, const SurfaceFunctions& functions, const rad::Warn& warn,
         ById<LightId, LightSource>& sources)
      : scene_(scene), functions_(functions), sources_(sources) {
    for (const SurfaceId i : scene.outermostIds()) addRelay(i, warn);
    std::vector<Box3d> boxes;
    for (const Relay& relay : relays_) {
      Box3d& box = boxes.emplace_back();
      for (const V3d& corner : relay.corners) box.extendBy(corner);
      largest_ = std::max(largest_, relay.ball.radius);
    }
    tree_ = BoxTree(std::move(boxes));
  }

  // Adds the images of all real sources, and images of images, in sequences of up to `relays` relays. Adds
  // none and returns false if there are more than `most`.
  bool addAll(int relays, size_t most) {
    const size_t real = sources_.size();
    for (size_t i = 0; i < real && sources_.size() - real <= most; ++i)
      addImages(LightId(i), relays, most - (sources_.size() - real));
    if (sources_.size() - real <= most) return true;
    sources_.resize(real);
    return false;
  }

 private:
  // Ends early if there are more than `most`.
  void addImages(LightId real, int relays, size_t most) {
    Way way;
    const LightSource& source = sources_[real];
    const Surface& surface = scene_.surfaces[source.surface];
    if (!source.isDistant())
      way.passages.push_back({{source.center, source.radius},
                              {},
                              hullOf(surface.shape, scene_.vertices),
                              planeNormal(surface.shape) != nullptr});
    std::vector<Pending> pending;
    addPending(real, std::move(way), relays, pending);
    const size_t before = sources_.size();
    while (!pending.empty() && sources_.size() - before <= most) {
      const Pending next = std::move(pending.back());
      pending.pop_back();
      addImage(next, pending);
    }
  }

  // A relay that light reaches, and points whose hull contains the lit part of it.
  struct Reached {
    uint32_t relay;
    std::vector<V3d> part;
  };
  // An image that is still to be made. The last one in the list is made first, followed by all images of it,
  // so that in a long sequence of relays only the path to the last image is in memory.
  struct Pending {
    LightId source;
    std::shared_ptr<const Way> way;  // the path of the light up to the source
    Reached reached;
    int image;
    int relays;  // how many more there may be in the sequence, this one included
  };

  // Appends the images of a source so that the first one is made first.
  void addPending(LightId source, Way&& way, int relays, std::vector<Pending>& pending) const {
    if (relays <= 0) return;
    std::vector<Reached> reached = relaysReached(source, way);
    if (reached.empty()) return;
    const auto passages = std::make_shared<const Way>(Way{std::move(way.passages), {}});
    std::ranges::reverse(reached);
    for (const Reached& r : reached)
      for (int image = imagesBy(relays_[r.relay]); image-- > 0;)
        pending.push_back({source, passages, r, image, relays});
  }

  // The relays that the light of a source may reach after this path.
  std::vector<Reached> relaysReached(LightId source, const Way& way) const {
    std::vector<uint32_t> found;
    tree_.any([&](const Box3d& box) { return mayLight(source, way, box); },
              [&](uint32_t relay) {
                found.push_back(relay);
                return false;
              });
    std::ranges::sort(found);
    std::vector<Reached> reached;
    for (const uint32_t r : found) {
      // A relay makes no image of its own images, nor of its own surface as a source.
      if (relays_[r].surface == sources_[source].surface) continue;
      if (!lights(source, way, relays_[r])) continue;
      std::vector<V3d> part = clipped(relays_[r].hull, way.lit);
      if (!part.empty()) reached.push_back({r, std::move(part)});
    }
    return reached;
  }

  void addImage(const Pending& wanted, std::vector<Pending>& pending) {
    const auto& [source, before, reached, image, relays] = wanted;
    const Way& way = *before;
    const Relay& relay = relays_[reached.relay];
    const auto projection = project(sources_[source], way, relay, image);
    if (!projection) return;
    LightSource made = imageOf(sources_[source], relay, *projection);
    made.relayed = source;
    made.image = image;
    Way through = wayThrough(made, way, relay, reached.part, *projection);
    if (std::ranges::any_of(through.passages, [](const Passage& p) { return p.hull.empty(); })) return;
    if (!made.isDistant()) made.beam = through.passages.front().beam;
    relayOf_.resize(sources_.size());
    relayOf_.push_back(reached.relay);
    sources_.push_back(std::move(made));
    const auto [away, offset] = sideLit(sources_.last());
    through.lit.push_back({away, offset});
    addPending(sources_.last(), std::move(through), relays - 1, pending);
  }

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
    match(
        surface.shape,
        [&](const Polygon& polygon) {
          const auto vertices = std::span(scene_.vertices).subspan(polygon.firstVertex, polygon.vertices);
          relay.corners.assign(vertices.begin(), vertices.end());
          relay.ball.center = centerOf(polygon, scene_.vertices);
          for (const V3d& v : vertices)
            relay.ball.radius = std::max(relay.ball.radius, (v - relay.ball.center).length());
        },
        [&](const Ring& ring) {
          relay.ball.center = ring.center;
          relay.ball.radius = ring.outer;
          relay.corners = cornersOf(ring);
        },
        [](const OneOf<Sphere, Cone, Distant> auto&) {},  // not plane
        [](const NestedShape auto&) {});
    relay.hull = hullOf(surface.shape, scene_.vertices);
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

  bool isPrism(const Relay& relay) const {
    return std::holds_alternative<Prism>(*scene_.materialAt(relay.modifier));
  }

  std::optional<Projection> project(const LightSource& source, const Way& way, const Relay& relay,
                                    int image) {
    if (isPrism(relay)) return projectByPrism(source, relay, image);
    const double before = source.center.dot(relay.normal) - (source.isDistant() ? 0 : relay.offset) +
                          extent(source, relay.normal);
    if (before <= scene_.samePlace) return std::nullopt;  // behind the mirror
    // If the mirror's plane cuts the source, an earlier relay may hide the part in front of it.
    const auto reachesFront = [&](const Passage& passage) {
      return passage.ball.center.dot(relay.normal) - relay.offset + passage.ball.radius > scene_.samePlace;
    };
    if (!std::ranges::all_of(way.passages, reachesFront)) return std::nullopt;
    return Projection{relay.normal, relay.offset, -2. * relay.normal, true};
  }

  // The map to the image in a prism: a shear, combined with a reflection if the light leaves on the side
  // where it arrived. After the prism has redirected the ray from the source's center through the relay's
  // center, the ray then appears to come from the center of the image.
  std::optional<Projection> projectByPrism(const LightSource& source, const Relay& relay, int image) {
    FunctionPoint at;
    at.point = relay.ball.center + (relay.offset - relay.ball.center.dot(relay.normal)) * relay.normal;
    const V3d way = source.isDistant() ? -source.center : at.point - source.center;
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

  // The half space into which the last relay of a virtual source sends its light: the points with
  // away . p > offset.
  struct Side {
    V3d away;
    double offset;
  };
  Side sideLit(LightId index) const {
    const LightSource& source = sources_[index];
    const Relay& last = relays_[relayOf_[index]];
    // A mirror reflects on its front, even if its plane cuts the source; the light of a prism leaves on the
    // side opposite to the image.
    const double side =
        isPrism(last) ? source.center.dot(last.normal) - (source.isDistant() ? 0 : last.offset) : -1;
    return side > 0 ? Side{-last.normal, -last.offset} : Side{last.normal, last.offset};
  }

  // Whether light of a source that has taken this path can reach the relay at all.
  bool lights(LightId index, const Way& way, const Relay& relay) const {
    const LightSource& source = sources_[index];
    if (source.isVirtual()) {
      const auto [away, offset] = sideLit(index);
      const auto beyond = [away = away, offset = offset](const V3d& p) { return p.dot(away) - offset; };
      if (mostOver(relay, beyond) <= scene_.samePlace) return false;
      if (!meetsBeams(source, way, relay.ball)) return false;
    }
    if (source.isDistant()) return true;
    // As in RADIANCE, the reach is compared with the distance to the relay's center.
    if (source.reach > 0 && (relay.ball.center - source.center).length() > source.reach) return false;
    if (source.spot) {
      // The spot's cone starts at the source's center. For rays from the rest of the source, the relay's ball
      // is enlarged by the source's radius.
      const Beam cone{source.spot->aim, 1 - source.spot->solidAngle / (2 * kPi)};
      const Ball enlarged{relay.ball.center, relay.ball.radius + source.radius};
      if (cone.cosine > 0 && !cone.meets(source.center, enlarged)) return false;
    }
    const auto* plane = source.as<PlaneLight>();
    return !plane || mostOver(relay, [&](const V3d& p) { return (p - source.center).dot(plane->normal); }) >
                         scene_.samePlace;
  }

  // A conservative test: false only if lights() is false for every relay whose corners lie within the box.
  bool mayLight(LightId index, const Way& way, const Box3d& box) const {
    const LightSource& source = sources_[index];
    if (!source.isVirtual()) return true;
    const auto excludes = [&](const HalfSpace& lit) { return isOutside(box, lit); };
    if (std::ranges::any_of(way.lit, excludes)) return false;
    const auto [away, offset] = sideLit(index);
    const V3d middle = box.center(), half = box.size() / 2;
    const V3d span(std::abs(away.x), std::abs(away.y), std::abs(away.z));
    const double rounding = kRelayRounding * (middle.length() + half.length() + std::abs(offset));
    if (middle.dot(away) + half.dot(span) - offset + rounding <= scene_.samePlace) return false;
    Ball ball{middle, half.length() + largest_};
    double sizes = ball.center.length() + ball.radius;
    for (const Passage& passage : way.passages) sizes += passage.ball.center.length();
    ball.radius += kRelayRounding * sizes;
    return meetsBeams(source, way, ball);
  }

  // Whether light that has taken this path can reach anything in the ball.
  static bool meetsBeams(const LightSource& source, const Way& way, const Ball& ball) {
    return std::ranges::all_of(way.passages, [&](const Passage& passage) {
      return passage.beam.meets(passage.ball.center, ball) &&
             (!source.isDistant() || meetsDistantLight(source, passage.ball, ball));
    });
  }

  // Whether light of a distant source that has passed a relay's bounding ball can reach anything in another
  // ball.
  static bool meetsDistantLight(const LightSource& source, const Ball& relay, const Ball& ball) {
    // A source with an opening of 120 degrees or more is assumed to light every relay: slower, but no light
    // is lost.
    const DistantLight& cone = *source.as<DistantLight>();
    if (cone.cosHalfAngle <= .5) return true;
    const V3d between = ball.center - relay.center;
    const double radius = relay.radius + ball.radius, distance = between.length() + radius;
    const double spread = distance * cone.sinHalfAngle / cone.cosHalfAngle;
    const V3d aside = between - between.dot(source.center) * source.center;
    return aside.length() <= radius + spread;
  }

  // Reduces each hull to the part from which light reaches the hull of `part` through the last passage. A
  // hull becomes empty if no such light exists.
  static void keepWhatReaches(const std::vector<V3d>& part, std::vector<Passage>& passages) {
    if (passages.size() < 2) return;
    std::vector<HalfSpace> seen;
    addPenumbra(part, passages.back().hull, seen);
    for (Passage& passage : std::span(passages).first(passages.size() - 1)) {
      if (passage.isFlat) {
        passage.hull = clipped(std::move(passage.hull), seen);
      } else {
        Box3d box;
        for (const V3d& p : passage.hull) box.extendBy(p);
        const auto excludes = [&](const HalfSpace& bound) { return isOutside(box, bound); };
        if (std::ranges::any_of(seen, excludes)) passage.hull.clear();
      }
    }
  }

  // The passages of an image's light: those of the source's light, as they appear in the relay, and then the
  // relay itself. part: points whose hull contains the part of the relay that the light reaches.
  static Way wayThrough(const LightSource& image, const Way& before, const Relay& relay,
                        const std::vector<V3d>& part, const Projection& projection) {
    Way way;
    auto& passages = way.passages;
    if (projection.isMirror) {
      for (const Passage& passage : before.passages) {
        // In long sequences the oldest relays after the source are omitted: they bound the light least.
        const size_t fromEnd = static_cast<size_t>(&before.passages.back() - &passage);
        if (fromEnd >= kMostRelays && !(&passage == &before.passages.front() && !image.isDistant())) continue;
        Passage& shown = passages.emplace_back(passage);
        shown.ball.center = projection.point(shown.ball.center);
        shown.beam.axis = projection.vector(shown.beam.axis);
        for (V3d& p : shown.hull) p = projection.point(p);
      }
    } else if (!image.isDistant()) {
      // The light of a prism appears to come from the image of the source, but not from images of earlier
      // relays, which are therefore dropped. A shear lengthens the source by at most its shift.
      const double radius = image.radius * (1 + projection.shift.length());
      const V3d half(radius, radius, radius);
      passages.push_back(
          {{image.center, radius}, {}, cornersOf(Box3d(image.center - half, image.center + half))});
    }
    keepWhatReaches(part, passages);
    for (Passage& passage : passages) {
      passage.beam = sharedBeam(passage.beam, beamThrough(passage.ball, relay.ball));
      addPenumbra(passage.hull, part, way.lit);
    }
    passages.push_back({relay.ball, {}, part, true});
    return way;
  }

  static LightSource imageOf(const LightSource& source, const Relay& relay, const Projection& projection) {
    LightSource image = source;
    image.hitsWhereAimed = false;
    image.surface = relay.surface;
    image.shape = rsphere::imageOf(source.shape, projection);
    if (image.spot) {
      image.spot->aim = projection.vector(image.spot->aim).normalized();
      // A shear does not map a cone to a cone, so the image has no cone. The spotlight's cone is tested when
      // the ray reaches the real source.
      if (!projection.isMirror) image.spot->solidAngle = 4 * kPi;
    }
    image.center =
        source.isDistant() ? projection.vector(source.center).normalized() : projection.point(source.center);
    return image;
  }

  const Scene& scene_;
  const SurfaceFunctions& functions_;
  FunctionScratch scratch_;
  ById<LightId, LightSource>& sources_;
  std::vector<Relay> relays_;
  BoxTree tree_;                   // of the relays' corners
  double largest_ = 0;             // radius of a relay's ball
  ById<LightId, size_t> relayOf_;  // of each virtual source: index of its last relay in relays_
};

}  // namespace

void addVirtualSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                       const rad::Warn& warn, ById<LightId, LightSource>& sources) {
  if (relays <= 0 || sources.empty()) return;
  using tuning::Relays;
  const size_t real = sources.size(),
               most = relays < kRelaysAsNeeded ? SIZE_MAX : Relays::kFew + Relays::kForEach * real;
  if (most < SIZE_MAX) relays = Relays::kMost;
  Images images(scene, functions, warn, sources);
  while (!images.addAll(relays, relays > Relays::kUsual ? most : SIZE_MAX)) --relays;
  if (most < SIZE_MAX && relays < Relays::kMost && warn)
    warn(fmt::format("light of sources by more than {} mirrors in a row is left out (-dr)", relays));
}

}  // namespace rsphere
