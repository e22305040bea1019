#include "spots/bright_spots.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/frame.h"
#include "base/vector_widths.h"
#include "openings/panes.h"
#include "spots/light_particles.h"
#include "spots/tuning.h"

namespace rsphere {
namespace {

// Lower bound on the squared sine of a spot's angular radius. In single precision, smaller spots cannot be
// distinguished from points.
constexpr float kNarrowest = 1e-6f;

// 1 - cosine of the angle with this squared sine, without loss of precision for small angles.
double versineOf(double sine2) { return sine2 / (1 + std::sqrt(1 - sine2)); }

}  // namespace

// A place where light from a source hit a diffuse surface.
struct BrightSpots::Particle {
  V3d point, normal;
  double power;  // reflected
  double free;   // distance to the next surface in a random direction
};

// A group of neighbouring particles, and the spot that they form.
struct BrightSpots::Node {
  std::span<Particle> particles;
  Box3d box;  // around the particles
  Spot spot;
  double area = 0;
  double samePlace;  // Scene::samePlace

  Node(std::span<Particle> some, double same) : particles(some), samePlace(same) {
    for (const Particle& p : some) box.extendBy(p.point);
    std::array<double, 3> sides{box.size().x, box.size().y, box.size().z};
    std::ranges::sort(sides);
    area = std::max(sides[1], samePlace) * std::max(sides[2], samePlace);
    spot.center = box.center();
    spot.radius = std::max(.5 * tuning::BrightSpots::kWider * box.size().length(), 4 * samePlace);
    for (const Particle& p : some) {
      if (p.free < spot.radius) continue;  // in a narrow gap, whose light reaches no other surface
      spot.power += p.power;
      spot.normal += p.normal * p.power;
    }
    if (spot.power > 0) spot.normal /= spot.power;
  }
  Sunlit sunlit() const {
    Sunlit found{box, spot.normal, spot.power / (kPi * area), {}};
    for (size_t i = 0; i < found.places.size(); ++i)
      found.places[i] = particles[(2 * i + 1) * particles.size() / (2 * found.places.size())].point;
    return found;
  }
  // The product of the light that the spot reflects and its brightness. Aiming at spots of higher worth
  // reduces the variance more.
  double worth() const { return spot.power * spot.power / area; }
  std::pair<Node, Node> halves() const {
    const auto axis = static_cast<int>(box.majorAxis());
    const size_t half = particles.size() / 2;
    std::nth_element(particles.begin(), particles.begin() + static_cast<ptrdiff_t>(half), particles.end(),
                     [axis](const Particle& a, const Particle& b) { return a.point[axis] < b.point[axis]; });
    return {Node(particles.first(half), samePlace), Node(particles.subspan(half), samePlace)};
  }
};

static_assert(kMaterialTypes == 19, "Is it a pane that light passes?");
// Follows a particle to the first diffuse surface, through panes; empty if it reaches none.
std::optional<BrightSpots::Particle> BrightSpots::arrived(const Scene& scene, const Tracer& tracer,
                                                          const V3d& origin, const V3d& direction,
                                                          double power, Random& random) {
  const auto last = beyondPanes(scene, tracer, origin, direction, [&](const Surface& surface) {
    if (!std::holds_alternative<Glass>(*scene.materialOf(surface))) return false;
    power *= tuning::BrightSpots::kTransmittance;
    return true;
  });
  if (!last || last->hit.surface == kNone) return {};
  const Hit& hit = last->hit;
  const auto diffuse = diffuseReflection(*scene.materialOf(scene.surfaces[hit.surface]));
  if (!diffuse) return {};
  power *= brightness(diffuse->color) * diffuse->share;
  if (!(power > 0)) return {};  // black surfaces would hide the extent of a spot
  const V3d point = last->origin + hit.distance * direction,
            front = hit.cosine < 0 ? -hit.normal : hit.normal;
  const V3d back = sentFrom(front, random);
  return Particle{point, front, power, tracer.nearest(point, back, kFarAway, hit.surface).distance};
}

// Traces particles from distant sources through the openings, from their bright side to their dark side.
std::vector<BrightSpots::Particle> BrightSpots::particlesThrough(const Openings& openings, const Scene& scene,
                                                                 const Tracer& tracer,
                                                                 const LightSources& lights) const {
  struct Sent {
    V3d direction;
    double power;  // W
  };
  std::vector<Sent> sent;
  for (const LightSource& light : lights.all()) {
    if (light.isVirtual()) continue;
    const Surface& surface = scene.surfaces[light.surface];
    const auto* distant = surface.shape.as<Distant>();
    const double radiance = brightness(sourceRadiance(scene, surface));
    if (!distant || !(radiance > 0)) continue;
    const double all = areaTowards(openings.all(), -distant->direction);
    if (all > 0) sent.push_back({-distant->direction, radiance * distant->solidAngle * all});
  }
  // Hundreds of suns, as of a year of daylight, share the particles.
  const auto count = static_cast<int>(
      std::ceil(tuning::BrightSpots::kParticles / static_cast<double>(std::max<size_t>(1, sent.size()))));
  std::vector<Particle> found;
  Random random(1);
  for (const auto& [direction, power] : sent)
    for (int i = 0; i < count; ++i) {
      const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform();
      const V3d in = pointTowards(openings.all(), direction, u1, u2, u3);
      if (tracer.nearest(in, -direction).surface != kNone) continue;
      if (const auto particle = arrived(scene, tracer, in, direction, power / count, random))
        found.push_back(*particle);
    }
  return found;
}

std::vector<BrightSpots::Particle> BrightSpots::particles(const Scene& scene, const Tracer& tracer,
                                                          const LightSources& lights,
                                                          const SurfaceFunctions& functions) const {
  std::vector<Particle> found;
  sendParticles(scene, tracer, lights, functions, tuning::BrightSpots::kParticles,
                [&](const V3d& origin, const V3d& direction, double power, const Surface&, Random& random) {
                  if (const auto particle = arrived(scene, tracer, origin, direction, power, random))
                    found.push_back(*particle);
                });
  return found;
}

// The mean square of the distances across the rooms that receive the light of some particles (square world
// units); 0 if there are too few. Measured at the ends of random walks, which spread all over the rooms:
// where the particles are, a shaft may be much narrower.
double BrightSpots::meanSquareAcrossRooms(std::span<const Particle> particles, const Tracer& tracer) {
  double sum = 0;
  size_t count = 0;
  Random random(2);
  for (size_t i = 0; i < particles.size(); i += tuning::BrightSpots::kForEachWalk) {
    V3d point = particles[i].point, normal = particles[i].normal;
    Hit hit;
    for (int k = 0; k < tuning::BrightSpots::kStepsOfWalk; ++k) {
      const V3d direction = sentFrom(normal, random);
      hit = tracer.nearest(point, direction, kFarAway, hit.surface);
      if (hit.surface == kNone) break;
      point += hit.distance * direction;
      normal = hit.cosine < 0 ? -hit.normal : hit.normal;
    }
    if (hit.surface == kNone) continue;
    sum += hit.distance * hit.distance;
    ++count;
  }
  return count >= tuning::BrightSpots::kFewest ? sum / static_cast<double>(count) : 0;
}

BrightSpots::BrightSpots(const Scene& scene, const Tracer& tracer, const LightSources& lights,
                         const SurfaceFunctions& functions, const Openings* openings)
    : samePlace_(scene.samePlace) {
  if (tracer.bounds().isEmpty()) return;
  spots_.origin = tracer.bounds().center();
  if (openings) {
    std::vector<Particle> inside = particlesThrough(*openings, scene, tracer, lights);
    const double squared = meanSquareAcrossRooms(inside, tracer);
    if (squared > 0) {
      for (const Node& node : find(inside, tuning::BrightSpots::kRoomSurface * squared,
                                   tuning::Caps::kAimed / 2, tuning::BrightSpots::kBrighter / 2, 1))
        sunlit_.push_back(node.sunlit());
    }
  }
  std::vector<Particle> everywhere = particles(scene, tracer, lights, functions);
  find(everywhere, scene.area(), tuning::Caps::kAimed, tuning::BrightSpots::kBrighter,
       tuning::BrightSpots::kBrighter);
}

std::vector<BrightSpots::Node> BrightSpots::find(std::span<Particle> all, double area, size_t most,
                                                 double brighter, double leastWorth) {
  double power = 0;
  for (const Particle& p : all) power += p.power;
  if (!(power > 0) || !(area > 0)) return {};
  const double usual = power / area;

  // Particles are halved recursively down to the smallest groups. The group to divide next is the one whose
  // worth grows most if it is divided completely. The gain of a single division would be misleading: dividing
  // a room in half gains almost nothing until the spot of its lamp is isolated.
  struct Branch {
    Node node;
    double finest = 0;  // total worth of the smallest groups in it
    size_t halves = 0;  // index of its first half; 0: not divided
    double gain() const { return halves > 0 ? finest - node.worth() : 0; }
  };
  std::vector<Branch> tree{{Node(all, samePlace_)}};
  for (size_t i = 0; i < tree.size(); ++i) {
    if (tree[i].node.particles.size() < 2 * tuning::BrightSpots::kFewest) continue;
    auto halves = tree[i].node.halves();
    tree[i].halves = tree.size();
    tree.push_back({std::move(halves.first)});
    tree.push_back({std::move(halves.second)});
  }
  for (size_t i = tree.size(); i-- > 0;) {
    const size_t halves = tree[i].halves;
    tree[i].finest = halves > 0 ? tree[halves].finest + tree[halves + 1].finest : tree[i].node.worth();
  }
  const auto isBright = [&](const Branch* branch) {
    return branch->node.spot.power > brighter * usual * branch->node.area;
  };
  std::vector<const Branch*> chosen{&tree.front()};
  while (spots_.count + static_cast<size_t>(std::ranges::count_if(chosen, isBright)) < most) {
    const auto best = std::ranges::max_element(
        chosen, [](const Branch* a, const Branch* b) { return a->gain() < b->gain(); });
    if (!((*best)->gain() > tuning::BrightSpots::kLeastGain * tree.front().finest)) break;
    const Branch* halves = &tree[(*best)->halves];
    *best = halves;
    chosen.push_back(halves + 1);
  }
  std::erase_if(chosen, [&](const Branch* branch) { return !isBright(branch); });
  double worth = 0;
  for (const Branch* branch : chosen) worth += branch->node.worth();
  if (!(worth > leastWorth * usual * power)) return {};
  if (empty()) usual_ = usual / kPi;
  std::vector<Node> nodes;
  for (const Branch* branch : chosen) {
    keep(branch->node.spot);
    nodes.push_back(branch->node);
  }
  return nodes;
}

void BrightSpots::keep(const Spot& spot) {
  const size_t i = spots_.count++;
  const V3d center = spot.center - spots_.origin;
  spots_.x[i] = static_cast<float>(center.x);
  spots_.y[i] = static_cast<float>(center.y);
  spots_.z[i] = static_cast<float>(center.z);
  spots_.normalX[i] = static_cast<float>(spot.normal.x);
  spots_.normalY[i] = static_cast<float>(spot.normal.y);
  spots_.normalZ[i] = static_cast<float>(spot.normal.z);
  spots_.radius[i] = static_cast<float>(spot.radius);
  spots_.anyway[i] = static_cast<float>(1 - spot.normal.length() + tuning::Highlights::kEdgeOn);
  spots_.power[i] = static_cast<float>(spot.power);
}

// A spot is treated as a small flat surface with the spot's normal. Spots that contain the point or are near
// it are ignored.
RSPHERE_FOR_WIDTHS("avx2") void BrightSpots::aim(const AimFrom& from, Aim& aim) const {
  const auto& [point, front, rays, all] = from;
  const Imath::V3f at(point - spots_.origin), ahead(front);
  const auto negligible = static_cast<float>(samePlace_ * samePlace_);  // so that no squared distance is 0
  Spots::Numbers comes;
  for (size_t i = 0; i < spots_.count; ++i) {
    const float x = spots_.x[i] - at.x, y = spots_.y[i] - at.y, z = spots_.z[i] - at.z;
    const float squared = x * x + y * y + z * z + negligible, inverse = 1 / std::sqrt(squared);
    const float cosine = (x * ahead.x + y * ahead.y + z * ahead.z + spots_.radius[i]) * inverse;
    const float facing =
        spots_.anyway[i] - (x * spots_.normalX[i] + y * spots_.normalY[i] + z * spots_.normalZ[i]) * inverse;
    const float before = std::min(std::max(cosine, 0.f), 1.f), seen = std::min(std::max(facing, 0.f), 1.f);
    const float apart =
        squared > tuning::BrightSpots::kApart * spots_.radius[i] * spots_.radius[i] ? 1.f : 0.f;
    comes[i] = apart * spots_.power[i] * before * seen * inverse * inverse;
    aim.x[i] = x;
    aim.y[i] = y;
    aim.z[i] = z;
    const float sine2 = spots_.radius[i] * spots_.radius[i] * inverse * inverse;
    aim.sine2[i] = std::max(sine2, kNarrowest);
    aim.squared[i] = squared;
  }
  float sum = 0;
  for (size_t i = 0; i < spots_.count; ++i) aim.sum[i] = sum += comes[i];
  aim.count = spots_.count;
  aim.mean = sum / (kPi * kPi);
}

V3d BrightSpots::sample(const Aim& aim, double u1, double u2, double u3) const {
  // Below 1 in single precision, too: 1 would select the last spot even if that contributes nothing because
  // it contains the point, and there are no directions to a spot around the point.
  const float due = std::min(static_cast<float>(u1), 1 - 0x1p-24f) * aim.sum[aim.count - 1];
  size_t i = 0;
  while (i + 1 < aim.count && !(due < aim.sum[i])) ++i;
  const V3d axis = V3d(aim.x[i], aim.y[i], aim.z[i]).normalized();
  const auto [x, y] = frame(axis);
  const double versine = u2 * versineOf(aim.sine2[i]), sine = std::sqrt(versine * (2 - versine));
  return sine * std::cos(2 * kPi * u3) * x + sine * std::sin(2 * kPi * u3) * y + (1 - versine) * axis;
}

RSPHERE_FOR_WIDTHS("avx2") double BrightSpots::density(const Aim& aim, const V3d& direction) const {
  const auto dx = static_cast<float>(direction.x), dy = static_cast<float>(direction.y),
             dz = static_cast<float>(direction.z);
  std::array<bool, kRoom> in;
  for (size_t i = 0; i < aim.count; ++i) {
    const float x = aim.x[i], y = aim.y[i], z = aim.z[i];
    // The cross product is precise for small angles; the cosine is not.
    const float cx = y * dz - z * dy, cy = z * dx - x * dz, cz = x * dy - y * dx;
    in[i] = (cx * cx + cy * cy + cz * cz <= aim.sine2[i] * aim.squared[i]) & (x * dx + y * dy + z * dz > 0);
  }
  double sum = 0;
  for (size_t i = 0; i < aim.count; ++i) {
    const double chance = i > 0 ? aim.sum[i] - aim.sum[i - 1] : aim.sum[i];
    if (!in[i] || !(chance > 0)) continue;
    sum += chance / (2 * kPi * versineOf(aim.sine2[i]));
  }
  return sum / aim.sum[aim.count - 1];
}

}  // namespace rsphere
