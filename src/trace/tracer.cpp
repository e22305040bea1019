#include "trace/tracer.h"

#include <cmath>
#include <limits>

#include "trace/embree.h"

namespace rsphere {
namespace {

// What a surface does to shadow rays and ties, looked up once.
struct Occluder {
  uint32_t surface = 0;
  int32_t modifier = kNone;  // place of definition: later wins ties
  bool hasMaterial = false;
  bool transparent = false;
  bool opaqueFront = false, opaqueBack = false;  // surely lets no shadow ray pass when hit there
};

bool stopsFromBehind(const Material& material) {
  // A light source stops rays to other sources from both sides, whatever -bv says; so do materials with
  // functions.
  if (const auto* brtd = std::get_if<BrtdFunction>(&material)) return !brtd->transmits;
  if (const auto* wgmd = std::get_if<WgmdFunction>(&material)) return !wgmd->transmits;
  return std::holds_alternative<Anisotropic>(material) || std::holds_alternative<Ashikhmin>(material) ||
         std::holds_alternative<FunctionScatterer>(material) || std::holds_alternative<Light>(material) ||
         std::holds_alternative<Glow>(material) || std::holds_alternative<Spotlight>(material);
}

bool stopsFromFront(const Material& material) {
  if (const auto* mirror = std::get_if<Mirror>(&material))
    return mirror->alternate.kind == Alternate::Kind::none;
  return std::holds_alternative<Opaque>(material) || stopsFromBehind(material);
}

// Whether a mixture stands before the surface's material.
bool meetsMixture(const Scene& scene, const Surface& surface) {
  for (int32_t m = surface.modifier; m != surface.material; m = scene.modifiers[m].next)
    if (std::holds_alternative<Mixture>(scene.modifiers[m].content)) return true;
  return false;
}

Occluder makeOccluder(const Scene& scene, uint32_t i, bool backFacesVisible) {
  const Surface& surface = scene.surfaces[i];
  Occluder o;
  o.surface = i;
  o.modifier = scene.description.primitives[surface.primitive].modifier;
  if (surface.material == kNone) return o;
  o.hasMaterial = true;
  const Material* material = scene.materialOf(surface);
  o.transparent = material && isTransparent(*material);
  // An alternate or a mixture has to be asked.
  if (material && !meetsMixture(scene, surface)) {
    o.opaqueFront = stopsFromFront(*material);
    o.opaqueBack = stopsFromBehind(*material) || (o.opaqueFront && backFacesVisible);
  }
  return o;
}

// Whether surface a, of two that are hit at the same place, is the one that counts.
bool wins(const Occluder& a, double cosineA, const Occluder& b, double cosineB) {
  if (a.hasMaterial != b.hasMaterial) return a.hasMaterial;
  if (a.transparent != b.transparent) return b.transparent;
  if ((cosineA > 0) != (cosineB > 0)) return cosineA > 0;
  if (a.modifier != b.modifier) return a.modifier > b.modifier;
  return a.surface < b.surface;
}

// Moves up by one step of single precision and the rounding of what led there.
float roundUp(double x) {
  return std::nextafter(static_cast<float>(x * (1 + 1e-6)), std::numeric_limits<float>::infinity());
}

bool intersectShape(const Scene& scene, const Surface& surface, const V3d& origin, const V3d& direction,
                    double farthest, ShapeHit& hit) {
  return std::visit(
      [&](const auto& shape) {
        using S = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<S, Polygon>)
          return intersect(shape, scene.vertices, origin, direction, farthest, hit);
        else if constexpr (std::is_same_v<S, Distant>)
          return false;
        else
          return intersect(shape, origin, direction, farthest, hit);
      },
      surface.shape);
}

// The ray as callbacks see it; Embree hands the context through.
struct Query {
  embree::QueryContext context;  // first, so that its address is the query's
  const V3d* origin = nullptr;
  const V3d* direction = nullptr;
  double start = 0;     // where Embree's ray begins, along the true one
  double farthest = 0;  // for nearest(): of the best hit so far, for shadow(): of the source
  int32_t source = kNone;
  const Occluder* best = nullptr;
  ShapeHit hit;
  bool passable = false;
};

}  // namespace

struct Tracer::Embree {
  const Scene& scene;
  std::vector<Occluder> occluders;  // by Embree's primitive number
  std::vector<int32_t> occluderOf;  // by surface; kNone for distant ones
  V3d center{0, 0, 0};
  double radius = 0;  // of a sphere around everything
  double padding = 0;
  RTCDevice device = nullptr;
  RTCScene tree = nullptr;

  explicit Embree(const Scene& s) : scene(s) {}
  ~Embree() {
    if (tree) rtcReleaseScene(tree);
    if (device) rtcReleaseDevice(device);
  }

  static Box3d boundsOf(const Scene& scene, const Surface& surface) {
    return std::visit(
        [&](const auto& shape) {
          using S = std::decay_t<decltype(shape)>;
          if constexpr (std::is_same_v<S, Polygon>)
            return rsphere::bounds(shape, scene.vertices);
          else if constexpr (std::is_same_v<S, Distant>)
            return Box3d();
          else
            return rsphere::bounds(shape);
        },
        surface.shape);
  }

  static void writeBounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    const Box3d box = boundsOf(self.scene, self.scene.surfaces[self.occluders[arguments->primID].surface]);
    const V3d low = box.min - self.center - V3d(self.padding),
              high = box.max - self.center + V3d(self.padding);
    RTCBounds& out = *arguments->bounds_o;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -kInfinity); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), kInfinity); };
    out.lower_x = down(low.x), out.lower_y = down(low.y), out.lower_z = down(low.z);
    out.upper_x = up(high.x), out.upper_y = up(high.y), out.upper_z = up(high.z);
  }

  static void onIntersect(const RTCIntersectFunctionNArguments* arguments) {
    if (!arguments->valid[0]) return;
    const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    const Occluder& occluder = self.occluders[arguments->primID];
    ShapeHit hit;
    const double farthest = query.best ? query.hit.distance + kSamePlace : query.farthest;
    if (!intersectShape(self.scene, self.scene.surfaces[occluder.surface], *query.origin, *query.direction,
                        farthest, hit))
      return;
    if (query.best && hit.distance >= query.hit.distance - kSamePlace &&
        !wins(occluder, hit.cosine, *query.best, query.hit.cosine))
      return;
    query.best = &occluder;
    query.hit = hit;
    auto& rayHit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    rayHit.ray.tfar =
        std::min(rayHit.ray.tfar, roundUp(hit.distance + kSamePlace - query.start + self.padding));
    rayHit.hit.geomID = arguments->geomID;
    rayHit.hit.primID = arguments->primID;
  }

  static void onOccluded(const RTCOccludedFunctionNArguments* arguments) {
    if (!arguments->valid[0]) return;
    const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    const Occluder& occluder = self.occluders[arguments->primID];
    if (static_cast<int32_t>(occluder.surface) == query.source) return;
    ShapeHit hit;
    if (!intersectShape(self.scene, self.scene.surfaces[occluder.surface], *query.origin, *query.direction,
                        query.farthest, hit))
      return;
    // At the source's own place the tie decides; query.hit is where the source itself is hit.
    if (query.best && hit.distance >= query.hit.distance - kSamePlace &&
        !wins(occluder, hit.cosine, *query.best, query.hit.cosine))
      return;
    if (hit.cosine > 0 ? occluder.opaqueFront : occluder.opaqueBack)
      reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
    else
      query.passable = true;
  }

  // Embree's ray for a query: begins where the true ray comes near the scene, so that single precision
  // suffices. False where it never does.
  bool aim(Query& query, RTCRay& ray) const {
    const V3d m = *query.origin - center;
    const double b = m.dot(*query.direction);
    const double c = m.length();
    query.start = c > 2 * radius ? -b - radius : 0;
    if (c > 2 * radius) {
      if (b > 0 || (m - b * *query.direction).length() > radius) return false;
      query.start = std::max(query.start, 0.);
    }
    const V3d begin = m + query.start * *query.direction;
    ray.org_x = static_cast<float>(begin.x);
    ray.org_y = static_cast<float>(begin.y);
    ray.org_z = static_cast<float>(begin.z);
    ray.dir_x = static_cast<float>(query.direction->x);
    ray.dir_y = static_cast<float>(query.direction->y);
    ray.dir_z = static_cast<float>(query.direction->z);
    ray.tnear = 0;
    const double reach = std::min(query.farthest - query.start, 4 * radius) + padding;
    if (!(reach > 0)) return false;
    ray.tfar = roundUp(reach);
    ray.time = 0;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return true;
  }
};

Tracer::Tracer(const Scene& scene, bool backFacesVisible) : embree_(std::make_unique<Embree>(scene)) {
  Embree& e = *embree_;
  e.occluderOf.assign(scene.surfaces.size(), kNone);
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const Box3d box = Embree::boundsOf(scene, scene.surfaces[i]);
    if (box.isEmpty()) continue;
    bounds_.extendBy(box);
    e.occluderOf[i] = static_cast<int32_t>(e.occluders.size());
    e.occluders.push_back(makeOccluder(scene, i, backFacesVisible));
  }
  if (e.occluders.empty()) return;
  e.center = bounds_.center();
  e.radius = bounds_.size().length() / 2;
  // A ray of Embree's starts within 2 radii and ends within 4 more: rounding moves its origin by at most
  // 2^-23 radius a coordinate, and its direction, over that length, by 2^-22.
  e.padding = e.radius * 0x1p-21;

  const auto fail = [&] { throw rad::Error("cannot build the ray tracing tree", rad::Status::system); };
  // Threads help only where there is something to build; starting them costs more than a small scene's tree.
  e.device = rtcNewDevice(e.occluders.size() < 20000 ? "threads=1,user_threads=1" : nullptr);
  if (!e.device) fail();
  e.tree = rtcNewScene(e.device);
  rtcSetSceneFlags(e.tree, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(e.occluders.size()));
  rtcSetGeometryUserData(geometry, &e);
  rtcSetGeometryBoundsFunction(geometry, Embree::writeBounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, Embree::onIntersect);
  rtcSetGeometryOccludedFunction(geometry, Embree::onOccluded);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(e.tree, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(e.tree);
  if (rtcGetDeviceError(e.device) != RTC_ERROR_NONE) fail();
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

Hit Tracer::nearest(const V3d& origin, const V3d& direction, double farthest) const {
  Hit result;
  if (embree_->occluders.empty()) return result;
  Query query;
  query.origin = &origin;
  query.direction = &direction;
  query.farthest = farthest;
  RTCRayHit rayHit;
  if (!embree_->aim(query, rayHit.ray)) return result;
  rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::initContext(query.context);
  embree::intersect(embree_->tree, query.context, rayHit);
  if (query.best)
    result = {static_cast<int32_t>(query.best->surface), query.hit.distance, query.hit.normal,
              query.hit.cosine};
  return result;
}

Shadow Tracer::shadow(const V3d& origin, const V3d& direction, double distance, int32_t source) const {
  if (embree_->occluders.empty()) return Shadow::clear;
  Query query;
  query.origin = &origin;
  query.direction = &direction;
  query.farthest = distance;
  query.source = source;
  const int32_t own = source == kNone ? kNone : embree_->occluderOf[source];
  if (own != kNone) {
    // The front is what shines; the tie with whatever lies on the source is decided for that side.
    query.best = &embree_->occluders[own];
    query.hit = {distance, V3d(0, 0, 0), 1};
    query.farthest += kSamePlace;
  }
  RTCRay ray;
  if (!embree_->aim(query, ray)) return Shadow::clear;
  embree::initContext(query.context);
  embree::occluded(embree_->tree, query.context, ray);
  if (ray.tfar < 0) return Shadow::blocked;
  return query.passable ? Shadow::unsure : Shadow::clear;
}

}  // namespace rsphere
