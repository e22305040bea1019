#pragma once
#include <cmath>

#include "shade/material_hit.h"

namespace rsphere {

// A hit on a surface in the plane z = 0, from straight above or below unless another interaction is given.
class FakeHit final : public MaterialHit {
 public:
  FakeHit(const Arrival& arrival, MaterialContext& context) : MaterialHit(arrival, ModifierId(0), context) {
    at_.cosine = std::abs(arrival.cosine);
    at_.front = arrival.cosine > 0;
    at_.normal = V3d(0, 0, at_.front ? 1 : -1);
    at_.direction = -at_.normal;
    at_.kinds = arrival.kinds;
    at_.pattern = Color(.5, .5, .5);
  }
  FakeHit(const Interaction& at, MaterialContext& context)
      : MaterialHit({}, ModifierId(0), context), at_(at) {}

  Interaction interaction() const override { return at_; }
  const Color& pattern() const override { return at_.pattern; }
  Interaction interactionAfter(ModifierId) const override { return at_; }
  FunctionPoint point() const override { return {}; }
  const Medium& medium() const override { return medium_; }
  V3d towardsSource() const override { return V3d(0, 0, 1); }
  int samplesOf(double) const override { return 1; }

  bool turned = false;

 private:
  void applyModifiers() override {}
  void turnToFront() override { turned = true; }

  Interaction at_;
  Medium medium_{Color(.1, .1, .1), {}, 0};
};

}  // namespace rsphere
