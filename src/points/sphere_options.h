#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/constants.h"
#include "points/kernels.h"

namespace rsphere {

struct GlareOptions {
  bool wanted = false;  // -Su
  // -Sub  Luminance above which regions other than light sources are glare sources. Values above kFixed are
  // in cd/m2. Smaller values are factors on the mean luminance of the task or, without a task, of the whole
  // view.
  double threshold = 2000;
  // -Sut  The task is a disk around the direction this far below the line of sight; degrees.
  double taskBelow = 0;
  double taskOpening = 0;  // diameter of the disk, degrees; 0: no task

  static constexpr double kFixed = 100;
  bool isFixed() const { return threshold > kFixed; }
};

// How the directions of a point are weighted, and the letters of -Sw in their order.
enum class Weights : uint8_t { homogeneous, voronoi, silhouettes };
inline constexpr std::string_view kWeightsLetters = "hvc";

// The options of the estimator of sphere mode.
struct SphereOptions {
  int baseDirections = 2048;                    // -Sn  1 to 1,000,000
  int mostDirections = 4096;                    // -Sx  of one set
  int mostForAccuracy = 0;                      // limit for all sets of -Sa, if it is larger than -Sx
  double densityFactor = 1;                     // -Sk
  double accuracy = 0;                          // -Sa  0: off; also of rays
  double accuracyFloor = -1;                    // -Sa  least value (W/sr/m2; W/m2 with -i and -I) to which
                                                // the accuracy refers; below 0: found from the scene
  Weights weights = Weights::silhouettes;       // -Sw
  bool basicRadiance = false;                   // -Sb
  bool everyDirection = false;                  // -Sd
  uint64_t rotation = 0;                        // -Sr
  int zones = 0;                                // -Sz  number of zones or bins; 0: none
  std::string zoneOf, zoneCount;                // -Szb -Szn  expressions for bins; empty: not given
  std::shared_ptr<const DirectionBins> bins{};  // from these expressions; their number is `zones`
  double azimuth = 0;                           // -So  degrees, from x towards y
  Kernels::Some quantityErrors{};               // quantities other than the mean that have standard errors
  GlareOptions glare;                           // -Su -Sub -Sut

  // The default numbers of light paths and of rays of patches, which all points share, suffice down to this
  // accuracy (-Sa). Below, these numbers grow with its inverse square, up to limits.
  static constexpr double kUsualAccuracy = .01;

  // The rays of each patch of the coarse solution (RayOptions::leastForPatches). Their number grows with the
  // number of directions and with the accuracy, so that the error common to all points falls with the error
  // of directions. Measured in four daylit rooms (-aa .1, -Sn 512 to 4096): the actual errors of answers are
  // .8 to 1.3 times the stated ones, and the error of directions alone falls with the power .75 of their
  // number.
  int raysForPatches() const {
    constexpr double kUsual = 1024, kUsualDirections = 2048, kMost = 1e6;
    const double part = baseDirections / kUsualDirections;
    const double finer = accuracy > 0 ? kUsualAccuracy / accuracy : 0;
    return static_cast<int>(
        std::clamp(kUsual * std::max({part, std::pow(part, 1.5), finer * finer}), 1., kMost));
  }

  // The horizontal direction that the half cylinder of -oS faces.
  V3d facing() const { return {std::cos(radians(azimuth)), std::sin(radians(azimuth)), 0}; }

  // Cap on the directions at one point, over all sets of -Sa.
  int mostOfAllSets() const { return std::max(mostDirections, mostForAccuracy); }
};

}  // namespace rsphere
