#include "contrib/contribution_defaults.h"

namespace rsphere {

void setContributionDefaults(RayOptions& options) {
  options.ambientBounces = 1;
  options.ambientDivisions = 350;
  options.ambientSuperSamples = 0;
  options.firstRays = 0;
  options.ambientAccuracy = 0;
  options.directThreshold = 0;
  options.directJitter = .9;
  options.directRelays = 3;
  options.specularThreshold = .02;
  options.weightLimit = 2e-3;
}

void limitToContributions(RayOptions& options) {
  options.ambientAccuracy = 0;
  options.ambientSuperSamples = 0;
  options.directThreshold = 0;
  options.ambientFile.clear();
}

}  // namespace rsphere
