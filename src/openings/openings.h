#pragma once
// Portals of daylight: panes with a bright and a dark side, and holes in walls. A small window provides most
// of the light in a room, but few directions of a hemisphere hit it. Some rays of each gather are therefore
// aimed at openings, with multiple importance sampling (balance heuristic: Veach and Guibas 1995). Missing or
// wrong openings change the variance, not the mean.
//
// Source: Bitterli, Novák, Jarosz, "Portal-masked environment map sampling" (Computer Graphics Forum 34,
// 2015). Differences: portals are found automatically, and sampled by area.
#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "openings/light_finder.h"
#include "openings/proposals.h"
#include "openings/rectangle.h"
#include "openings/tuning.h"

namespace rsphere {

// Panes or a hole, with their bounding rectangle, and gaps beside panes. Its normal points to the dark side,
// which receives light through the opening.
struct Opening : Rectangle {
  double filled = 0;  // area of its panes or of the hole (square world units)
  bool isHole = false;
  double radiance = 0;  // brightness, mean of the light that enters (W/sr/m2)
  double power = 0;     // of the light that enters: radiance times `filled`
  // It sees no sky, or most of it through other panes: a glass partition, the mouth of a skylight's shaft.
  bool isIndoors = false;
  // The hole by which light leaves a shaft behind the panes, with the same normal. Beyond it, the panes are
  // seen only through it, and so are the walls of the shaft, which they light.
  std::optional<Rectangle> mouth = std::nullopt;

  // What a point sees of the opening: the mouth if the point lies beyond it.
  const Rectangle& seenFrom(const V3d& point) const {
    return mouth && mouth->above(point) > 0 ? *mouth : *this;
  }
  // The area of the parts that send light to the point (square world units).
  double filledFrom(const V3d& point) const {
    const Rectangle& seen = seenFrom(point);
    return &seen == this ? filled : seen.area();
  }
};

// The projected area (square world units) of openings for light that enters in this direction (unit).
inline double areaTowards(std::span<const Opening> openings, const V3d& direction) {
  double sum = 0;
  for (const Opening& o : openings) sum += std::max(0., direction.dot(o.normal)) * o.area();
  return sum;
}

// A point on the openings, uniform by projected area; u1, u2, u3: uniform in [0, 1). REQUIRES a projected
// area above 0.
inline V3d pointTowards(std::span<const Opening> openings, const V3d& direction, double u1, double u2,
                        double u3) {
  double due = u1 * areaTowards(openings, direction);
  const Opening* chosen = nullptr;
  for (const Opening& o : openings) {
    const double area = std::max(0., direction.dot(o.normal)) * o.area();
    if (area > 0) chosen = &o;
    if (due < area) break;
    due -= area;
  }
  return chosen->at(u2, u3);
}

// What openings and their images have in common as a LightFinder: rectangles, sampled by area.
template <class Place>
class AimedAtOpenings {
 public:
  bool empty() const { return places_.empty(); }
  // In descending order of power.
  std::span<const Place> all() const { return places_; }
  // The mean brightness (W/sr/m2) behind the openings, on their dark sides.
  double inside() const { return inside_; }

  // The sampling distribution for a point of a diffuse surface.
  struct Aim : Proposals<tuning::Caps::kAimed> {
    double seen = 0;  // form factor from the point to all places
  };
  static constexpr AimedAt kKind = AimedAt::openings;
  V3d sample(const Aim& aim, double u1, double u2, double u3) const {
    return (places_[aim.number[aim.chosen(u1)]].seenFrom(aim.point).at(u2, u3) - aim.point).normalized();
  }
  double density(const Aim& aim, const V3d& direction) const {
    double sum = 0;
    for (size_t i = 0; i < aim.count; ++i)
      sum += (aim.upTo[i] - aim.before(i)) *
             densityTo(places_[aim.number[i]].seenFrom(aim.point), aim.point, direction);
    return sum / aim.before(aim.count);
  }

 protected:
  AimedAtOpenings(std::vector<Place> places, double inside) : places_(std::move(places)), inside_(inside) {}

  // Aims at the first places. counts(place, at): whether the point of the place sends light to `from`.
  template <class Counts>
  void aimAtFirst(size_t places, const AimFrom& from, Aim& aim, Counts counts) const {
    aim.clear();
    aim.seen = 0;
    for (uint32_t i = 0; i < places; ++i) {
      const Place& place = places_[i];
      const double factor = formFactorTo(place.seenFrom(from.point), place.filledFrom(from.point), from.point,
                                         from.normal, [&](const V3d& at) { return counts(place, at); });
      if (!(factor > 0)) continue;
      aim.seen += factor;
      aim.add(i, factor * kPi * place.radiance);
    }
    aim.finish(from.point);
  }

  std::vector<Place> places_;

 private:
  double inside_;
};

class Openings : public AimedAtOpenings<Opening> {
 public:
  // Made by findOpenings(). inside, depth: results of the functions inside() and depth().
  Openings(std::vector<Opening> openings, double inside, double depth)
      : AimedAtOpenings(std::move(openings), inside), depth_(depth) {}

  // The mean distance of the surfaces behind the openings (world units), as a measure of the size of rooms.
  double depth() const { return depth_; }

  // See LightFinder.
  void aim(const AimFrom& from, Aim& aim) const {
    aimAtFirst(places_.size(), from, aim, [](const Opening&, const V3d&) { return true; });
  }

 private:
  double depth_;
};

}  // namespace rsphere
