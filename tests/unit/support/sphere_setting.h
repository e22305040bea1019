#pragma once
#include <functional>
#include <memory>
#include <utility>

#include "cli/option_table.h"
#include "estimate/estimator.h"

namespace rsphere {

// A scene in sphere mode: the mode's options, but for what `change` does to those of rays.
struct SphereSetting {
  Scene scene;
  Options options = modeDefaults(true);
  std::unique_ptr<Transport> transport;

  explicit SphereSetting(Scene it, const std::function<void(RayOptions&)>& change = {})
      : scene(std::move(it)) {
    if (change) change(options.ray);
    transport = std::make_unique<Transport>(scene, options.ray, IrradianceAt::none);
  }

  SphereTracing tracing(const Aims& aims = {}) const {
    return {transport->prepared(), transport->caches(), aims};
  }
};

}  // namespace rsphere
