#include "transport/openings.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "scene/even_sequence.h"
#include "scene/random.h"
#include "shade/scattering.h"
#include "trace/tracer.h"
#include "transport/holes.h"
#include "transport/path_tracer.h"
#include "transport/transport.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

using Tuning = tuning::Openings;

// Whether light from behind may come through a surface.
bool lightPasses(const Transport& transport, const Surface& surface) {
  const Material* material = transport.scene().materialOf(surface);
  if (!material || enclosesVolume(*material) || isLightSource(*material)) return false;
  if (const auto* scatterer = std::get_if<FunctionScatterer>(material)) return scatterer->transmissivity > 0;
  if (const auto* bsdf = std::get_if<BsdfMaterial>(material)) {
    if (!isBlack(bsdf->diffuseTransmitted)) return true;
    try {
      const BsdfData& data = transport.functions().bsdf(surface.material);
      return data.transmission(true) || !isBlack(data.diffuseTransmittance(true)) ||
             !isBlack(data.diffuseTransmittance(false));
    } catch (const rad::Error&) {
      return false;  // rays that hit it report the file
    }
  }
  return isTransparent(*material) || std::holds_alternative<Prism>(*material);
}

// Whether panes close most of a hole: near its middle and near its corners.
bool hasPane(const Transport& transport, const Rectangle& hole) {
  const Scene& scene = transport.scene();
  const double reach = .5 * std::min(hole.width, hole.height);
  int panes = 0;
  for (int c = 0; c < 5; ++c) {
    const double a = c < 4 ? .25 + .5 * (c & 1) : .5, b = c < 4 ? .25 + .5 * (c >> 1) : .5;
    const V3d middle = hole.corner + a * hole.width * hole.x + b * hole.height * hole.y;
    const Hit hit = transport.tracer().nearest(middle - reach * hole.normal, hole.normal, 2 * reach);
    if (hit.surface != kNone && lightPasses(transport, scene.surfaces[hit.surface])) ++panes;
  }
  return panes > 2;
}

}  // namespace

std::vector<Openings::Opening> Openings::panesOf(const Transport& transport, double leastArea) {
  const Scene& scene = transport.scene();
  std::vector<Opening> panes;
  for (const Surface& surface : scene.outermost()) {
    const auto* polygon = std::get_if<Polygon>(&surface.shape);
    if (!polygon || polygon->area < leastArea || !lightPasses(transport, surface)) continue;
    const V3d* const corner = scene.vertices.data() + polygon->firstVertex;
    Opening pane;
    double longest = 0;
    for (uint32_t i = 0; i < polygon->vertices; ++i) {
      const V3d edge = corner[(i + 1) % polygon->vertices] - corner[i];
      if (edge.length2() <= longest * (1 + 1e-9)) continue;
      longest = edge.length2();
      pane.x = edge;
    }
    pane.normal = polygon->normal;
    pane.x = (pane.x - pane.x.dot(pane.normal) * pane.normal).normalized();
    pane.y = pane.normal.cross(pane.x);
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < polygon->vertices; ++i) {
      const V3d way = corner[i] - corner[0];
      const double at[2] = {way.dot(pane.x), way.dot(pane.y)};
      for (int c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], at[c]);
        high[c] = std::max(high[c], at[c]);
      }
    }
    pane.corner = corner[0] + low[0] * pane.x + low[1] * pane.y;
    pane.width = high[0] - low[0];
    pane.height = high[1] - low[1];
    pane.area = polygon->area;
    panes.push_back(pane);
  }
  return panes;
}

// Holes in walls through which the sky may be seen, without those that have a pane.
std::vector<Openings::Opening> Openings::holesOf(const Transport& transport, double leastArea) {
  std::vector<Opening> holes;
  if (transport.distant().empty()) return holes;
  for (const Rectangle& r : rsphere::holesOf(transport.scene(), leastArea)) {
    Opening hole;
    hole.corner = r.corner;
    hole.x = r.x;
    hole.y = r.y;
    hole.normal = r.normal;
    hole.width = r.width;
    hole.height = r.height;
    hole.area = r.width * r.height;
    hole.isHole = true;
    if (!hasPane(transport, r)) holes.push_back(hole);
  }
  return holes;
}

// Whether a hole leads to another place than the openings so far: the two faces of a thick wall have one each.
bool Openings::isNewPlace(const Opening& hole) const {
  return std::none_of(openings_.begin(), openings_.end(), [&](const Opening& o) {
    const V3d between = o.corner + .5 * o.width * o.x + .5 * o.height * o.y -
                        (hole.corner + .5 * hole.width * hole.x + .5 * hole.height * hole.y);
    return std::abs(o.normal.dot(hole.normal)) > .99 &&
           between.length() < .5 * std::min({o.width, o.height, hole.width, hole.height});
  });
}

// Merges panes that lie side by side with small gaps only.
void Openings::merge(std::vector<Opening>& panes) {
  for (size_t i = 0; i < panes.size(); ++i)
    for (size_t j = i + 1; j < panes.size();) {
      Opening& a = panes[i];
      const Opening& b = panes[j];
      const V3d between = b.corner - a.corner;
      // Panes are coplanar within 1e-4 of their size and an angle of .08 degrees.
      const double scale = 1e-4 * (a.width + a.height);
      double low[2] = {0, 0}, high[2] = {a.width, a.height};
      bool together = a.normal.dot(b.normal) > 1 - 1e-6 && std::abs(between.dot(a.normal)) < scale;
      for (int c = 0; c < 4 && together; ++c) {
        const V3d way = between + (c & 1) * b.width * b.x + (c >> 1) * b.height * b.y;
        const double at[2] = {way.dot(a.x), way.dot(a.y)};
        for (int k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], at[k]);
          high[k] = std::max(high[k], at[k]);
        }
      }
      together = together && (high[0] - low[0]) * (high[1] - low[1]) * Tuning::kFilled < a.area + b.area;
      if (!together) {
        ++j;
        continue;
      }
      a.corner += low[0] * a.x + low[1] * a.y;
      a.width = high[0] - low[0];
      a.height = high[1] - low[1];
      a.area += b.area;
      a.power += b.power;
      panes.erase(panes.begin() + static_cast<ptrdiff_t>(j));
      j = i + 1;
    }
}

namespace {

// The brightness (W/sr/m2) of the sky, for a ray that hits nothing but panes; without their transmittance.
double skySeen(const Transport& transport, PathTracer& probe, V3d origin, const V3d& direction) {
  const Scene& scene = transport.scene();
  SurfaceId from;
  for (int pane = 0; pane < kMostPanes; ++pane) {
    const Hit hit = transport.tracer().nearest(origin, direction, kFarAway, from);
    if (hit.surface == kNone) return brightness(probe.glimpse(origin, direction, 0));
    const Surface& surface = scene.surfaces[hit.surface];
    if (scene.materialOf(surface) && !lightPasses(transport, surface)) break;
    from = hit.surface;
    origin += hit.distance * direction;
  }
  return 0;
}

// What is seen through a pane, from one side: means over the hemisphere.
struct SeenThrough {
  double all = 0;       // brightness (W/sr/m2)
  double sky = 0;       // from the sky, neither reflected nor attenuated by panes
  double distance = 0;  // root mean square, of what is hit (world units)
};

// Whether the side that is seen first is the bright side of an opening.
bool showsMoreSky(const SeenThrough& one, const SeenThrough& other) {
  return one.sky > std::max(Tuning::kMoreSky * other.sky, Tuning::kLeastSky * one.all);
}
bool isBrighter(const SeenThrough& one, const SeenThrough& other) {
  return showsMoreSky(one, other) || (!showsMoreSky(other, one) && one.all > Tuning::kBrighter * other.all);
}

}  // namespace

Openings::Openings(const Transport& transport) {
  const Box3d& bounds = transport.tracer().bounds();
  if (bounds.isEmpty()) return;
  const V3d size = bounds.size();
  const double face = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
  const double lift = std::max(1e-6 * std::max({size.x, size.y, size.z}), 2 * kSamePlace);
  std::vector<Opening> panes = panesOf(transport, Tuning::kLeastArea * face);
  const std::vector<Opening> holes = holesOf(transport, Tuning::kLeastHole * face);
  panes.insert(panes.end(), holes.begin(), holes.end());
  if (panes.empty()) return;
  std::stable_sort(panes.begin(), panes.end(), [](const Opening& a, const Opening& b) {
    return a.width * a.height > b.width * b.height;
  });
  if (panes.size() > Tuning::kMostAsked) panes.resize(Tuning::kMostAsked);
  PathTracer probe(transport);
  // Over the hemisphere around a normal, from points of a pane.
  const auto seenFrom = [&](const Opening& pane, const V3d& offset, const V3d& normal) {
    SeenThrough sum;
    double squares = 0, hits = 0;
    for (int i = 0; i < Tuning::kProbes; ++i) {
      const Imath::V2d at = evenly(static_cast<size_t>(i), .5, .5),
                       to = evenly(static_cast<size_t>(i), .1, .3);
      const V3d point = pane.corner + at.x * pane.width * pane.x + at.y * pane.height * pane.y + offset;
      const V3d direction = diffuseDirection(normal, to.y, to.x);
      sum.all += brightness(probe.glimpse(point, direction, static_cast<uint64_t>(i))) / Tuning::kProbes;
      sum.sky += skySeen(transport, probe, point, direction) / Tuning::kProbes;
      const Hit hit = transport.tracer().nearest(point, direction);
      if (hit.surface == kNone) continue;
      squares += hit.distance * hit.distance;
      ++hits;
    }
    sum.distance = std::sqrt(squares / std::max(hits, 1.));
    return sum;
  };
  double all = 0;
  for (Opening& pane : panes) {
    const SeenThrough along = seenFrom(pane, -lift * pane.normal, pane.normal),
                      against = seenFrom(pane, lift * pane.normal, -pane.normal);
    const auto& judge = pane.isHole ? showsMoreSky : isBrighter;
    const bool above = judge(along, against);
    if (!above && !judge(against, along)) continue;
    if (pane.isHole && !isNewPlace(pane)) continue;
    if (above) pane.normal = -pane.normal;
    const SeenThrough behind = seenFrom(pane, lift * pane.normal, pane.normal);
    if (!(behind.distance > 0)) continue;  // no surface receives its light
    pane.power = (above ? along : against).all * pane.area;
    inside_ += pane.power * behind.all;
    depth_ += pane.power * behind.distance;
    all += pane.power;
    openings_.push_back(pane);
  }
  if (all > 0) {
    inside_ /= all;
    depth_ /= all;
  }
  merge(openings_);
  const auto byPower = [](const Opening& a, const Opening& b) { return a.power > b.power; };
  std::stable_sort(openings_.begin(), openings_.end(), byPower);
  if (openings_.size() > Tuning::kMost) openings_.resize(Tuning::kMost);
}

void Openings::aim(const V3d& point, const V3d& normal, Aim& aim) const {
  aim.count = 0;
  double sum = 0, seen = 0;
  for (uint32_t i = 0; i < openings_.size(); ++i) {
    const Opening& o = openings_[i];
    if ((point - o.corner).dot(o.normal) <= 0) continue;
    // The form factor to the opening, estimated from five of its points.
    const double inset = Tuning::kInset, between = 1 - 2 * inset;
    double factor = 0;
    for (int c = 0; c < 5; ++c) {
      const double a = c < 4 ? inset + between * (c & 1) : .5, b = c < 4 ? inset + between * (c >> 1) : .5;
      const V3d way = o.corner + a * o.width * o.x + b * o.height * o.y - point;
      const double squared = way.length2();
      const double here = way.dot(normal), there = -way.dot(o.normal);
      if (here > 0 && there > 0) factor += here * there / (squared * squared);
    }
    factor = factor / 5 * o.area / kPi;
    if (!(factor > 0)) continue;
    seen += factor;
    aim.opening[aim.count] = i;
    aim.upTo[aim.count++] = sum += factor * o.power / o.area;
  }
  aim.mean = sum;
  aim.seen = seen;
}

double Openings::areaTowards(const V3d& direction) const {
  double sum = 0;
  for (const Opening& o : openings_) sum += std::max(0., direction.dot(o.normal)) * o.width * o.height;
  return sum;
}

V3d Openings::pointTowards(const V3d& direction, double u1, double u2, double u3) const {
  double due = u1 * areaTowards(direction);
  const Opening* chosen = nullptr;
  for (const Opening& o : openings_) {
    const double area = std::max(0., direction.dot(o.normal)) * o.width * o.height;
    if (area > 0) chosen = &o;
    if (due < area) break;
    due -= area;
  }
  return chosen->corner + u2 * chosen->width * chosen->x + u3 * chosen->height * chosen->y;
}

V3d Openings::sample(const Aim& aim, const V3d& point, double u1, double u2, double u3) const {
  const double due = u1 * aim.upTo[aim.count - 1];
  size_t chosen = 0;
  while (chosen + 1 < aim.count && !(due < aim.upTo[chosen])) ++chosen;
  const Opening& o = openings_[aim.opening[chosen]];
  return (o.corner + u2 * o.width * o.x + u3 * o.height * o.y - point).normalized();
}

double Openings::density(const Aim& aim, const V3d& point, const V3d& direction) const {
  double sum = 0, before = 0;
  for (size_t i = 0; i < aim.count; ++i) {
    const double chance = aim.upTo[i] - before;
    before = aim.upTo[i];
    const Opening& o = openings_[aim.opening[i]];
    const double cosine = -direction.dot(o.normal);
    if (!(cosine > 0)) continue;
    const V3d from = point - o.corner;
    const double distance = from.dot(o.normal) / cosine;
    const V3d at = from + distance * direction;
    const double u = at.dot(o.x), v = at.dot(o.y);
    if (u < 0 || v < 0 || u > o.width || v > o.height) continue;
    sum += chance * distance * distance / (cosine * o.width * o.height);
  }
  return sum / before;
}

}  // namespace rsphere
