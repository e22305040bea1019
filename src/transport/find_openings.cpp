#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/even_sequence.h"
#include "base/keep_largest.h"
#include "openings/holes.h"
#include "openings/panes.h"
#include "openings/tuning.h"
#include "shade/scattering.h"
#include "trace/tracer.h"
#include "transport/find_aims.h"
#include "transport/path_tracer.h"

namespace rsphere {
namespace {

// Whether panes close most of a hole. Tests five points: the middle, and one near each corner.
bool hasPane(const PreparedScene& prepared, const Rectangle& hole) {
  const double reach = .5 * std::min(hole.width, hole.height);
  int panes = 0;
  for (int c = 0; c < 5; ++c) {
    const V3d middle = c < 4 ? hole.at(.25 + .5 * (c & 1), .25 + .5 * (c >> 1)) : hole.at(.5, .5);
    const Hit hit = prepared.tracer().nearest(middle - reach * hole.normal, hole.normal, 2 * reach);
    if (hit.surface != kNone && lightPasses(prepared, prepared.scene().surfaces[hit.surface])) ++panes;
  }
  return panes > 2;
}

// Light that a pane or a hole receives from one side: mean brightness over the hemisphere (W/sr/m2).
struct Seen {
  double all = 0;
  // From the sky, neither reflected nor attenuated by panes. For a hole, also from places under the open sky:
  // behind an open window, an overhang or blinds may hide the sky itself.
  double sky = 0;
  double skyOfPanes = 0;  // the part of `sky` that comes through panes, other than the opening's own
};

// Whether `one` is the bright side of an opening.
bool showsMoreSky(const Seen& one, const Seen& other) {
  return one.sky > std::max(tuning::Openings::kMoreSky * other.sky, tuning::Openings::kLeastSky * one.all);
}
bool isBrighter(const Seen& one, const Seen& other) {
  return showsMoreSky(one, other) ||
         (!showsMoreSky(other, one) && one.all > tuning::Openings::kBrighter * other.all);
}

// Samples the light and the distances on both sides of panes and holes.
class Probe {
 public:
  // lift: distance of the ray origins from the rectangle (world units), larger than rounding errors.
  Probe(const PreparedScene& prepared, double lift)
      : t_(prepared), tracer_(prepared, noCaches_, Aims{}), lift_(lift) {}

  // The light that comes through an opening from the hemisphere around `normal`, one of its two normals.
  Seen through(const Opening& o, const V3d& normal) {
    Seen seen;
    look(o, normal, -lift_, [&](const V3d& point, const V3d& direction, uint64_t number) {
      const double bright = brightness(tracer_.glimpse(point, direction, number));
      int panes = o.isHole ? 1 : 0;  // behind a hole, the first pane counts: it is not the opening's own
      const auto last = beyondPanes(t_.scene(), t_.tracer(), point, direction, [&](const Surface& surface) {
        return lightPasses(t_, surface) && ++panes > 0;
      });
      seen.all += bright / tuning::Caps::kProbes;
      if (last && last->hit.surface == kNone) {
        const double sky = brightness(tracer_.glimpse(last->origin, direction, 0)) / tuning::Caps::kProbes;
        seen.sky += sky;
        seen.skyOfPanes += panes > 1 ? sky : 0;
      } else if (last && o.isHole && isUnderSky(*last, direction, number)) {
        seen.sky += bright / tuning::Caps::kProbes;
      }
    });
    return seen;
  }

  // Widens a pane over the gaps between it and what surrounds it, as where a frame stands in front of a
  // smaller pane: light that enters beside a portal would be left to paths from the eye. A strip beside the
  // pane is added if it is open to the sky, and on its dark side to the pane. Openings may not overlap: the
  // light of the common part would be counted twice.
  void widen(Opening& pane, std::span<const Opening> all) const {
    const double shortest = std::min(pane.width, pane.height), step = tuning::Openings::kGapStep * shortest;
    Rectangle turned = pane;
    for (int closed = 0; closed < 4 && pane.filled > tuning::Openings::kFilled * pane.area(); ++closed) {
      turned = {turned.at(1, 0), turned.y, -turned.x, turned.normal, turned.height, turned.width};
      Rectangle strip = turned;
      strip.corner -= step * strip.y;
      strip.height = step;
      const auto overlaps = [&](const Opening& o) {
        const Imath::Box2d there = extentIn(strip, o.corners());
        return &o != &pane && std::abs(strip.above(o.at(.5, .5))) < shortest && there.max.x > 0 &&
               there.min.x < strip.width && there.max.y > 0 && there.min.y < step;
      };
      int open = 0;
      look(strip, -strip.normal, -lift_, [&](const V3d& point, const V3d& direction, uint64_t) {
        open += t_.tracer().nearest(point, direction).surface == kNone &&
                t_.tracer().nearest(point, strip.y, step).surface == kNone;
      });
      if (open <= tuning::Caps::kProbes / 4 || std::ranges::any_of(all, overlaps)) continue;
      turned.corner = strip.corner;
      turned.height += step;
      static_cast<Rectangle&>(pane) = turned;
      closed = -1;
    }
  }

  // The room on the side of `normal`: mean brightness (W/sr/m2), and root mean square distance of its
  // surfaces (world units; 0 if nothing is hit).
  struct Room {
    double brightness = 0, distance = 0;
  };
  Room behind(const Rectangle& r, const V3d& normal) {
    Room room;
    double squares = 0, hits = 0;
    look(r, normal, lift_, [&](const V3d& point, const V3d& direction, uint64_t seed) {
      room.brightness += brightness(tracer_.glimpse(point, direction, seed)) / tuning::Caps::kProbes;
      const Hit hit = t_.tracer().nearest(point, direction);
      if (hit.surface == kNone) return;
      squares += hit.distance * hit.distance;
      ++hits;
    });
    room.distance = std::sqrt(squares / std::max(hits, 1.));
    return room;
  }

 private:
  using Look = FunctionRef<void(const V3d& point, const V3d& direction, uint64_t seed)>;
  static void look(const Rectangle& r, const V3d& normal, double lift, Look each) {
    for (int i = 0; i < tuning::Caps::kProbes; ++i) {
      const auto n = static_cast<size_t>(i);
      const Imath::V2d at = evenly(n, .5, .5), to = evenly(n, .1, .3);
      each(r.at(at.x, at.y) + lift * normal, diffuseDirection(normal, to.y, to.x), n);
    }
  }

  // Whether a random direction from a place that is hit leads to the sky.
  bool isUnderSky(const LastPart& last, const V3d& direction, uint64_t number) const {
    const V3d& n = last.hit.normal;
    const Imath::V2d to = evenly(number, .7, .9);
    const V3d next = diffuseDirection(n.dot(direction) > 0 ? -n : n, to.y, to.x);
    const V3d place = last.origin + last.hit.distance * direction;
    return t_.tracer().nearest(place, next, kFarAway, last.hit.surface).surface == kNone;
  }

  const PreparedScene& t_;
  const Caches noCaches_;
  PathTracer tracer_;
  double lift_;
};

static_assert(kShapes == 8, "May a new shape be a window pane?");
std::vector<Opening> panesOf(const PreparedScene& prepared, double leastArea) {
  const Scene& scene = prepared.scene();
  std::vector<Opening> panes;
  for (const Surface& surface : scene.outermost()) {
    const auto* polygon = surface.shape.as<Polygon>();
    const double area = polygon ? areaOf(*polygon, scene.vertices) : 0;
    if (!polygon || area < leastArea || !lightPasses(prepared, surface)) continue;
    panes.push_back({rectangleAround(scene, {&polygon, 1}), area});
  }
  return panes;
}

// Holes in walls, with and without panes. None without distant sources, because there is no sky to see.
std::vector<Rectangle> holesInWalls(const PreparedScene& prepared, double leastArea) {
  if (prepared.lights().distant().empty()) return {};
  const Scene& scene = prepared.scene();
  return holesOf(scene, prepared.tracer().bounds(), leastArea, [&](const Surface& surface) {
    const Material* material = scene.materialOf(surface);
    return material && !enclosesVolume(*material) && !isLightSource(*material) &&
           !lightPasses(prepared, surface);
  });
}

// The mouth of the shaft behind an opening: the farthest hole that may be one.
std::optional<Rectangle> mouthOf(const Opening& o, std::span<const Rectangle> holes) {
  using Limits = tuning::Openings;
  std::optional<Rectangle> mouth;
  double deepest = Limits::kLeastDepth * std::min(o.width, o.height);
  for (const Rectangle& hole : holes) {
    const V3d way = hole.at(.5, .5) - o.at(.5, .5);
    const double depth = way.dot(o.normal), aside = (way - depth * o.normal).length();
    const double shortest = std::min({o.width, o.height, hole.width, hole.height});
    if (std::abs(o.normal.dot(hole.normal)) < Limits::kParallel || depth < deepest ||
        depth > Limits::kMostDepth * std::max(o.width, o.height) || aside > Limits::kSameHole * shortest ||
        std::max(hole.area() / o.area(), o.area() / hole.area()) > Limits::kWidening)
      continue;
    deepest = depth;
    mouth = hole;
    mouth->normal = o.normal;
  }
  return mouth;
}

// Whether a hole differs from all openings found so far. A thick wall has two faces, each with a hole for one
// opening.
bool isNewPlace(const Opening& hole, std::span<const Opening> openings) {
  return std::ranges::none_of(openings, [&](const Opening& o) {
    return std::abs(o.normal.dot(hole.normal)) > tuning::Openings::kParallel &&
           (o.at(.5, .5) - hole.at(.5, .5)).length() <
               tuning::Openings::kSameHole * std::min({o.width, o.height, hole.width, hole.height});
  });
}

// Merges neighbouring panes that are separated only by small gaps.
void merge(std::vector<Opening>& panes) {
  for (size_t i = 0; i < panes.size(); ++i)
    for (size_t j = i + 1; j < panes.size();) {
      Opening& a = panes[i];
      const Opening& b = panes[j];
      // Panes within these tolerances are coplanar: 1e-4 of their size, and an angle of .08 degrees.
      const double scale = 1e-4 * (a.width + a.height);
      Imath::Box2d around = extentIn(a, b.corners());
      around.extendBy({{0, 0}, {a.width, a.height}});
      const Imath::V2d size = around.size();
      const bool together = a.normal.dot(b.normal) > 1 - 1e-6 && std::abs(a.above(b.corner)) < scale &&
                            size.x * size.y * tuning::Openings::kFilled < a.filled + b.filled;
      if (!together) {
        ++j;
        continue;
      }
      a.corner += around.min.x * a.x + around.min.y * a.y;
      a.width = size.x;
      a.height = size.y;
      a.filled += b.filled;
      a.power += b.power;
      a.isIndoors = a.isIndoors && b.isIndoors;
      panes.erase(panes.begin() + static_cast<ptrdiff_t>(j));
      j = i + 1;
    }
}

// The area of a wall as wide and high as the scene (square world units), with which areas of openings are
// compared. Compared with the area of a ground of 1 km, the windows of a room would be too small. If the
// scene is flat, the height is a thousandth of the width.
double wallOf(const V3d& size) {
  const auto [least, most] = std::minmax({size.x, size.y, size.z});
  return most * std::max(least, 1e-3 * most);
}

// Panes, and holes that no pane closes, that may be openings: the largest first.
std::vector<Opening> candidates(const PreparedScene& prepared, double leastArea,
                                std::span<const Rectangle> holes) {
  std::vector<Opening> asked = panesOf(prepared, leastArea);
  for (const Rectangle& hole : holes)
    if (!hasPane(prepared, hole)) asked.push_back({hole, hole.area(), true});
  keepLargest(asked, tuning::Caps::kAsked, [](const Opening& o) { return o.area(); });
  return asked;
}

}  // namespace

Openings findOpenings(const PreparedScene& prepared) {
  const Box3d& bounds = prepared.tracer().bounds();
  if (bounds.isEmpty()) return {{}, 0, 0};
  const V3d size = bounds.size();
  const double leastArea = tuning::Openings::kLeastArea * wallOf(size);
  const std::vector<Rectangle> holes = holesInWalls(prepared, leastArea);
  std::vector<Opening> asked = candidates(prepared, leastArea, holes), found;
  if (asked.empty()) return {{}, 0, 0};
  Probe probe(prepared, std::max(1e-6 * std::max({size.x, size.y, size.z}), 2 * prepared.scene().samePlace));
  double all = 0, inside = 0, depth = 0;
  for (Opening& opening : asked) {
    const Seen along = probe.through(opening, opening.normal),
               against = probe.through(opening, -opening.normal);
    const auto& judge = opening.isHole ? showsMoreSky : isBrighter;
    const bool above = judge(along, against);
    if (!above && !judge(against, along)) continue;
    if (opening.isHole && !isNewPlace(opening, found)) continue;
    if (above) opening.normal = -opening.normal;
    const Probe::Room room = probe.behind(opening, opening.normal);
    if (!(room.distance > 0)) continue;  // no surface receives its light
    const Seen& bright = above ? along : against;
    opening.power = bright.all * opening.filled;
    opening.isIndoors = bright.skyOfPanes >= bright.sky / 2;
    inside += opening.power * room.brightness;
    depth += opening.power * room.distance;
    all += opening.power;
    found.push_back(opening);
  }
  if (all > 0) {
    inside /= all;
    depth /= all;
  }
  for (Opening& opening : found)
    if (!opening.isHole) probe.widen(opening, found);
  merge(found);
  for (Opening& opening : found) {
    opening.radiance = opening.power / opening.filled;
    opening.mouth = mouthOf(opening, holes);
  }
  keepLargest(found, tuning::Caps::kAimed, [](const Opening& o) { return o.power; });
  return {std::move(found), inside, depth};
}

}  // namespace rsphere
