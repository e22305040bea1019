// Indirect light from the field of interpolation (-aa).
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/even_sequence.h"
#include "transport/irradiance_field.h"
#include "transport/path_tracer.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// The cosine of the greatest tilt of the normal that light is interpolated for.
constexpr double kLeastUpright = .7;

constexpr int kReachRays = 16;

}  // namespace

// How the fields look at the scene, for a path of this depth.
class PathTracer::Looker final : public SiteLooker, public CoarseSolution::Looker {
 public:
  Looker(PathTracer& tracer, int depth) : tracer_(tracer), depth_(depth) {}
  GatheredLight gather(const GatherSite& site, uint64_t seed) override {
    return tracer_.gatherer().gather(site, seed, depth_);
  }
  bool sees(const V3d& from, const V3d& to) override {
    const V3d way = to - from;
    const double length = way.length();
    return !(length > kSamePlace) || tracer_.t_.tracer().isClear(from, way / length, length);
  }
  void link(const GatherSite& site, int rays, uint64_t seed, CoarseSolution::Links& links) override {
    tracer_.gatherer().link(site, rays, seed, depth_, links);
  }
  double reach(const GatherSite& site) override { return tracer_.reach(site); }
  bool smallObjectNear(const GatherSite& site, double side, double lift) override {
    // An object as wide as a cell is not smaller than it, whatever rounding does.
    constexpr double kRounding = 1e-6;
    return tracer_.t_.tracer().anySmallNear(
        {site.point, site.normal, side, side * (1 - kRounding), 3 * lift});
  }

 private:
  PathTracer& tracer_;
  int depth_;
};

PathTracer& PathTracer::gatherer() {
  if (!gatherer_) gatherer_ = std::make_unique<PathTracer>(t_, t_.spots());
  return *gatherer_;
}

namespace {

// Whether fields serve a ray's end: sites see what the world sees, nothing cut away, and no medium of its
// own.
bool isOrdinary(const Ray& ray, const Medium& medium) {
  return !ray.mist && !ray.clips && !ray.clipsBeyond && !ray.scatterers.count &&
         ray.medium.extinction == medium.extinction;
}

SurfacePlace placeOf(const Ray& ray, const V3d& trueNormal) {
  return {ray.point, trueNormal, ray.surface, &ray.path, ray.length};
}

}  // namespace

// The diffuse bounces that the limits allow beyond the end of a ray.
int PathTracer::bouncesLeft(const Ray& ray) const {
  const RayOptions& o = t_.options();
  int left = o.ambientBounces - ray.ambientLevel;
  if (o.reflectionLimit != 0) left = std::min(left, std::abs(o.reflectionLimit) - ray.level);
  if (o.reflectionLimit > 0)
    for (double weight = ray.weight / 2, n = 0; n < left; ++n, weight /= 2)
      if (weight < o.weightLimit) left = static_cast<int>(n);
  return std::max(left, 0);
}

// The patch that serves a ray's end; null where the path has to be followed.
CoarseSolution::Patch* PathTracer::patchAt(const Ray& ray, const V3d& normal, const V3d& trueNormal,
                                           Looker& looker) {
  const double u1 = random_.uniform(), u2 = random_.uniform();
  if (!isOrdinary(ray, t_.medium()) || normal.dot(trueNormal) < kLeastUpright) return nullptr;
  return t_.coarse()->find(placeOf(ray, trueNormal), u1, u2, looker);
}

// Whether the coarse solution has what addIndirect() asks for, and it was added.
bool PathTracer::addFromPatch(Ray& ray, const V3d& normal, const V3d& trueNormal, const Rgb& coefficient) {
  Looker looker(*this, ray.depth);
  const int beyond = ray.ambientLevel - 1;
  // Nobody asks a patch for the bounces beyond these.
  const bool isLast = linking_ && ray.ambientLevel >= t_.options().ambientBounces - 1;
  CoarseSolution::Patch* const patch = isLast ? nullptr : patchAt(ray, normal, trueNormal, looker);
  if (linking_) {
    const Rgb whole = coefficient * ray.contribution * passedBy(ray);
    if (patch)
      linking_->links.push_back({patch, V3f(whole), beyond});
    else
      linking_->addEnd(beyond, whole);
    if (isLast) return true;
  } else if (patch) {
    ray.value += coefficient * Rgb(t_.coarse()->light(*patch, bouncesLeft(ray), looker));
  }
  return patch;
}

// Whether the field has what addIndirect() asks for, and it was added.
bool PathTracer::addInterpolated(Ray& ray, const V3d& normal, const V3d& trueNormal, const Rgb& coefficient) {
  // Nobody else asks for an imagined point.
  if (ray.surface == kNone || gathersFirstAnew_) return false;
  if (!isOrdinary(ray, t_.medium()) || normal.dot(trueNormal) < kLeastUpright) return false;
  Looker looker(*this, ray.depth);
  GatheredLight light;
  if (!t_.field()->find(placeOf(ray, trueNormal), fieldReader_, looker, light)) return false;
  const V3f mean = light.meanOfTilted(trueNormal, normal);
  for (int c = 0; c < 3; ++c) ray.value[c] += coefficient[c] * mean[c];
  return true;
}

Ray PathTracer::gatherRoot(const GatherSite& site, int depth) const {
  Ray root;
  root.medium = t_.medium();
  root.point = site.point;
  root.normal = site.normal;
  root.length = 0;
  root.depth = depth;
  return root;
}

// Sends rays over a hemisphere: most of them stratified by projected solid angle, the others aimed at
// openings and bright spots. Each counts by the density with which all of these together choose its direction
// (the balance heuristic). normal: what the hemisphere is around; directions behind trueNormal are left out,
// and count as dark.
void PathTracer::gatherHemisphere(const Ray& root, const V3d& normal, const V3d& trueNormal, RayKind kind,
                                  int rays, GatherRay each) {
  V3d x, y;
  frame(normal, x, y);
  Openings::Aim openings;
  if (t_.openings()) t_.openings()->aim(root.point, normal, openings);
  BrightSpots::Aim spots;
  if (spots_) spots_->aim(root.point, normal, spots);
  double shares[3] = {1, openings.share, spots.share};
  shares[2] *= 1 - shares[1];
  shares[0] = 1 - shares[1] - shares[2];
  // So few rays that a kind might get none are of one kind at random; their density is that of the mixture.
  int counts[3] = {rays, 0, 0};
  if (rays < 16 && shares[0] < 1) {
    counts[0] = 0;
    for (int i = 0; i < rays; ++i) {
      const double u = random_.uniform();
      ++counts[u < shares[0] ? 0 : u < shares[0] + shares[1] ? 1 : 2];
    }
  } else {
    for (int k = 1; k < 3; ++k) counts[k] = static_cast<int>(shares[k] * rays + .5);
    counts[0] = rays - counts[1] - counts[2];
    for (int k = 0; k < 3; ++k) shares[k] = static_cast<double>(counts[k]) / rays;
  }
  const auto send = [&](const V3d& direction) {
    const double cosine = direction.dot(normal);
    if (cosine <= 0 || direction.dot(trueNormal) <= 0) return;
    double density = shares[0];
    if (shares[1] > 0)
      density += shares[1] * kPi / cosine * t_.openings()->density(openings, root.point, direction);
    if (shares[2] > 0) density += shares[2] * kPi / cosine * spots_->density(spots, direction);
    Ray child;
    child.direction = direction;
    Rgb weight(kMeanReflectance, kMeanReflectance, kMeanReflectance);
    if (!continueRay(child, kind, root, weight)) return;
    ++child.ambientLevel;
    each(child, weight.x / (kMeanReflectance * density * rays));
  };
  const double shift1 = random_.uniform(), shift2 = random_.uniform(), shift3 = random_.uniform();
  // A Fibonacci lattice over the projected hemisphere, shifted at random: as even as a jittered grid for any
  // number.
  constexpr double kGolden = .6180339887498949;
  for (int i = 0; i < counts[0]; ++i) {
    const double around = shift2 + i * kGolden;
    send(diffuseDirection(normal, (i + shift1) / counts[0], around - std::floor(around)));
  }
  for (int i = 0; i < counts[1]; ++i) {
    const Imath::V2d u = evenly(static_cast<size_t>(i), shift1, shift2);
    send(t_.openings()->sample(openings, root.point, (i + shift3) / counts[1], u.x, u.y));
  }
  for (int i = 0; i < counts[2]; ++i) {
    const Imath::V2d u = evenly(static_cast<size_t>(i), shift1, shift2);
    send(spots_->sample(spots, (i + shift3) / counts[2], u.x, u.y));
  }
}

// What a patch of the coarse solution finds.
void PathTracer::link(const GatherSite& site, int rays, uint64_t seed, int depth,
                      CoarseSolution::Links& links) {
  random_ = Random(seed ^ rotationBits(t_.options()));
  linking_ = &links;
  const Ray root = gatherRoot(site, depth);
  Rgb sum(0, 0, 0);
  gatherHemisphere(root, site.normal, site.normal, kReflectedAmbient, rays, [&](Ray& child, double part) {
    child.contribution = Rgb(part, part, part);
    evaluate(child);
    sum += child.value * part;
  });
  links.addLight(0, sum);
  linking_ = nullptr;
}

double PathTracer::reach(const GatherSite& site) {
  // By projected solid angle, in the frame of the site.
  static const auto directions = [] {
    const HemisphereCells cells(kReachRays);
    std::array<V3d, kReachRays> of;
    for (int i = 0; i < kReachRays; ++i)
      of[i] = cells.direction(i, .5, .5, V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1));
    return of;
  }();
  V3d x, y;
  frame(site.normal, x, y);
  double inverse = 0;
  for (const V3d& d : directions) {
    const Hit hit = t_.tracer().nearest(site.point, d.x * x + d.y * y + d.z * site.normal);
    if (hit.surface != kNone) inverse += 1 / hit.distance;
  }
  return inverse > 0 ? kReachRays / inverse : kFarAway;
}

// What a site of the field gets. depth: of the ray that asks; nothing but the limit of nesting depends on it.
GatheredLight PathTracer::gather(const GatherSite& site, uint64_t seed, int depth) {
  const RayOptions& o = t_.options();
  const Ray root = gatherRoot(site, depth);
  V3d x, y;  // the frame of gatherHemisphere()
  frame(site.normal, x, y);
  const int count = o.ambientDivisions + o.ambientSuperSamples;
  const HemisphereCells cells(count);
  std::vector<Rgb> radiance(cells.count(), Rgb(0, 0, 0));
  std::vector<double> distance(cells.count(), kFarAway);
  random_ = Random(seed ^ rotationBits(t_.options()));
  gatherHemisphere(root, site.normal, site.normal, kReflectedAmbient, count, [&](Ray& child, double part) {
    evaluate(child);
    const int cell = cells.cellOf(child.direction, x, y, site.normal);
    radiance[cell] += child.value * (part * cells.count());
    distance[cell] = std::min(distance[cell], apparentLength(child));
  });
  return cells.sum(radiance, distance, t_.field()->finestSpacing() / 2, x, y, site.normal);
}

}  // namespace rsphere
