#include "trace/tracer.h"

#include <Imath/ImathBoxAlgo.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/overloaded.h"
#include "trace/embree.h"
#include "trace/refracting.h"
#include "trace/triangle.h"

namespace rsphere {
namespace {

// The properties of a surface that matter for shadow rays and ties, stored once for each finish.
struct Occluder {
  PrimitiveId modifier;  // the later definition takes precedence in ties
  bool sensor = false;   // takes precedence in ties, and blocks no shadow ray
  bool hasMaterial = false;
  bool transparent = false;
  bool opaqueFront = false, opaqueBack = false;  // whether this side stops every shadow ray

  bool stops(double cosine) const { return cosine > 0 ? opaqueFront : opaqueBack; }
};

// Whether a mixture precedes the material in the chain.
bool meetsMixture(const Scene& scene, const Finish& finish) {
  for (ModifierId m = finish.modifier; m != finish.material; m = scene.modifiers[m].next)
    if (std::holds_alternative<Mixture>(scene.modifiers[m].content)) return true;
  return false;
}

Occluder makeOccluder(const Scene& scene, const Finish& finish, bool backFacesVisible) {
  Occluder o;
  o.modifier = finish.described;
  o.sensor = finish.sensor;
  if (finish.material == kNone) return o;
  o.hasMaterial = true;
  const Material* material = scene.materialAt(finish.material);
  o.transparent = material && isTransparent(*material);
  // Alternates, antimatter and mixtures decide at the hit whether a ray passes.
  if (material && finish.clip == 0 && !meetsMixture(scene, finish)) {
    const Sides stops = stopsShadows(*material);
    o.opaqueFront = stops.front;
    o.opaqueBack = stops.back || (stops.front && backFacesVisible);
  }
  return o;
}

// The surface to which a hit is attributed.
struct Owner {
  const Occluder* occluder = nullptr;  // null: none
  SurfaceId surface;

  explicit operator bool() const { return occluder != nullptr; }
};

// Whether surface a takes precedence over b, if both are hit at the same place.
bool wins(const Owner& ownerA, double cosineA, const Owner& ownerB, double cosineB) {
  const Occluder &a = *ownerA.occluder, &b = *ownerB.occluder;
  if (a.sensor != b.sensor) return a.sensor;
  if (a.hasMaterial != b.hasMaterial) return a.hasMaterial;
  if (a.transparent != b.transparent) return b.transparent;
  if ((cosineA > 0) != (cosineB > 0)) return cosineA > 0;
  if (a.modifier != b.modifier) return a.modifier > b.modifier;
  return ownerA.surface > ownerB.surface;
}

// Increases a length by more than the rounding errors of single precision (2^-24) and of its computation.
float roundUp(double x) { return static_cast<float>(x * (1 + 1e-6)); }

// Whether an instance or mesh has a modifier, which then applies to all of its contents.
bool standsForContents(const Owner& o) { return o.occluder->modifier != rad::kVoid; }

// The nearest hit so far, in the coordinates of the tree that is queried.
struct Found {
  Owner owner;
  ShapeHit hit;
  PlacementPath path;        // placements from the world to the surface that was hit
  uint8_t modifierPath = 0;  // number of these that apply to the surface's modifiers
  const rad::Mesh* mesh = nullptr;
  uint32_t triangle;  // of the mesh
  TriangleHit triangleHit;
};

// The query that belongs to a ray of Embree, in the coordinates of the queried tree. Embree passes the
// context to the callbacks.
struct Query {
  embree::QueryContext context;  // must be first: callbacks cast its address to that of the Query
  V3d origin, direction;
  double start = 0;     // distance along the true ray at which Embree's ray starts
  double farthest = 0;  // limit of the query
  double samePlace;     // Scene::samePlace, in units of this tree
  // Hits closer to the origin are ignored: Scene::samePlace, or that of the contents of an instance or mesh.
  // Less if the ray starts in space.
  double nearest;
  uint8_t depth = 0;  // of the tree: the number of placements that lead to it
  Found best;         // shadow(): the source itself, if it is a surface
  SurfaceId source;
  Owner standIn;          // the instance or mesh to which hits on the tree's contents may be attributed
  bool passable = false;  // shadow(): whether something was hit that may transmit light
  // Primitives of the tree: `from` is where the ray starts, which it cannot hit again; `target` is its aim.
  uint32_t from = Tracer::kNoBlocker, target = Tracer::kNoBlocker;
  uint32_t blocker = 0;  // shadow(): the primitive of the tree that stopped the ray
  double stop = 0;       // its distance

  double reach() const { return best.owner ? best.hit.distance + samePlace : farthest; }
  // Whether the best hit takes precedence over another hit within reach().
  bool loses(const Owner& owner, const ShapeHit& hit) const {
    return best.owner && hit.distance >= best.hit.distance - samePlace &&
           !wins(owner, hit.cosine, best.owner, best.hit.cosine);
  }
};

double distanceTo(const Box3d& box, const V3d& point) { return (point - Imath::clip(point, box)).length(); }

// Whether the shape is a polygon or ring in the plane of the neighborhood.
bool liesInPlane(ShapeRef shape, const Tracer::Neighborhood& around) {
  constexpr double kParallel = 1e-9;  // planes are parallel if |cosine| of their normals is within this of 1
  const V3d* const normal = planeNormal(shape);
  if (!normal || std::abs(normal->dot(around.normal)) < 1 - kParallel) return false;
  return std::abs(planeOffset(shape) - normal->dot(around.point)) <= around.thickness;
}

float roundDown(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

// Embree's settings, by the total number of primitives.
const char* deviceFor(size_t primitives) {
  // Embree's cache for subdivision surfaces (128 MB of address space) is not needed. In small scenes, threads
  // and huge pages are disabled: starting threads takes longer than building the tree, and Embree reads
  // /proc/meminfo to find out about huge pages.
  if (primitives < 20000) return "tessellation_cache_size=0,threads=1,user_threads=1,hugepages=0";
  // Compared with leaves of one primitive, leaves of up to four save 27 bytes a primitive. In scenes larger
  // than the processor's caches they take no more time: more primitives are tested, but less of the tree is
  // read. In scenes of a few thousand polygons they take 4 to 10% more time.
  if (primitives < 200000) return "tessellation_cache_size=0";
  return "tessellation_cache_size=0,object_accel_max_leaf_size=4";
}

}  // namespace

// Surfaces that are traced together, and Embree's tree over them.
class Tracer::Tree {
 public:
  // Trees of the contents of instances and meshes: of all surfaces of each group, of the refracting surfaces
  // of each group, and of each mesh.
  struct Others {
    std::span<const std::unique_ptr<Tree>> groups, refracting, meshes;
  };

  // The tree of a group of surfaces. occluders: by index of finish. only: if not null, the tree has only
  // these surfaces, and its instances refer to trees of refracting surfaces. Instances with a modifier still
  // refer to whole trees, because the modifier applies to all of their contents.
  Tree(RTCDevice device, const Scene& scene, const SurfaceGroup& group, std::span<const Occluder> occluders,
       const Others& others, const ById<SurfaceId, bool>* only = nullptr)
      : scene_(scene), others_(others), isWhole_(!only), occluders_(occluders) {
    for (const SurfaceId i : group.surfaces)
      if (only && (*only)[i]) {
        chosen_.push_back(i);
        chosenFaces_.push_back(scene.surfaces.face(i));
      }
    count_ = isWhole_ ? group.surfaces.size() : chosen_.size();
    if (count_ == 0) return;
    first_ = group.surfaces[0];
    faces_ = isWhole_ ? &scene.surfaces.face(first_) : chosenFaces_.data();
    for (size_t i = 0; i < count_; ++i) {
      const Box3d box = boundsOf(scene.surfaces[surfaceOf(i)]);
      primitives_ += !box.isEmpty();
      bounds_.extendBy(box);
    }
    build(device, count_, onIntersect<&Tree::meetSurface>, onOccluded<&Tree::crossSurface>);
  }

  // The tree of a mesh's triangles.
  Tree(RTCDevice device, const Scene& scene, const Mesh& mesh, std::span<const Occluder> occluders)
      : scene_(scene), occluders_(occluders), mesh_(&mesh) {
    primitives_ = mesh.data.triangles.size();
    for (uint32_t i = 0; i < primitives_; ++i) bounds_.extendBy(rsphere::bounds(mesh.data, i));
    build(device, primitives_, onIntersect<&Tree::meetTriangle>, onOccluded<&Tree::crossTriangle>);
  }

  ~Tree() {
    if (tree_) rtcReleaseScene(tree_);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  const Box3d& bounds() const { return bounds_; }
  Box3d boundsOf(const Surface& surface) const {
    const Contents contents = contentsOf(surface);
    if (!contents.tree) return rsphere::bounds(surface.shape, scene_.vertices);
    return placed(scene_.placements[contents.placement], contents.tree->bounds_);
  }
  size_t primitives() const { return primitives_; }

  // Embree's primitive number of a surface in the whole tree of the world; kNoBlocker for kNone.
  static uint32_t primitiveOf(SurfaceId surface) { return static_cast<uint32_t>(surface.number()); }

  // The primitive that a ray starting on this surface cannot hit again; kNoBlocker if there is none.
  uint32_t beginOf(SurfaceId surface) const {
    const uint32_t primitive = primitiveOf(surface);
    if (primitive >= count_) return kNoBlocker;
    const Face& face = faces_[primitive];
    return face.hasArea || planeNormal(scene_.surfaces.shapeOf(face)) ? primitive : kNoBlocker;
  }

  // The owner of hits that are attributed to a surface itself, not to an instance or mesh around it.
  Owner ownerOf(SurfaceId surface) const {
    return {&occluders_[scene_.surfaces.face(surface).finish], surface};
  }

  // Updates query.best with the nearest hit in this tree; see Tracer::nearest().
  void nearest(Query& query) const {
    RTCRayHit rayHit;
    if (!aim(query, rayHit.ray)) return;
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree::initContext(query.context);
    embree::intersect(tree_, query.context, rayHit);
  }

  // Whether this primitive of a group's tree stops the ray.
  bool isBlocker(Query& query, uint32_t primitive) const {
    return primitive < count_ && crossSurface(query, primitive);
  }

  // Whether the ray is certainly stopped. If not, query.passable is set if it may have to be followed.
  bool blocks(Query& query) const {
    RTCRay ray;
    if (!aim(query, ray)) return false;
    embree::initContext(query.context);
    embree::occluded(tree_, query.context, ray);
    return ray.tfar < 0;
  }

  // Tracer::anySmallNear() in the coordinates of the tree.
  bool anySmallNear(const Neighborhood& around) const {
    if (!tree_ || distanceTo(bounds_, around.point) > around.radius) return false;
    const V3d m = around.point - center_;
    // Single precision moves the point by at most 2^-23 of its distance from the center.
    const double radius = around.radius + padding_ + 0x1p-23 * (radius_ + around.radius);
    return embree::anyWithin(tree_, static_cast<float>(m.x), static_cast<float>(m.y), static_cast<float>(m.z),
                             roundUp(radius), [&](uint32_t i) { return isSmallNear(around, i); });
  }

 private:
  // The surface with this primitive number of Embree.
  SurfaceId surfaceOf(size_t primitive) const {
    return isWhole_ ? SurfaceId(first_.index() + primitive) : chosen_[primitive];
  }

  // The contents of an instance or a mesh.
  struct Contents {
    const Tree* tree = nullptr;
    uint32_t placement = 0;
  };
  Contents contentsOf(const Surface& surface) const {
    return match(
        surface.shape,
        [&](const Instance& instance) {
          const bool all = isWhole_ || scene_.hasOwnModifier(surface);
          return Contents{(all ? others_.groups : others_.refracting)[instance.group].get(),
                          instance.placement};
        },
        [&](const MeshInstance& mesh) {
          return Contents{others_.meshes[mesh.mesh].get(), mesh.placement};
        },
        [](const OneOf<Polygon, Sphere, Cone, Ring, Distant, MeshFaces> auto&) { return Contents{}; });
  }

  Box3d boundsOf(uint32_t primitive) const {
    if (mesh_) return rsphere::bounds(mesh_->data, primitive);
    return boundsOf(scene_.surfaces[surfaceOf(primitive)]);
  }

  bool isSmallNear(const Neighborhood& around, uint32_t primitive) const {
    const Surface& surface = scene_.surfaces[surfaceOf(primitive)];
    const Box3d box = boundsOf(surface);
    if (surface.finish.sensor) return false;
    if (distanceTo(box, around.point) > around.radius) return false;
    const V3d size = box.size();
    if (std::max({size.x, size.y, size.z}) <= around.widest) return !liesInPlane(surface.shape, around);
    const auto* instance = surface.shape.as<Instance>();
    if (!instance) return false;
    const Placement& placement = scene_.placements[instance->placement];
    const double scale = placement.toInner.scale;
    return others_.groups[instance->group]->anySmallNear(
        {placement.toInner.point(around.point), placement.directionToInner(around.normal),
         around.radius * scale, around.widest * scale, around.thickness * scale});
  }

  void build(RTCDevice device, size_t primitives, RTCIntersectFunctionN intersect,
             RTCOccludedFunctionN occluded) {
    if (bounds_.isEmpty()) return;
    center_ = bounds_.center();
    radius_ = bounds_.size().length() / 2;
    samePlace_ = samePlaceIn(bounds_);
    // Embree's ray starts within 2 radii of the center and is at most 4 radii long. Rounding of its origin
    // moves it by at most 2^-23 radius per coordinate, and rounding of its direction by 2^-22 radius over
    // that length.
    padding_ = radius_ * 0x1p-21;
    tree_ = rtcNewScene(device);
    rtcSetSceneFlags(tree_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(primitives));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, writeBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(tree_);
  }

  static void writeBounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const Tree*>(arguments->geometryUserPtr);
    const Box3d box = self.boundsOf(arguments->primID);
    RTCBounds& out = *arguments->bounds_o;
    if (box.isEmpty()) {  // Embree ignores such primitives
      out.lower_x = std::numeric_limits<float>::infinity(), out.upper_x = -out.lower_x;
      return;
    }
    const V3d low = box.min - self.center_ - V3d(self.padding_),
              high = box.max - self.center_ + V3d(self.padding_);
    out.lower_x = roundDown(low.x), out.lower_y = roundDown(low.y), out.lower_z = roundDown(low.z);
    out.upper_x = -roundDown(-high.x), out.upper_y = -roundDown(-high.y), out.upper_z = -roundDown(-high.z);
  }

  // Sets Embree's ray for a query. It starts where the true ray comes near the tree, so that single precision
  // suffices. False if the true ray does not come near.
  bool aim(Query& query, RTCRay& ray) const {
    if (!tree_) return false;
    const V3d m = query.origin - center_;
    query.start = 0;
    V3d begin = m;
    if (m.length2() > 4 * radius_ * radius_) {
      const double b = m.dot(query.direction);
      if (b > 0 || (m - b * query.direction).length() > radius_) return false;
      query.start = std::max(-b - radius_, 0.);
      begin += query.start * query.direction;
    }
    ray.org_x = static_cast<float>(begin.x);
    ray.org_y = static_cast<float>(begin.y);
    ray.org_z = static_cast<float>(begin.z);
    ray.dir_x = static_cast<float>(query.direction.x);
    ray.dir_y = static_cast<float>(query.direction.y);
    ray.dir_z = static_cast<float>(query.direction.z);
    ray.tnear = 0;
    const double reach = std::min(query.farthest - query.start, 4 * radius_) + padding_;
    if (!(reach > 0)) return false;
    ray.tfar = roundUp(reach);
    ray.time = 0;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return true;
  }

  // Embree's callbacks. `meet` returns whether the primitive is the nearest hit so far, `cross` whether it
  // certainly stops the ray.
  template <bool (Tree::*meet)(Query&, uint32_t) const>
  static void onIntersect(const RTCIntersectFunctionNArguments* arguments) {
    if (!arguments->valid[0]) return;
    const auto& self = *static_cast<const Tree*>(arguments->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    if (arguments->primID == query.from || !(self.*meet)(query, arguments->primID)) return;
    auto& rayHit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    rayHit.ray.tfar = std::min(rayHit.ray.tfar, roundUp(query.reach() - query.start + self.padding_));
    rayHit.hit.geomID = arguments->geomID;
    rayHit.hit.primID = arguments->primID;
  }
  template <bool (Tree::*cross)(Query&, uint32_t) const>
  static void onOccluded(const RTCOccludedFunctionNArguments* arguments) {
    if (!arguments->valid[0]) return;
    const auto& self = *static_cast<const Tree*>(arguments->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    if (arguments->primID == query.from || arguments->primID == query.target ||
        !(self.*cross)(query, arguments->primID))
      return;
    query.blocker = arguments->primID;
    reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
  }

  bool meets(const Query& query, const auto& shape, ShapeHit& hit) const {
    return intersect(shape, scene_.vertices, query.origin, query.direction, query.reach(), hit,
                     query.nearest);
  }

  // Most scenes consist of polygons, so they are tested on a short path.
  bool meetSurface(Query& query, uint32_t primitive) const {
    const Face& face = faces_[primitive];
    if (!face.hasArea) return meetOther(query, surfaceOf(primitive));
    ShapeHit hit;
    return meets(query, face, hit) && take(query, {&occluders_[face.finish], surfaceOf(primitive)}, hit);
  }

  [[gnu::noinline]] bool meetOther(Query& query, SurfaceId id) const {
    const Surface& surface = scene_.surfaces[id];
    const Owner owner = ownerOf(id);
    if (const Contents contents = contentsOf(surface); contents.tree)
      return meetContents(query, owner, contents);
    ShapeHit hit;
    return meets(query, surface.shape, hit) && take(query, owner, hit);
  }

  bool take(Query& query, const Owner& owner, const ShapeHit& hit) const {
    if (query.loses(owner, hit)) return false;
    query.best.owner = owner;
    query.best.hit = hit;
    query.best.path.count = query.best.modifierPath = query.depth;
    query.best.mesh = nullptr;
    return true;
  }

  bool meetTriangle(Query& query, uint32_t primitive) const {
    TriangleHit hit;
    if (!intersect(mesh_->data, primitive, query.origin, query.direction, query.reach(), hit, query.nearest))
      return false;
    if (!take(query, triangleOwner(primitive, query.standIn), hit.hit)) return false;
    query.best.mesh = &mesh_->data;
    query.best.triangle = primitive;
    query.best.triangleHit = hit;
    return true;
  }

  // A hit on a mesh without a modifier is attributed to the triangle's material or, if it has none, to the
  // mesh.
  Owner triangleOwner(uint32_t triangle, const Owner& mesh) const {
    const int32_t material = mesh_->data.triangles[triangle].material;
    return standsForContents(mesh) || material == rad::Mesh::kNoMaterial
               ? mesh
               : ownerOf(mesh_->facesOf[static_cast<size_t>(material)]);
  }

  // The query transformed to the coordinates of the contents of an instance or mesh.
  Query inner(const Query& query, const Owner& owner, const Contents& contents) const {
    const Placement& placement = scene_.placements[contents.placement];
    Query in;
    in.origin = placement.toInner.point(query.origin);
    in.direction = placement.directionToInner(query.direction);
    in.farthest = query.reach() * placement.toInner.scale;
    in.samePlace = query.samePlace * placement.toInner.scale;
    in.nearest =
        query.nearest < query.samePlace ? query.nearest * placement.toInner.scale : contents.tree->samePlace_;
    in.depth = query.depth + 1;
    in.standIn = owner;
    return in;
  }

  bool meetContents(Query& query, const Owner& owner, const Contents& contents) const {
    Query in = inner(query, owner, contents);
    contents.tree->nearest(in);
    if (!in.best.owner) return false;
    const Placement& placement = scene_.placements[contents.placement];
    Found& found = in.best;
    found.hit.distance *= placement.toOuter.scale;
    found.hit.normal = placement.directionToOuter(found.hit.normal);
    found.path.placements[query.depth] = contents.placement;
    if (standsForContents(owner)) {
      found.owner = owner;
      found.modifierPath = query.depth;
    }
    if (query.loses(found.owner, found.hit)) return false;
    query.best = found;
    return true;
  }

  // Whether a hit stops the ray. This depends on the side that was hit. Near the source it also depends on
  // the tie with the source, which is query.best.
  bool crosses(Query& query, const Owner& owner, const ShapeHit& hit) const {
    if (query.loses(owner, hit)) return false;
    if (owner.occluder->stops(hit.cosine)) {
      query.stop = hit.distance;
      return true;
    }
    query.passable = true;
    return false;
  }

  bool crossSurface(Query& query, uint32_t primitive) const {
    const SurfaceId surface = surfaceOf(primitive);
    const Face& face = faces_[primitive];
    const Owner owner = query.standIn ? query.standIn : Owner{&occluders_[face.finish], surface};
    if (owner.surface == query.source || owner.occluder->sensor) return false;
    if (!face.hasArea) return crossOther(query, surface, owner);
    ShapeHit hit;
    return meets(query, face, hit) && crosses(query, owner, hit);
  }

  [[gnu::noinline]] bool crossOther(Query& query, SurfaceId own, const Owner& owner) const {
    const Surface& surface = scene_.surfaces[own];
    if (const Contents contents = contentsOf(surface); contents.tree)
      return crossContents(query, ownerOf(own), contents);
    ShapeHit hit;
    return meets(query, surface.shape, hit) && crosses(query, owner, hit);
  }

  bool crossTriangle(Query& query, uint32_t primitive) const {
    TriangleHit hit;
    return intersect(mesh_->data, primitive, query.origin, query.direction, query.reach(), hit,
                     query.nearest) &&
           crosses(query, triangleOwner(primitive, query.standIn), hit.hit);
  }

  bool crossContents(Query& query, const Owner& own, const Contents& contents) const {
    Query in = inner(query, own, contents);
    in.best = query.best;
    in.best.hit.distance *= scene_.placements[contents.placement].toInner.scale;
    in.source = query.source;
    if (query.standIn)
      in.standIn = query.standIn;
    else if (!standsForContents(own) && !contents.tree->mesh_)
      in.standIn = {};
    const bool blocked = contents.tree->blocks(in);
    query.passable = query.passable || in.passable;
    query.stop = in.stop * scene_.placements[contents.placement].toOuter.scale;
    return blocked;
  }

  const Scene& scene_;
  Others others_;
  bool isWhole_ = true;
  std::span<const Occluder> occluders_;  // by index of finish
  const Mesh* mesh_ = nullptr;
  SurfaceId first_;                // of a group
  std::vector<SurfaceId> chosen_;  // unless isWhole_: its surfaces, by Embree's primitive number
  std::vector<Face> chosenFaces_;
  const Face* faces_ = nullptr;  // of a group, by Embree's primitive number
  size_t count_ = 0;             // of Embree's primitives; 0 for a mesh
  size_t primitives_ = 0;        // number of primitives with bounds
  Box3d bounds_;
  V3d center_{0, 0, 0};
  double radius_ = 0;   // of a sphere around all primitives
  double padding_ = 0;  // see build()
  double samePlace_ = kSamePlace;
  RTCScene tree_ = nullptr;
};

struct Tracer::Embree {
  RTCDevice device = nullptr;
  std::vector<Occluder> occluders;                    // by index of finish
  std::vector<std::unique_ptr<Tree>> meshes, groups;  // in the order of the scene
  // By group: the tree of its refracting surfaces; null if there are none.
  std::vector<std::unique_ptr<Tree>> refracting;

  double samePlace = kSamePlace, rounding = 0;  // in the world

  Query query(const V3d& origin, const V3d& direction, double farthest, SurfaceId from) const {
    Query query;
    query.origin = origin;
    query.direction = direction;
    query.farthest = farthest;
    query.samePlace = samePlace;
    query.nearest = from == kInSpace ? rounding : samePlace;
    query.from = groups[0]->beginOf(from);
    return query;
  }

  // Whether a stopped shadow ray hits a surface that may refract it before it is stopped.
  bool refractsBefore(Query& query) const {
    Query bent = this->query(query.origin, query.direction, query.stop, kNone);
    bent.nearest = query.nearest;
    refracting[0]->nearest(bent);
    const Found& found = bent.best;
    // The tree contains all triangles of a mesh, including those that do not refract.
    if (!found.owner || found.owner.occluder->stops(found.hit.cosine)) return false;
    query.best.owner = found.owner;
    query.best.hit = found.hit;
    query.farthest = found.hit.distance + query.samePlace;
    return !groups[0]->blocks(query);
  }

  ~Embree() {
    refracting.clear();
    groups.clear();
    meshes.clear();
    if (device) rtcReleaseDevice(device);
  }
};

Tracer::Tracer(const Scene& scene, bool backFacesVisible)
    : scene_(scene), embree_(std::make_unique<Embree>()) {
  Embree& e = *embree_;
  const auto fail = [] { throw rad::Error("cannot build the ray tracing tree", rad::Status::system); };
  size_t primitives = scene.surfaces.size();
  for (const Mesh& mesh : scene.meshes) primitives += mesh.data.triangles.size();
  e.device = rtcNewDevice(deviceFor(primitives));
  if (!e.device) fail();
  for (const Finish& finish : scene.surfaces.finishes())
    e.occluders.push_back(makeOccluder(scene, finish, backFacesVisible));
  for (const Mesh& mesh : scene.meshes)
    e.meshes.push_back(std::make_unique<Tree>(e.device, scene, mesh, e.occluders));
  // Trees of instances are built before the trees that contain the instances.
  e.groups.resize(scene.groups.size());
  e.refracting.resize(scene.groups.size());
  const ById<SurfaceId, bool> refracts = refractingSurfaces(scene);
  const Tree::Others others{e.groups, e.refracting, e.meshes};
  const auto build = [&](const auto& self, size_t g) -> void {
    const SurfaceGroup& group = scene.groups[g];
    if (scene.groups.size() > 1)
      for (const SurfaceId surface : group.surfaces)
        if (const auto* instance = scene.surfaces[surface].shape.as<Instance>())
          if (!e.groups[instance->group]) self(self, instance->group);
    e.groups[g] = std::make_unique<Tree>(e.device, scene, group, e.occluders, others);
    bool refractsAny = false;
    for (const SurfaceId s : group.surfaces) refractsAny = refractsAny || refracts[s];
    if (refractsAny)
      e.refracting[g] = std::make_unique<Tree>(e.device, scene, group, e.occluders, others, &refracts);
  };
  if (!scene.groups.empty()) {
    build(build, 0);
    bounds_ = e.groups[0]->bounds();
    e.samePlace = scene.samePlace;
    e.rounding = roundingIn(bounds_);
    for (const SurfaceId s : scene.outermostIds())
      if (refracts[s]) refracting_.push_back(e.groups[0]->boundsOf(scene.surfaces[s]));
  }
  if (rtcGetDeviceError(e.device) != RTC_ERROR_NONE) fail();
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

size_t Tracer::primitives() const {
  size_t sum = 0;
  for (const auto& tree : embree_->groups) sum += tree->primitives();
  for (const auto& tree : embree_->meshes) sum += tree->primitives();
  return sum;
}

Hit Tracer::nearest(const V3d& origin, const V3d& direction, double farthest, SurfaceId from) const {
  Hit result;
  if (embree_->groups.empty()) return result;
  Query query = embree_->query(origin, direction, farthest, from);
  embree_->groups[0]->nearest(query);
  const Found& found = query.best;
  if (!found.owner) return result;
  result.surface = found.owner.surface;
  result.distance = found.hit.distance;
  result.normal = found.hit.normal;
  result.cosine = found.hit.cosine;
  if (found.path.count == 0) return result;
  result.path = found.path;
  result.path.count = found.modifierPath;
  if (!found.mesh) return result;
  const Imath::V2d uv = localCoordinates(*found.mesh, found.triangle, found.triangleHit);
  result.u = uv.x;
  result.v = uv.y;
  V3d smooth = smoothNormal(*found.mesh, found.triangle, found.triangleHit);
  if (smooth == V3d(0, 0, 0)) return result;
  for (size_t i = found.path.count; i-- > 0;)
    smooth = scene_.placements[found.path.placements[i]].directionToOuter(smooth);
  result.perturbation = smooth - result.normal;
  return result;
}

bool Tracer::stopsShadows(SurfaceId surface, bool front) const {
  const Occluder& o = embree_->occluders[scene_.surfaces.face(surface).finish];
  return front ? o.opaqueFront : o.opaqueBack;
}

bool Tracer::isClear(const V3d& origin, const V3d& direction, double distance, SurfaceId from) const {
  if (embree_->groups.empty()) return true;
  Query query = embree_->query(origin, direction, distance, from == kInSpace ? from : kNone);
  return !embree_->groups[0]->blocks(query) && !query.passable;
}

bool Tracer::anySmallNear(const Neighborhood& around) const {
  return !embree_->groups.empty() && embree_->groups[0]->anySmallNear(around);
}

Shadow Tracer::shadow(const V3d& origin, const V3d& direction, double distance, SurfaceId source,
                      uint32_t* blocker, SurfaceId from) const {
  if (embree_->groups.empty()) return Shadow::clear;
  const Tree& tree = *embree_->groups[0];
  Query query = embree_->query(origin, direction, distance, from);
  query.source = source;
  if (source != kNone) {
    query.target = Tree::primitiveOf(source);
    // The source emits from its front, so ties with surfaces on it are resolved for that side.
    query.best.owner = tree.ownerOf(source);
    query.best.hit = {distance, V3d(0, 0, 0), 1};
    query.farthest += query.samePlace;
  }
  bool blocked = true;
  if (blocker && tree.isBlocker(query, *blocker))
    query.blocker = *blocker;
  else
    blocked = tree.blocks(query);
  const bool refracted = blocked && embree_->refracting[0] && embree_->refractsBefore(query);
  blocked = blocked && !refracted;
  // If a ray is unoccluded, the next one usually is too. Testing the old blocker would then take more time
  // than it saves.
  if (blocker) *blocker = blocked ? query.blocker : kNoBlocker;
  if (blocked) return Shadow::blocked;
  if (refracted) return Shadow::refracted;
  return query.passable ? Shadow::unsure : Shadow::clear;
}

}  // namespace rsphere
