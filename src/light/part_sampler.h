#pragma once
// The samples of one light source as seen from a point: how each map of LightSource is divided into parts, and
// how a part is sampled.
#include "light/sources.h"

namespace rsphere {

// A part of the unit square that is mapped to a source.
struct SourcePart {
  double s0 = 0, s1 = 1, t0 = 0, t1 = 1;
};

class PartSampler {
 public:
  // Keeps references. Samples of the source, which has this index, are appended to `samples`.
  PartSampler(const LightSource& source, LightId index, const Scene& scene, const V3d& point,
              const SourceSampling& how, Random& random, std::vector<SourceSample>& samples)
      : source_(source),
        index_(index),
        scene_(scene),
        point_(point),
        jitter_(how.jitter),
        allowed_(how.largest / 2),
        random_(random),
        samples_(samples) {}

  // Adds the samples of all parts. towards: the vector to the source's center, or the unit direction to a
  // distant source. REQUIRES that the source has passed the tests in LightSources::sample().
  void sample(const V3d& towards);

 private:
  // A sample in a direction (unit) that represents a solid angle (sr). Nothing is added if the ray does not
  // hit the source. length: the distance to the point on or in the source that it is aimed at, which is
  // compared with the reach.
  void add(const V3d& direction, double solidAngle, double length);
  bool hit(const V3d& direction, double length, SourceSample& sample) const;

  void addRound(const V3d& middle, double sine, double distance);
  void addDistant(double distance);
  void addTube(const V3d& towards);
  void addMiddle(const V3d& aim, double length, double area);
  void addMiddles(const V3d& towards);
  void addNear(const SourcePart& part);
  template <class Position>
  void addPlane(const Position& at);

  const LightSource& source_;
  LightId index_;
  const Scene& scene_;
  const V3d& point_;
  double jitter_;   // -dj
  double allowed_;  // the limit for the half-extents of parts relative to their distance (-ds)
  Random& random_;
  std::vector<SourceSample>& samples_;
};

}  // namespace rsphere
