#include "field/surface_cells.h"

#include <tuple>

#include "base/constants.h"
#include "base/even_sequence.h"
#include "base/frame.h"
#include "base/overloaded.h"
#include "base/random.h"
#include "field/tuning.h"

namespace rsphere {
namespace {

// The number of cells that an extent is divided into, so that their side is at most `side`.
double partsOf(double extent, double side, int least) {
  return std::max<double>(std::ceil(extent / side), least);
}

constexpr double kNormalStep = 1e-9;  // components of plane normals are rounded to multiples of this
constexpr SurfaceId kPlane(-2);       // replaces the surface in the keys of shared planes

bool isPlaced(const SurfacePlace& place) { return place.path && place.path->count > 0; }

}  // namespace

uint64_t CellKey::hash(int shift) const {
  const auto both =
      static_cast<uint64_t>(static_cast<uint32_t>(surface.number())) << 32 | static_cast<uint32_t>(level);
  uint64_t h = mixBits(chart ^ both);
  h = mixBits(h ^ static_cast<uint64_t>(i >> shift));
  return mixBits(h ^ static_cast<uint64_t>(j >> shift) * 0x9e3779b97f4a7c15u);
}

CellGrid::CellGrid(const Box3d& bounds) {
  double magnitude = 0;
  if (!bounds.isEmpty()) {
    const V3d extent = bounds.size();
    size = std::max({extent.x, extent.y, extent.z});
    origin = bounds.min;
    for (int c = 0; c < 3; ++c)
      magnitude = std::max({magnitude, std::abs(bounds.min[c]), std::abs(bounds.max[c])});
  }
  if (!(size > 0)) size = 1;
  for (int level = 0; level <= kLevels; ++level) sides[static_cast<size_t>(level)] = std::ldexp(size, -level);
  lift = std::max({1e-9 * size, 1e-12 * magnitude, 2 * samePlaceIn(bounds)});
}

int CellGrid::levelOf(double side) const {
  if (!(side > 0)) return kLevels;
  int exponent = 0;
  const double mantissa =
      std::frexp(size / side, &exponent);  // size / side in [2^(exponent - 1), 2^exponent)
  return std::clamp(mantissa > .5 ? exponent : exponent - 1, 0, kLevels);
}

double SurfaceChart::extent() const {
  if (ball_) return ball_->radius;
  if (cone_) return std::max(cone_->radius0, cone_->radius1);
  return width_ > 0 ? std::max(width_, height_) : HUGE_VAL;
}

std::optional<SurfaceChart> SurfaceChart::of(const Scene& scene, const CellGrid&, const SurfacePlace& place) {
  std::optional<SurfaceChart> chart;
  if (place.surface == kNone) return chart;
  chart.emplace();
  chart->scene_ = &scene;
  chart->surface_ = place.surface;
  const bool has = match(
      scene.surfaces[place.surface].shape, [&](const Sphere& ball) { return chart->setBall(ball, place); },
      [&](const Cone& cone) { return chart->setCone(cone, place); },
      [&](const Polygon& polygon) { return chart->setPolygon(polygon, place); },
      [&](const Ring& ring) { return chart->setRing(ring, place); }, [](const Distant&) { return false; },
      [](const NestedShape auto&) { return false; });
  if (!has) chart.reset();
  return chart;
}

bool SurfaceChart::setBall(const Sphere& ball, const SurfacePlace& place) {
  const V3d out = place.point - ball.center;
  if (isPlaced(place) || out.dot(place.normal) < 0) return false;
  ball_ = &ball;
  for (int c = 0; c < 3; ++c)
    if (std::abs(out[c]) > std::abs(out[axis_])) axis_ = c;
  sign_ = out[axis_] < 0 ? -1 : 1;
  id_ = static_cast<uint64_t>(axis_ * 2 + (sign_ < 0));
  const double scale = ball.radius / std::abs(out[axis_]);
  u_ = out[(axis_ + 1) % 3] * scale;
  v_ = out[(axis_ + 2) % 3] * scale;
  return true;
}

bool SurfaceChart::setCone(const Cone& cone, const SurfacePlace& place) {
  const V3d out = place.point - cone.base;
  std::tie(x_, y_) = frame(cone.axis);
  if (isPlaced(place) || out.dot(x_) * place.normal.dot(x_) + out.dot(y_) * place.normal.dot(y_) < 0)
    return false;
  cone_ = &cone;
  u_ = std::atan2(out.dot(y_), out.dot(x_)) * extent();
  v_ = out.dot(cone.axis);
  return true;
}

bool SurfaceChart::setPolygon(const Polygon& polygon, const SurfacePlace& place) {
  setNormal(polygon.normal, place);
  const V3d* const corner = scene_->vertices.data() + polygon.firstVertex;
  const uint32_t count = polygon.vertices;
  double longest = 0;
  for (uint32_t i = 0; i < std::min(count, tuning::SurfaceCells::kEdges); ++i) {
    const V3d edge = toWorld(corner[(i + 1) % count]) - toWorld(corner[i]);
    // Edges whose lengths differ only by rounding are treated as equal, and the first is chosen.
    if (edge.length2() <= longest * (1 + 1e-9)) continue;
    longest = edge.length2();
    x_ = edge;
  }
  x_ = (x_ - x_.dot(normal_) * normal_).normalized();
  y_ = normal_.cross(x_);
  Imath::Box2d around({0, 0});
  const V3d first = toWorld(corner[0]);
  for (uint32_t i = 1; i < count; ++i) {
    const V3d way = toWorld(corner[i]) - first;
    around.extendBy({way.dot(x_), way.dot(y_)});
  }
  origin_ = first + around.min.x * x_ + around.min.y * y_;
  return setPlace(around.size().x, around.size().y, place.point);
}

bool SurfaceChart::setRing(const Ring& ring, const SurfacePlace& place) {
  setNormal(ring.normal, place);
  std::tie(x_, y_) = frame(normal_);
  const double outer = ring.outer * (placement_ ? placement_->toOuter.scale : 1);
  origin_ = toWorld(ring.center) - outer * (x_ + y_);
  return setPlace(2 * outer, 2 * outer, place.point);
}

// Sets the normal, on the side of the place, and the instances that contain the surface.
void SurfaceChart::setNormal(V3d normal, const SurfacePlace& place) {
  if (isPlaced(place)) {
    placement_ = scene_->placementOf(*place.path);
    normal = placement_->directionToOuter(normal).normalized();
    for (uint8_t i = 0; i < place.path->count; ++i) id_ = mixBits(id_ ^ place.path->placements[i]);
  }
  const bool front = normal.dot(place.normal) > 0;
  id_ = mixBits(id_ * 2 + front);
  normal_ = front ? normal : -normal;
}

V3d SurfaceChart::toWorld(const V3d& p) const { return placement_ ? placement_->toOuter.point(p) : p; }

// Sets the extent and the coordinates of the place. False if the extent is zero.
bool SurfaceChart::setPlace(double width, double height, const V3d& point) {
  width_ = width;
  height_ = height;
  if (!(width_ > 0) || !(height_ > 0)) return false;
  const V3d way = point - origin_;
  u_ = std::clamp(way.dot(x_), 0., width_);
  v_ = std::clamp(way.dot(y_), 0., height_);
  return true;
}

SurfaceChart SurfaceChart::ofPlane(const CellGrid& grid, const SurfacePlace& place) {
  SurfaceChart chart;
  chart.surface_ = kPlane;
  chart.isShared_ = true;
  for (int c = 0; c < 3; ++c) {
    const double steps = std::round(place.normal[c] / kNormalStep);
    chart.id_ = mixBits(chart.id_ ^ static_cast<uint64_t>(static_cast<int64_t>(steps)));
    chart.normal_[c] = steps * kNormalStep;
  }
  chart.normal_.normalize();
  std::tie(chart.x_, chart.y_) = frame(chart.normal_);
  const V3d local = place.point - grid.origin;
  // Planes within a slab share a chart. The offset of 3/8 avoids slab boundaries at round numbers.
  const double offset = std::floor(chart.normal_.dot(local) / grid.lift + .375);
  chart.id_ = mixBits(chart.id_ ^ static_cast<uint64_t>(static_cast<int64_t>(offset)));
  // Places the chart in front of all surfaces that share it.
  chart.origin_ = grid.origin + (offset + .625) * grid.lift * chart.normal_;
  chart.u_ = local.dot(chart.x_);
  chart.v_ = local.dot(chart.y_);
  return chart;
}

void SurfaceChart::divideAcross(int parts) {
  (width_ < height_ ? leastU_ : leastV_) = parts;
  id_ = mixBits(id_ + static_cast<uint64_t>(parts));
}

double SurfaceChart::stepU(const CellGrid& grid, int level) const {
  const double side = grid.side(level);
  return width_ > 0 ? width_ / partsOf(width_, side, leastU_) : side;
}

double SurfaceChart::stepV(const CellGrid& grid, int level) const {
  const double side = grid.side(level);
  return height_ > 0 ? height_ / partsOf(height_, side, leastV_) : side;
}

CellKey SurfaceChart::cell(const CellGrid& grid, int level, int64_t i, int64_t j) const {
  const auto within = [&](int64_t k, double end, int least) {
    if (!(end > 0)) return k;
    return std::clamp(k, int64_t{0}, static_cast<int64_t>(partsOf(end, grid.side(level), least)) - 1);
  };
  return {surface_, level, within(i, width_, leastU_), within(j, height_, leastV_), id_};
}

CellKey SurfaceChart::cellAt(const CellGrid& grid, int level, double u, double v) const {
  const double side = grid.side(level);
  const auto index = [side](double at, double end, int least) {
    if (!(end > 0)) return static_cast<int64_t>(std::floor(at / side));
    const double parts = partsOf(end, side, least);
    return static_cast<int64_t>(std::clamp(std::floor(at / (end / parts)), 0., parts - 1));
  };
  return {surface_, level, index(u, width_, leastU_), index(v, height_, leastV_), id_};
}

bool SurfaceChart::holds(const V3d& point) const {
  if (surface_ == kPlane) return true;
  const V3d local = placement_ ? placement_->toInner.point(point) : point;
  return match(
      scene_->surfaces[surface_].shape,
      [&](const Polygon& polygon) { return inside(polygon, scene_->vertices, local); },
      [&](const Ring& ring) {
        const double radius = (local - ring.center).length();
        return radius >= ring.inner && radius <= ring.outer;
      },
      [](const OneOf<Sphere, Cone, Distant> auto&) { return true; },  // not plane
      [](const NestedShape auto&) { return true; });
}

std::optional<GatherSite> SurfaceChart::siteAt(const CellGrid& grid, double u, double v) const {
  if (ball_) {
    V3d out;
    out[axis_] = sign_ * ball_->radius;
    out[(axis_ + 1) % 3] = u;
    out[(axis_ + 2) % 3] = v;
    out.normalize();
    return GatherSite{ball_->center + (ball_->radius + grid.lift) * out, out};
  }
  if (cone_) {
    if (v < 0 || v > cone_->length) return {};
    const double angle = u / extent(), slope = (cone_->radius1 - cone_->radius0) / cone_->length;
    const V3d out = std::cos(angle) * x_ + std::sin(angle) * y_;
    const V3d normal = (out - slope * cone_->axis).normalized();
    return GatherSite{cone_->base + v * cone_->axis + (cone_->radius0 + slope * v) * out + grid.lift * normal,
                      normal};
  }
  const V3d at = origin_ + u * x_ + v * y_;
  if (!holds(at)) return {};
  return GatherSite{at + grid.lift * normal_, normal_};
}

std::optional<GatherSite> SurfaceChart::siteWithin(const CellGrid& grid, const Imath::V2d& shares) const {
  const Imath::V2d around = 2. * shares - Imath::V2d(1, 1);
  if (ball_) return siteAt(grid, around.x * ball_->radius, around.y * ball_->radius);
  if (cone_) return siteAt(grid, around.x * kPi * extent(), shares.y * cone_->length);
  return siteAt(grid, shares.x * width_, shares.y * height_);
}

std::optional<GatherSite> SurfaceChart::siteIn(const CellGrid& grid, const CellKey& key,
                                               const Imath::V2d& shares) const {
  return siteAt(grid, (static_cast<double>(key.i) + shares.x) * stepU(grid, key.level),
                (static_cast<double>(key.j) + shares.y) * stepV(grid, key.level));
}

std::optional<GatherSite> SurfaceChart::site(const CellGrid& grid, const CellKey& key) const {
  for (int c = 0; c < tuning::SurfaceCells::kCandidates; ++c) {
    // The first candidate is slightly off the middle. If it lay in the plane of a wall, which often stands in
    // the exact middle of a floor, the wall would not occlude it.
    const Imath::V2d in =
        evenly(static_cast<size_t>(c), .5 + tuning::SurfaceCells::kAside, .5 - tuning::SurfaceCells::kAside);
    if (auto site = siteIn(grid, key, in)) return site;
  }
  return {};
}

}  // namespace rsphere
